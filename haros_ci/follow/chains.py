# SPDX-License-Identifier: Apache-2.0
"""What one callback leaves behind lets another, or itself when it runs again, leave something else behind: states that follow one another.

Callbacks are rehearsed until nothing new comes. What is still new when that has taken its time is not known.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from haros_ci.follow.made import Root
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import Cell, Choice, Known, Opaque, tick
from haros_ci.values.cells import Slot
from haros_ci.values.effects import Effects
from haros_ci.values.state import Writes, joined

#: Steps of rehearsals of a node up to which all of its callbacks are rehearsed once more; up to which some are again and again.
CHEAP, MOST = 2_000, 30_000
#: Rehearsals of each callback: a choice of more values than these could find is not known anyway.
ROUNDS = 10
#: Variables of all callbacks together from which on each callback is rehearsed twice at most.
WIDE = 100_000
#: Why a value is not known.
GOES_ON = "callbacks give it one value after another"
#: Types of plain data.
PLAIN = {bool, int, float, str}


def followed(
    walk: Walk,
    batch: Sequence[Root],
    first: int,
    rehearse: Callable[[Root, Effects, int], Writes],
    put_together: Callable[[Writes, Writes], Writes],
) -> Effects:
    """What the callbacks leave behind, however often they have run, one after another.

    *batch* are those from the number *first* on: what each does by itself is in ``walk.effects``, and stays there. *rehearse* gives
    what a callback writes that begins with what others leave behind; *put_together* that with what it wrote before.
    """
    begun, every, is_cheap, spent = tick(), walk.effects.copy(), walk.rehearsed < CHEAP, dict(walk.spent)
    numbers = range(first, first + len(batch))
    cells = {} if is_cheap else _assignable(walk, numbers)
    asked = [number for number in numbers if is_cheap or _open(cells, every, number)]
    for turn in range(ROUNDS):
        if not asked:
            return every
        before, effects = every, every.every[:]
        for number in asked:
            effects[number] = put_together(effects[number], rehearse(walk.roots[number], before, number))
        walk.spent = dict(spent)  # it takes nothing of what may go into functions in earnest
        every = Effects(effects)
        new = [cell for cell in every.together if walk.is_older(cell, begun) and _is_new(cell, before, every)]
        if not new:
            return every
        cells = cells or _assignable(walk, numbers)
        if turn == ROUNDS - 1 or walk.quiet_steps > MOST or (turn and sum(map(len, cells.values())) > WIDE):
            left = {*new, *(cell for number in numbers for cell in _open(cells, every, number))}
            return Effects([*effects, {cell: Opaque(GOES_ON, type=cell.type) for cell in left}])
        asked = [number for number in numbers if _open(cells, every, number)]
    return every


def _is_new(cell: Slot, before: Effects, after: Effects) -> bool:
    """Whether a variable with plain data may hold after the callbacks what it did not hold before."""
    value, known = after.together[cell], before.together.get(cell, cell.value)
    held = joined(cell.value, known)
    if value is known or not _kinds(held):
        return False
    return isinstance(value, Opaque) or len(_options(joined(held, value))) > len(_options(held))


def _assignable(walk: Walk, numbers: Iterable[int]) -> dict[int, list[Cell]]:
    """For each callback the variables with plain data that it, or what it calls, may assign to."""
    every: dict[str, list[Cell]] = {}
    for (_, name), cell in walk.globals.items():
        if _kinds(cell.value):
            every.setdefault(name, []).append(cell)
    found: dict[int, list[Cell]] = {}
    for number in numbers:
        function = walk.roots[number].function
        names = walk.relevance.changes(function.function, function.source)
        fields = function.this.fields if function.this is not None else {}
        found[number] = [fields[name] for name in fields if name in names and _kinds(fields[name].value)]
        found[number] += [cell for name in every if name in names for cell in every[name]]
    return found


def _open(cells: Mapping[int, Sequence[Cell]], effects: Effects, number: int) -> list[Cell]:
    """Of what a callback may assign to what it has not, or to which it may assign other data than it has."""
    return [cell for cell in cells[number] if _is_open(cell, effects.every[number])]


def _is_open(cell: Cell, mine: Writes) -> bool:
    left = _kinds(mine.get(cell))
    return cell not in mine or (bool(left) and _kinds(cell.value) | left != {bool})


def _kinds(value: object) -> set[type]:
    """The types of the plain data that a value may be; none where it may be something else."""
    found = {option.kind if isinstance(option, Known) else object for option in _options(value)}
    return found if found <= PLAIN else set()


def _options(value: object) -> tuple[object, ...]:
    return value.options if isinstance(value, Choice) else (value,)
