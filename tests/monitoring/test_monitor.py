# SPDX-License-Identifier: Apache-2.0
"""One property against messages: what docs/hpl.md says, held to sentences about the whole recording, and defects that must be seen."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from monitoring.traces import PATTERNS, SCOPES, Trace, drawn, traced, verdict

from haros_ci.behaviour.parser import parse_property
from haros_ci.monitoring import monitor, patterns, pool
from haros_ci.monitoring.monitor import Monitor
from haros_ci.monitoring.patterns import monitor_of
from haros_ci.monitoring.verdict import Outcome, Verdict

MS = 1_000_000


def outcome(text: str, messages: list[tuple[str, Any, int]] | Trace, limit: int = pool.MOST_KEPT) -> Outcome:
    """Of messages with their times in milliseconds; a number is the field ``data``."""
    watched = monitor_of(parse_property(text), limit=limit)
    watched.start(0)
    for number, (topic, message, time) in enumerate(messages, 1):
        if topic in watched.topics:
            watched.take(topic, message if isinstance(message, dict) else {"data": message}, time * MS, number)
    return watched.finish(messages[-1][2] * MS if messages else 0)


def differences(pattern: str, count: int, length: int = 12) -> Iterator[tuple[str, Trace, object, object]]:
    """Where monitors and sentences disagree on *count* recordings for each scope."""
    for scope in SCOPES:
        draw = random.Random(f"{pattern} {scope}")
        for _ in range(count):
            property, trace = drawn(draw, pattern, scope), traced(draw, length)
            said = outcome(str(property), trace)
            ours = said.verdict.value, None if said.time is None else round(said.time * 1000)
            if ours != (expected := verdict(property, trace)):
                yield str(property), trace, ours, expected


@pytest.mark.parametrize("pattern", PATTERNS)
def test_monitors_say_what_the_sentences_say(pattern: str) -> None:
    assert not list(differences(pattern, 250))


@pytest.mark.parametrize("pattern", PATTERNS)
def test_every_verdict_is_among_the_random_recordings(pattern: str) -> None:
    draw = random.Random(pattern)
    seen = {verdict(drawn(draw, pattern, scope), traced(draw))[0] for scope in SCOPES for _ in range(250)}
    open_ended = {"undecided"} if pattern in ("some", "causes") else set()
    assert seen == {"held", "violated", "never exercised"} | open_ended


@pytest.mark.parametrize(
    ("required", "verdict"),
    [
        ("/c", "held"),
        ("(/a or /c)", "held"),
        ("(/a {data = @B.data} or /c)", "held"),
        ("(/c or /a {data = @B.data})", "held"),
        ("(/a {data = @B.data} or /c {data > 0})", "held"),
        ("(/a {data = @B.data} or /c {data > 1})", "violated"),
        ("/a {data = @B.data}", "violated"),
    ],
)
def test_each_of_several_events_is_enough(required: str, verdict: str) -> None:
    """The smallest recording of the second difference to HAROS's monitors that docs/hpl.md states."""
    assert outcome(f"globally: /b as B requires {required} within 5 s", [("/c", 1, 0), ("/b", 2, 1)]).verdict.value == verdict  # fmt: skip


def _closed(self: Monitor, since: int, time: int) -> bool:
    return self.window is None or time - since <= self.window


def _kept_open(self: Monitor, record: pool.Record) -> None:
    self.ended(record)


def _first_stays(self: pool.Pool, record: pool.Record) -> None:
    self.records.setdefault(self._key(record), record)


def _last_stays(self: pool.Pool, record: pool.Record) -> None:
    self.records[self._key(record)] = record


def _trigger_first(self: patterns.Response, roles: Any, topic: str, message: Any, time: int, number: int) -> None:
    if roles.trigger is not None and roles.trigger.matches(message, self.known):
        self.triggered(roles.trigger, topic, message, time, number)
    if roles.behaviour is not None and self.pool:
        self.answer(roles.behaviour, message)


