# SPDX-License-Identifier: Apache-2.0
"""Which ends can exist at the same time."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import product
from typing import TYPE_CHECKING

from haros_ci.model.architecture import Condition
from haros_ci.model.presence import together

if TYPE_CHECKING:
    from haros_ci.checking.system import End


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


def _on_branches(one: End, other: End) -> bool:
    """Whether the code makes either the one or the other: below ``if`` and ``else`` of one statement, in one process."""
    first, second = one.node.raw, other.node.raw
    if first.process != second.process or one.node.type != other.node.type:
        return bool(first.conditions and second.conditions) and first.conditions != second.conditions
    mine, theirs = ((*end.node.raw.conditions, *end.conditions) for end in (one, other))
    return any(_branches(a, b) for a in mine for b in theirs)


def _branches(one: Condition, other: Condition) -> bool:
    if one.location.path != other.location.path or one.condition != other.condition:
        return False
    return (one.statement, other.statement) in (("if", "else"), ("else", "if"))
