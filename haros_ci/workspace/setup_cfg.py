# SPDX-License-Identifier: Apache-2.0
"""setup.cfg as setuptools reads it ("Configuring setuptools using setup.cfg files"), as far as it names programs."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

from haros_ci.model.build import EntryPoint, RefusedEntry
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.regex import regex
from haros_ci.workspace.tree import PathTree

MAX_LINES = 10_000
_LONGEST = 500

_SECTION = regex(r"\[([^\]]+)\]")
_ENTRY = regex(r"\s*([\w.-]+)\s*=\s*([\w.]+)\s*:\s*([\w.]+)\s*(?:\[.*\]\s*)?\Z")
#: What setuptools takes for an entry point (``pkg_resources.EntryPoint.parse``), with the function that a program needs.
_TAKEN = regex(r"[^=]+=\s*[\w.]+\s*:\s*[\w.]+\s*(?:\[.*\])?\s*\Z")
_SCRIPT = regex(r"""\s*["']?([\w.-]+)["']?\s*=\s*["']([^"']+)["']""")
_KEY = regex(r"([\w.\- ]+?)\s*[=:]\s*(.*)\Z", re.DOTALL)


def console_scripts(text: str) -> list[tuple[str, int, int]]:
    """The lines ``name = module:function`` of console scripts, each with its line and column."""
    return _values(text, "options.entry_points", "console_scripts")


def project_scripts(text: str) -> list[tuple[str, int, int]]:
    """The same of ``[project.scripts]`` in pyproject.toml: lines ``name = "module:function"`` (PEP 621)."""
    found = []
    section = ""
    for number, line in enumerate(text.splitlines()[:MAX_LINES], start=1):
        header = _SECTION.match(line.strip())
        if header is not None:
            section = header[1].strip()
        elif section in ("project.scripts", 'project.entry-points."console_scripts"'):
            match = _SCRIPT.match(line) if len(line) < 1_000 else None
            if match is not None:
                found.append((f"{match[1]} = {match[2]}", number, match.start(1) + 1))
    return found


def script_directories(text: str) -> dict[str, tuple[str, int]]:
    """Where setuptools puts programs: ``script_dir`` of develop, ``install_scripts`` of install, each with its line."""
    found = {}
    for section, key in (("develop", "script_dir"), ("install", "install_scripts")):
        values = _values(text, section, key) or _values(text, section, key.replace("_", "-"))
        for value, line, _ in values[:1]:
            found[section] = (value, line)
    return found


def package_directories(text: str) -> dict[str, str]:
    """``package_dir`` of the options: the directory of each package, "" for all others."""
    found = {}
    for line, _, _ in _values(text, "options", "package_dir"):
        for pair in line.split(","):
            name, equals, directory = pair.partition("=")
            if equals:
                found[name.strip()] = directory.strip()
    return found


def scripts_of_text(text: str) -> list[str]:
    """The console scripts of entry points given as text."""
    section = ""
    found = []
    for line in text.splitlines():
        bare = line.strip()
        if bare.startswith("["):
            section = bare.strip("[] ")
        elif bare and not bare.startswith("#") and section in ("", "console_scripts"):
            found.append(bare)
    return found


def refused_entries(items: Iterable[tuple[Any, tuple[int, int]]], path: str) -> tuple[RefusedEntry, ...]:
    """Those of the lines at such places of *path* from which no program is made; what is no text is not known."""
    return tuple(
        RefusedEntry(item.strip(), Location(path, line, column))
        for item, (line, column) in items
        if isinstance(item, str)
        and item.strip()
        and len(item) < _LONGEST
        and "\n" not in item
        and not _TAKEN.match(item)
    )


def entry_points(
    tree: PathTree,
    package: Package,
    items: Iterable[tuple[Any, tuple[int, int]]],
    path: str,
    roots: tuple[tuple[str, str], ...],
) -> tuple[EntryPoint, ...]:
    """The entry points of *package* that lines of *path* at such places are."""
    found = []
    for item, (line, column) in items:
        match = _ENTRY.match(item) if isinstance(item, str) and len(item) < _LONGEST else None
        if match is not None:
            name, module, function = match.groups()
            entry = EntryPoint(
                name=name,
                module=module,
                function=function,
                path=tree.module(module, roots),
                package=package.name,
                location=Location(path, line, column),
            )
            found.append(entry)
    return tuple(found)


def _values(text: str, section: str, key: str) -> list[tuple[str, int, int]]:
    """The lines of one value. Continuation lines are indented; ``#`` and ``;`` begin comments (configparser)."""
    found: list[tuple[str, int, int]] = []
    here = current = ""
    for number, line in enumerate(text.splitlines()[:MAX_LINES], start=1):
        bare = line.strip()
        if not bare or bare[0] in "#;":
            continue
        if not line[0].isspace():
            header = _SECTION.match(line)
            if header is not None:
                here, current = header[1].strip(), ""
                continue
            match = _KEY.match(line) if len(line) < 1_000 else None
            current = match[1].strip() if match is not None else ""
            bare = match[2].strip() if match is not None else ""
        if here == section and current == key and bare:
            found.append((bare, number, line.find(bare) + 1))
    return found
