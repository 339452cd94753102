# SPDX-License-Identifier: Apache-2.0
"""An edit of a C++ file that only changes what some functions do: which ones, and where everything else stands now.

Most edits add or change statements, or comments. Classes, types, signatures and the order of all these are then as before, and of
what has not changed only the lines are others.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from haros_ci.records import dataclass
from haros_ci.syntax import Function, Program
from haros_ci.syntax.node import Record

#: The fields of parts of programs that are lines.
LINES = frozenset(("line", "body_line", "else_line"))
#: What a function does; all else of it is its head.
BODY = frozenset(("body", "inits", "guards"))
#: The end of a lambda's name, after that of the function around it.
LAMBDA = "::(lambda)"

Lines = dict[int, int]


@dataclass(frozen=True, slots=True)
class Moves:
    """*functions* are the qualified names of those that do something else, *around* those and the ones around changed lambdas.

    *lines* has the new line of each old one that is known.
    """

    functions: frozenset[str]
    around: frozenset[str]
    lines: Lines


def moves(before: Program, now: Program) -> Moves | None:
    """What an edit has changed; None where it changed more than what functions of C++ do."""
    lines: Lines = {}
    if not _same_around(before, now, lines) or len(before.functions) != len(now.functions):
        return None
    changed: set[str] = set()
    for old, new in zip(before.functions, now.functions, strict=True):
        if not _same_head(old, new, lines):
            return None
        inner: Lines = {}
        if _same_body(old, new, inner) and _fits(inner, lines):
            lines.update(inner)
        else:
            changed.add(old.name)
    named = {function.name for function in now.functions if function.kind != "lambda"}
    around = {_outermost(name) for name in changed}
    if (changed and before.language == "python") or not around <= named or "" in around:
        return None
    return Moves(frozenset(changed), frozenset(around), lines)


def _same_around(before: Program, now: Program, lines: Lines) -> bool:
    """Whether all but the functions is the same."""
    for name in Program.__struct_fields__:
        if name not in ("functions", "registered", "problems"):
            if not _same(getattr(before, name), getattr(now, name), lines):
                return False
    if [message for _, message in before.problems] != [message for _, message in now.problems]:
        return False
    return _same_places(before.registered, now.registered, lines)


def _same_head(old: Function, new: Function, lines: Lines) -> bool:
    head = [name for name in Function.__struct_fields__ if name not in BODY]
    return all(_same_field(name, old, new, lines) for name in head) and (old.body is None) == (new.body is None)


def _outermost(name: str) -> str:
    """The function around a lambda; the function itself if it is no lambda."""
    return name.partition(LAMBDA)[0]


def _same_body(old: Function, new: Function, lines: Lines) -> bool:
    if not _same(old.body, new.body, lines) or not _same(old.inits, new.inits, lines):
        return False
    return _same_guards(old.guards, new.guards, lines)


def _same_guards(old: Sequence[tuple[int, int, str]], new: Sequence[tuple[int, int, str]], lines: Lines) -> bool:
    return [item[1:] for item in old] == [item[1:] for item in new] and _paired(
        ((one[0], other[0]) for one, other in zip(old, new, strict=True)), lines
    )


Registered = Sequence[tuple[str, tuple[str, ...], int, int]]


def _same_places(old: Registered, new: Registered, lines: Lines) -> bool:
    bare = [(macro, arguments, column) for macro, arguments, _, column in old]
    if bare != [(macro, arguments, column) for macro, arguments, _, column in new]:
        return False
    return _paired(((one[2], other[2]) for one, other in zip(old, new, strict=True)), lines)


def _paired(pairs: Iterable[tuple[int, int]], lines: Lines) -> bool:
    """Note the new line of each old one; False where one would have two, or where only one of the two is there."""
    return all(lines.setdefault(old, new) == new and (old == 0) == (new == 0) for old, new in pairs)


def _fits(inner: Lines, lines: Lines) -> bool:
    return all(lines.get(old, new) == new for old, new in inner.items())


def _same_field(name: str, old: Record, new: Record, lines: Lines) -> bool:
    one, other = getattr(old, name), getattr(new, name)
    if name == "guards":
        return _same_guards(one, other, lines)
    return _paired(((one, other),), lines) if name in LINES else _same(one, other, lines)


def _same(old: object, new: object, lines: Lines) -> bool:
    """Whether two parts are the same but for their lines, which are noted."""
    if old.__class__ is not new.__class__:
        return False
    if isinstance(old, tuple) and isinstance(new, tuple):
        return len(old) == len(new) and all(_same(one, other, lines) for one, other in zip(old, new, strict=True))
    if isinstance(old, Record) and isinstance(new, Record):
        return all(_same_field(name, old, new, lines) for name in old.__struct_fields__)
    return old == new
