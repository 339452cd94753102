# SPDX-License-Identifier: Apache-2.0
"""A workspace's settings of ruff, without what leads ruff to other files.

Keys as in ruff's documentation, "Settings". What ``extend`` names is read from the workspace alone, and given to ruff as copies
that extend each other.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path
from posixpath import basename, dirname, join, normpath
from typing import Any

from haros_ci.linters import settings_files
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.records import dataclass

#: Top-level keys that are not passed on: what leads to other files, writes, changes files or the output, or stops other versions.
LEFT_OUT = frozenset(
    """
    extend cache-dir output-format output-prefer-rule-codes fix unsafe-fixes fix-only show-fixes required-version
    respect-gitignore analyze
    """.split()
)
#: Directories in which ruff looks for modules, to tell whose an import is; shell variables and ``~`` are replaced in them.
SOURCES = "src"
#: How long a chain of ``extend`` may be.
LONGEST_CHAIN = 8
PYPROJECT = "pyproject.toml"
#: How deep a value may be nested.
MAX_DEPTH = 20


@dataclass(frozen=True, slots=True)
class ConfigFile:
    """One file of a chain: what ruff may have of it, and what the project says of Python's version."""

    path: str
    options: dict[str, Any]
    python: str | None = None


def chain(workspace: Workspace, path: str, problems: list[Problem] | None = None) -> tuple[ConfigFile, ...]:
    """The settings file at *path* and what it extends, each once; *problems* takes what does not count, and why.

    A file that cannot be read as TOML is as if it were empty.
    """
    found: list[ConfigFile] = []
    notes: list[Problem] = [] if problems is None else problems
    while path:
        try:
            table = settings_files.tables(workspace.setting(path))
        except (ValueError, RecursionError):
            notes.append(Problem(path, "ruff has no settings from this file: it is not valid TOML"))
            return (*found, ConfigFile(path, {}))
        project = table.get("project")
        options, python = table, None
        if basename(path) == PYPROJECT:
            options = _table(_table(table.get("tool")).get("ruff"))
            python = _text(_table(project).get("requires-python"))
        found.append(ConfigFile(path, _harmless(path, options, notes), python))
        named = options.get("extend")
        if named is None:
            break
        target, why = _target(workspace, path, named, [link.path for link in found])
        if why:
            notes.append(Problem(path, f"ruff does not read the file that `extend` names here: {why}"))
        path = target
    return tuple(found)


def write(links: tuple[ConfigFile, ...], directory: Path) -> Path:
    """Copies of *links* below *directory*, each in a directory of its own; the first one is the file to name to ruff."""
    for number, link in enumerate(links):
        place = directory / str(number)
        place.mkdir(parents=True)
        options = link.options
        if number + 1 < len(links):
            options = {**options, "extend": f"../{number + 1}/{_name(links[number + 1])}"}
        if basename(link.path) == PYPROJECT:
            project = {} if link.python is None else {"project": {"requires-python": link.python}}
            options = {**project, "tool": {"ruff": options}}
        (place / _name(link)).write_text(toml_text(options), encoding="utf-8")
    return directory / "0" / _name(links[0])


def toml_text(table: dict[str, Any]) -> str:
    """A TOML document of plain values, lists and tables; every table within is written inline."""
    return "".join(f"{json_text(key)} = {_value(value)}\n" for key, value in table.items() if _is_plain(value))


def json_text(text: str) -> str:
    """*text* as a basic string of TOML, which JSON's are but for DEL."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _name(link: ConfigFile) -> str:
    return PYPROJECT if basename(link.path) == PYPROJECT else "ruff.toml"


def _harmless(path: str, options: dict[str, Any], problems: list[Problem]) -> dict[str, Any]:
    kept = {key: value for key, value in options.items() if key not in LEFT_OUT}
    if SOURCES in kept:
        sources = kept[SOURCES] if isinstance(kept[SOURCES], list) else []
        kept[SOURCES] = [source for source in sources if isinstance(source, str) and _stays_inside(source)]
        if len(kept[SOURCES]) < len(sources):
            problems.append(Problem(path, "ruff does not use a directory under `src` that lies outside the workspace"))
    return kept


def _target(workspace: Workspace, path: str, named: object, seen: list[str]) -> tuple[str, str]:
    """The file that *named* means in the settings file *path*, or "" and the reason why it does not count."""
    if not isinstance(named, str):
        return "", "it is not a text"
    target = normpath(join(dirname(path), named))
    if not _stays_inside(named, above=True) or target.split("/")[0] == "..":
        return "", "it lies outside the workspace, or its path is not written out"
    if target in seen:
        return "", "it extends this one"
    if len(seen) >= LONGEST_CHAIN:
        return "", f"more than {LONGEST_CHAIN} files extend each other"
    if not workspace.setting(target):
        return "", "there is no such file, or it is not text"
    return target, ""


def _stays_inside(name: str, *, above: bool = False) -> bool:
    """Whether *name* is a path below where it stands (with *above* also one that goes up), as it is written.

    ``~`` and ``$`` are replaced by the shell's values wherever ruff finds them.
    """
    parts = name.split("/")
    return not (name.startswith("/") or "~" in name or "$" in name or "\0" in name or (".." in parts and not above))


def _table(value: object) -> dict[str, Any]:
    return value if isinstance(value, dict) else {}


def _text(value: object) -> str | None:
    return value if isinstance(value, str) else None


def _is_plain(value: object, depth: int = 0) -> bool:
    """Whether TOML can hold *value* and ruff can mean anything by it: it has no option for times."""
    if isinstance(value, (dict, list)):
        inner: Iterator[object] = iter(value.values() if isinstance(value, dict) else value)
        return depth < MAX_DEPTH and all(_is_plain(item, depth + 1) for item in inner)
    return isinstance(value, (str, int)) or (isinstance(value, float) and math.isfinite(value))


def _value(value: object) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json_text(key)} = {_value(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    return str(value) if isinstance(value, (int, float)) else json_text(str(value))
