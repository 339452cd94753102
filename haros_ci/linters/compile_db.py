# SPDX-License-Identifier: Apache-2.0
"""compile_commands.json, read as hostile data: which flags may pass on to a tool, and which files have any.

Format: clang's "JSON Compilation Database Format Specification". Its commands are never run.
"""

from __future__ import annotations

import json
import os
import stat
from collections.abc import Collection, Iterable, Iterator, Sequence
from pathlib import Path

from haros_ci.linters import sandbox
from haros_ci.linters.linter import LintOptions
from haros_ci.linters.paths import is_viewed
from haros_ci.model.workspace import Workspace

#: A database beyond this many bytes is not read.
SIZE_LIMIT = 100_000_000
SYSTEM_PREFIXES = ("/usr", "/opt", "/lib", "/Library", "/Applications")
DIRECTORY_FLAGS = ("-isystem", "-iquote", "-I")
#: Directories of the checkout in which a build leaves headers; no revision has them.
_MADE_BY_BUILDS = frozenset(("build", "install", "devel"))
#: Flags whose value cannot name a file, with the value attached or following.
PLAIN_FLAGS = ("-std=", "-D", "-U", "-x", "-W")


def flags_by_file(workspace: Workspace, options: LintOptions) -> dict[str, tuple[str, ...]]:
    """For every workspace file in the database its harmless flags, include directories absolute.

    The database lies where the options say, relative to the user's checkout, or in its ``build``. Its paths into the
    checkout stand for the same places in *workspace*, which may be a base revision. Anything unexpected in it is left
    out, never an error. Where tools are kept from what lies elsewhere, or the workspace is trusted, directories of headers that
    a build has made in the checkout stand for themselves.
    """
    checkout, root = os.path.realpath(options.root or workspace.root), os.path.realpath(workspace.root)
    try:
        entries = json.loads(_read(Path(checkout), options.compile_database, workspace.hiding.databases))
    except (ValueError, RecursionError):
        return {}
    known = {file.path for file in workspace.files}
    built = options.trust_config or sandbox.protection().files
    found: dict[str, tuple[str, ...]] = {}
    for entry in entries if isinstance(entries, list) else ():
        if isinstance(entry, dict) and isinstance(entry.get("file"), str):
            directory = os.path.join(checkout, str(entry.get("directory", "")))
            name = os.path.relpath(os.path.realpath(os.path.join(directory, entry["file"])), checkout)
            if name in known and name not in found:
                found[name] = tuple(_harmless(_arguments(entry), directory, checkout, root, built))
    return found


def directories(flags: Iterable[str]) -> tuple[str, ...]:
    """The include directories among *flags*."""
    return tuple(flag.removeprefix("-I") for flag in flags if flag.startswith(("/", "-I/")))


def _read(root: Path, path_given: str | None, refused: Collection[str] = ()) -> str:
    """The text of the database; "" if there is none, and where a link in the checkout leads out of it: a change can bring such a link.

    None of those *refused* is read, which a change brings, by whatever link.
    """
    path = root / (path_given if path_given is not None else "build")
    if path.is_dir():
        path /= "compile_commands.json"
    written, real = os.path.abspath(path), os.path.realpath(path)
    if _is_allowed(written, str(root), of_system=False) and not _is_allowed(real, str(root), of_system=False):
        return ""
    if not {os.path.relpath(place, root) for place in (written, real)}.isdisjoint(refused):
        return ""
    try:
        with open(os.open(real, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC), "rb") as file:
            status = os.fstat(file.fileno())
            if stat.S_ISREG(status.st_mode) and status.st_size <= SIZE_LIMIT:
                return file.read(SIZE_LIMIT).decode("utf-8", "replace")
    except OSError:
        pass
    return ""


def _arguments(entry: dict[str, object]) -> list[str]:
    arguments, command = entry.get("arguments"), entry.get("command")
    if isinstance(arguments, list):
        return [a for a in arguments if isinstance(a, str)]
    if isinstance(command, str):
        import shlex

        try:
            return shlex.split(command)
        except ValueError:
            pass
    return []


def _harmless(arguments: Sequence[str], directory: str, checkout: str, root: str, built: bool) -> Iterator[str]:
    """The flags on the lists above; -W only with a warning's name (``-Wl,`` and ``-Wa,`` speak to other programs)."""
    following = iter(arguments[1:])
    for argument in following:
        flag = next((f for f in (*DIRECTORY_FLAGS, *PLAIN_FLAGS) if argument.startswith(f)), None)
        if flag is None:
            continue
        value = argument[len(flag) :]
        if not value and flag not in ("-W", "-std="):
            value = next(following, "")
        if flag in DIRECTORY_FLAGS:
            path = os.path.realpath(os.path.join(directory, value))
            if path == checkout or path.startswith(checkout + "/"):
                inside = path[len(checkout) :]
                if not is_viewed(inside):  # .git holds tokens
                    continue
                is_made = built and not _MADE_BY_BUILDS.isdisjoint(inside.split("/"))
                path = path if is_made and not os.path.isdir(root + inside) else root + inside
            if value and _is_allowed(path, root, checkout) and os.path.isdir(path):
                yield from (flag, path) if flag != "-I" else (flag + path,)
        elif flag == "-x":
            if value in ("c", "c++"):
                yield from (flag, value)
        elif value and not (flag == "-W" and "," in value) and value.isprintable():
            yield flag + value


def _is_allowed(path: str, *roots: str, of_system: bool = True) -> bool:
    prefixes = (*roots, *SYSTEM_PREFIXES) if of_system else roots
    return any(path == prefix or path.startswith(prefix + "/") for prefix in prefixes)
