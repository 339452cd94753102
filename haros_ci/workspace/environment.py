# SPDX-License-Identifier: Apache-2.0
"""The environment variables that a workspace sets by itself: environment hooks of its packages, and files that its project file names."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from haros_ci.model.build import Build, CMakeCommand
from haros_ci.model.environment import Environment
from haros_ci.model.workspace import Workspace
from haros_ci.workspace.dotenv import read_dotenv
from haros_ci.workspace.shell_values import names_set
from haros_ci.workspace.shell_variables import Variables, read_script
from haros_ci.workspace.shell_words import HOLE, MAX_SCRIPT

#: Hooks that are read.
MAX_HOOKS = 200

_SHELLS = ("sh", "bash")
_TEMPLATES = ("", ".em", ".in", ".develspace.em", ".develspace.in")
_HOOK = re.compile(r"\.(sh|bash|dsv)(?:\.develspace)?(\.em|\.in)?\Z")
_EM_BLOCK = re.compile(r"@\[\s*(if|for|while|def|try|end|else|elif)\b[^\]\n]*\]")
_EM = re.compile(r"@@|@#[^\n]*|@\((?:[^()\n]|\([^()\n]*\))*\)|@\{[^{}]*\}|@\[[^\]\n]*\]|@[A-Za-z_][\w.]*")
_IN = re.compile(r"@([A-Za-z_]\w*)@")
#: Names that are directories of every install prefix: what a .dsv file sets to one of them is a path.
_DIRECTORIES = frozenset(("", "bin", "etc", "include", "lib", "share", "src", "opt"))


@dataclass(frozen=True, slots=True)
class Hook:
    """An environment hook of *package* at the root-relative *path*; *is_certain* if it is always there."""

    path: str
    package: str
    is_certain: bool


def hooks_of(workspace: Workspace, builds: Mapping[str, Build]) -> Iterator[Hook]:
    """The environment hooks that CMake of packages names, and that are there."""
    there = workspace.names.union(file.path for file in workspace.files)
    for name, build in sorted(builds.items()):
        for command in build.commands:
            if command.is_test or command.name not in ("catkin_add_env_hooks", "ament_environment_hooks"):
                continue
            for path in _paths(command, there):
                yield Hook(path, name, not command.is_conditional)


def _paths(command: CMakeCommand, there: frozenset[str]) -> Iterator[str]:
    if command.name == "ament_environment_hooks":
        for word in command.arguments:
            path = command.place(word)
            if path is not None and path in there:
                yield path
        return
    if not command.arguments:
        return
    directory = command.after("DIRECTORY", "SHELLS", "SKIP_INSTALL")[:1] or ("${ROOT}/" + command.directory,)
    for shell in command.after("SHELLS", "DIRECTORY", "SKIP_INSTALL"):
        base = command.place(f"{directory[0]}/{command.arguments[0]}.{shell}") if shell in _SHELLS else None
        found = [f"{base}{ending}" for ending in _TEMPLATES if f"{base}{ending}" in there] if base else []
        yield from found[:1]


def environment_of(workspace: Workspace, builds: Mapping[str, Build]) -> Environment:
    """What the environment hooks of the packages set, as a shell that nobody has told otherwise has it.

    Where two hooks disagree, or a value cannot be read, the variable is lost.
    """
    hooks = list(dict.fromkeys(hooks_of(workspace, builds)))[:MAX_HOOKS]
    alone = [read_hook(workspace, hook, {}) for hook in hooks]
    if not any(each.values or each.lost for each in alone):
        return Environment()
    found: dict[str, set[str | None]] = {}
    where: dict[str, str] = {}
    for hook, each in zip(hooks, alone, strict=True):
        _note(found, where, hook, each)
    for number, hook in enumerate(hooks):  # again, with what the others set
        others = [pair for at, pair in enumerate(zip(hooks, alone, strict=True)) if at != number]
        if given := _set_before(others):
            _note(found, where, hook, _own(read_hook(workspace, hook, given), alone[number]))
    return _agreed(found, where)


def _set_before(others: Iterable[tuple[Hook, Variables]]) -> dict[str, str | None]:
    """What a hook finds set where *others* are read before it; None for what they disagree about, and what is not certain."""
    found: dict[str, set[str | None]] = {}
    for hook, each in others:
        _note(found, {}, hook, each)
    return {name: next(iter(values)) if len(values) == 1 else None for name, values in found.items()}


def _agreed(found: Mapping[str, set[str | None]], where: Mapping[str, str]) -> Environment:
    """The variables with the one value that was *found* for each; the others are lost."""
    values = {name: next(iter(each)) for name, each in found.items() if len(each) == 1}
    known = {name: value for name, value in values.items() if value is not None}
    lost = {name: _reason(name, where[name]) for name in found if name not in known}
    return Environment(known, lost, frozenset(known))


def _reason(name: str, path: str) -> str:
    return f"environment variable '{name}' is set in {path}, to what is not known"


def _note(found: dict[str, set[str | None]], where: dict[str, str], hook: Hook, each: Variables) -> None:
    for name, value in (*each.values.items(), *((name, None) for name in sorted(each.lost))):
        found.setdefault(name, set()).add(value if hook.is_certain else None)
        where.setdefault(name, hook.path)


def _own(found: Variables, first: Variables) -> Variables:
    """Of what a hook leaves behind, the variables that it has set itself."""
    names = first.values.keys() | first.lost
    return Variables({name: v for name, v in found.values.items() if name in names}, found.lost & names)


def read_hook(workspace: Workspace, hook: Hook, given: Mapping[str, str | None]) -> Variables:
    """What one hook sets, where *given* is set before it."""
    kind = _HOOK.search(hook.path)
    text = workspace.text(hook.path)
    if kind is None or not text:
        return Variables({})
    if len(text) > MAX_SCRIPT:
        return Variables({}, names_set(text[:MAX_SCRIPT]))
    stuck: frozenset[str] = frozenset()
    if kind[2] == ".em":
        text, stuck = _expanded(text)
    elif kind[2] == ".in":
        text = _IN.sub(lambda found: hook.package if found[1] == "PROJECT_NAME" else HOLE, text)
    if kind[1] == "dsv":
        return read_dsv(text, given)
    return read_script(text, given, stuck)


def _expanded(text: str) -> tuple[str, frozenset[str]]:
    """An empy template with holes for what is put in, and the names that are set under its conditions."""
    stuck: set[str] = set()
    depth, start = 0, 0
    for found in _EM_BLOCK.finditer(text):
        if depth:
            stuck |= names_set(text[start : found.start()])
        depth += {"end": -1, "else": 0, "elif": 0}.get(found[1], 1)
        start = found.end()
    if depth > 0:
        stuck |= names_set(text[start:])

    def hole(found: re.Match[str]) -> str:
        if found[0] == "@@":
            return "@"
        return "" if found[0].startswith(("@#", "@[", "@{")) else HOLE

    return _EM.sub(hole, text), frozenset(stuck)


def _dsv_value(value: str) -> str | None:
    """The *value* of a line of a .dsv file; None for a path below the install prefix, and for what a template puts in."""
    is_path = HOLE in value or value in _DIRECTORIES or ("/" in value and not value.startswith("/"))
    return None if is_path else value


def read_dsv(text: str, given: Mapping[str, str | None]) -> Variables:
    """What a .dsv file sets (``type;name;value``, as colcon and ament read it); paths below the install prefix are lost."""
    values: dict[str, str | None] = {}
    for line in text.splitlines()[:2_000]:
        kind, _, rest = line.strip().partition(";")
        name, found, value = rest.partition(";")
        if kind in ("set", "set-if-unset") and name:
            made = _dsv_value(value) if found else None
            before = values.get(name, given.get(name)) if name in values or name in given else ""
            values[name] = made if kind == "set" or before == "" else before
        elif kind.startswith(("prepend", "append")) and name:
            values[name] = None
    known = {name: value for name, value in values.items() if value is not None}
    return Variables(known, frozenset(values.keys() - known.keys()))


def environment_files(workspace: Workspace, paths: Iterable[str]) -> Environment:
    """What the listed files at the root-relative *paths* set, the later before the earlier: shell scripts, or a ``NAME=value`` on each line."""
    made = Environment()
    for path in paths:
        text = workspace.text(path)
        given: dict[str, str | None] = {**made, **dict.fromkeys(made.lost)}
        found = read_script(text, given) if path.endswith((".sh", ".bash")) else read_dotenv(text, given)
        made = made.over(Environment(found.values, {name: _reason(name, path) for name in found.lost}))
    return made
