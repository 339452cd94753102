# SPDX-License-Identifier: Apache-2.0
"""A counterexample held against the monitor, which knows nothing of formulas: it must violate its property, and keep every axiom."""

from __future__ import annotations

from dataclasses import replace

from haros_ci.behaviour.tree import PatternKind
from haros_ci.monitoring.monitor import TRIGGER, Monitor
from haros_ci.monitoring.patterns import Response, monitor_of
from haros_ci.monitoring.verdict import Outcome, Verdict
from haros_ci.verification.outcomes import Run, Step
from haros_ci.verification.problem import MILLISECOND, Claim, Problem, events_of

#: Turns of a loop that are replayed.
TURNS = 3
#: Windows that a loop is replayed for, at most so many turns.
MOST_TURNS = 200


def messages(run: Run, window: int = 0) -> list[tuple[int, Step]]:
    """The steps with their numbers, those of a loop several times: as often as the window of a claim needs."""
    found = list(enumerate(run.steps))
    if run.loop is None:
        return found
    turns = min(TURNS + (window // run.period if run.period else 0), MOST_TURNS)
    for turn in range(1, turns):
        for number in range(run.loop, len(run.steps)):
            step = run.steps[number]
            found.append((number, replace(step, time=step.time + turn * run.period)))
    return found


def held_against(problem: Problem, claim: Claim, run: Run) -> tuple[Monitor, Outcome]:
    """What the monitor of *claim* says of what the claim sees of *run*."""
    monitor = monitor_of(claim.stated, claim.names, claim.constants)
    monitor.start(0)
    time = 0
    for number, step in messages(run, claim.window or 0):
        time = step.time
        if step.topic in monitor.topics and is_seen(problem, claim, step):
            monitor.take(step.topic, step.message, step.time, number + 1)
    return monitor, monitor.finish(run.end if run.loop is None else time)


def is_seen(problem: Problem, claim: Claim, step: Step) -> bool:
    """Whether *step* is something that *claim* is about."""
    if not claim.node:
        return not step.received
    member = problem.member(claim.node)
    hears = problem.hears(claim.node, step.topic)
    if step.topic in claim.promised and (
        member is None or step.topic in member.publishes or step.topic not in member.subscribes
    ):
        return not step.received and step.node == claim.node
    if not hears:
        return not step.received and step.node == claim.node
    if problem.network.is_async:
        return step.received and step.node == claim.node
    return not step.received


def is_two_sided(problem: Problem, claim: Claim) -> bool:
    """Whether a topic is behaviour of a node's claim and something else besides, and the node both publishes and receives there."""
    if not claim.node:
        return False
    member = problem.member(claim.node)
    others = {claim.name(event) for event, is_behaviour in events_of(claim) if not is_behaviour}
    both = claim.promised & others
    return member is not None and any(topic in member.publishes and topic in member.subscribes for topic in both)


def never_ends(claim: Claim) -> bool:
    """Whether a violation is that something never comes, so that no recording can show it."""
    pattern = claim.stated.pattern
    return pattern.bound is None and pattern.kind in (PatternKind.SOME, PatternKind.CAUSES)


def confirmed(problem: Problem, claim: Claim, axioms: tuple[Claim, ...], run: Run) -> Run | str:
    """*run* with what the monitor says of it; a sentence where it disagrees."""
    watching, outcome = held_against(problem, claim, run)
    expected = (Verdict.VIOLATED, Verdict.UNDECIDED) if never_ends(claim) else (Verdict.VIOLATED,)
    if outcome.verdict not in expected:
        return f"the replay disagrees: the monitor says {outcome.verdict.value}"
    for axiom in axioms:
        monitor, kept = held_against(problem, axiom, run)
        demands = axiom.stated.pattern.kind in (PatternKind.SOME, PatternKind.CAUSES)
        is_due = demands and run.loop is None and monitor.open_end() is not None
        if kept.verdict is Verdict.VIOLATED or is_due:
            return f"the replay disagrees: the run does not keep the axiom {axiom.title}"
    steps = list(run.steps)
    roles = [(witness.number - 1, witness.role) for witness in outcome.witnesses]
    reason = outcome.reason
    if outcome.verdict is Verdict.UNDECIDED:
        roles = [(watching.pool.first.number - 1, TRIGGER)] if isinstance(watching, Response) and watching.pool else []
        reason = f"{watching.promised} never comes"
    for number, role in roles:
        steps[number] = replace(steps[number], role=role)
    at = None if outcome.time is None else round(outcome.time * 1000 * MILLISECOND)
    return replace(run, steps=tuple(steps), at=at, reason=reason)
