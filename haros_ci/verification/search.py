# SPDX-License-Identifier: Apache-2.0
"""The search for counterexamples to the claims of a problem: what cannot be modelled is set aside, the rest goes in groups of one cone."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from typing import Any

import z3

from haros_ci.behaviour.text import canonical, time_text
from haros_ci.behaviour.tree import PatternKind, ScopeKind
from haros_ci.verification.bounded import bounded
from haros_ci.verification.cones import Cone, cone, may_go_on
from haros_ci.verification.fields import Fields
from haros_ci.verification.groups import Group, Sought, Tell
from haros_ci.verification.lowering import lowered
from haros_ci.verification.outcomes import Finding, Result
from haros_ci.verification.patterns import Formula
from haros_ci.verification.predicates import Compiler, Message, Value
from haros_ci.verification.problem import MILLISECOND, Claim, NotModelled, Problem, events_of
from haros_ci.verification.proofs import greatest_latency, sentence
from haros_ci.verification.replay import is_two_sided, never_ends
from haros_ci.verification.scoped import shares_scope
from haros_ci.verification.unrolling import _variable

#: Halvings of an interval of latencies, and the least step in nanoseconds.
HALVINGS, LEAST_LATENCY = 12, MILLISECOND // 10
#: Patterns that proofs by composition are looked for.
COMPOSED = (PatternKind.CAUSES, PatternKind.REQUIRES, PatternKind.NO)


def nobody(number: int, seconds: float) -> None:
    """Tells nobody."""


def findings(
    problem: Problem, tell: Tell = nobody, passed: Callable[[int], bool] = lambda number: False
) -> Iterator[Finding]:
    """What is found out about each claim but those that are *passed* over, in groups of the same cone."""
    problem = problem.settled()
    left: list[tuple[int, str]] = []
    axioms = tuple(_modelled(problem, problem.axioms, left))
    refused: list[tuple[int, str]] = []
    claims = tuple(_modelled(problem, (c for c in problem.claims if not passed(c.number)), refused))
    for number, reason in refused:
        yield Finding(number, Result.NOT_MODELLED, reason)
    modelled = replace(problem, axioms=axioms, claims=claims)
    groups: dict[tuple[frozenset[str], tuple[int, ...]], list[Claim]] = {}
    for claim in claims:
        found = cone(modelled, claim)
        groups.setdefault((found.topics, found.numbers), []).append(claim)
    for together in groups.values():
        yield from _of_group(problem, modelled, together, tuple(left), tell)


def _of_group(
    stated: Problem, problem: Problem, claims: list[Claim], left: tuple[tuple[int, str], ...], tell: Tell
) -> Iterator[Finding]:
    within = cone(problem, claims[0])
    goes_on = may_go_on(within.axioms)
    try:
        fields = Fields()
        fields.add((*problem.axioms, *claims))
        group = Group(problem, within, fields, stated, tell, [Sought(c, goes_on or never_ends(c)) for c in claims])
        group.search()
    except NotModelled as err:
        yield from (Finding(claim.number, Result.NOT_MODELLED, str(err)) for claim in claims)
        return
    for sought in group.claims:
        concerned = tuple(item for item in left if _is_near(stated, item[0], within))
        yield replace(
            _concluded(group, sought), cone=within.numbers, left=concerned, topics=tuple(sorted(within.topics))
        )


def _is_near(stated: Problem, number: int, within: Cone) -> bool:
    return any(axiom.number == number and axiom.topics & within.topics for axiom in stated.axioms)


def _modelled(problem: Problem, claims: Iterable[Claim], refused: list[tuple[int, str]]) -> Iterator[Claim]:
    """The claims without quantifiers of which all can be said in formulas; the others are *refused*."""
    for claim in claims:
        try:
            if is_two_sided(problem, claim):
                raise NotModelled(f"a topic that {claim.node} publishes and receives, in two roles")
            found = lowered(claim)
            fields = Fields()
            fields.add((found,))
            compiler = Compiler(found, fields)
            for event, _ in events_of(found):
                others = {o.alias: _any(fields, found.name(o)) for o, _ in events_of(found) if o.alias is not None}
                compiler.holds(event, _any(fields, found.name(event)), others)
            yield found
        except NotModelled as err:
            refused.append((claim.number, str(err)))


def _any(fields: Fields, topic: str) -> Message:
    """Some message."""

    def value(key: str) -> Value:
        slot = fields.slots[topic, key]
        return Value(slot.kind, _variable(slot, f"some {topic} {key}"))

    return value


def _concluded(group: Group, sought: Sought) -> Finding:
    """The answer for one claim."""
    number, limits = sought.claim.number, group.problem.limits
    depth = min(sought.silent, sought.looped) if sought.needs_loop else sought.silent
    derivation = () if sought.proof is None else sentence(group.problem, sought.claim, sought.proof)
    axioms = () if sought.proof is None else sought.proof.axioms
    base = Finding(number, Result.NONE, depth=max(depth, 0), is_whole=depth >= limits.depth)
    if sought.broken is not None:
        if isinstance(sought.broken, str):
            return replace(base, result=Result.UNDETERMINED, reason=sought.broken)
        found = replace(
            base, result=Result.VIOLATED, run=sought.broken, axioms=sought.axioms, reason=sought.broken.reason
        )
        return _with_latency(group, sought, found)
    if group.contradiction:
        return replace(base, result=Result.CONTRADICTORY, axioms=group.contradiction, depth=sought.looked)
    if sought.is_vacuous:
        depth = 0 if sought.is_untestable else sought.looked
        return replace(base, result=Result.VACUOUS, axioms=sought.against, depth=depth, is_whole=sought.is_untestable)
    if sought.is_proved:
        return _with_latency(group, sought, replace(base, result=Result.PROVED, axioms=axioms, derivation=derivation))
    if depth < 0:
        return replace(base, result=Result.UNDETERMINED, reason="the budget was spent before an answer")
    if not sought.is_tested:
        what = "puts it to the test" if group.is_consistent else "keeps all axioms"
        return replace(
            base, result=Result.UNDETERMINED, reason=f"no run of so few events ({depth}) {what}; longer ones may"
        )
    return _with_latency(group, sought, replace(base, reason=_not_composed(group, sought.claim)))


def _not_composed(group: Group, claim: Claim) -> str:
    """Which axioms a proof could not use for their scopes; "" if there are none."""
    others = [
        axiom
        for axiom in group.cone.axioms
        if axiom.stated.scope.kind is not ScopeKind.GLOBALLY and not shares_scope(group.problem, claim, axiom)
    ]
    if not others or claim.stated.pattern.kind not in COMPOSED:
        return ""
    more = f" and {len(others) - 1} more" if len(others) > 1 else ""
    return f"not composed: the scope of {others[0].node or 'the configuration'}: {canonical(others[0].stated)}{more}"


def _with_latency(group: Group, sought: Sought, found: Finding) -> Finding:
    """*found* with the greatest latency at which a bound is kept: by a proof, else up to as many events as a counterexample has."""
    problem, claim = group.problem, sought.claim
    if not problem.network.is_async or claim.window is None:
        return found
    if sought.proof is not None:
        latency = greatest_latency(problem, claim, sought.proof)
        if latency is not None:
            words = f"proved up to a latency of {_time(latency)}"
            return replace(found, latency=latency, of_latency=words, derivation=sentence(problem, claim, sought.proof))
    if found.run is None:
        return found
    latency = _bisected(group, claim, len(found.run.steps), looped=found.run.loop is not None)
    if latency is None:
        return found
    return replace(
        found,
        latency=latency,
        of_latency=f"no counterexample of up to {len(found.run.steps)} events up to a latency of {_time(latency)}",
    )


def _time(nanoseconds: int) -> str:
    return time_text(nanoseconds / 1000 / MILLISECOND)


def _bisected(group: Group, claim: Claim, length: int, *, looped: bool) -> int | None:
    """The greatest latency, in tenths of milliseconds, of which runs of *length* events have no counterexample; None if there is none."""
    problem = group.problem
    low, high = (
        problem.network.low,
        problem.network.high if problem.network.high is not None else 2 * (claim.window or 0),
    )
    if not _is_safe(group, claim, length, low, looped=looped):
        return None
    for _ in range(HALVINGS):
        middle = (low + high) // 2 // LEAST_LATENCY * LEAST_LATENCY
        if middle <= low:
            break
        if _is_safe(group, claim, length, middle, looped=looped):
            low = middle
        else:
            high = middle
    return low


def _is_safe(group: Group, claim: Claim, length: int, latency: int, *, looped: bool) -> bool:
    problem = replace(group.problem, network=replace(group.problem.network, high=latency))
    group.tell(claim.number, problem.limits.budget)
    runs = bounded(problem, group.cone, group.fields, length, is_looped=looped)
    formula = Formula(claim, runs.run)
    runs.solver.add(*formula.constraints)
    answer: Any = runs.check(formula.violated, seconds=max(0.5, problem.limits.budget / HALVINGS))
    return bool(answer == z3.unsat)
