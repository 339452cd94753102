# SPDX-License-Identifier: Apache-2.0
"""What is found out about the properties of a configuration without any recording: as text with the runs that violate them, and as JSON.

The JSON is one object: configuration, network, depth, budget, properties [{id, text, path, line, column, verdict, reason, events (how many a
counterexample cannot have), whole, latency, derivation, axioms [{id, node, path, line}], run}], assumptions, notes. A *run* is {steps [{time, node, topic,
values, receives, of, role, places [{path, line}], receivers [{node, path, line}]}], loop, period, violated}; times are in seconds, *of* is the
number of the step whose message is received, from 0, *loop* that of the step from which on all repeats.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from typing import Any

from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.report.escape import json_document, log_line

SIGNS = {
    "proved": "+",
    "no counterexample": "+",
    "violated": "x",
    "vacuous": "-",
    "axioms contradictory": "x",
    "undetermined": "?",
    "not modelled": "?",
}
#: Values of a message, and characters of one, that are shown.
MOST_SHOWN, LONGEST = 12, 60


@dataclass(frozen=True, slots=True)
class ShownStep:
    """An event of a run, *time* in seconds. *places* are where its node publishes, or subscribes; *receivers* who gets the message at once, with the place."""

    time: float
    node: str
    topic: str
    values: Mapping[str, Any]
    receives: bool = False
    of: int | None = None
    role: str = ""
    places: tuple[Location, ...] = ()
    receivers: tuple[tuple[str, Location | None], ...] = ()


@dataclass(frozen=True, slots=True)
class ShownRun:
    """A counterexample; *loop* is the step from which on it repeats every *period* seconds, *violated* the time in seconds (None: never over)."""

    steps: tuple[ShownStep, ...]
    loop: int | None
    period: float
    violated: float | None


@dataclass(frozen=True, slots=True)
class ShownAxiom:
    """A property that an answer rests on."""

    title: str
    node: str
    location: Location | None


@dataclass(frozen=True, slots=True)
class ShownFinding:
    """A property and what is found out about it; *sentence* says it in words."""

    title: str
    text: str
    location: Location | None
    verdict: str
    reason: str
    sentence: str
    events: int
    is_whole: bool
    latency: str
    derivation: tuple[str, ...]
    axioms: tuple[ShownAxiom, ...]
    run: ShownRun | None


@dataclass(frozen=True, slots=True)
class Verification:
    """All of one configuration, with what is assumed, in sentences."""

    configuration: str
    network: str
    depth: int
    budget: float
    properties: tuple[ShownFinding, ...]
    assumptions: tuple[str, ...]
    notes: tuple[str, ...]

    @property
    def is_clean(self) -> bool:
        """Whether there is no counterexample."""
        return all(one.run is None for one in self.properties)


def text(found: Verification) -> str:
    """For a terminal."""
    return "".join(f"{log_line(line)}\n" for line in _lines(found))


def _lines(found: Verification) -> Iterator[str]:
    yield f"{found.configuration}: {len(found.properties)} properties, {found.network}"
    for one in found.properties:
        yield f"{SIGNS[one.verdict]} {one.verdict}: {one.title}"
        yield from (f"    {line}" for line in _finding_lines(one))
    counts = {name: sum(one.verdict == name for one in found.properties) for name in SIGNS}
    yield ", ".join(f"{count} {name}" for name, count in counts.items() if count) or "nothing to verify"
    if found.assumptions:
        yield "assumed:"
        yield from (f"  - {sentence}" for sentence in found.assumptions)
    yield from (f"note: {note}" for note in found.notes)


def _finding_lines(one: ShownFinding) -> Iterator[str]:
    yield one.sentence
    if one.latency:
        yield one.latency
    yield from (f"  {link}" for link in one.derivation)
    if one.verdict in ("vacuous", "axioms contradictory"):
        yield from (f"  {axiom.node or 'the configuration'}: {axiom.title}" for axiom in one.axioms)
    if one.run is not None:
        yield from run_lines(one.run)


def run_lines(run: ShownRun) -> Iterator[str]:
    """The events of a run, one on each line."""
    due = run.violated
    for number, step in enumerate(run.steps):
        if due is not None and due < step.time:
            yield _violated(due)
            due = None
        if run.loop == number:
            yield f"repeats from here, every {run.period:g} s:"
        yield f"{f'{step.time:+.4f} s':>14}  {step_text(step)}{f'  <- {step.role}' if step.role else ''}"
    if run.loop is None:
        yield f"{'':>14}  then nothing" if run.steps else f"{'':>14}  nobody ever publishes anything"
    if due is not None:
        yield _violated(due)


def _violated(time: float) -> str:
    return f"{f'{time:+.4f} s':>14}  violated"


def step_text(step: ShownStep) -> str:
    """An event in words, without its time."""
    return f"{step.node} {'receives' if step.receives else 'publishes'} {step.topic}{values_text(step.values)}"


def values_text(values: Mapping[str, Any]) -> str:
    """`` {linear.x = 1.0}``; "" without any."""
    shown = [f"{key} = {_value(value)}" for key, value in list(values.items())[:MOST_SHOWN]]
    more = ", …" if len(values) > MOST_SHOWN else ""
    return f" {{{', '.join(shown)}{more}}}" if shown else ""


def _value(value: Any) -> str:
    if isinstance(value, (str, bool)):
        found = json.dumps(value, ensure_ascii=False)
        return found if len(found) <= LONGEST else f"{found[: LONGEST - 1]}…"
    return f"{value:g}" if isinstance(value, float) and float(f"{value:g}") == value else repr(value)


def as_json(found: Verification) -> str:
    """For a program."""
    document = {
        "configuration": found.configuration,
        "network": found.network,
        "depth": found.depth,
        "budget": found.budget,
        "properties": [_property(one) for one in found.properties],
        "assumptions": list(found.assumptions),
        "notes": list(found.notes),
    }
    return json_document(document, 2) + "\n"


def _property(one: ShownFinding) -> dict[str, Any]:
    return {
        "id": one.title,
        "text": one.text,
        **_place(one.location),
        "column": one.location.column if one.location is not None else None,
        "verdict": one.verdict,
        "reason": one.reason or None,
        "events": one.events,
        "whole": one.is_whole,
        "latency": one.latency or None,
        "derivation": list(one.derivation),
        "axioms": [{"id": axiom.title, "node": axiom.node or None, **_place(axiom.location)} for axiom in one.axioms],
        "run": None if one.run is None else _run(one.run),
    }


def _run(run: ShownRun) -> dict[str, Any]:
    return {
        "steps": [
            {
                "time": step.time,
                "node": step.node,
                "topic": step.topic,
                "values": {key: _finite(value) for key, value in step.values.items()},
                "receives": step.receives,
                "of": step.of,
                "role": step.role or None,
                "places": [_place(place) for place in step.places],
                "receivers": [{"node": node, **_place(place)} for node, place in step.receivers],
            }
            for step in run.steps
        ],
        "loop": run.loop,
        "period": run.period if run.loop is not None else None,
        "violated": run.violated,
    }


def _place(place: Location | None) -> dict[str, Any]:
    return {"path": place.path if place is not None else None, "line": place.line if place is not None else None}


def _finite(value: Any) -> Any:
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value
