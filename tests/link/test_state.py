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


def test_of_many_writes_to_a_map_between_two_marks_one_is_kept() -> None:
    """Each copies the map: thousands of entries, one by one, would be millions in the log."""
    state, cell, other = State(), Cell({}), Cell(())
    before = state.mark()
    for number in range(100):
        state.write(cell, {**cell.value, number: ONE})  # type: ignore[dict-item]
        state.write(other, (*other.value, Cell(ONE)))
    assert len(state._log) == 2
    middle = state.mark()
    state.write(cell, {})
    state.write(cell, {1: TWO})
    assert state.undo(middle) == {cell: {1: TWO}}
    assert len(cell.value) == len(other.value) == 100
    state.write(cell, {})
    assert set(state.undo(before)) == {cell, other}
    assert (cell.value, other.value) == ({}, ())
    state.write(cell, {1: ONE})
    assert state.undo(before) == {cell: {1: ONE}} and cell.value == {}


def test_a_log_is_full_of_contents_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("haros_ci.values.state.MOST_KEPT", 10)
    state, cell, plain = State(), Cell(tuple(Cell(ONE) for _ in range(6))), Cell(ONE)
    start = state.mark()
    for _ in range(20):
        state.write(plain, TWO)
    state.write(cell, cell.value[1:])
    assert not state.is_full
    state.mark()
    state.write(cell, cell.value[1:])
    assert state.is_full
    state.undo(start)
    assert not state.is_full


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
