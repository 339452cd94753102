# SPDX-License-Identifier: Apache-2.0
"""The answers of ``haros-ci verify`` in words: what is said of each property, what is assumed, and its runs as recordings."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence

from haros_ci.analysis.monitored import Monitored
from haros_ci.analysis.verified import ToVerify
from haros_ci.behaviour.text import time_text
from haros_ci.report.verify_text import ShownAxiom, ShownFinding, ShownRun, ShownStep, Verification
from haros_ci.verification.cones import Cone, open_publishers
from haros_ci.verification.outcomes import Finding, Result, Run, Step
from haros_ci.verification.problem import ENVIRONMENT, Network, Problem
from haros_ci.verification.replay import messages

SECOND = 1_000_000_000
#: The topic of the messages with which a recording of a counterexample begins and ends, so that all times have passed.
MARKER = "/haros_ci/verify"
#: Names in one sentence.
MOST_NAMES = 20


def shown(asked: ToVerify, answers: Sequence[Finding]) -> Verification:
    """All that is said of one configuration."""
    limits = asked.problem.limits
    return Verification(
        asked.chosen.configuration,
        network_text(asked.problem.network),
        limits.depth,
        limits.budget,
        tuple(_finding(asked, answer) for answer in answers),
        tuple(assumptions(asked, answers)),
        asked.notes,
    )


def network_text(network: Network) -> str:
    """``asynchronous network, latency 0 s to 20 ms, no loss``."""
    if not network.is_async:
        return "messages arrive at once"
    low = time_text(network.low / SECOND)
    latency = (
        f"latency {low} to {time_text(network.high / SECOND)}"
        if network.high is not None
        else f"latency of {low} or more, without end"
    )
    return f"asynchronous network, {latency}, {'loss where a queue can overflow' if network.loses else 'no loss'}"


def _finding(asked: ToVerify, answer: Finding) -> ShownFinding:
    item = asked.properties[answer.number]
    is_named = answer.result in (Result.PROVED, Result.VACUOUS, Result.CONTRADICTORY)
    return ShownFinding(
        item.title,
        item.text,
        item.location,
        answer.result.value,
        answer.reason,
        sentence(answer, asked.problem.limits.budget),
        answer.depth,
        answer.is_whole,
        answer.of_latency,
        answer.derivation,
        tuple(
            _axiom(asked.properties[number])
            for number in answer.axioms
            if is_named or _is_in(asked, number, answer.run)
        ),
        None if answer.run is None else _run(asked, answer.run, answer.axioms),
    )


def _is_in(asked: ToVerify, number: int, run: Run | None) -> bool:
    """Whether an axiom promises something about what happens in *run*."""
    happening = {step.topic for step in run.steps} if run is not None else set()
    return any(axiom.number == number and axiom.promised & happening for axiom in asked.problem.axioms)


def _axiom(item: Monitored) -> ShownAxiom:
    return ShownAxiom(item.title, item.node, item.location)


def sentence(answer: Finding, budget: float) -> str:
    """What an answer means."""
    events = f"{answer.depth} {'event' if answer.depth == 1 else 'events'}"
    match answer.result:
        case Result.PROVED:
            return "follows from axioms, for runs of any length:"
        case Result.NONE:
            rest = "" if answer.is_whole else f"; then its {budget:g} s were spent"
            why = f" ({answer.reason})" if answer.reason else ""
            return f"no counterexample of up to {events}{rest}{why}"
        case Result.VIOLATED:
            count = len(answer.run.steps) if answer.run is not None else 0
            return f"{answer.reason} (a run of {count} {'event' if count == 1 else 'events'}, replayed)"
        case Result.VACUOUS:
            length = "" if answer.is_whole else f" in runs of up to {events}"
            return f"nothing puts it to the test{length}; what excludes that:"
        case Result.CONTRADICTORY:
            return "no run keeps these axioms, so that anything would follow:"
        case Result.NOT_MODELLED:
            return f"formulas do not have {answer.reason}"
        case _:
            return answer.reason


def _run(asked: ToVerify, run: Run, axioms: tuple[int, ...]) -> ShownRun:
    nodes = {asked.properties[number].node for number in axioms}
    steps = tuple(_step(asked, step, nodes) for step in run.steps)
    return ShownRun(steps, run.loop, run.period / SECOND, None if run.at is None else run.at / SECOND)


def _step(asked: ToVerify, step: Step, nodes: set[str]) -> ShownStep:
    receivers: list[str] = []
    if not step.received and not asked.problem.network.is_async:
        receivers = [m.name for m in asked.problem.members if step.topic in m.subscribes and m.name in nodes]
    return ShownStep(
        step.time / SECOND,
        step.node,
        step.topic,
        step.values,
        step.received,
        step.of if step.received else None,
        step.role,
        asked.places(step.node, step.topic, "subscribers" if step.received else "publishers"),
        tuple((name, next(iter(asked.places(name, step.topic, "subscribers")), None)) for name in receivers),
    )


def assumptions(asked: ToVerify, answers: Sequence[Finding]) -> Iterator[str]:
    """What the answers rest on besides the axioms."""
    problem = asked.problem
    topics = frozenset(topic for answer in answers for topic in answer.topics)
    numbers = {number for answer in answers for number in (*answer.cone, *answer.axioms)}
    cone = Cone(topics, tuple(axiom for axiom in problem.axioms if axiom.number in numbers))
    outside = [topic for topic in sorted(topics) if problem.publishers(topic) == (ENVIRONMENT,)]
    if outside:
        yield f"anything can come at any time, from outside, on {_names(outside)}: no node of the configuration publishes there"
    for node, of in _grouped(open_publishers(problem, cone)):
        yield f"{node} may publish anything on {_names(of)}: no axiom is about that"
    yield from _lent(problem, cone)
    yield from _left_out(asked, answers)
    if numbers:
        yield f"nodes keep their properties: {len(numbers)} axioms are used"
    if topics:
        yield "floating point numbers are real ones: nothing is rounded, no NaN, no infinity"


def _left_out(asked: ToVerify, answers: Sequence[Finding]) -> Iterator[str]:
    """What is not looked at."""
    for number, reason in dict.fromkeys(item for answer in answers for item in answer.left):
        yield f"the axiom {asked.properties[number].title} is left out: formulas do not have {reason}"
    if asked.incomplete:
        yield f"not all topics of {_names(asked.incomplete)} are known: what they publish besides is left out"


def _lent(problem: Problem, cone: Cone) -> Iterator[str]:
    """The topics that nodes have by their promises alone."""
    for axiom in cone.axioms:
        lent = [topic for topic in sorted(axiom.promised) if problem.is_lent(axiom, topic)]
        if lent:
            yield f"{axiom.node} publishes on {_names(lent)}: its property {axiom.title} says so, and the model does not have it"


def _grouped(pairs: Sequence[tuple[str, str]]) -> Iterator[tuple[str, list[str]]]:
    for node in dict.fromkeys(node for node, _ in pairs):
        yield node, [topic for other, topic in pairs if other == node]


def _names(names: Sequence[str]) -> str:
    more = f" and {len(names) - MOST_NAMES} more" if len(names) > MOST_NAMES else ""
    return f"{', '.join(names[:MOST_NAMES])}{more}"


def traces(asked: ToVerify, answers: Sequence[Finding]) -> dict[str, str]:
    """The counterexamples as recordings that ``haros-ci monitor --jsonl`` reads, by the names of their files."""
    found = {}
    for number, answer in enumerate(answers, 1):
        if answer.run is not None:
            item = asked.properties[answer.number]
            slug = re.sub(r"[^a-z0-9]+", "-", item.title.lower())[:40].strip("-")
            found[f"{number:03d}-{slug or 'property'}.jsonl"] = recording(answer.run, item.monitor.window or 0)
    return found


def recording(run: Run, window: int) -> str:
    """What is published in *run*, between two markers; of a loop as many turns as a window of so many nanoseconds needs."""
    rows = [(0, MARKER, {"text": "begin"})]
    rows += [(step.time, step.topic, dict(step.message)) for _, step in messages(run, window) if not step.received]
    rows.append((max(run.end, rows[-1][0]) if run.loop is None else rows[-1][0], MARKER, {"text": "end"}))
    return "".join(
        json.dumps({"topic": topic, "time": time / SECOND, "msg": message}) + "\n" for time, topic, message in rows
    )
