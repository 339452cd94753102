# SPDX-License-Identifier: Apache-2.0
"""The headers that a file includes in every build, and the files of a package that a build comes by."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator
from functools import lru_cache

from haros_ci.checking.project import ProjectPackage
from haros_ci.checking.provision import Sources
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex

_COMMENT = regex(r"/\*.*?(?:\*/|\Z)", re.S)  # one that is not closed goes to the end
_DIRECTIVE = regex(r"^[ \t]*#[ \t]*(include|if|ifdef|ifndef|elif|else|endif|define)\b[ \t]*(.*)$", re.M)
_GUARD = regex(r"(?:ifndef|if\s*!\s*defined(?:\s*\()?)\s*(\w+)")
_TARGET = regex(r"([<\"])([^>\"\n]+)[>\"]")
_HEADERS = (".h", ".hh", ".hpp", ".hxx", ".h++", ".ipp", ".inl", ".tpp", ".cuh")
#: Classes for which Qt's moc makes a source that includes their header.
_MOC = regex(r"\bQ_(?:OBJECT|GADGET|NAMESPACE)\b")
#: Files that one package may make a check look at.
MAX_FILES = 5_000


@dataclass(frozen=True, slots=True)
class QuotedInclude:
    """``#include`` of *header*, as written, *is_quoted* in quotes."""

    header: str
    is_quoted: bool
    location: Location


@lru_cache(maxsize=MAX_FILES)
def includes(path: str, text: str) -> tuple[QuotedInclude, ...]:
    """Those that no ``#if`` stands around, but for the include guard."""
    return tuple(_includes(path, text))


def _includes(path: str, text: str) -> Iterator[QuotedInclude]:
    plain = _COMMENT.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text) if "/*" in text else text
    depth, guard, is_first, at, line = 0, "", True, 0, 1
    for match in _DIRECTIVE.finditer(plain):
        word, rest = match[1], match[2]
        line += plain.count("\n", at, match.start())
        at = match.start()
        if word == "define":
            if guard and depth == 1 and rest.split()[:1] == [guard]:
                depth = 0
            guard = ""
            continue
        if word in ("if", "ifdef", "ifndef"):
            guarded = _GUARD.match(f"{word} {rest.strip()}") if is_first else None
            guard = guarded[1] if guarded is not None else ""
            depth += 1
        elif word == "endif":
            depth = max(depth - 1, 0)
        elif word == "include" and depth == 0:
            target = _TARGET.match(rest)
            if target is not None:
                column = match[0].index("#") + 1
                yield QuotedInclude(target[2].strip(), target[1] == '"', Location(path, line, column))
        is_first = False


def compiled(package: ProjectPackage, *, tests: bool = False) -> list[str]:
    """The C++ files that CMake compiles in every build: not for tests, or for *tests* alone."""
    found: dict[str, None] = {}
    for target in package.build.targets:
        if target.kind in ("alias", "imported") or target.is_test is not tests or target.is_conditional:
            continue
        found |= dict.fromkeys(path for path in target.sources if path not in target.conditional_sources)
    own = {file.path for file in package.files if file.language == "cpp"}
    return [path for path in found if path in own and is_compiled(package, path)]


def is_compiled(package: ProjectPackage, path: str) -> bool:
    """Whether a source of a target is compiled by itself: a header is not, but where Qt's moc makes a source of it."""
    return not path.endswith(_HEADERS) or is_for_moc(package.project.glance(path))


def is_for_moc(text: str) -> bool:
    """Whether a header of this *text* has classes for Qt's moc."""
    return _MOC.search(text) is not None


def reached(package: ProjectPackage, sources: Sources, *, tests: bool = False) -> Iterator[QuotedInclude]:
    """What the compiled files include from elsewhere, and what the package's own headers that they include do."""
    todo = compiled(package, tests=tests)[::-1]
    seen = set(todo)
    own = {file.path for file in package.files}
    while todo and len(seen) < MAX_FILES:
        path = todo.pop()
        for include in includes(path, package.project.glance(path)):
            beside = posixpath.normpath(posixpath.join(posixpath.dirname(path), include.header))
            inner = [beside] if include.is_quoted and beside in own else []
            inner = inner or [item for item, name in sources.ending(include.header) if name == package.name]
            if not inner:
                yield include
            for item in inner[:1]:
                if item not in seen:
                    seen.add(item)
                    todo.append(item)
