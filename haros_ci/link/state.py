# SPDX-License-Identifier: Apache-2.0
"""The one mutable thing of link: what cells hold, with a log, so that branches are tried, undone and joined."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from haros_ci.link.values import NONE, Cell, Opaque, Partial, Value, join

#: What ``join`` does not know: contents of sequences and maps.
CONTENTS = frozenset((tuple, dict, Partial))
#: What cells held (or hold), by cell.
Writes = dict[Cell, Any]


@dataclass(frozen=True, slots=True)
class Held:
    """The value of a parameter that a ROS 2 node has declared or set; not *is_certain* if it has on some paths only."""

    value: Value
    is_certain: bool = True


class State:
    """Writes to cells, each with what it replaced."""

    def __init__(self) -> None:
        self._log: list[tuple[Cell, Any]] = []

    def write(self, cell: Cell, value: Any) -> None:
        self._log.append((cell, cell.value))
        cell.value = value

    def mark(self) -> int:
        """A point to come back to."""
        return len(self._log)

    def since(self, mark: int) -> Writes:
        """The cells written since *mark*, with what they hold now."""
        return {cell: cell.value for cell, _ in self._log[mark:]}

    def undo(self, mark: int) -> Writes:
        """Go back to *mark*; what was written since is returned."""
        writes = self.since(mark)
        while len(self._log) > mark:
            cell, old = self._log.pop()
            cell.value = old
        return writes

    def merge(self, branches: list[Writes]) -> None:
        """Let each cell hold the join of what it holds after each branch; a branch that leaves it alone counts, too."""
        if len(branches) == 1:
            for cell, value in branches[0].items():
                self.write(cell, value)
            return
        first, *rest = branches
        for cell in dict.fromkeys(cell for branch in branches for cell in branch):
            held = cell.value
            value = first.get(cell, held)
            for branch in rest:
                other = branch.get(cell, held)
                if other is not value:
                    value = joined(value, other)
            self._log.append((cell, held))
            cell.value = value


def joined(one: Any, other: Any) -> Any:
    """``join``, also for the contents of sequences and maps (element by element, where they have the same shape)."""
    if one is other:
        return one
    if one.__class__ not in CONTENTS and other.__class__ not in CONTENTS:
        return join(one, other)
    if isinstance(one, tuple) and isinstance(other, tuple):
        if len(one) == len(other) and all(a is b for a, b in zip(one, other, strict=True)):
            return one
        return partial("the list has other elements on other paths", one, other)
    if isinstance(one, dict) and isinstance(other, dict):
        if one.keys() == other.keys() and all(one[k] is other[k] for k in one):
            return one
        if not any(isinstance(value, Cell) for value in (*one.values(), *other.values())):
            missing = Opaque("it is set on some paths only")
            return {k: _entry(one.get(k, missing), other.get(k, missing)) for k in {**one, **other}}
        return Opaque("the map has other entries on other paths")
    if isinstance(one, (tuple, dict)) or isinstance(other, (tuple, dict)):
        return partial("its elements are not known on every path", one, other)
    if isinstance(one, Partial) or isinstance(other, Partial):
        return partial(one.reason if isinstance(one, Opaque) else other.reason, one, other)
    return join(one, other)


def _entry(one: Any, other: Any) -> Any:
    """What is held under one key: of what a ROS 2 node declares, the value stays known where only one way has it."""
    held = [each for each in (one, other) if isinstance(each, Held)]
    if not held:
        return join(one, other)
    told = [each for each in held if each.value != NONE]
    if len(told) < 2:
        return Held(told[0].value, False) if told else held[0]
    return Held(join(told[0].value, told[1].value), told[0].is_certain and told[1].is_certain)


def certain(content: Any) -> tuple[Cell, ...]:
    """The elements that a sequence of that content has for sure."""
    return content if isinstance(content, tuple) else content.some if isinstance(content, Partial) else ()


def partial(reason: str, one: Any, other: Any) -> Opaque:
    """The content of a sequence that has one or the other: what both have is in it."""
    second = certain(other)
    some = tuple(cell for cell in certain(one) if any(cell is each for each in second))
    return Partial(reason, some=some) if some else Opaque(reason)
