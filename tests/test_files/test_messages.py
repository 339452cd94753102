# SPDX-License-Identifier: Apache-2.0
"""What generated tests draw: values at the boundaries of predicates, and messages that have them."""

from __future__ import annotations

import math
import struct
from typing import Any

import pytest
from hypothesis import find, given, settings
from hypothesis import strategies as st
from hypothesis.errors import NoSuchExample, Unsatisfiable

from haros_ci.test_files.property_tests import messages as m

FEW = settings(max_examples=300, database=None, derandomize=True)


def drawn(strategy: Any, condition: Any) -> bool:
    """Whether *strategy* gives a value for which *condition* holds, soon."""
    try:
        find(strategy, condition, settings=FEW)
    except (NoSuchExample, Unsatisfiable):
        return False
    return True


@pytest.mark.parametrize("value", [31, 32, 33, -128, 127, 0])
def test_whole_numbers_beside_a_boundary_come_soon(value: int) -> None:
    assert drawn(m.whole(-128, 127, near=(32,)), lambda number: number == value)


@pytest.mark.parametrize(
    ("strategy", "value"),
    [
        (m.whole(0, 255, near=(300, -5)), 301),
        (m.whole(0, 10), 11),
        (m.whole(0, 10, near=(math.inf, math.nan)), -1),
        (m.floats(-1.0, 1.0, near=(5.0,)), 5.0),
        (m.floats(0.0, 1.0, open_low=True), 0.0),
        (m.floats(0.0, 1.0, open_high=True), 1.0),
    ],
)
def test_nothing_comes_from_outside(strategy: Any, value: float) -> None:
    assert not drawn(strategy, lambda number: number == value)


@pytest.mark.parametrize("value", [-1.0, math.nextafter(-1.0, 0), math.nextafter(-1.0, -2), 0.0])
def test_floating_point_numbers_beside_a_boundary_come_soon(value: float) -> None:
    assert drawn(m.floats(near=(-1.0,)), lambda number: number == value)


@FEW
@given(st.floats(allow_nan=False, allow_infinity=False))
def test_the_next_number_is_that_of_the_standard_library(number: float) -> None:
    if abs(number) < 1.7e308:
        assert m.beyond(number, 1, 64) == math.nextafter(number, math.inf)
        assert m.beyond(number, -1, 64) == math.nextafter(number, -math.inf)


@FEW
@given(st.floats(width=32, allow_nan=False, allow_infinity=False, min_value=-(2.0**100), max_value=2.0**100))
def test_numbers_of_32_bits_stay_such(number: float) -> None:
    for direction in (-1, 1):
        other = m.beyond(number, direction, 32)
        assert struct.unpack("<f", struct.pack("<f", other))[0] == other
        assert (other > number) is (direction > 0)


@FEW
@given(m.floats(-0.1, 0.1, near=(0.05,), bits=32))
def test_ends_that_are_no_numbers_of_32_bits_stay_out(number: float) -> None:
    assert -0.1 <= number <= 0.1
    assert struct.unpack("<f", struct.pack("<f", number))[0] == number


@FEW
@given(m.floats() | m.floats(bits=32) | m.floats(0.0))
def test_no_number_is_infinite_unless_it_is_asked_for(number: float) -> None:
    assert math.isfinite(number)


def test_an_empty_range_gives_nothing() -> None:
    assert not drawn(m.floats(1.0, 0.0), lambda number: True)


@pytest.mark.parametrize(
    ("path", "value", "made"),
    [
        (("x",), 5, {"x": 5, "inner": {"y": 0}, "items": [1]}),
        (("inner", "y"), 5, {"x": 0, "inner": {"y": 5}, "items": [1]}),
        (("items", 0), 5, {"x": 0, "inner": {"y": 0}, "items": [5]}),
        (("items", 2), 5, {"x": 0, "inner": {"y": 0}, "items": [1, 1, 5]}),
        (("items", m.LENGTH), 3, {"x": 0, "inner": {"y": 0}, "items": [1, 1, 1]}),
        (("items", m.LENGTH), 0, {"x": 0, "inner": {"y": 0}, "items": []}),
    ],
)
def test_a_value_is_put_where_its_path_leads(path: m.Path, value: Any, made: Any) -> None:
    message = {"x": 0, "inner": {"y": 0}, "items": [1]}
    m.put(message, path, value)
    assert message == made


def test_items_of_an_array_of_messages_are_apart() -> None:
    message = {"items": [{"y": 0}]}
    m.put(message, ("items", 1, "y"), 5)
    assert message == {"items": [{"y": 0}, {"y": 5}]}


@pytest.mark.parametrize(
    ("message", "made"),
    [
        ({"header": {"stamp": {"secs": 0, "nsecs": 0}}}, {"header": {"stamp": {"secs": 7, "nsecs": 5}}}),
        ({"stamp": {"sec": 0, "nanosec": 0}}, {"stamp": {"sec": 7, "nanosec": 5}}),
        ([{"stamp": {"secs": 0, "nsecs": 0}}], [{"stamp": {"secs": 7, "nsecs": 5}}]),
        ({"stamp": {"secs": 1, "nsecs": 0}}, {"stamp": {"secs": 1, "nsecs": 0}}),
        ({"stamp": 0, "secs": 0}, {"stamp": 0, "secs": 0}),
        ({"at": {"secs": 0, "nsecs": 0}}, {"at": {"secs": 0, "nsecs": 0}}),
    ],
)
def test_a_stamp_that_is_not_set_becomes_now(message: Any, made: Any) -> None:
    assert m.stamped(message, 7_000_000_005) == made
