# SPDX-License-Identifier: Apache-2.0
"""Predicates on messages: what they mean, and that what cannot be had makes them false."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, ClassVar

import pytest

from haros_ci.behaviour.parser import parse_property
from haros_ci.monitoring.patterns import monitor_of
from haros_ci.monitoring.verdict import Verdict


@dataclass
class Point:
    x: float = 3.0
    y: float = 4.0
    LIMIT: ClassVar[int] = 9


@dataclass
class Stamp:
    sec: int = 7
    nanosec: int = 8


@dataclass
class Deep:
    p: Point = field(default_factory=Point)
    at: Stamp = field(default_factory=Stamp)
    values: tuple[int, ...] = (1, 2, 3)


MESSAGE = {
    "x": 3, "y": 4.0, "text": "abc", "on": True, "values": [1, 2, 3], "none": [], "nan": math.nan, "p": {"x": 1, "y": 2},
    "points": [{"x": 1}, {"x": 5}], "q": {"x": 0.0, "y": 0.0, "z": 1.0, "w": 0.0}, "pose": {"orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}},
}  # fmt: skip


def holds(predicate: str, message: Any = MESSAGE) -> bool:
    watched = monitor_of(parse_property(f"globally: no /a as M {{{predicate}}}"))
    watched.start(0)
    watched.take("/a", message, 0, 1)
    return watched.finish(0).verdict is Verdict.VIOLATED


@pytest.mark.parametrize(
    "predicate",
    [
        "x = 3", "x = 3.0", "x != 4", "x < y", "x <= 3", "y > x", "y >= 4", "on", "on = True", 'text = "abc"', 'text != "ab"', "not x = 4",
        "x + 1 = y", "y - x = 1", "x * y = 12", "y / x > 1.3", "x ** 2 = 9", "-x < 0", "x = 3 and y = 4", "x = 1 or y = 4", "x = 1 implies y = 9",
        "x = 3 iff y = 4", "x in [0 to 3]", "not x in [0 to 3]!", "not x in ![3 to 4]", "x in {1, 3}", "x in values", "not x in none",
        "values[0] = 1", "values[x - 1] = 3", "p.y = 2", "points[1].x = 5", "@M.x = 3", "@M.p.x = 1",
        "forall i in values: values[@i] > 0", "exists i in values: values[@i] = 3", "exists i in [0 to 2]: values[@i] = 2", "exists i in {0, 2}: values[@i] = 3",
        "forall i in none: none[@i] > 0", "not (exists i in none: none[@i] > 0)", "exists i in points: points[@i].x = 5",
        "len(values) = 3", "len(text) = 3", "sum(values) = 6", "prod(values) = 6", "max(values) = 3", "max(x, y, 9) = 9", "min(values) = 1", "gcd(x, 6) = 3",
        "abs(-x) = 3", "sqrt(y) = 2", "ceil(3.2) = 4", "floor(3.8) = x", "log(8, 2) = x", "atan2(0, 1) = 0", "sin(0) = 0", "cos(0) = 1", "int(3.9) = x",
        'str(x) = "3"', "bool(x)", 'float("2.5") = 2.5', "deg(PI) = 180", "abs(abs(yaw(q)) - PI) < 0.001", "roll(pose) = 0", "pitch(0, 0, 0, 1) = 0",
        "nan != nan", "nan != 1", "len(points) = 2", "x < INF",
    ],
)  # fmt: skip
def test_holds(predicate: str) -> None:
    assert holds(predicate)


@pytest.mark.parametrize(
    "predicate",
    [
        "x = 4", "nan = nan", "nan < 1", "nan > 1", "values[3] = 1", "not values[3] = 1", "values[-1] = 3", "values[0.5] = 1", "missing = 1", "not missing = 1", "p.z = 1",
        "text < 3", "text[0] = 1", "x / 0 = 1", "sqrt(-1) = 1", "log(0, 2) = 1", "x.y = 1", 'int("a") = 1', "values > 1", "on.x", "x in [4 to 9]",
        "len(x) = 1", "exists i in [0 to 100000000]: @i = 5", "x ** 1e308 = 1", "(x ** 64) ** 64 ** 64 < 0", "-1 ** 0.5 = 1", "asin(2) = 1",
        "roll(p) = 0", "max(none) = 1", "sum(points) = 1",
    ],
)  # fmt: skip
def test_does_not_hold(predicate: str) -> None:
    assert not holds(predicate)


@pytest.mark.parametrize(
    "predicate",
    ["p.x = 3", "values[1] = 2", "p.LIMIT = 9", "len(values) = 3", "at.sec = 7", "at.secs = 7", "at.nsecs = 8"],
)
def test_messages_of_bags_are_instances(predicate: str) -> None:
    assert holds(predicate, Deep())


@pytest.mark.parametrize(
    "predicate", ["p.__class__ != 1", "__dataclass_fields__ != 1", "values.count != 1", "p.x.real = 3", "_x != 1"]
)
def test_nothing_but_fields_of_messages_is_looked_up(predicate: str) -> None:
    assert not holds(predicate, Deep())


def test_arrays_of_numpy_give_plain_numbers() -> None:
    numpy = pytest.importorskip("numpy", reason="the extra [bags] is not installed")
    message = {"r": numpy.array([0.1, 2], dtype=numpy.float32), "b": numpy.array([200, 100], dtype=numpy.uint8)}
    assert holds("b[0] + b[1] = 300", message)
    assert holds("sum(b) = 300", message)
    assert not holds("r[0] = 0.1", message)
    assert holds("len(r) = 2 and 2 in r", message)


def test_what_a_message_does_not_have_is_counted() -> None:
    watched = monitor_of(parse_property("globally: no /a {x > 1}"))
    watched.start(0)
    for number in range(3):
        watched.take("/a", {"y": 1}, 0, number)
    found = watched.finish(0)
    assert (found.faults, found.faulty_topic) == (3, "/a")
