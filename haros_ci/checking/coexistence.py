# SPDX-License-Identifier: Apache-2.0
"""Which ends can exist at the same time."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache
from itertools import product
from typing import TYPE_CHECKING

from haros_ci.model.architecture import Condition
from haros_ci.model.presence import together
from haros_ci.regex import regex
from haros_ci.results.code_alone import code_alone
from haros_ci.results.constant_tests import constants_of
from haros_ci.results.module_names import parsed

if TYPE_CHECKING:
    from haros_ci.checking.system import End


#: Statements whose condition decides whether what is below them is done once or never.
_DECIDED = ("if", "elif", "else")
#: Longer conditions count as none of values alone.
_LONGEST = 400
#: A condition of values alone, which no parameter, argument or macro changes.
_CONSTANT = regex(
    r"(?:[\d\s()<>=!&|+*/%~^,.-]|\b(?:[tT]rue|[fF]alse|not|and|or|is|in|None|nullptr|NULL)\b|\"[^\"\\]*\"|'[^'\\]*')+"
)


#: A condition on one name; and, in C++, how a name is given a value for good, or some value.
_ON_A_NAME = regex(r"(?:not\s+|!\s*)?([A-Za-z_]\w{0,100})")
_FOR_GOOD = regex(
    r"\b(?:const|constexpr)[ \t]+(?:bool|int|auto)[ \t]+(\w+)[ \t]*(?:=[ \t]*(?:true|false|\d+)|\{[ \t]*(?:true|false|\d+)[ \t]*\})[ \t]*;"
)
_GIVEN = regex(r"\b(\w+)[ \t]*(?:=(?!=)|\{)")


def is_never_made(end: End, text: Callable[[str], str] | None = None) -> bool:
    """Whether no run of its program makes it, whatever it is given: what is not compiled, or stands below ``if False``.

    With *text*, which gives the text of a file, that is so, too, below a condition on a variable that is given one value in its file, which is written there.
    """
    return end.raw.is_ruled_out and all(
        condition.statement == "#if"
        or _is_constant(condition.condition)
        or (text is not None and _is_switch(condition, text))
        for condition in end.raw.conditions
    )


def _is_switch(condition: Condition, text: Callable[[str], str]) -> bool:
    """Whether *condition* is on a variable of its file that has one value, whatever the program is given."""
    path = condition.location.path
    match = _ON_A_NAME.fullmatch(condition.condition)
    return match is not None and match[1] in (_python_constants if path.endswith(".py") else _cpp_constants)(text(path))


@lru_cache(maxsize=64)
def _python_constants(text: str) -> frozenset[str]:
    tree = parsed(text)
    return frozenset() if tree is None else frozenset(constants_of(ast.walk(tree)))


@lru_cache(maxsize=64)
def _cpp_constants(text: str) -> frozenset[str]:
    """The constants of a file of C++ whose value is written there, and whose name is given no other one."""
    code = code_alone(text, "c")
    values = Counter(_GIVEN.findall(code))
    return frozenset(name for name in _FOR_GOOD.findall(code) if values[name] == 1)


def in_doubt(conditions: tuple[Condition, ...]) -> tuple[Condition, ...]:
    """Those of *conditions*, around what no condition rules out, that may not hold: ``if True`` always does."""
    return tuple(c for c in conditions if c.statement not in _DECIDED or not _is_constant(c.condition))


def _is_constant(condition: str) -> bool:
    return len(condition) <= _LONGEST and _CONSTANT.fullmatch(condition) is not None


def can_meet(first: Iterable[End], second: Iterable[End]) -> Iterator[tuple[End, End]]:
    """The pairs of two different ends that can exist at the same time, as things are.

    Their presence conditions do not contradict each other, they are not on different branches of one statement of a program, and
    their nodes are not under different launch conditions that nobody has decided: one may be there instead of the other.
    """
    for one, other in product(tuple(first), tuple(second)):
        if one.raw.is_ruled_out or other.raw.is_ruled_out:
            continue
        if one is not other and together(one.presence, other.presence) is not None and not _on_branches(one, other):
            yield one, other


def by_types(
    givers: Iterable[End], takers: Iterable[End], differs: Callable[[End, End], bool]
) -> dict[tuple[str, str], dict[End, None]]:
    """All ends that can meet an end for which *differs* is true, by the types of the two, in the order of the pairs.

    A pair is compared only if it can add a new pair of types: there may be thousands of ends on both sides.
    """
    found: dict[tuple[str, str], dict[End, None]] = {}
    groups: dict[str, dict[int, End]] = {}
    for number, taker in enumerate(takers):
        groups.setdefault(taker.type or "", {})[number] = taker
    left: dict[tuple[str, str], dict[int, End]] = {}
    for giver in givers:
        new: list[tuple[int, End, tuple[str, str]]] = []
        for type, group in groups.items():
            pair = (giver.type or "", type)
            waiting = left.setdefault(pair, dict(group))
            hits = [
                (number, taker, pair) for number, taker in waiting.items() if _meet_and_differ(giver, taker, differs)
            ]
            if not hits and any(
                n not in waiting and _meet_and_differ(giver, taker, differs) for n, taker in group.items()
            ):
                found[pair][giver] = None
            new += hits
        for number, taker, pair in sorted(new, key=lambda item: item[0]):
            found.setdefault(pair, {}).update({giver: None, taker: None})
            del left[pair][number]
    return found


def _meet_and_differ(giver: End, taker: End, differs: Callable[[End, End], bool]) -> bool:
    return differs(giver, taker) and any(can_meet((giver,), (taker,)))


def _on_branches(one: End, other: End) -> bool:
    """Whether the code makes either the one or the other: below ``if`` and ``else`` of one statement, or in two commands, in one process."""
    first, second = one.node.raw, other.node.raw
    if first.process != second.process or one.node.type != other.node.type:
        return bool(first.conditions and second.conditions) and first.conditions != second.conditions
    mine, theirs = ((*end.node.raw.conditions, *end.conditions) for end in (one, other))
    return any(_branches(a, b) for a in mine for b in theirs) or any(
        a.condition != b.condition for a, b in zip(_commands(mine), _commands(theirs), strict=False)
    )


def _commands(conditions: Iterable[Condition]) -> list[Condition]:
    """The commands of a program that must run, those of groups before what is in them; of a group's commands one runs."""
    return [condition for condition in conditions if condition.statement == "command"]


def _branches(one: Condition, other: Condition) -> bool:
    if one.location.path != other.location.path or one.condition != other.condition:
        return False
    return (one.statement, other.statement) in (("if", "else"), ("else", "if"))
