# SPDX-License-Identifier: Apache-2.0
"""What callbacks leave behind for one another: joined with what holds where one of them begins."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Mapping, Sequence
from itertools import accumulate

from haros_ci.follow import counters, handed_out
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import UNSET, UNSET_OR_INHERITED, Opaque
from haros_ci.values.cells import Slot
from haros_ci.values.state import Writes, joined

#: Reasons of values that what others write takes the place of.
UNSETS = frozenset((UNSET, UNSET_OR_INHERITED))


class Effects:
    """What several callbacks write, in their order; of each cell, what all but one leave behind is joined once."""

    def __init__(self, every: Sequence[Writes]) -> None:
        self.every = every
        #: Of the few cells that are asked for: the callbacks that write it, and what those up to and from each leave behind.
        self._sides: dict[Slot, tuple[list[int], list[object], list[object]]] = {}

    def besides(self, cell: Slot, own: int) -> list[object]:
        """What the others leave behind in *cell*: those before the callback of the number *own*, and those after it."""
        if cell not in self._sides:
            numbers = [number for number, writes in enumerate(self.every) if cell in writes]
            values = [self.every[number][cell] for number in numbers]
            back = list(accumulate(reversed(values), lambda later, value: joined(value, later)))
            self._sides[cell] = numbers, list(accumulate(values, joined)), back[::-1]
        numbers, before, after = self._sides[cell]
        place = bisect_left(numbers, own)
        rest = place + (place < len(numbers) and numbers[place] == own)
        return [*before[place - 1 : place], *after[rest : rest + 1]] if place else after[rest : rest + 1]


def disturb(walk: Walk, effects: Effects, own: int, found: Mapping[Slot, object]) -> None:
    """Join what the callbacks leave behind with what holds; of its *own* a callback sees plain values only, and parameters.

    *found* is what holds after one or another of them, of the cells that this changes.
    """
    mine = effects.every[own] if 0 <= own < len(effects.every) else {}
    for cell, value in found.items():
        if cell in mine and not (
            cell is walk.server or cell is walk.declared or counters.is_seen_again(cell.value, mine[cell])
        ):
            for left in effects.besides(cell, own):
                after = _joined(cell.value, left)
                if after is not cell.value:
                    walk.state.put(cell, after)
        else:
            walk.state.put(cell, value)
    if walk.handed:
        handed_out.changed(walk)


def changed(together: Mapping[Slot, object]) -> Writes:
    """Of what callbacks may leave behind, joined with what holds: the cells that hold something else then."""
    after = {cell: _joined(cell.value, value) for cell, value in together.items()}
    return {cell: value for cell, value in after.items() if value is not cell.value}


def _joined(held: object, value: object) -> object:
    if held is value or (held.__class__ is Opaque and held.reason not in UNSETS):
        return held
    return joined(held, value)


def all_together(walk: Walk) -> Mapping[Slot, object]:
    """What each cell holds after one or another of the callbacks rehearsed so far; each is joined once."""
    together(walk.effects[walk.joined :], walk.together)
    walk.joined = len(walk.effects)
    return walk.together


def together(effects: Iterable[Writes], found: Writes | None = None) -> Writes:
    """What each cell holds after one or another of the callbacks, or after what is *found* already."""
    found = {} if found is None else found
    for writes in effects:
        for cell, value in writes.items():
            found[cell] = joined(found[cell], value) if cell in found else value
    return found
