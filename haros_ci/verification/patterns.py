# SPDX-License-Identifier: Apache-2.0
"""The five patterns as formulas about a whole run: whether a claim is violated, and whether it is put to the test.

The meaning is that of docs/hpl.md: windows are half-open, earlier and later are strict in the order of events, a scope that closes ends all
that is due in it. A pair of events may cross the end of a loop: its second one is then a period later. What has happened before a loop counts for
its first turn alone where there is a bound, so that ``requires`` is held against later turns, too.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from haros_ci.behaviour.meaning import free_variables
from haros_ci.behaviour.tree import PatternKind
from haros_ci.verification.predicates import FALSE, Message, both, no, one_of
from haros_ci.verification.problem import Claim
from haros_ci.verification.scopes import View
from haros_ci.verification.unrolling import Unrolling, milliseconds

Known = Mapping[str, Message]


class Formula:
    """A claim in a run: ``violated`` and ``tested`` are formulas, under ``constraints``."""

    def __init__(self, claim: Claim, run: Unrolling) -> None:
        self.view = View(claim, run)
        self.claim, self.run = claim, run
        pattern = claim.stated.pattern
        self.window = None if claim.window is None else milliseconds(claim.window)
        first, second = pattern.trigger, pattern.behaviour
        self.is_requirement = pattern.kind is PatternKind.REQUIRES
        if self.is_requirement:
            first, second = second, first
        self.first, self.second = first, second
        aliases = {event.alias for event in first if event.alias is not None}
        #: Whether the second event of the pattern asks for values of the first one.
        self.asks = any(variable.name in aliases for event in second for variable in free_variables(event))
        self._plain: dict[int, Any] = {}
        self.violated, self.tested = _OF[pattern.kind](self)

    @property
    def constraints(self) -> list[Any]:
        return self.view.constraints

    def firsts(self, step: int) -> Iterator[tuple[Any, Known]]:
        """Each way in which *step* is the first event of the pattern, in the scope, and what is known then."""
        known = self.view.registers[step]
        for event in self.first:
            term = both(self.view.inside[step], self.view.is_one(step, event, self.is_requirement, known))
            named = {event.alias: self.view.message(step, event)} if event.alias is not None else {}
            yield term, {**known, **named}

    def seconds(self, step: int, known: Known) -> Any:
        """Whether *step* is the second event, wherever the scope is, to a first one of which *known* says what others ask."""
        if not self.asks:
            if step not in self._plain:
                self._plain[step] = self._second(step, self.view.registers[step])
            return self._plain[step]
        return self._second(step, known)

    def _second(self, step: int, known: Known) -> Any:
        is_behaviour = not self.is_requirement
        return one_of(*(self.view.is_one(step, event, is_behaviour, known) for event in self.second))

    def near(self, since: Any, time: Any) -> Any:
        """Whether *time* is in the window from *since* on."""
        return both() if self.window is None else time - since < self.window

    def near_next(self, since: Any, step: int) -> Any:
        """The same for the next turn of the loop."""
        return both() if self.window is None else self.run.time[step] + self.run.period - since < self.window

    def openings(self) -> Iterator[tuple[Any, int, Any]]:
        """Whether the scope opens, the first step that can be in it, and the time."""
        if not self.view.begins:
            yield both(), 0, milliseconds(0)
        for step in self.run.steps if self.view.begins else ():
            yield self.view.opening[step], step + 1, self.run.time[step]

    def some_later(self, first: int, since: Any, known: Known) -> Any:
        """Whether the second event comes at *first* or later, in the scope without a break and in the window."""
        view, run = self.view, self.run
        found = [
            both(view.between(first, j), self.seconds(j, known), self.near(since, run.time[j]))
            for j in range(first, run.length)
        ]
        if run.is_looped:
            rest = view.to_end(first)
            found += [
                both(rest, view.from_loop[j], self.seconds(j, known), self.near_next(since, j)) for j in run.steps
            ]
        return one_of(*found)


def _existence(formula: Formula) -> tuple[Any, Any]:
    violated, opened = [], []
    for opens, first, since in formula.openings():
        known = formula.view.registers[min(first, formula.run.length)]
        violated.append(both(opens, no(formula.some_later(first, since, known))))
        opened.append(opens)
    return one_of(*violated), one_of(*opened)


def _absence(formula: Formula) -> tuple[Any, Any]:
    view, run = formula.view, formula.run
    found = []
    for opens, first, since in formula.openings():
        inside = [
            both(view.between(first, j), formula.seconds(j, view.registers[j]), formula.near(since, run.time[j]))
            for j in range(first, run.length)
        ]
        if run.is_looped and view.begins:
            rest = view.to_end(first)
            inside += [
                both(rest, view.from_loop[j], formula.seconds(j, view.registers[j]), formula.near_next(since, j))
                for j in run.steps
            ]
        found.append(both(opens, one_of(*inside)))
    return one_of(*found), one_of(*(opens for opens, _, _ in formula.openings()))


def _response(formula: Formula) -> tuple[Any, Any]:
    violated, tested = [], []
    for i in formula.run.steps:
        for term, known in formula.firsts(i):
            tested.append(term)
            later = formula.some_later(i + 1, formula.run.time[i], known)
            violated.append(both(term, no(later)))
    return one_of(*violated), one_of(*tested)


def _prevention(formula: Formula) -> tuple[Any, Any]:
    violated, tested = [], []
    for i in formula.run.steps:
        for term, known in formula.firsts(i):
            tested.append(term)
            violated.append(both(term, formula.some_later(i + 1, formula.run.time[i], known)))
    return one_of(*violated), one_of(*tested)


def _requirement(formula: Formula) -> tuple[Any, Any]:
    run = formula.run
    violated, tested = [], []
    for j in run.steps:
        for term, known in formula.firsts(j):
            tested.append(term)
            earlier = [_before(formula, i, j, known) for i in range(j)]
            violated.append(both(term, no(one_of(*earlier))))
            if run.is_looped:
                violated.append(both(term, run.repeats(j), no(one_of(*_in_later_turns(formula, j, known)))))
    return one_of(*violated), one_of(*tested)


def _before(formula: Formula, i: int, j: int, known: Known) -> Any:
    """Whether *i*, before *j*, is what the behaviour at *j* needs."""
    near = formula.near(formula.run.time[i], formula.run.time[j])
    return both(formula.view.between(i, j), formula.seconds(i, known), near)


def _in_later_turns(formula: Formula, j: int, known: Known) -> Iterator[Any]:
    """What the behaviour at *j* has before it once the loop has turned often enough."""
    view, run = formula.view, formula.run
    for i in run.steps:
        is_in = run.repeats(i)
        if i < j:
            yield both(is_in, _before(formula, i, j, known))
        counts = is_in if formula.window is not None else both()
        around = both(view.to_end(i), view.from_loop[j], formula.near_next(run.time[i], j))
        yield both(counts, formula.seconds(i, known), around)


_OF = {
    PatternKind.NO: _absence,
    PatternKind.SOME: _existence,
    PatternKind.CAUSES: _response,
    PatternKind.FORBIDS: _prevention,
    PatternKind.REQUIRES: _requirement,
}
NEVER = FALSE
