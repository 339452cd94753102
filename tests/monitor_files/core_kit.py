# SPDX-License-Identifier: Apache-2.0
"""Generated cores held against the offline monitor: the same property, the same messages, everything that is said of them."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from monitoring.traces import PATTERNS, SCOPES, drawn, traced

from haros_ci.behaviour.fault import HplFault
from haros_ci.behaviour.meaning import mistakes
from haros_ci.behaviour.parser import parse_property
from haros_ci.monitor_files.classes import Described
from haros_ci.monitor_files.core import core_text
from haros_ci.monitoring.monitor import SECOND
from haros_ci.monitoring.patterns import monitor_of
from haros_ci.monitoring.watch import Watch

MS = 1_000_000
#: Topic, message and time in milliseconds.
Messages = Sequence[tuple[str, Mapping[str, Any], int]]
Said = tuple[str, float | None, tuple[tuple[Any, ...], ...], tuple[int, int, int], int]


def core(*texts: str, names: Mapping[str, str] | None = None) -> dict[str, Any]:
    """The names that a generated core for these properties defines."""
    described = [Described(monitor_of(parse_property(text), names or {}), text, text) for text in texts]
    made, left_out = core_text(described)
    assert not left_out
    return run(made)


def run(made: str) -> dict[str, Any]:
    """The names that a text of a core defines."""
    found: dict[str, Any] = {"__name__": "generated"}
    exec(compile(made, "generated", "exec"), found)
    return found


def generated(made: Mapping[str, Any], messages: Messages, *, timers: bool = True) -> list[Said]:
    """What the generated monitors say; with *timers* they are woken at their deadlines, too, as in a running system."""
    monitors = made["Monitors"](made["PROPERTIES"])
    monitors.start(0)
    for topic, message, time in messages:
        due = monitors.deadline() if timers else None
        if due is not None and due <= time * MS:
            monitors.on_timer(due)
        monitors.on_message(topic, message, time * MS)
    return [
        (
            one["verdict"],
            one["time"],
            tuple(
                (seen["role"], seen["topic"], seen["number"], seen["time"], seen["values"]) for seen in one["witnesses"]
            ),
            (one["scopes"], one["triggers"], one["behaviours"]),
            one["faults"],
        )
        for one in monitors.finish(messages[-1][2] * MS if messages else 0)
    ]


def offline(texts: Sequence[str], messages: Messages) -> list[Said]:
    """What ``haros_ci/monitoring`` says of the same."""
    watch = Watch(monitor_of(parse_property(text)) for text in texts)
    watch.begin(0)
    for number, (topic, message, time) in enumerate(messages, 1):
        if topic in watch.topics:
            watch.take(topic, message, time * MS, number)
    topics = frozenset(topic for topic, _, _ in messages)
    return [
        (
            one.verdict.value,
            one.time,
            tuple((seen.role, seen.topic, seen.number, seen.time, seen.values) for seen in one.witnesses),
            (one.scopes, one.triggers, one.behaviours),
            one.faults,
        )
        for one in watch.finish(messages[-1][2] * MS if messages else 0, topics)
    ]


def random_pair(draw: random.Random, number: int, patterns: Sequence[str] = PATTERNS) -> tuple[str, Messages]:
    """A property and a recording: every second time with predicates about nested fields, arrays and functions."""
    scope, pattern = SCOPES[number % 4], patterns[number // 4 % len(patterns)]
    while True:
        text = str(drawn(draw, pattern, scope))
        trace: Messages = [(topic, {"data": data}, time) for topic, data, time in traced(draw, 20)]
        if number // 20 % 2:
            text = with_predicates(draw, text)
            trace = [(topic, message(draw, sent["data"]), time) for topic, sent, time in trace]
        try:
            if not mistakes(parse_property(text)):
                return text, trace
        except HplFault:
            continue


def with_predicates(draw: random.Random, text: str) -> str:
    """The same property with a further condition in each of its predicates."""
    whole = ""
    for part in text.split("}"):
        condition = part.rpartition("{")[2]
        alias = f"@{condition.partition('@')[2].partition('.')[0]}" if "@" in condition else ""
        more = predicate(draw, 2, alias)
        word = draw.choice(("and", "or", "implies", "iff"))
        whole += f"{part} {word} {more}}}" if "{" in part else part
    return whole


def predicate(draw: random.Random, depth: int, alias: str) -> str:
    """A random condition, in which some fields are missing from some messages."""
    if depth == 0 or draw.random() < 0.3:
        return f"{number(draw, depth, alias)} {draw.choice(('=', '!=', '<', '<=', '>', '>='))} {number(draw, depth, alias)}"
    inner = [predicate(draw, depth - 1, alias) for _ in range(2)]
    name = f"i{depth}"
    return draw.choice((
        f"({inner[0]} and {inner[1]} and {inner[0]})",
        f"({inner[0]} or {inner[1]})",
        f"({inner[0]} implies {inner[1]})",
        f"({inner[0]} iff {inner[1]})",
        f"(not ({inner[0]}))",
        f"({number(draw, depth, alias)} in [0 to 3])",
        f"({number(draw, depth, alias)} in ![{draw.randrange(2)} to {number(draw, 0, alias)}]!)",
        f"({number(draw, depth, alias)} in {{1, 2, {number(draw, 0, alias)}}})",
        "(data in list)",
        f'(name = "{draw.choice(("a", "b"))}")',
        f"(forall {name} in list: list[@{name}] < {draw.randrange(4)})",
        f"(exists {name} in [0 to {draw.randrange(5)}]: list[@{name}] = {number(draw, 0, alias)})",
    ))  # fmt: skip


def number(draw: random.Random, depth: int, alias: str) -> str:
    """A random term."""
    if depth <= 0:
        known = (f"{alias}.data", f"{alias}.pose.x") if alias else ("data",)
        return draw.choice(
            ("data", "pose.x", "pose.y", "list[0]", "list[pose.x]", "len(list)", "-data", "2", "0.5", *known)
        )
    a, b = number(draw, depth - 1, alias), number(draw, depth - 1, alias)
    return draw.choice(
        (
            a,
            f"({a} {draw.choice(('+', '-', '*', '/', '**'))} {b})",
            f"max({a}, {b}, 1)",
            f"abs({a})",
            "sum(list)",
            f"sqrt({a})",
            f"floor({a})",
        )
    )


def message(draw: random.Random, data: int) -> dict[str, Any]:
    """A message of which parts can be missing."""
    found: dict[str, Any] = {"data": data, "name": draw.choice("ab")}
    if draw.random() < 0.8:
        found["pose"] = {"x": draw.choice((0, 1, 0.5, 2.5)), "y": data}
    if draw.random() < 0.9:
        found["list"] = [draw.randrange(4) for _ in range(draw.randrange(5))]
    return found


#: Properties of one core: most of the time goes into compiling it.
BATCH = 60


def disagreements(
    count: int,
    seed: int,
    made_of: Any = core,
    patterns: Sequence[str] = PATTERNS,
    on_pair: Callable[[Said], Any] = lambda said: None,
) -> Iterator[tuple[str, Messages, Said, Said]]:
    """Where generated and offline monitor disagree on *count* random pairs, of all scopes and patterns in turn."""
    draw = random.Random(seed)
    for first in range(0, count, BATCH):
        pairs = [random_pair(draw, at, patterns) for at in range(first, min(first + BATCH, count))]
        made = made_of(*(text for text, _ in pairs))
        for at, (text, messages) in enumerate(pairs):
            (theirs,) = offline([text], messages)
            (ours,) = generated({**made, "PROPERTIES": made["PROPERTIES"][at : at + 1]}, messages, timers=bool(at % 3))
            on_pair(theirs)
            if ours != theirs:
                yield text, messages, ours, theirs


assert SECOND == 1000 * MS
