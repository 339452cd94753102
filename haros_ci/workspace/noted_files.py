# SPDX-License-Identifier: Apache-2.0
"""Notes on files that a change brings or alters and that hold code, flags or data of ROS in a form that nothing here reads."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator

from haros_ci.model.workspace import Problem
from haros_ci.workspace.compiler_flags import has_flags, may_have_flags
from haros_ci.workspace.files import FileTree, TooLarge, decode
from haros_ci.workspace.language import language_of
from haros_ci.workspace.used_code import UsedCode
from haros_ci.workspace.used_names import TEMPLATES

#: Files that a message names; the rest is counted.
MAX_NAMED = 10
#: Bytes of a file of settings that are read; one with more may hold anything.
_LARGEST = 1 << 20
#: What a template may become that is analysed, and no code.
_DATA = frozenset(("launch", "xml", "yaml", "world", "interface"))
#: How files are called that say which repositories belong to this one: git-submodule(1), vcstool, wstool.
_SOURCES = (".gitmodules", ".repos", ".rosinstall")


def noted(
    paths: Collection[str],
    findings: Collection[str],
    used: UsedCode,
    has_changed: Callable[[str], bool],
    tree: FileTree,
) -> Iterator[Problem]:
    """One for all of a kind among *paths*, which are not analysed as code; *findings* are those that are used as code, and so findings already."""
    rest = [path for path in paths if path not in findings]
    languages = {path: used.language_by_text(path) for path in rest}
    for language in ("C++", "Python"):
        found = [path for path in rest if languages[path] == language]
        yield from _one(
            found, has_changed, ("holds", "hold"), f"{language} under a name that is not analysed as {language}"
        )
    called = (path for path in rest if not languages[path] and used.namer_of_calls(path))
    yield from _one(called, has_changed, ("holds", "hold"), "calls of Python, and Python code names it: it may be run")
    yield from _one(
        filter(_is_template, rest), has_changed, ("is", "are"), "made into data of ROS by a build, and so not analysed"
    )
    sources = (path for path in paths if path.lower().endswith(_SOURCES))
    yield from _one(
        sources,
        has_changed,
        ("names", "name"),
        "other repositories, of which nothing is analysed but what is checked out here",
    )
    flagged = (path for path in paths if may_have_flags(path.rpartition("/")[2]) and _has_flags(path, tree))
    yield from _one(flagged, has_changed, ("sets", "set"), "flags of compilers, which no tool is given")


def named(paths: list[str]) -> str:
    """The first of *paths*, and how many there are more."""
    more = len(paths) - MAX_NAMED
    return ", ".join([*paths[:MAX_NAMED], *([f"and {more:,} more"] if more > 0 else [])])


def _one(
    paths: Iterable[str], has_changed: Callable[[str], bool], verbs: tuple[str, str], what: str
) -> Iterator[Problem]:
    if changed := [path for path in paths if has_changed(path)]:
        files = "1 changed file" if len(changed) == 1 else f"{len(changed):,} changed files"
        yield Problem(changed[0], f"{files} {verbs[len(changed) > 1]} {what}: {named(changed)}")


def _is_template(path: str) -> bool:
    stem, _, suffix = path.rpartition("/")[2].rpartition(".")
    return suffix.lower() in TEMPLATES and language_of(stem) in _DATA


def _has_flags(path: str, tree: FileTree) -> bool:
    try:
        data = tree.read(path, _LARGEST)
    except TooLarge:
        return True
    except OSError:
        return False
    return data is not None and has_flags(path.rpartition("/")[2], decode(data))
