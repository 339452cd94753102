# SPDX-License-Identifier: Apache-2.0
"""A counterexample as plain values: from a model of the solver to steps with times and messages, round numbers where these do."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

import z3

from haros_ci.verification.fields import LONGEST_ARRAY, Fields, Kind, Slot
from haros_ci.verification.outcomes import Run, Step
from haros_ci.verification.predicates import one_of
from haros_ci.verification.problem import MILLISECOND
from haros_ci.verification.unrolling import Option, Unrolling

#: Steps in milliseconds that are tried between two events, in this order.
STEPS = (10, 1, 100, 1000, 0)
#: Questions to the solver for rounder numbers, and z3's units of work for one of them, so that each machine has the same numbers; seconds for all
#: of them, which are not spent unless a machine is very slow.
MOST_TRIALS, MOST_WORK, LONGEST_TRIAL = 300, 3_000_000, 30.0
#: Real values are multiples of one in so many, where that is possible: floating point numbers hold these exactly.
PARTS = 16


class Rounding:
    """A model whose events are fixed, and whose numbers are made round one after the other."""

    def __init__(self, solver: Any, run: Unrolling, model: Any) -> None:
        self.solver, self.run, self.model = solver, run, model
        self.trials = 0
        self.ends = time.monotonic() + LONGEST_TRIAL
        solver.set("timeout", int(LONGEST_TRIAL * 1000))
        solver.set("rlimit", MOST_WORK)
        for term in (*run.happens.values(), *run.idle, *run.loops):
            solver.add(term == model.eval(term, True))

    def attempt(self, *parts: Any) -> bool:
        """Keep *parts* if there is a model with them."""
        if self.trials >= MOST_TRIALS or time.monotonic() > self.ends:
            return False
        self.trials += 1
        self.solver.push()
        self.solver.add(*parts)
        found = bool(self.solver.check() == z3.sat)
        if found:
            self.model = self.solver.model()
        self.solver.pop()
        if found:
            self.solver.add(*parts)
        return found

    def of(self, term: Any) -> Any:
        return self.model.eval(term, True)

    def rounded(self) -> Any:
        """The model with round numbers."""
        self._exact()
        self._times()
        for step in self.run.steps:
            topic = next((o.topic for o in self.run.options if z3.is_true(self.of(self.run.happens[step, o]))), None)
            if topic is not None:
                self._values(step, topic)
        self.solver.set("rlimit", 0)
        return self.model

    def _exact(self) -> None:
        """Numbers that survive being written down: whole milliseconds, and values that floating point numbers hold. The rest is for the eye."""
        times = [term == z3.ToReal(z3.FreshInt("whole")) for term in self.run.time]
        values = [
            PARTS * self.run.value(step, topic, slot.key).term == z3.ToReal(z3.FreshInt("part"))
            for step in self.run.steps
            for topic in sorted({option.topic for option in self.run.options})
            for slot in self.run.fields.of(topic)
            if slot.kind is Kind.REAL and z3.is_true(self.of(one_of(*self._at(step, topic))))
        ]
        if not self.attempt(*times, *values):
            self.attempt(*times)
            self.attempt(*values)

    def _at(self, step: int, topic: str) -> list[Any]:
        return [self.run.happens[step, option] for option in self.run.options if option.topic == topic]

    def _times(self) -> None:
        before = z3.RealVal(0)
        for step, term in enumerate(self.run.time):
            candidates = STEPS if step else (0, *STEPS)
            if not any(self.attempt(term == before + delay) for delay in candidates):
                exact = _fraction(self.of(term))
                whole = -(-exact.numerator // exact.denominator)
                if not any(self.attempt(term == value) for value in (whole, whole - 1)):
                    nearest = Fraction(round(exact * MILLISECOND), MILLISECOND)
                    self.attempt(term == z3.Q(nearest.numerator, nearest.denominator))
            before = term

    def _values(self, step: int, topic: str) -> None:
        pairs = [(slot, self.run.value(step, topic, slot.key).term) for slot in self.run.fields.of(topic)]
        if pairs and self.attempt(*(term == _zero(slot) for slot, term in pairs)):
            return
        for slot, term in pairs:
            if any(self.attempt(term == value) for value in _candidates(slot, self.of(term))):
                continue
            self.attempt(term == self.of(term))


def _zero(slot: Slot) -> Any:
    return z3.BoolVal(False) if slot.kind is Kind.BOOL else max(0, slot.low or 0)


def _candidates(slot: Slot, found: Any) -> Iterator[Any]:
    yield _zero(slot)
    if slot.kind is Kind.REAL:
        exact = _fraction(found)
        for value in (round(exact), Fraction(round(exact * 10), 10), Fraction(round(exact * 1000), 1000)):
            close = Fraction(float(value))
            yield z3.Q(close.numerator, close.denominator)
    elif slot.kind is Kind.INT:
        yield from (value for value in (1, 2) if slot.low is None or value >= slot.low)


def _fraction(value: Any) -> Fraction:
    if z3.is_int_value(value):
        return Fraction(value.as_long())
    if z3.is_algebraic_value(value):
        value = value.approx(20)
    return Fraction(value.numerator_as_long(), value.denominator_as_long())


def run_of(run: Unrolling, model: Any, window: int) -> Run:
    """The steps of *model*; *window* is the longest bound of all that holds in it, in nanoseconds."""
    steps: list[Step] = []
    numbers: dict[int, int] = {}
    for step in run.steps:
        option = next((o for o in run.options if z3.is_true(model.eval(run.happens[step, o], True))), None)
        if option is None:
            break
        numbers[step] = len(steps)
        source = _source(run, model, option, step) if option.sender else None
        values = _values(run, model, option.topic, step)
        steps.append(
            Step(
                _time(model, run.time[step]),
                option.node,
                option.topic,
                message_of(run.fields, option.topic, values),
                values,
                bool(option.sender),
                -1 if source is None else numbers[source],
            )
        )
    loop = next((i for i, begins in enumerate(run.loops) if z3.is_true(model.eval(begins, True))), None)
    period = 0 if loop is None else _time(model, run.period)
    last = steps[-1].time if steps else 0
    return Run(tuple(steps), loop, period, last + window + MILLISECOND)


def _time(model: Any, term: Any) -> int:
    return round(_fraction(model.eval(term, True)) * MILLISECOND)


def _source(run: Unrolling, model: Any, option: Option, step: int) -> int | None:
    return next((j for j in range(step) if z3.is_true(model.eval(run.matches[option, j, step], True))), None)


def _values(run: Unrolling, model: Any, topic: str, step: int) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for slot in run.fields.of(topic):
        value = model.eval(run.value(step, topic, slot.key).term, True)
        found[slot.key] = _plain(slot, value, run.fields)
    return found


def _plain(slot: Slot, value: Any, fields: Fields) -> Any:
    match slot.kind:
        case Kind.BOOL:
            return z3.is_true(value)
        case Kind.INT:
            return value.as_long()
        case Kind.REAL:
            return float(_fraction(value))
        case _:
            number = value.as_long()
            names = {code: text for text, code in fields.texts.items()}
            return names.get(number) if number in names else _other(number, fields)


def _other(number: int, fields: Fields) -> str:
    """A text that no property names, the same for the same number."""
    text = f"other {number}"
    while text in fields.texts:
        text += "'"
    return text


def message_of(fields: Fields, topic: str, values: Mapping[str, Any]) -> dict[str, Any]:
    """The message with these values of its slots: arrays have their length, with zeros where nothing is asked."""
    slots = [slot for slot in fields.of(topic) if slot.key in values]
    lengths = {slot.path: min(values[slot.key], LONGEST_ARRAY) for slot in slots if slot.is_length}
    message: dict[str, Any] = {}
    for path in sorted(lengths, key=len):
        _put(message, path, [0] * lengths[path], lengths)
    for slot in slots:
        if not slot.is_length:
            _put(message, slot.path, values[slot.key], lengths)
    return message


def _put(message: dict[str, Any], path: tuple[str | int, ...], value: Any, lengths: Mapping[Any, int]) -> None:
    here: Any = message
    for number, part in enumerate(path):
        if isinstance(part, int) and part >= len(here):
            return
        if number == len(path) - 1:
            here[part] = value
            return
        inner = here.get(part) if isinstance(part, str) else here[part]
        if not isinstance(inner, (dict, list)):
            inner = here[part] = {}
        here = inner
