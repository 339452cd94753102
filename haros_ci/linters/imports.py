# SPDX-License-Identifier: Apache-2.0
"""Which Python files of a package import which: one changed module then renews its importers only."""

from __future__ import annotations

import re
from posixpath import basename, dirname

from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace

_IMPORT = re.compile(r"^[ \t]*(?:from[ \t]+([\w.]+)[ \t]+import\b([^#\n;]*)|import[ \t]+([^#\n;]+))", re.MULTILINE)
_WORD = re.compile(r"\w+")


def closures(workspace: Workspace) -> dict[str, tuple[str, ...]]:
    """For every Python file the other files of its package that it imports, directly or not, sorted.

    Names are matched by their words against module and directory names, wherever in the package the file lies: a module
    too many costs a repeated analysis, one too few a stale result.
    """
    packages: dict[str | None, list[SourceFile]] = {}
    for file in workspace.files:
        if file.language == "python":
            packages.setdefault(file.package, []).append(file)
    found: dict[str, tuple[str, ...]] = {}
    for files in packages.values():
        modules: dict[str, set[str]] = {}
        for file in files:
            modules.setdefault(_module(file.path), set()).add(file.path)
        direct = {file.path: _imported(workspace.text(file.path), modules) for file in files} if len(files) > 1 else {}
        for file in files:
            found[file.path] = tuple(sorted(_reachable(file.path, direct) - {file.path}))
    return found


def _module(path: str) -> str:
    """The last word of the module's name: an ``__init__.py`` is its directory."""
    stem = basename(path).removesuffix(".py")
    return basename(dirname(path)) if stem == "__init__" else stem


def _imported(text: str, modules: dict[str, set[str]]) -> set[str]:
    paths: set[str] = set()
    lines = "\n".join(line for line in text.split("\n") if "import" in line)  # the pattern alone is slow on long files
    for source, names, plain in _IMPORT.findall(lines):
        if names.count("(") > names.count(")"):  # a list over several lines: any module's name in the file may be meant
            names += " ".join(modules.keys() & set(_WORD.findall(text)))
        for word in _WORD.findall(f"{source} {names} {plain}"):
            paths |= modules.get(word, set())
    return paths


def _reachable(start: str, direct: dict[str, set[str]]) -> set[str]:
    seen, waiting = {start}, [start]
    while waiting:
        new = direct.get(waiting.pop(), set()) - seen
        seen |= new
        waiting += new
    return seen
