# SPDX-License-Identifier: Apache-2.0
"""Macros that nothing in a workspace defines, and nothing outside of it can be meant to.

A compiler, a platform or a header that is not here may define almost any name. It does not define the next of a row of names that the
workspace itself numbers (``MSG_TYPE4`` where a file defines ``MSG_TYPE1`` to ``MSG_TYPE3``): such a name is not defined if no file of the
workspace defines it, no CMake file has it as a word, and no script, document or other file of the build has it after ``-D``.
What stands in a comment counts for nothing.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from haros_ci.model.workspace import Workspace
from haros_ci.syntax import Directive
from haros_ci.syntax.source import Source

#: Names of one row that a file defines for it to be the workspace's own, and characters of a name.
ROW, LONGEST = 2, 100
#: Characters of files that are searched for a name; beyond nothing is known.
MOST = 20_000_000
#: Files that may hand definitions to a compiler, by language and by the end of their names.
_HANDING = ("shell", "dockerfile", "yaml", "markdown", "setup")
_OTHERS = ("Makefile", ".mk", ".json", ".meta", ".bazel", ".bzl", ".ninja", ".toml", ".pro", ".bat", ".ps1")

_WORD = re.compile(r"[A-Za-z_]\w*")
_DIGITS = re.compile(r"\d+")
_DEFINED = re.compile(r"[-/]D\s?([A-Za-z_]\w*)")


def never_defined(workspace: Workspace, sources: Iterable[Source]) -> frozenset[str]:
    """The macros that conditions in *sources*, all C++ files of the workspace, ask for and that nothing defines."""
    defined: set[str] = set()
    asked: set[str] = set()
    rows: set[str] = set()
    read = set()
    for source in sources:
        read.add(source.path)
        own, is_lost = _defined(source.program.directives)
        if is_lost:
            return frozenset()
        defined |= own
        rows |= _rows(own)
        asked.update(_asked(source.program.directives))
    found = {name for name in asked - defined if len(name) <= LONGEST and _row(name) in rows}
    mentioned = _mentioned(workspace, read) if found else set()
    if mentioned is None:
        return frozenset()
    return frozenset(name for name in found if mentioned.isdisjoint((name, _row(name).partition("#")[0])))


def _defined(directives: Iterable[Directive]) -> tuple[set[str], bool]:
    """The macros that a file defines or takes back, and whether it has more directives than were read."""
    found: set[str] = set()
    for directive in directives:
        if directive.word == "lost":
            return found, True
        name = _WORD.match(directive.text) if directive.word in ("define", "undef") else None
        found |= {name[0]} if name is not None else set()
    return found, False


def _rows(names: Iterable[str]) -> set[str]:
    """The rows of which *names* has several."""
    counts: dict[str, int] = {}
    for name in names:
        row = _row(name)
        counts[row] = counts.get(row, 0) + (row != "")
    return {row for row, count in counts.items() if count >= ROW}


def _row(name: str) -> str:
    """A name with its last number left out; "" of one without a number, or that a compiler may define."""
    numbers = [*_DIGITS.finditer(name[:LONGEST])]
    if not numbers or name.startswith("_"):
        return ""
    last = numbers[-1]
    return f"{name[: last.start()]}#{name[last.end() :]}" if last.start() else ""


def _asked(directives: Iterable[Directive]) -> Iterator[str]:
    """The names that the conditions of a file ask for."""
    for directive in directives:
        if directive.word in ("if", "ifdef", "ifndef", "elif", "elifdef", "elifndef"):
            yield from _WORD.findall(directive.text)


def _mentioned(workspace: Workspace, read: set[str]) -> set[str] | None:
    """The names that files of a build have, but for the C++ files that were *read*; None where there is too much."""
    found: set[str] = set()
    left = MOST
    paths = {file.path: file.language for file in workspace.files if file.path not in read}
    paths |= {name: "" for name in workspace.names - read if name not in paths and name.endswith((".in", *_OTHERS))}
    for path, language in sorted(paths.items()):
        is_code = language in ("cmake", "cpp") or path.endswith(".in")
        if is_code or language in _HANDING or path.endswith(_OTHERS):
            text = workspace.text(path)
            left -= len(text)
            if left < 0:
                return None
            found |= _names(text, language == "cmake", is_code)
    return found


def _names(text: str, is_cmake: bool, is_code: bool) -> set[str]:
    """The names in a text, outside of CMake's comments: all words of code, of others those after ``-D``."""
    found: set[str] = set()
    for line in map(_without_comment, text.splitlines()) if is_cmake else (text,):
        found.update(_DEFINED.findall(line))
        found.update(_WORD.findall(line) if is_code else ())
    return found


def _without_comment(line: str) -> str:
    """A line of CMake up to its comment; the whole of one where the sign may stand in a text."""
    head = line.partition("#")[0]
    return line if '"' in head else head
