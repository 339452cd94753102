# SPDX-License-Identifier: Apache-2.0
"""From what the solver has found to a counterexample that can be shown: completed, round, replayed."""

from __future__ import annotations

from collections.abc import Callable

import z3

from haros_ci.records import dataclass
from haros_ci.verification.bounded import Bounded, bounded
from haros_ci.verification.cones import Cone, component
from haros_ci.verification.fields import Fields
from haros_ci.verification.models import LONGEST_TRIAL, Rounding, run_of
from haros_ci.verification.outcomes import Run
from haros_ci.verification.patterns import Formula
from haros_ci.verification.problem import Claim, Problem
from haros_ci.verification.replay import confirmed

#: More events than a counterexample of the cone has, to complete it.
MORE_EVENTS = 6


@dataclass(frozen=True, slots=True)
class Completed:
    """The counterexample, or why it is none after all; and all axioms that it keeps."""

    run: Run | str
    axioms: tuple[int, ...]


def completed(
    problem: Problem,
    stated: Problem,
    cone: Cone,
    fields: Fields,
    claim: Claim,
    runs: Bounded,
    formula: Formula,
    tell: Callable[[int, float], None],
) -> Completed:
    """The model that *runs* has just found for ``formula.violated``, as a run that keeps all axioms that have to do with *claim*."""
    whole = component(problem, claim)
    if whole.numbers != cone.numbers:
        wider = _widened(problem, whole, fields, claim, runs, tell)
        if isinstance(wider, str):
            return Completed(wider, whole.numbers)
        runs, formula = wider
    runs.solver.push()
    runs.solver.add(*runs.axioms.values(), formula.violated)
    tell(claim.number, LONGEST_TRIAL)
    model = Rounding(runs.solver, runs.run, runs.model).rounded()
    runs.solver.pop()
    windows = [axiom.window or 0 for axiom in (*whole.axioms, claim)]
    run = run_of(runs.run, model, max(windows))
    axioms = component(stated, claim).axioms
    return Completed(confirmed(stated, _as_stated(stated, claim), axioms, run), whole.numbers)


def _as_stated(stated: Problem, claim: Claim) -> Claim:
    return next(other for other in stated.claims if other.number == claim.number)


def _widened(
    problem: Problem, whole: Cone, fields: Fields, claim: Claim, runs: Bounded, tell: Callable[[int, float], None]
) -> tuple[Bounded, Formula] | str:
    """A counterexample that keeps the axioms outside of the cone, too; a sentence where none is found."""
    budget = problem.limits.budget
    for length in range(runs.run.length, runs.run.length + MORE_EVENTS + 1):
        tell(claim.number, 2 * budget)
        wider = bounded(problem, whole, fields, length, is_looped=runs.run.is_looped)
        formula = Formula(claim, wider.run)
        wider.solver.add(*formula.constraints)
        answer = wider.check(formula.violated, seconds=budget)
        if answer == z3.sat:
            return wider, formula
        if answer == z3.unknown:
            break
    return "there is a counterexample that keeps the axioms it is made of, and none was found that keeps those on what follows of it, too"
