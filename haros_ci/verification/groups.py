# SPDX-License-Identifier: Apache-2.0
"""The claims of one cone, searched together: runs of 0, 1, 2, … events, each claim within its budget."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import z3

from haros_ci.behaviour.tree import PatternKind
from haros_ci.records import dataclass, field
from haros_ci.verification.bounded import Bounded, bounded
from haros_ci.verification.chains import Prover
from haros_ci.verification.cones import Cone
from haros_ci.verification.counterexamples import Completed, completed
from haros_ci.verification.fields import Fields
from haros_ci.verification.outcomes import Run
from haros_ci.verification.patterns import Formula
from haros_ci.verification.problem import Claim, Problem
from haros_ci.verification.proofs import Proof, suffices

#: Says of which claim the solver is asked next, and for how many seconds at most.
Tell = Callable[[int, float], None]
#: The share of a budget for proofs, and for runs without a loop where there are others, too.
FOR_PROOFS, FOR_SILENCE = 0.2, 0.6


@dataclass(slots=True)
class Sought:
    """A claim and how far it has come: *spent* seconds, up to how many events there is no counterexample (*silent*; with a loop *looped*)."""

    claim: Claim
    needs_loop: bool
    spent: float = 0.0
    silent: int = -1
    looped: int = -1
    #: Whether some run puts it to the test; and what speaks against it, once that is known.
    is_tested: bool = False
    against: tuple[int, ...] = ()
    is_vacuous: bool = False
    is_untestable: bool = False
    looked: int = 0
    is_stuck: bool = False
    proof: Proof | None = None
    is_proved: bool = False
    #: The counterexample, or why it is none after all.
    broken: Run | str | None = None
    axioms: tuple[int, ...] = ()


@dataclass(slots=True)
class Group:
    """The claims of one *cone*; *stated* is the problem with all axioms as they were stated, for replays."""

    problem: Problem
    cone: Cone
    fields: Fields
    stated: Problem
    tell: Tell
    claims: list[Sought] = field(default_factory=list)
    #: Whether some run keeps all axioms; else the axioms that exclude each other, once that is known.
    is_consistent: bool = False
    contradiction: tuple[int, ...] = ()

    def search(self) -> None:
        """Look at each claim until it is decided, or its budget is spent."""
        for sought in self.claims:
            self.prove(sought)
        for is_looped in (False, True):
            for sought in self.claims:
                sought.is_stuck = False
            for length in range(int(is_looped), self.problem.limits.depth + 1):
                waiting = [sought for sought in self.claims if self.is_open(sought, is_looped=is_looped)]
                if not waiting:
                    break
                self.look(waiting, length, is_looped=is_looped)
        self.look_for_reasons()

    def is_open(self, sought: Sought, *, is_looped: bool) -> bool:
        """Whether there is something to ask."""
        if (
            sought.broken is not None
            or sought.is_stuck
            or sought.is_untestable
            or (is_looped and not self.wants_loop(sought))
        ):
            return False
        return not sought.is_proved or not sought.is_tested

    def wants_loop(self, sought: Sought) -> bool:
        """Whether endless runs can say more."""
        return sought.needs_loop or not sought.is_tested

    def left(self, sought: Sought, *, is_looped: bool) -> float:
        """The seconds that a claim has left."""
        budget = self.problem.limits.budget
        return (budget if is_looped or not sought.needs_loop else budget * FOR_SILENCE) - sought.spent

    def prove(self, sought: Sought) -> None:
        """Look for a proof by composition."""
        with self.timed([sought]):
            seconds = self.problem.limits.budget * FOR_PROOFS
            self.tell(sought.claim.number, seconds)
            prover = Prover(self.problem, sought.claim, self.cone.axioms, self.fields, seconds)
            if (untestable := prover.untestable()) is not None:
                sought.is_untestable = sought.is_vacuous = True
                sought.against = untestable.axioms
                return
            sought.proof = prover.proof()
            sought.is_proved = sought.proof is not None and suffices(self.problem, sought.claim, sought.proof)

    @contextmanager
    def timed(self, claims: list[Sought]) -> Iterator[None]:
        """What is done here is on the account of *claims*, in equal parts."""
        begun = time.monotonic()
        try:
            yield
        finally:
            for sought in claims:
                sought.spent += (time.monotonic() - begun) / len(claims)

    def look(self, waiting: list[Sought], length: int, *, is_looped: bool) -> None:
        """Ask about runs of *length* events; all of them, shorter ones were asked about before."""
        with self.timed(waiting):
            self.tell(waiting[0].claim.number, self.problem.limits.budget)
            runs = bounded(self.problem, self.cone, self.fields, length, is_looped=is_looped, is_exact=length > 0)
            if not self.is_consistent:
                seconds = max(0.1, min(self.left(sought, is_looped=is_looped) for sought in waiting) / 4)
                self.is_consistent = runs.check(seconds=seconds) == z3.sat
        for sought in waiting:
            with self.timed([sought]):
                self.ask(sought, runs, length, is_looped=is_looped)

    def ask(self, sought: Sought, runs: Bounded, length: int, *, is_looped: bool) -> None:
        """Ask about one claim in *runs*."""
        seconds = self.left(sought, is_looped=is_looped)
        if seconds <= 0:
            sought.is_stuck = True
            return
        self.tell(sought.claim.number, seconds)
        runs.solver.push()
        formula = Formula(sought.claim, runs.run)
        runs.solver.add(*formula.constraints)
        if not sought.is_proved:
            self.ask_for_violation(sought, runs, formula, seconds, is_looped=is_looped)
        if not sought.is_tested and sought.broken is None and not sought.is_stuck:
            sought.is_tested = runs.check(formula.tested, seconds=max(0.1, seconds / 4)) == z3.sat
            sought.looked = max(sought.looked, runs.run.length)
        runs.solver.pop()

    def ask_for_violation(
        self, sought: Sought, runs: Bounded, formula: Formula, seconds: float, *, is_looped: bool
    ) -> None:
        answer = runs.check(formula.violated, seconds=seconds)
        if answer == z3.unsat:
            if is_looped:
                sought.looped = runs.run.length
            else:
                sought.silent = runs.run.length
        elif answer == z3.sat:
            sought.is_tested = True
            found: Completed = completed(
                self.problem, self.stated, self.cone, self.fields, sought.claim, runs, formula, self.tell
            )
            sought.broken, sought.axioms = found.run, found.axioms
        else:
            sought.is_stuck = True

    def look_for_reasons(self) -> None:
        """Which axioms keep a claim from being put to the test, or exclude each other: not only in short runs."""
        untested = [sought for sought in self.claims if self.may_be_vacuous(sought)]
        if not untested:
            return
        seconds = max(1.0, self.problem.limits.budget / 4)
        self.tell(untested[0].claim.number, self.problem.limits.budget)
        if not self.is_consistent:
            self.contradiction = self.excluded_demand(seconds)
        length = max(sought.looked for sought in untested)
        runs = bounded(self.problem, self.cone, self.fields, length, is_prefix=True)
        for sought in untested:
            self.tell(sought.claim.number, seconds)
            runs.solver.push()
            formula = Formula(sought.claim, runs.run)
            runs.solver.add(*formula.constraints)
            if runs.check(formula.tested, seconds=seconds) == z3.unsat:
                sought.is_vacuous, sought.looked = True, length
                sought.against = self.smallest(runs, runs.core(), seconds, formula.tested)
            runs.solver.pop()

    def excluded_demand(self, seconds: float) -> tuple[int, ...]:
        """An axiom that demands what others exclude, with these; () if none is found."""
        for axiom in self.cone.axioms:
            if axiom.stated.pattern.kind is PatternKind.SOME and not axiom.stated.scope.activator:
                prover = Prover(self.problem, axiom, self.cone.axioms, self.fields, seconds)
                if (found := prover.excluded(axiom.stated.pattern.behaviour)) is not None:
                    return tuple(sorted({axiom.number, *found.axioms}))
        return ()

    def may_be_vacuous(self, sought: Sought) -> bool:
        """Whether no run puts a claim to the test, of all lengths that were asked for."""
        is_whole = sought.looked >= self.problem.limits.depth or not self.is_consistent
        return is_whole and not sought.is_tested and sought.broken is None and not sought.is_untestable

    def smallest(self, runs: Bounded, core: tuple[int, ...], seconds: float, *parts: Any) -> tuple[int, ...]:
        """Of the axioms *core*, which together exclude *parts*, none that can be left out."""
        kept = list(core)
        runs.solver.set("timeout", max(1, int(seconds * 100)))
        for number in core:
            rest = [runs.axioms[other] for other in kept if other != number]
            if runs.solver.check(*rest, *parts) == z3.unsat:
                kept.remove(number)
        return tuple(kept)
