# SPDX-License-Identifier: Apache-2.0
"""What several callbacks write, and what they leave behind for one another."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable
from itertools import accumulate

from haros_ci.values.cells import Slot
from haros_ci.values.state import Writes, joined


class Effects:
    """What several callbacks write, in their order: joined cell by cell once, and without one of them for that one."""

    def __init__(self, every: Iterable[Writes] = ()) -> None:
        self.every: list[Writes] = []
        #: What each cell holds after one or another of the callbacks.
        self.together: Writes = {}
        #: Of each cell, the first and the last callback that writes it, and whether they leave different things behind.
        self._first: dict[Slot, int] = {}
        self._last: dict[Slot, int] = {}
        self._differing: set[Slot] = set()
        #: Of the few of these that are asked for: the callbacks that write it, and what those up to and from each leave behind.
        self._sides: dict[Slot, tuple[list[int], list[object], list[object]]] = {}
        for writes in every:
            self.append(writes)

    def __len__(self) -> int:
        return len(self.every)

    def append(self, writes: Writes) -> None:
        """Add what one more callback writes."""
        number, together, last = len(self.every), self.together, self._last
        self.every.append(writes)
        for cell, value in writes.items():
            last[cell] = number
            if cell not in together:
                together[cell], self._first[cell] = value, number
            elif together[cell] is not value:
                together[cell] = joined(together[cell], value)
                self._differing.add(cell)
        self._sides.clear()

    def copy(self) -> Effects:
        """The same callbacks, to which others are not added."""
        copied = Effects()
        copied.every, copied.together = self.every[:], self.together.copy()
        copied._first, copied._last, copied._differing = self._first.copy(), self._last.copy(), self._differing.copy()
        return copied

    def besides(self, cell: Slot, own: int) -> list[object]:
        """What the others leave behind in *cell*: those before the callback of the number *own*, and those after it."""
        if cell not in self.together:
            return []
        if cell not in self._differing:
            return [self.together[cell]] * ((self._first[cell] < own) + (own < self._last[cell]))
        if cell not in self._sides:
            numbers = [number for number, writes in enumerate(self.every) if cell in writes]
            values = [self.every[number][cell] for number in numbers]
            back = list(accumulate(reversed(values), lambda later, value: joined(value, later)))
            self._sides[cell] = numbers, list(accumulate(values, joined)), back[::-1]
        numbers, before, after = self._sides[cell]
        place = bisect_left(numbers, own)
        rest = place + (place < len(numbers) and numbers[place] == own)
        return [*before[place - 1 : place], *after[rest : rest + 1]] if place else after[rest : rest + 1]
