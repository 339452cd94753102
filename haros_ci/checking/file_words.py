# SPDX-License-Identifier: Apache-2.0
"""What the files of Python say of names, each looked through once: who asks for every name of a file takes no time of its square."""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Mapping, Set
from typing import TypeVar

from haros_ci.checking.code_text import alone
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.regex import regex

#: Code that gives objects attributes by name, or asks for them so.
_BY_NAME = regex(
    r"\b(?:setattr|vars|exec|eval|locals)\s*\(|__(?:getattr|getattribute|setattr|dict|new|init_subclass|setstate)__"
    r"|\bMethodType\b|\bmetaclass\s*=|\bmock\b"
)
#: ``hasattr(x, "name")``, and the words in quotes there.
_ASKED = regex(r"attr\s*\(([^()\n]*)")
_QUOTED = regex(r"(?<=[\"'])\w+(?=[\"'])")
_CALLED = regex(r"(?<!class )(?<!\w)(\w+)\s*\(")
_NAMED = regex(r"(?<!\w)(?<!def )\w+")
_NAMED_ELSEWHERE = regex(r"(?<!\w)(?<!def )(?<!\bself\.)\w+")
_DEFINED = regex(r"\bdef[ \t]+(\w+)")
_MEMBER = regex(r"\b\w+\.(?=(\w+))")
#: Comments, and texts in one line.
_NO_CODE = regex(r"#[^\n]*|\"[^\"\n]*\"|'[^'\n]*'")
_SHARED = regex(r"(?m)^[ \t]*(?:global|nonlocal)\s([^\n]*)")
_WORD = regex(r"\w+")
#: A member before an assignment, or before a comma in a row of them.
_MAY_BE_SET = regex(r"(\w*)\]?\)?\.(\w+)(?=\s*(=(?!=)|,))")
_SIGN = regex(r"=(?!=)|\n")
Made = TypeVar("Made")


def makes_by_name(code: Codebase, path: str) -> bool:
    """Whether code of the file gives objects attributes by name."""
    return _once(code, ("by name", path), lambda: _BY_NAME.search(alone(code, path)) is not None)


def asked_for(code: Codebase, path: str) -> Set[str]:
    """The names that the file asks objects for (``getattr(x, "name")``)."""

    def find() -> frozenset[str]:
        asked = _ASKED.findall(alone(code, path))
        return frozenset(word for inner in asked for word in _QUOTED.findall(inner))

    return _once(code, ("asked for", path), find)


def called_in(code: Codebase, path: str) -> Set[str]:
    """The names behind which a bracket opens, but for those of classes."""
    return _once(code, ("called in", path), lambda: frozenset(_CALLED.findall(code.text(path))))


def defined_in(code: Codebase, path: str) -> Set[str]:
    """The names of functions of the file."""
    return _once(code, ("defined in", path), lambda: frozenset(_DEFINED.findall(code.text(path))))


def named_in(code: Codebase, path: str, is_elsewhere: bool) -> Set[str]:
    """The words of the file before remarks, but for the names of functions; with *is_elsewhere* those that ``self`` does not have."""

    def find() -> frozenset[str]:
        pattern = _NAMED_ELSEWHERE if is_elsewhere else _NAMED
        return frozenset(word for line in lines_of(code, path) for word in pattern.findall(line.partition("#")[0]))

    return _once(code, ("named in", path, is_elsewhere), find)


def lines_of(code: Codebase, path: str) -> list[str]:
    """The lines of the file."""
    return _once(code, ("lines of", path), lambda: code.text(path).split("\n"))


def first_members(code: Codebase, routine: Routine) -> Mapping[str, tuple[int, int, int]]:
    """Where each name stands first behind a point in the routine: the line, and where that begins and ends there."""

    def find() -> dict[str, tuple[int, int, int]]:
        found: dict[str, tuple[int, int, int]] = {}
        line = routine.function.line
        for number, part in enumerate(code.lines(routine, line).split("\n"), line):
            for member in _MEMBER.finditer(part.partition("#")[0]):
                found.setdefault(member[1], (number, member.start(), member.end(1)))
        return found

    return _once(code, ("first members", id(routine)), find)


def shared_in(code: Codebase, path: str) -> Set[str]:
    """The words behind ``global`` and ``nonlocal``."""

    def find() -> frozenset[str]:
        return frozenset(word for rest in _SHARED.findall(alone(code, path)) for word in _WORD.findall(rest))

    return _once(code, ("shared in", path), find)


def receivers_of(code: Codebase, path: str) -> Mapping[str, list[str]]:
    """By member the words before its point, where it is set: ``a`` and ``b`` for ``c`` in ``a.c, b.c = 1, 2``."""

    def find() -> dict[str, list[str]]:
        text = _NO_CODE.sub("", code.text(path))
        signs = [(sign.start(), sign[0]) for sign in _SIGN.finditer(text)]
        places = [place for place, _ in signs]
        found: dict[str, list[str]] = {}
        for member in _MAY_BE_SET.finditer(text):
            at = bisect_left(places, member.start(3))
            if member[3] == "=" or (at < len(signs) and signs[at][1] == "="):
                found.setdefault(member[2], []).append(member[1])
        return found

    return _once(code, ("receivers of", path), find)


def word_count(code: Codebase, path: str) -> Counter[str]:
    """How often each word stands in the file, remarks and texts left out."""
    return _once(code, ("word count", path), lambda: Counter(_WORD.findall(_NO_CODE.sub("", code.text(path)))))


def functions_of(code: Codebase, path: str) -> Set[str]:
    """The functions and methods of the file, by their whole names."""
    functions = code.by_path[path].program.functions
    return _once(code, ("functions of", path), lambda: frozenset(function.name for function in functions))


def own_names(code: Codebase, routine: Routine) -> Set[str]:
    """The classes and functions of the file of *routine*."""

    def find() -> frozenset[str]:
        program = routine.source.program
        return frozenset((*(class_.name for class_ in program.classes), *(one.name for one in program.functions)))

    return _once(code, ("own names", routine.path), find)


def _once(code: Codebase, key: tuple[object, ...], make: Callable[[], Made]) -> Made:
    if key not in code.kept:
        code.kept[key] = make()
    kept: Made = code.kept[key]
    return kept
