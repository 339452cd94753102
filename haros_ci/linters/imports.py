# SPDX-License-Identifier: Apache-2.0
"""Which Python files of a package import which: one changed module then renews its importers only."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from collections.abc import Set as AbstractSet
from posixpath import basename, dirname, join

from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex

_IMPORT = regex(r"^[ \t]*(?:from[ \t]+([\w.]+)[ \t]+import\b([^#\n;]*)|import[ \t]+([^#\n;]+))", re.MULTILINE)
_WORD = regex(r"\w+")
_INIT = "__init__.py"

#: The files of a package by the last word of their modules' names.
Modules = dict[str, set[str]]


def closures(workspace: Workspace, *, across: bool = False) -> dict[str, tuple[str, ...]]:
    """For every Python file the other files of its package that it imports, directly or not, sorted.

    Names are matched by their words against module and directory names, wherever in the package the file lies: a module
    too many costs a repeated analysis, one too few a stale result. The ``__init__.py`` of the packages of Python that a file is in
    count as imported: they decide what the module is called. With *across* also files of other packages count whose module a name
    can mean, because it is at the top there.
    """
    packages: dict[str | None, list[SourceFile]] = {}
    for file in workspace.files:
        if file.language == "python":
            packages.setdefault(file.package, []).append(file)
    modules = {package: _modules(files) for package, files in packages.items()}
    tops = _tops(packages) if across else {}
    direct: dict[str, set[str]] = {}
    for package, files in packages.items():
        alone = len(files) == 1 and len(packages) == 1
        paths = {file.path for file in files}
        known = modules[package].keys() | tops.keys()
        for file in files:
            if alone:
                direct[file.path] = set()
                continue
            words = set(_words(workspace.text(file.path), known))
            found = {path for word in words for path in modules[package].get(word, ())}
            for other in {name for word in words for name in tops.get(word, ()) if name != package}:
                found |= {path for word in words for path in modules[other].get(word, ())}
            direct[file.path] = found | set(_above(file.path, paths))
    return {path: tuple(sorted(_reachable(path, direct) - {path})) for path in direct}


def _modules(files: list[SourceFile]) -> Modules:
    found: Modules = {}
    for file in files:
        found.setdefault(_module(file.path), set()).add(file.path)
    return found


def _tops(packages: Mapping[str | None, list[SourceFile]]) -> dict[str, set[str | None]]:
    """For each module or package of Python that lies in no other the packages that have it."""
    found: dict[str, set[str | None]] = {}
    for package, files in packages.items():
        paths = {file.path for file in files}
        for path in paths:
            place = dirname(dirname(path)) if basename(path) == _INIT else dirname(path)
            if join(place, _INIT) not in paths:
                found.setdefault(_module(path), set()).add(package)
    return found


def _above(path: str, paths: Collection[str]) -> Iterator[str]:
    """The ``__init__.py`` of the packages of Python that *path* is in, from the innermost on."""
    place = dirname(path)
    while (init := join(place, _INIT)) in paths:
        yield init
        if not place:
            return
        place = dirname(place)


def _module(path: str) -> str:
    """The last word of the module's name: an ``__init__.py`` is its directory."""
    stem = basename(path).removesuffix(".py")
    return basename(dirname(path)) if stem == "__init__" else stem


def _words(text: str, modules: AbstractSet[str]) -> Iterator[str]:
    """The words of the import statements of *text*."""
    lines = "\n".join(line for line in text.split("\n") if "import" in line)  # the pattern alone is slow on long files
    for source, names, plain in _IMPORT.findall(lines):
        if names.count("(") > names.count(")"):  # a list over several lines: any module's name in the file may be meant
            names += " ".join(modules & set(_WORD.findall(text)))
        yield from _WORD.findall(f"{source} {names} {plain}")


def _reachable(start: str, direct: dict[str, set[str]]) -> set[str]:
    seen, waiting = {start}, [start]
    while waiting:
        new = direct.get(waiting.pop(), set()) - seen
        seen |= new
        waiting += new
    return seen
