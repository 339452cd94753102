# SPDX-License-Identifier: Apache-2.0
"""Whether a turn of a loop has left everything as it was; what callbacks leave behind for one another."""

from __future__ import annotations

import pytest

from haros_ci.follow.disturbances import Effects
from haros_ci.values.abstract import Cell, Choice, Known, Opaque, Value, tick
from haros_ci.values.state import State

ONE, TWO, OPEN = Known(1), Known(2), Opaque("why")


@pytest.mark.parametrize(
    ("before", "writes", "expected"),
    (
        (ONE, [], True),
        (ONE, [Known(1)], True),
        (ONE, [TWO, Known(1)], True),
        (OPEN, [Opaque("why")], True),
        (Choice((ONE, TWO)), [Choice((Known(1), Known(2)))], True),
        (ONE, [TWO], False),
        (OPEN, [ONE], False),
        (ONE, [OPEN], False),
        (OPEN, [Opaque("why else")], False),
        (Choice((ONE, TWO)), [Choice((ONE, Known(3)))], False),
        (Choice((ONE, TWO)), [Choice((ONE, TWO, Known(3)))], False),
    ),
)
def test_a_state_is_as_it_was(before: Value, writes: list[Value], expected: bool) -> None:
    state, cell = State(), Cell(before)
    mark, begun = state.mark(), tick()
    for value in writes:
        state.write(cell, value)
    state.write(Cell(ONE), TWO)  # of the turn itself
    assert state.is_as_at(mark, begun) is expected


def test_what_all_but_one_leave_behind() -> None:
    cell, other = Cell(ONE), Cell(ONE)
    effects = Effects([{cell: Known(1)}, {}, {cell: Known(2), other: OPEN}, {cell: Known(3)}])
    assert [effects.besides(cell, own) for own in range(4)] == [
        [Choice((Known(2), Known(3)))],
        [Known(1), Choice((Known(2), Known(3)))],
        [Known(1), Known(3)],
        [Choice((Known(1), Known(2)))],
    ]
    assert effects.besides(other, 2) == []
    assert effects.besides(Cell(ONE), 0) == []


def test_what_all_but_one_leave_behind_where_all_leave_the_same() -> None:
    cell = Cell(ONE)
    effects = Effects([{}, {cell: OPEN}, {cell: OPEN}])
    assert [effects.besides(cell, own) for own in range(4)] == [[OPEN], [OPEN], [OPEN], [OPEN]]
    assert Effects([{cell: OPEN}]).besides(cell, 0) == []


def test_effects_that_are_added() -> None:
    cell = Cell(ONE)
    effects = Effects([{cell: Known(1)}])
    before = effects.copy()
    assert effects.besides(cell, 0) == []
    effects.append({cell: Known(2)})
    assert (effects.besides(cell, 0), effects.besides(cell, 1)) == ([Known(2)], [Known(1)])
    assert effects.together == {cell: Choice((Known(1), Known(2)))}
    effects.append({cell: Known(3)})
    assert effects.besides(cell, 1) == [Known(1), Known(3)]
    assert (len(before), before.besides(cell, 0), before.together) == (1, [], {cell: Known(1)})
