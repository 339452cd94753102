# SPDX-License-Identifier: Apache-2.0
"""Functions of <algorithm> that put the elements of a list in another order (cppreference), and std::begin and std::end."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci.follow.walk import Walk
from haros_ci.values import iterators
from haros_ci.values.abstract import NONE, Cell, Known, Mapped, Object, Opaque, Partial, Sequence, Value
from haros_ci.values.state import certain, possible

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: What arranges the elements between its first two arguments; the order is known of those in SORTING without a predicate, and of std::reverse.
SORTING = frozenset(("sort", "stable_sort"))
ARRANGING = SORTING | frozenset(
    "reverse shuffle random_shuffle rotate partial_sort nth_element partition stable_partition next_permutation "
    "prev_permutation make_heap sort_heap push_heap pop_heap".split()
)
BEGINS, ENDS = frozenset(("std::begin", "std::cbegin")), frozenset(("std::end", "std::cend"))
ORDER = "the order of the elements is not known"


def called(walk: Walk, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """What such a function gives, with the list arranged; None of any other, and where it is not known of what it goes through."""
    if name in BEGINS | ENDS:
        return _edge(name, args[0].value) if len(args) == 1 else None
    short = name.removeprefix("std::")
    is_range = short.startswith("ranges::")
    short = short.removeprefix("ranges::")
    if short not in ARRANGING or not name.startswith("std::") or not args:
        return None
    listed = args[0].value if is_range else _of(args[0].value)
    if not isinstance(listed, Sequence):
        return None
    others = args[1:] if is_range else args[2:]
    is_whole = is_range or (len(args) > 1 and _is_whole(listed, args))
    _arrange(walk, listed, short if is_whole and not others else "")
    return (
        NONE
        if short not in ("rotate", "partition", "stable_partition", "next_permutation", "prev_permutation")
        else (Opaque("what an algorithm gives is not known"))
    )


def _edge(name: str, every: Value) -> Value | None:
    """``std::begin`` or ``std::end`` of a list or map."""
    if not isinstance(every, (Sequence, Mapped)):
        return None
    return iterators.at(every, 0) if name in BEGINS else iterators.end_of(every)


def _of(start: Value) -> Value | None:
    """The list that an iterator goes through."""
    of = start.fields.get("[of]") if isinstance(start, Object) and start.definition is None else None
    return of.value if of is not None else None


def _is_whole(every: Sequence, args: tuple[PassedArgument, ...]) -> bool:
    """Whether the first two arguments are the list's ``begin()`` and ``end()``."""
    return iterators.position(args[0].value) == 0 and args[1].value is every.end


def _arrange(walk: Walk, every: Sequence, name: str) -> None:
    """Put the elements of a list in the order that the function *name*, "" for one that is not known, gives them."""
    content = every.content.value
    if isinstance(content, tuple):
        if len(content) < 2:
            return
        order = list(reversed(content)) if name == "reverse" else _sorted(content) if name in SORTING else None
        if order is None:
            walk.state.write(every.content, Partial(ORDER, some=content, is_all=True))
        else:  # what an element is called by elsewhere means the same place
            for cell, value in zip(content, [other.value for other in order], strict=True):
                walk.state.write(cell, value)
    elif isinstance(content, Partial):
        walk.state.write(
            every.content,
            Partial(content.reason, content.location, content.type, certain(content), possible(content)),
        )


def _sorted(cells: tuple[Cell, ...]) -> list[Cell] | None:
    """The elements in their order; None if they are not all known, or of one kind."""
    values = [cell.value.value for cell in cells if isinstance(cell.value, Known)]
    texts = [value for value in values if type(value) is str]
    numbers = [value for value in values if type(value) in (int, float) and isinstance(value, (int, float))]
    if len(texts) == len(cells):
        return [cells[number] for number in sorted(range(len(cells)), key=lambda number: texts[number])]
    if len(numbers) == len(cells):
        return [cells[number] for number in sorted(range(len(cells)), key=lambda number: numbers[number])]
    return None