@pytest.mark.parametrize(
    ("owner", "name", "defect", "patterns_of_it"),
    [
        (monitor.Monitor, "in_window", _closed, ("no", "some", "causes")),
        (monitor.Monitor, "close", _kept_open, ("no", "forbids", "requires")),
        (pool.Pool, "add", _first_stays, ("forbids", "requires")),
        (pool.Pool, "add", _last_stays, ("causes",)),
        (pool.Pool, "drop_until", lambda self, time: None, ("forbids", "requires")),
        (pool.Pool, "clear", lambda self: None, ("forbids", "requires")),
        (patterns.Response, "step", _trigger_first, ("causes",)),
        (patterns.Response, "expire", lambda self, time: None, ("causes",)),
        (patterns.Existence, "ended", lambda self, record: None, ("some",)),
        (patterns.Requirement, "is_founded", lambda self, behaviour, message: bool(self.pool), ("requires",)),
    ],
)
def test_a_defect_is_seen(
    owner: type, name: str, defect: Callable[..., Any], patterns_of_it: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(owner, name, defect)
    for pattern in patterns_of_it:
        assert any(differences(pattern, 2_000, length=24)), pattern


A, B, Q = "/a", "/b", "/q"


@pytest.mark.parametrize(
    ("text", "messages", "said"),
    [
        ("globally: no /a", [(A, 1, 5)], ("violated", 0.005, [("behaviour", A, 1)])),
        ("globally: /a causes /b within 5 ms", [(A, 1, 0), (B, 1, 5)], ("violated", 0.005, [("trigger", A, 1)])),
        ("globally: /a causes /b within 5 ms", [(A, 1, 0), (B, 1, 4)], ("held", None, [])),
        ("globally: /a causes /b within 5 ms", [(A, 1, 0), (B, 1, 4), (A, 1, 6)], ("undecided", None, [])),
        ("globally: /a causes /b", [(A, 1, 0)], ("undecided", None, [])),
        ("globally: /a causes /b", [(B, 1, 0)], ("never exercised", None, [])),
        ("globally: some /a within 5 ms", [(B, 1, 5)], ("violated", 0.005, [])),
        ("after /b: some /a", [(A, 1, 5)], ("never exercised", None, [])),
        ("until /q: some /a", [(Q, 1, 5)], ("violated", 0.005, [("terminator", Q, 1)])),
        ("after /b until /q: /a causes /b", [(B, 1, 0), (A, 1, 1), (Q, 1, 2)], ("violated", 0.002, [
            ("activator", B, 1), ("trigger", A, 2), ("terminator", Q, 3)])),
        ("globally: /b requires /a within 3 ms", [(A, 1, 0), (B, 1, 3)], ("violated", 0.003, [("behaviour", B, 2)])),
        ("globally: /a forbids /b within 3 ms", [(A, 1, 0), (B, 1, 2)], ("violated", 0.002, [
            ("trigger", A, 1), ("behaviour", B, 2)])),
        ("globally: /a forbids /b within 3 ms", [(A, 1, 0), (B, 1, 3)], ("held", None, [])),
        ("globally: /a {data > 3} causes /a {data > 5}", [(A, 4, 0), (A, 6, 1)], ("undecided", None, [])),
        ("globally: no /a {data > 3}", [(B, 4, 0)], ("never exercised", None, [])),
        ("globally: no /a", [(B, 4, 0)], ("held", None, [])),
        ("globally: no /a within 0 s", [(A, 4, 0)], ("held", None, [])),
        ("globally: no (/a or /b {data > 2})", [(B, 1, 0), (B, 3, 1)], ("violated", 0.001, [("behaviour", B, 2)])),
    ],
)  # fmt: skip
def test_what_is_said(text: str, messages: Any, said: Any) -> None:
    found = outcome(text, messages)
    witnesses = [(each.role, each.topic, each.number) for each in found.witnesses]
    assert (found.verdict.value, found.time, witnesses) == said
    assert found.verdict is Verdict.HELD or found.reason


def test_what_occurred_is_counted() -> None:
    found = outcome(
        "after /p until /q: /a causes /b", [("/p", 1, 0), (A, 1, 1), (A, 1, 2), (B, 1, 3), (Q, 1, 4), ("/p", 1, 5)]
    )
    assert (found.scopes, found.triggers, found.behaviours) == (2, 2, 1)


def test_a_witness_has_the_values_that_the_property_asks_of_it() -> None:
    text = "globally: /a as A causes /b {y = @A.p.q and x = @A.x} within 2 ms"
    found = outcome(text, [(A, {"x": 2, "p": {"q": 7}, "z": 1}, 0), (B, {"y": 6, "x": 2}, 1), (B, {"y": 7, "x": 2}, 2)])
    assert found.witnesses[0].values == {"p.q": 7, "x": 2}


@pytest.mark.parametrize(
    "text", ["globally: /a as A causes /b {data = @A.data}", "globally: /a as A forbids /b {data = @A.data}",
             "globally: /b as B requires /a {data = @B.data}"],
)  # fmt: skip
def test_only_so_many_messages_are_kept_and_then_nothing_is_claimed(text: str) -> None:
    many = [(A, n, n) for n in range(30)]
    watched = monitor_of(parse_property(text), limit=10)
    watched.start(0)
    for number, (topic, data, time) in enumerate(many, 1):
        watched.take(topic, {"data": data}, time * MS, number)
        assert len(watched.pool) <= 10  # type: ignore[attr-defined]
    assert watched.finish(100 * MS).verdict is Verdict.UNDECIDED


def test_large_arrays_fill_a_pool_by_their_size(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pool, "MOST_ITEMS", 100)
    text = "globally: /a as A causes /b {data[0] = sum(@A.data)}"
    found = outcome(text, [(A, {"data": [n] * 40}, n) for n in range(5)])
    assert found.verdict is Verdict.UNDECIDED and "kept" in found.reason


@pytest.mark.parametrize(
    "text", ["globally: /a causes /b", "globally: /a forbids /b", "globally: /b requires /a", "globally: /a as A causes /b {data = @A.data}",
             "globally: /a as A forbids /b {data = @A.data}", "globally: /b as B requires /a {data = @B.data}"],
)  # fmt: skip
def test_messages_that_are_alike_are_kept_once(text: str) -> None:
    watched = monitor_of(parse_property(text))
    watched.start(0)
    for number in range(1, 1001):
        watched.take(A, {"data": number % 3}, number, number)
        assert len(watched.pool) <= 3  # type: ignore[attr-defined]
