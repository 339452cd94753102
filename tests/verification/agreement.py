# SPDX-License-Identifier: Apache-2.0
"""Random properties and runs: whether the formulas of ``haros_ci.verification`` say the same as the monitor, which goes message by message."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from monitoring.traces import PATTERNS, SCOPES, TOPICS, Trace, drawn, traced

from haros_ci.behaviour.parser import parse_property
from haros_ci.behaviour.tree import Pattern, PatternKind, Property
from haros_ci.monitoring.monitor import Monitor
from haros_ci.monitoring.patterns import Response, monitor_of
from haros_ci.monitoring.verdict import Verdict

MS = 1_000_000
#: Longer than any window of ``drawn``, in milliseconds.
FAR = 1_000
#: Turns of a loop that the monitor is given besides those that the windows need.
TURNS = 4


@dataclass(frozen=True)
class Case:
    """A property, a run in milliseconds, and where it repeats with which period (None: silence)."""

    text: str
    trace: Trace
    loop: int | None = None
    period: int = 0


def endless(case: Case) -> bool | None:
    """Whether the endless run violates the property, by the monitor; None where it is no loop: the scope differs at its ends."""
    property = parse_property(case.text)
    monitor, scope = monitor_of(property), monitor_of(scope_of(property))
    monitor.start(0)
    scope.start(0)
    if case.loop is None:
        _feed(monitor, case.trace, 0)
        outcome = monitor.finish((_last(case.trace) + FAR) * MS)
        return outcome.verdict in (Verdict.VIOLATED, Verdict.UNDECIDED)
    states = []
    for part in (case.trace[: case.loop], case.trace[case.loop :]):
        _feed(scope, part, 0)
        states.append((scope.opened is not None, dict(scope.known)))
    if states[0] != states[1]:
        return None
    turns = TURNS + FAR // case.period
    _feed(monitor, case.trace[: case.loop], 0)
    for turn in range(turns):
        _feed(monitor, case.trace[case.loop :], turn * case.period)
    begun, end = ((_last(case.trace) + turn * case.period) * MS for turn in (turns - 3, turns - 1))
    if monitor.opened is not None and not monitor.done:
        monitor.expire(end)
    if monitor.failed is not None:
        return True
    if property.pattern.bound is not None or monitor.done:
        return False
    return _waits_since(monitor, property, begun)


def scope_of(property: Property) -> Property:
    """The same scope, and the same that is asked of its activator, with a pattern that no message of a run belongs to."""
    pattern = property.pattern
    inner = (*pattern.trigger, *pattern.behaviour)
    never = tuple(replace(event, topic=f"/never{number}") for number, event in enumerate(inner))
    return replace(property, pattern=Pattern(pattern.at, PatternKind.NO, never))


def _waits_since(monitor: Monitor, property: Property, begun: int) -> bool:
    """Whether something without a bound has been due for more than two whole turns."""
    if property.pattern.kind is PatternKind.SOME and monitor.opened is not None:
        return not monitor.found and monitor.opened.time <= begun  # type: ignore[attr-defined]  # an Existence
    if isinstance(monitor, Response) and monitor.pool:
        return monitor.pool.first.time <= begun
    return False


def _feed(monitor: Monitor, trace: Trace, shift: int) -> None:
    for number, (topic, data, time) in enumerate(trace, 1):
        if topic in monitor.topics:
            monitor.take(topic, {"data": data}, (time + shift) * MS, number)


def _last(trace: Trace) -> int:
    return trace[-1][2] if trace else 0


class Solved:
    """A property as formulas over runs of *length* events, with or without a loop."""

    def __init__(self, text: str, length: int, *, is_looped: bool) -> None:
        import z3

        from haros_ci.verification.fields import Fields
        from haros_ci.verification.patterns import Formula
        from haros_ci.verification.problem import Claim, Problem
        from haros_ci.verification.unrolling import Unrolling, options_of

        claim = Claim(0, text, parse_property(text))
        problem = Problem((), (), (claim,))
        fields = Fields()
        fields.add((claim,))
        self.run = Unrolling(problem, options_of(problem, TOPICS, ()), fields, length, is_looped=is_looped)
        self.formula = Formula(claim, self.run)
        self.solver = z3.Solver()
        self.solver.add(*self.run.constraints, *self.formula.constraints)
        self.z3 = z3

    def violates(self, case: Case) -> bool | None:
        """Whether the run of *case* violates the property; None if it is no loop. Both answers are asked for, and exclude each other."""
        solver, run, z3 = self.solver, self.run, self.z3
        solver.push()
        for step in run.steps:
            topic, data, time = case.trace[step] if step < len(case.trace) else ("", 0, _last(case.trace))
            solver.add(run.time[step] == time, run.idle[step] == (not topic))
            for option in run.options:
                solver.add(run.happens[step, option] == (option.topic == topic))
            if (topic, "data") in run.fields.slots:
                solver.add(run.value(step, topic, "data").term == data)
        if case.loop is not None:
            solver.add(run.loops[case.loop], run.period == case.period)
        answers = [solver.check(part) == z3.sat for part in (self.formula.violated, z3.Not(self.formula.violated))]
        solver.pop()
        assert answers != [True, True], case
        return None if answers == [False, False] else answers[0]


def cases(seed: object, count: int, each: int = 6, longest: int = 8) -> Iterator[list[Case]]:
    """*count* times *each* cases of one property; every other one with a loop, whose runs have all the same length."""
    draw = random.Random(str(seed))
    for number in range(count):
        property = drawn(draw, PATTERNS[number // 4 % 5], SCOPES[number % 4])
        if number // 20 % 2:
            length = draw.randrange(1, longest)
            yield [_looped(draw, str(property), length) for _ in range(each)]
        else:
            yield [Case(str(property), traced(draw, longest)) for _ in range(each)]


def _looped(draw: random.Random, text: str, length: int) -> Case:
    trace = traced(draw, length)
    while len(trace) != length:
        trace = traced(draw, length)
    loop = draw.randrange(length)
    least = trace[-1][2] - trace[loop][2]
    return Case(text, trace, loop, least + draw.choice((1, 2, 5, 10)))


def disagreements(
    seed: object, count: int, each: int = 6, longest: int = 8, *, first: bool = False
) -> tuple[list[tuple[Case, Any, Any]], Counter[str]]:
    """Where formulas and monitor differ, or the *first* difference alone, and what was compared."""
    found: list[tuple[Case, Any, Any]] = []
    seen: Counter[str] = Counter()
    for together in cases(seed, count, each, longest):
        is_looped = together[0].loop is not None
        length = len(together[0].trace) if is_looped else max(1, max(len(case.trace) for case in together))
        solved = Solved(together[0].text, length, is_looped=is_looped)
        for case in together:
            expected, said = endless(case), solved.violates(case)
            seen["no loop" if expected is None else f"{'loop' if is_looped else 'silence'}, {expected}"] += 1
            if expected is not said:
                found.append((case, expected, said))
                if first:
                    return found, seen
    return found, seen
