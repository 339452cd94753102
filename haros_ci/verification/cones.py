# SPDX-License-Identifier: Apache-2.0
"""What a property can depend on: the axioms on what its topics are made of, backwards through the system."""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci.behaviour.tree import PatternKind
from haros_ci.records import dataclass
from haros_ci.verification.problem import ENVIRONMENT, Claim, Problem


@dataclass(frozen=True, slots=True)
class Cone:
    """The *topics* of a search, and the *axioms* that hold on them."""

    topics: frozenset[str]
    axioms: tuple[Claim, ...]

    @property
    def numbers(self) -> tuple[int, ...]:
        return tuple(axiom.number for axiom in self.axioms)


def cone(problem: Problem, claim: Claim) -> Cone:
    """What *claim* is made of: axioms that promise something on its topics, and what these depend on in turn."""
    return _closed(claim.topics, problem.axioms, lambda axiom: axiom.promised)


def component(problem: Problem, claim: Claim) -> Cone:
    """All axioms that have to do with *claim*, also by what its topics cause: what is left out cannot keep a run from happening."""
    return _closed(claim.topics, problem.axioms, lambda axiom: axiom.topics)


def _closed(topics: frozenset[str], axioms: Iterable[Claim], of: object) -> Cone:
    assert callable(of)
    found: dict[int, Claim] = {}
    rest = list(axioms)
    while True:
        near = [axiom for axiom in rest if of(axiom) & topics]
        if not near:
            return Cone(topics, tuple(found[number] for number in sorted(found)))
        for axiom in near:
            found[axiom.number] = axiom
            topics |= axiom.topics
        rest = [axiom for axiom in rest if axiom.number not in found]


def heard(problem: Problem, axioms: Iterable[Claim]) -> list[tuple[str, str]]:
    """The nodes and topics of which it matters when they receive."""
    found = []
    for axiom in axioms:
        for topic in axiom.topics if axiom.node else ():
            member = problem.member(axiom.node)
            is_own = member is not None and topic in axiom.promised and topic not in member.subscribes
            if problem.hears(axiom.node, topic) and not is_own:
                found.append((axiom.node, topic))
    return found


def may_go_on(axioms: Iterable[Claim]) -> bool:
    """Whether axioms can demand messages for ever: what one demands can be what another one, or itself, depends on."""
    edges: dict[str, set[str]] = {}
    for axiom in axioms:
        pattern = axiom.stated.pattern
        if pattern.kind is PatternKind.CAUSES:
            causes = [axiom.name(event) for event in pattern.trigger]
        elif pattern.kind is PatternKind.SOME:
            causes = [axiom.name(event) for event in axiom.stated.scope.activator]
        else:
            continue
        for topic in causes:
            edges.setdefault(topic, set()).update(axiom.promised)
    return any(_reaches(edges, topic, topic) for topic in edges)


def _reaches(edges: dict[str, set[str]], first: str, last: str) -> bool:
    seen: set[str] = set()
    waiting = list(edges.get(first, ()))
    while waiting:
        topic = waiting.pop()
        if topic == last:
            return True
        if topic not in seen:
            seen.add(topic)
            waiting.extend(edges.get(topic, ()))
    return False


def open_publishers(problem: Problem, found: Cone) -> tuple[tuple[str, str], ...]:
    """Publishers on topics of a cone of which no axiom says anything there, with the topic; the environment is not among them."""
    bound = {(axiom.node, topic) for axiom in found.axioms for topic in axiom.promised}
    return tuple(
        (node, topic)
        for topic in sorted(found.topics)
        for node in problem.publishers(topic)
        if node != ENVIRONMENT and (node, topic) not in bound and ("", topic) not in bound
    )
