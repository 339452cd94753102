# SPDX-License-Identifier: Apache-2.0
"""What a recording says of properties: as text with a small timeline, as JSON, and as findings at the places of the properties.

The JSON is one object: recording {name, messages, begin, end, topics, notes}, configuration, clock, properties [{id, text, owner, node, axiom, path, line,
column, verdict, reason, time, witnesses [{role, topic, number, time, values, publishers [{node, path, line}]}], scopes, triggers, behaviours}].
Times are in seconds of the recording's clock; *number* counts all messages of the recording from 1.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from typing import Any

from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.report.escape import json_document, log_line

#: Columns of a timeline.
WIDTH = 60
MARKS = {"activator": "o", "trigger": "t", "behaviour": "b", "terminator": "c"}
SIGNS = {"held": "+", "violated": "x", "never exercised": "-", "undecided": "?"}


@dataclass(frozen=True, slots=True)
class Moment:
    """A message of a violation, *time* in seconds; *sources* are the nodes that publish on its topic, with the places where they do."""

    role: str
    topic: str
    number: int
    time: float
    values: Mapping[str, Any]
    sources: tuple[tuple[str, Location], ...] = ()


@dataclass(frozen=True, slots=True)
class Judged:
    """A property and what the recording says of it; *missing* are the topics of which a message should have come, with the places that publish there."""

    title: str
    text: str
    owner: str
    node: str
    is_axiom: bool
    location: Location | None
    verdict: str
    reason: str
    time: float | None
    moments: tuple[Moment, ...]
    counts: tuple[int, int, int]
    note: str = ""
    missing: tuple[tuple[str, tuple[tuple[str, Location], ...]], ...] = ()


@dataclass(frozen=True, slots=True)
class Held:
    """All of one recording; *begin* and *end* are in seconds, None without messages."""

    name: str
    configuration: str
    clock: str
    messages: int
    begin: float | None
    end: float | None
    topics: Mapping[str, int]
    properties: tuple[Judged, ...]
    notes: tuple[str, ...]


def text(held: Held) -> str:
    """For a terminal."""
    return "".join(f"{line}\n" for line in _lines(held))


def _lines(held: Held) -> Iterator[str]:
    span = "" if held.begin is None or held.end is None else f", {held.end - held.begin:.3f} s"
    of = f" of {held.configuration}" if held.configuration else ""
    yield log_line(f"{held.name}{of}: {held.messages:,} messages{span}, by {held.clock} time")
    for one in held.properties:
        node = f" ({one.node})" if one.node else ""
        yield log_line(f"{SIGNS[one.verdict]} {one.verdict}: {one.title}{node}")
        if one.reason:
            yield log_line(f"    {one.reason}")
        if one.verdict == "violated":
            yield from violation(one, held)
        scopes, triggers, behaviours = one.counts
        yield f"    counted: {scopes} openings of the scope, {triggers} triggers, {behaviours} behaviours"
        if one.note:
            yield log_line(f"    {one.note}")
    counts = {name: sum(one.verdict == name for one in held.properties) for name in SIGNS}
    yield ", ".join(f"{count} {name}" for name, count in counts.items())
    for note in held.notes:
        yield log_line(f"note: {note}")


def violation(judged: Judged, held: Held) -> Iterator[str]:
    """The messages of a violation with their times since the recording began, and the timeline."""
    begin = held.begin or 0.0
    for moment in judged.moments:
        values = ", ".join(f"{name} = {_value(value)}" for name, value in moment.values.items())
        at = f"{moment.time - begin:+.3f} s"
        yield log_line(
            f"    {at:>14}  {moment.role}: message {moment.number:,} on {moment.topic}{f' with {values}' if values else ''}"
        )
    assert judged.time is not None
    if not any(moment.time == judged.time for moment in judged.moments):
        yield f"    {f'{judged.time - begin:+.3f} s':>14}  violated"
    if held.end is not None and held.end > begin:
        yield f"    |{_timeline(judged, begin, held.end)}|"


def _timeline(judged: Judged, begin: float, end: float) -> str:
    """The whole recording with the messages of a violation, and the violation itself as ``x``."""

    def column(time: float) -> int:
        return min(WIDTH - 1, max(0, int((time - begin) / (end - begin) * WIDTH)))

    signs = ["-"] * WIDTH
    for moment in judged.moments:
        signs[column(moment.time)] = MARKS[moment.role]
    assert judged.time is not None
    at = column(judged.time)
    if signs[at] == "-" or judged.moments[-1:] and judged.moments[-1].time == judged.time:
        signs[at] = "x"
    return "".join(signs)


def _value(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False) if isinstance(value, (str, bool)) else repr(value)


def as_json(held: Held) -> str:
    """For a program."""
    document = {
        "recording": {
            "name": held.name,
            "messages": held.messages,
            "begin": held.begin,
            "end": held.end,
            "topics": dict(sorted(held.topics.items())),
            "notes": list(held.notes),
        },
        "configuration": held.configuration or None,
        "clock": held.clock,
        "properties": [_property(one) for one in held.properties],
    }
    return json_document(document, 2) + "\n"


def _property(judged: Judged) -> dict[str, Any]:
    place = judged.location
    return {
        "id": judged.title,
        "text": judged.text,
        "owner": judged.owner,
        "node": judged.node or None,
        "axiom": judged.is_axiom,
        "path": place.path if place is not None else None,
        "line": place.line if place is not None else None,
        "column": place.column if place is not None else None,
        "verdict": judged.verdict,
        "reason": judged.reason or None,
        "time": judged.time,
        "witnesses": [_moment(one) for one in judged.moments],
        **dict(zip(("scopes", "triggers", "behaviours"), judged.counts)),
    }


def _moment(moment: Moment) -> dict[str, Any]:
    return {
        "role": moment.role,
        "topic": moment.topic,
        "number": moment.number,
        "time": moment.time,
        "values": {name: _finite(value) for name, value in moment.values.items()},
        "publishers": [{"node": node, "path": place.path, "line": place.line} for node, place in moment.sources],
    }


def _finite(value: Any) -> Any:
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value
