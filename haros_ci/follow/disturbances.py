# SPDX-License-Identifier: Apache-2.0
"""What callbacks leave behind for one another: joined with what holds where one of them begins."""

from __future__ import annotations

from collections.abc import Mapping

from haros_ci.follow import counters, handed_out
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import UNSET, UNSET_OR_INHERITED, Opaque
from haros_ci.values.cells import Slot
from haros_ci.values.effects import Effects
from haros_ci.values.state import Writes, joined

#: Reasons of values that what others write takes the place of.
UNSETS = frozenset((UNSET, UNSET_OR_INHERITED))


def disturb(walk: Walk, effects: Effects, own: int, found: Mapping[Slot, object]) -> None:
    """Join what the callbacks leave behind with what holds; of its *own* a callback sees plain values only, and parameters.

    *found* is what holds after one or another of them, of the cells that this changes.
    """
    mine = effects.every[own] if 0 <= own < len(effects) else {}
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
