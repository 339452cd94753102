# SPDX-License-Identifier: Apache-2.0
"""Python scripts that nothing of the workspace starts, installs, imports or names: what is wrong in them waits for somebody to start them by hand."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cache
from posixpath import basename, splitext
from weakref import WeakKeyDictionary

from haros_ci.checking.check import Finding
from haros_ci.checking.installing import landings
from haros_ci.checking.project import Project
from haros_ci.model.former_names import mention
from haros_ci.regex import regex
from haros_ci.results.overwritten import is_overwritten
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

#: Files whose text may start a script or import a module.
_NAMING = (
    *(".py", ".launch", ".test", ".xml", ".xacro", ".md", ".rst", ".txt", ".sh", ".bash", ".zsh", ".service", ".desktop"),
    *(".yml", ".yaml", ".cfg", ".toml", ".ini", ".in", ".cmake", ".json", ".repos", "dockerfile", "makefile", "justfile", "procfile"),
)  # fmt: skip
#: Files that are started or found by their place or name.
_FOUND = regex(r"(?:__\w+__|setup|conf|conftest|test_.*|.*_test|main|node|.*launch.*)")
#: What imports modules or starts files whose names stand nowhere.
_DYNAMIC = regex(
    r"\bimport_module\s*\(|\b__import__\s*\(|\bpkgutil(?:[ \t]+as\b|[ \t]*\.[ \t]*(?!get_data\b)\w)|\bfrom[ \t]+pkgutil\b|\bspec_from_file_location\b|\bload_source\s*\(|\brun_path\s*\(|\bexecfile\s*\(|\*\.py\b"
)
#: Checks of systems that speak of what happens when a line runs.
OF_A_LINE = frozenset(("parameter-read-undeclared",))
#: Longer files start nothing; of a workspace with more of them nothing is said.
_LARGEST = 300_000
_MOST_FILES = 20_000

_kept: WeakKeyDictionary[Project, dict[str, bool]] = WeakKeyDictionary()


def weighed(project: Project, findings: Iterable[Finding]) -> Iterator[Finding]:
    """*findings* on what happens when a line of Python runs; those in files that nothing starts are notes, and say so.

    Those in a function that the file defines again are left out: it never runs.
    """
    for finding in findings:
        if finding.at.path.endswith(".py") and is_overwritten(project.text(finding.at.path), finding.at.line or 0):
            continue
        if finding.level is not Level.NOTE and is_unstarted(project, finding.at.path):
            message = _unstarted(finding.message, finding.at.path)
            finding = replace(finding, level=Level.NOTE, message=message)
        yield finding


def lowered(project: Project, results: Iterable[Result]) -> Iterator[Result]:
    """*results* of checks of systems; those of OF_A_LINE in files that nothing starts are notes, and say so."""
    for result in results:
        path = result.location.path
        if result.rule in OF_A_LINE and result.level is not Level.NOTE and is_unstarted(project, path):
            result = replace(result, level=Level.NOTE, message=_unstarted(result.message, path))
        yield result


def _unstarted(message: str, path: str) -> str:
    return f"{message.rstrip('. ')} (nothing here starts, installs or imports {basename(path)})"


def is_unstarted(project: Project, path: str) -> bool:
    """Whether the Python file at *path* is no program and no module that anything here starts, installs by its name or with its directory,
    or names; copies of it elsewhere do not count. Files whose name says how they are found are none.
    """
    known = _kept.setdefault(project, {})
    if path not in known:
        known[path] = _is_unstarted(project, path)
    return known[path]


def _is_unstarted(project: Project, path: str) -> bool:
    stem = splitext(basename(path))[0]
    if not path.endswith(".py") or _FOUND.fullmatch(stem) or "test" in path.split("/") or "tests" in path.split("/"):
        return False
    inside = [package for package in project.packages if any(file.path == path for file in package.files)]
    if not inside or len(project.workspace.names) > _MOST_FILES:
        return False
    package = inside[0]
    if package.has("CMakeLists.txt") and (landings(package, path) or package.cmake.installs_unknown):
        return False
    word = re.compile(mention(path, stem))
    for name in project.workspace.names:
        if name == path or basename(name) == basename(path) or not _may_name(name):
            continue
        text = project.text(name)
        if len(text) > _LARGEST:
            continue
        if stem in text and word.search(text):
            return False
        if name.startswith(package.inside("")) and name.endswith((".py", ".txt", ".cmake", ".cfg")):
            if any(line.find("#", 0, at) < 0 for line, at in _dynamic(text)):
                return False
    return True


def _dynamic(text: str) -> Iterator[tuple[str, int]]:
    """The lines that import or gather files by no name, and where in them; a comment is for who calls."""
    for found in _DYNAMIC.finditer(text):
        start = text.rfind("\n", 0, found.start()) + 1
        yield text[start : found.end()], found.start() - start


@cache
def _may_name(name: str) -> bool:
    last = basename(name).lower()
    return last.endswith(_NAMING) or "." not in last
