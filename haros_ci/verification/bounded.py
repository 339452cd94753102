# SPDX-License-Identifier: Apache-2.0
"""Runs of one length that keep the axioms of a cone, as a question to the solver."""

from __future__ import annotations

from typing import Any

import z3

from haros_ci.behaviour.tree import PatternKind
from haros_ci.records import dataclass
from haros_ci.verification.cones import Cone, heard
from haros_ci.verification.fields import Fields
from haros_ci.verification.patterns import Formula
from haros_ci.verification.problem import Problem
from haros_ci.verification.unrolling import Unrolling, options_of


@dataclass(slots=True)
class Bounded:
    """The *run*, the *solver*, and the *axioms*, each under its own literal."""

    run: Unrolling
    solver: Any
    axioms: dict[int, Any]
    #: The model of the last question that has one.
    model: Any = None

    def check(self, *parts: Any, seconds: float) -> Any:
        """sat, unsat or unknown of *parts* together with all axioms; no memory left is unknown."""
        self.solver.set("timeout", max(1, int(seconds * 1000)))
        try:
            answer = self.solver.check(*self.axioms.values(), *parts)
            if answer == z3.sat:
                self.model = self.solver.model()
            return answer
        except z3.Z3Exception:
            return z3.unknown

    def core(self) -> tuple[int, ...]:
        """The axioms that the last unsat rests on."""
        names = {str(literal): number for number, literal in self.axioms.items()}
        return tuple(sorted(names[str(part)] for part in self.solver.unsat_core() if str(part) in names))


def bounded(
    problem: Problem,
    cone: Cone,
    fields: Fields,
    length: int,
    *,
    is_looped: bool = False,
    is_exact: bool = False,
    is_prefix: bool = False,
) -> Bounded:
    """Runs of *length* events (*is_exact*: not fewer) on the topics of *cone* that keep its axioms; with *is_prefix* beginnings of such runs,
    which keep those that demand nothing."""
    options = options_of(problem, cone.topics, heard(problem, cone.axioms))
    run = Unrolling(problem, options, fields, length, is_looped=is_looped, is_exact=is_exact, is_prefix=is_prefix)
    solver = z3.Solver()
    solver.add(*run.constraints)
    literals = {}
    for axiom in cone.axioms:
        if is_prefix and axiom.stated.pattern.kind in (PatternKind.SOME, PatternKind.CAUSES):
            continue
        formula = Formula(axiom, run)
        literals[axiom.number] = z3.Bool(f"axiom {axiom.number}")
        solver.add(*formula.constraints, z3.Implies(literals[axiom.number], z3.Not(formula.violated)))
    return Bounded(run, solver, literals)
