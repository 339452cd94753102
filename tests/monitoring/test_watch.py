# SPDX-License-Identifier: Apache-2.0
"""Several properties against one recording: who gets which message, by which clock, and what cannot be had."""

from __future__ import annotations

from typing import Any

import pytest

from haros_ci.behaviour.parser import parse_property
from haros_ci.monitoring.clock import Clock, Stamped, Timed, stamp_of
from haros_ci.monitoring.patterns import monitor_of
from haros_ci.monitoring.verdict import Verdict
from haros_ci.monitoring.watch import Watch

MS, SECOND = 1_000_000, 1_000_000_000


def watch(*texts: str, by_header: bool = False, names: dict[str, str] | None = None) -> Watch:
    return Watch((monitor_of(parse_property(text), names or {}) for text in texts), by_header=by_header)


def stamped(time: int, **fields: Any) -> dict[str, Any]:
    return {"header": {"stamp": {"sec": time // SECOND, "nanosec": time % SECOND}}, **fields}


@pytest.mark.parametrize(
    ("times", "expected"),
    [
        ((5, 7, 7, 9), [5, 7, 7, 9]),
        ((5, 4, 6), [5, 5, 6]),
        ((10 * SECOND, SECOND, 2 * SECOND), [10 * SECOND, 10 * SECOND, 11 * SECOND]),
        ((10 * SECOND, SECOND, 1, 2 * SECOND), [10 * SECOND, 10 * SECOND, 10 * SECOND, 11 * SECOND]),
        ((10 * SECOND, 9 * SECOND, 9 * SECOND + 5), [10 * SECOND, 10 * SECOND, 10 * SECOND + 5]),
        ((10 * SECOND, 9 * SECOND + 1, 9 * SECOND + 5, 11 * SECOND), [10 * SECOND] * 3 + [11 * SECOND]),
    ],
)
def test_times_only_go_on(times: tuple[int, ...], expected: list[int]) -> None:
    clock = Clock()
    assert [clock.at(time, number) for number, time in enumerate(times, 1)] == expected


def test_steps_back_are_counted() -> None:
    clock = Clock()
    for number, time in enumerate((0, 5 * SECOND, 5 * SECOND - 1, 0, 1), 1):
        clock.at(time, number)
    assert (clock.noise, clock.jumps, clock.first_jump) == (1, 1, 4)


@pytest.mark.parametrize(
    ("step", "noise", "jumps"), [(1, 1, 0), (SECOND - 1, 1, 0), (SECOND, 0, 1), (SECOND + 1, 0, 1)]
)
def test_only_a_step_of_less_than_a_second_is_noise(step: int, noise: int, jumps: int) -> None:
    """As docs/monitor.md and the note say: a step of exactly 1 s is a clock that was set back."""
    clock = Clock()
    clock.at(5 * SECOND, 1)
    assert clock.at(5 * SECOND - step, 2) == 5 * SECOND
    assert (clock.noise, clock.jumps) == (noise, jumps)


def test_stamps_wait_for_those_less_than_a_second_before_them() -> None:
    def order(*stamps: int) -> list[int]:
        waiting, found = Stamped(), list[int]()
        for number, stamp in enumerate(stamps, 1):
            found += [timed.time for timed in waiting.put(Timed(number, "/a", 0, None), stamp)]
        return found

    assert order(SECOND, 2 * SECOND - 1) == []
    assert order(SECOND, 2 * SECOND) == [SECOND]


@pytest.mark.parametrize(
    ("message", "stamp"),
    [
        (stamped(1_500_000_000), 1_500_000_000),
        ({"header": {"stamp": {"secs": 2, "nsecs": 3}}}, 2_000_000_003),
        (stamped(0), None),
        ({"header": {"stamp": {"sec": "1", "nanosec": 0}}}, None),
        ({"header": {"stamp": {"sec": 1 << 60, "nanosec": 0}}}, None),
        ({"header": 3}, None),
        ({}, None),
        (3, None),
    ],
)
def test_stamps(message: Any, stamp: int | None) -> None:
    assert stamp_of(message) == stamp


def test_messages_are_in_the_order_of_their_stamps() -> None:
    text = "globally: /b requires /a within 5 ms"
    for by_header, verdict in ((True, Verdict.HELD), (False, Verdict.VIOLATED)):
        watched = watch(text, by_header=by_header)
        watched.take("/b", stamped(SECOND + 4 * MS), 100 * MS, 1)
        watched.take("/a", stamped(SECOND), 101 * MS, 2)
        if not by_header:
            watched.begin(0) if watched.began is None else None
        assert watched.finish(None)[0].verdict is verdict


def test_messages_without_a_stamp_leave_their_properties_undecided() -> None:
    watched = watch("globally: no /a {x > 1}", "globally: no /b {x > 1}", by_header=True)
    watched.take("/a", stamped(SECOND, x=1), 0, 1)
    watched.take("/b", {"x": 2}, 0, 2)
    first, second = watched.finish(None)
    assert (first.verdict, second.verdict) == (Verdict.HELD, Verdict.UNDECIDED)
    assert "message 2, on /b, has no header stamp" in second.reason


def test_what_cannot_be_read_leaves_its_properties_undecided_from_there_on() -> None:
    watched = watch("globally: no /a", "globally: some /a", "globally: /b causes /c")
    watched.begin(0)
    watched.take("/a", {}, 0, 1)
    watched.leave("/a", "message 2, on /a, cannot be read")
    watched.take("/b", {}, 1, 3)
    watched.take("/c", {}, 1, 4)
    verdicts = [each.verdict.value for each in watched.finish(2)]
    assert verdicts == ["violated", "held", "held"]


@pytest.mark.parametrize(
    ("property", "verdict"),
    [
        ("globally: no /a", "violated"),
        ("globally: some /a", "held"),
        ("globally: /b causes /a within 1 s", "held"),
        ("globally: /a forbids /c {x > 0}", "violated"),
        ("globally: /c {x = 1} requires /a", "held"),
        ("after /a until /d: no /c {x > 0}", "violated"),
        ("until /a: no /c {x > 0}", "never exercised"),
        ("globally: no (/a or /b {x > 5})", "violated"),
        ("globally: no /a {x > 0}", "undecided"),
        ("globally: /a as A forbids /c {x = @A.x}", "undecided"),
        ("after /a {x > 0}: no /c", "undecided"),
    ],
)
def test_that_it_came_is_enough_where_nothing_is_asked_of_it(property: str, verdict: str) -> None:
    watched = watch(property)
    watched.begin(0)
    for topic, number in (("/b", 1), ("/a", 2), ("/c", 3)):
        if topic == "/a":
            watched.miss("/a", "message 2, on /a, cannot be read", number, number)
        elif topic in watched.topics:
            watched.take(topic, {"x": 1}, number, number)
    assert watched.finish(3)[0].verdict.value == verdict and watched.counts["/a"] == 1


def test_by_header_stamps_a_message_has_to_be_had() -> None:
    watched = watch("globally: no /a", by_header=True)
    watched.miss("/a", "message 1, on /a, cannot be read", 1, 1)
    assert watched.finish(2)[0].verdict is Verdict.UNDECIDED


def test_topics_are_called_as_in_the_recording() -> None:
    watched = watch("globally: no cmd {x > 1}", names={"cmd": "/robot/cmd"})
    assert watched.topics == {"/robot/cmd"}
    watched.take("/robot/cmd", {"x": 2}, 0, 1)
    (outcome,) = watched.finish(None)
    assert (outcome.verdict, outcome.witnesses[0].topic) == (Verdict.VIOLATED, "/robot/cmd")


@pytest.mark.parametrize(("recorded", "verdict"), [({"/a"}, "held"), ({"/b"}, "never exercised"), (None, "held")])
def test_what_was_not_recorded_is_not_held(recorded: set[str] | None, verdict: str) -> None:
    watched = watch("globally: no /a")
    watched.begin(0)
    (outcome,) = watched.finish(9, None if recorded is None else frozenset(recorded))
    assert outcome.verdict.value == verdict


@pytest.mark.parametrize(("end", "verdict"), [(4, "undecided"), (5, "violated")])
def test_the_end_of_the_recording_counts(end: int, verdict: str) -> None:
    watched = watch("globally: /a causes /b within 5 ms")
    watched.begin(0)
    watched.take("/a", {}, 0, 1)
    assert watched.finish(end * MS)[0].verdict.value == verdict


def test_an_empty_recording() -> None:
    assert [each.verdict.value for each in watch("globally: some /a", "globally: /a causes /b").finish(None)] == [
        "undecided", "never exercised"]  # fmt: skip


@pytest.mark.parametrize(
    ("property", "recorded", "reason"),
    [
        ("globally: /a causes /b within 1 s", {"/a"}, "/b did not come within 1 s; the recording does not have /b"),
        ("globally: /a causes /b within 1 s", {"/a", "/b"}, "/b did not come within 1 s"),
        ("globally: /a causes (/b or /c) within 1 s", {"/a", "/c"}, "/b or /c did not come within 1 s"),
    ],
)
def test_it_is_said_where_a_topic_was_not_recorded(property: str, recorded: set[str], reason: str) -> None:
    watched = watch(property)
    watched.take("/a", {}, 0, 1)
    (outcome,) = watched.finish(5 * SECOND, frozenset(recorded))
    assert (outcome.verdict, outcome.reason) == (Verdict.VIOLATED, reason)
