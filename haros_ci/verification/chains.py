# SPDX-License-Identifier: Apache-2.0
"""Proofs by composition: a property that follows from axioms link by link, for runs of any length.

``causes``: each trigger reaches a node that promises an answer, whose subscriber promises a further one, up to the behaviour; the bounds, and the
latency of each link, add up. ``requires``: each publisher of the behaviour promises what must have come before, and so does each publisher of that.
``no``: no publisher may send it. The values of messages are kept along the chain, and each link is a question to the solver without any run in it.

Axioms are those that hold globally, or, where messages arrive at once, those of the claim's own scope as well: they open and close with it
(``scoped.py``), and a chain of them stays within one opening.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from functools import partial
from typing import Any

import z3

from haros_ci.behaviour.meaning import free_variables
from haros_ci.behaviour.text import canonical
from haros_ci.behaviour.tree import Event, PatternKind, ScopeKind
from haros_ci.records import dataclass
from haros_ci.verification.fields import Fields, Slot
from haros_ci.verification.predicates import Compiler, Message, Value, both, no
from haros_ci.verification.problem import Claim, Problem
from haros_ci.verification.proofs import NOTHING, Proof
from haros_ci.verification.scoped import joins, shares_scope
from haros_ci.verification.unrolling import _range, _variable

#: Links of a chain, and questions to the solver for one claim.
MOST_LINKS, MOST_QUESTIONS = 8, 500


@dataclass(frozen=True, slots=True)
class Met:
    """A message in a proof: on *topic*, with these *values*, of which *known* holds."""

    topic: str
    message: Message
    known: tuple[Any, ...]


class Prover:
    """Looks for a proof of *claim* from the axioms of *problem* that hold globally, and then also from those of its own scope."""

    def __init__(
        self, problem: Problem, claim: Claim, axioms: tuple[Claim, ...], fields: Fields, seconds: float
    ) -> None:
        self.problem, self.claim, self.fields = problem, claim, fields
        self.axioms = tuple(axiom for axiom in axioms if axiom.stated.scope.kind is ScopeKind.GLOBALLY)
        self.scoped = tuple(axiom for axiom in axioms if shares_scope(problem, claim, axiom))
        #: Whether a chain must stay within one opening of the claim's scope.
        self.within = False
        self.ends = time.monotonic() + seconds
        self.questions = 0
        self.made = 0

    def proof(self) -> Proof | None:
        """A proof without regard to bounds; None if there is none."""
        kind, scope = self.claim.stated.pattern.kind, self.claim.stated.scope.kind
        forward, back = scope in (ScopeKind.GLOBALLY, ScopeKind.AFTER), scope in (ScopeKind.GLOBALLY, ScopeKind.UNTIL)
        if kind is PatternKind.CAUSES:
            return self._twice(self.claim.stated.pattern.trigger, self._caused, globally=forward)
        if kind is PatternKind.REQUIRES:
            return self._twice(self.claim.stated.pattern.behaviour, self._required, globally=back)
        if kind is PatternKind.NO:
            return self._twice(self.claim.stated.pattern.behaviour, self._impossible, globally=True)
        return None

    def _twice(self, events: tuple[Event, ...], prove: Any, *, globally: bool) -> Proof | None:
        """A proof from global axioms, where these can be enough; else within one opening of the scope."""
        found = self._all(events, prove) if globally else None
        if found is not None or not self.scoped:
            return found
        self.within = True
        try:
            return self._all(events, prove)
        finally:
            self.within = False

    def untestable(self) -> Proof | None:
        """A proof that nothing ever puts the claim to the test: its scope cannot open, or its trigger (``requires``: its behaviour) cannot come."""
        pattern, scope = self.claim.stated.pattern, self.claim.stated.scope
        first = {PatternKind.REQUIRES: pattern.behaviour, PatternKind.SOME: (), PatternKind.NO: ()}
        for events in (scope.activator, first.get(pattern.kind, pattern.trigger)):
            found = self.excluded(events)
            if found is not None:
                return found
        return None

    def excluded(self, events: tuple[Event, ...]) -> Proof | None:
        """A proof that none of *events* of the claim can come; None for no events."""
        return self._all(events, self._impossible) if events and not self._asks(events) else None

    def _asks(self, events: tuple[Event, ...]) -> bool:
        return any(next(free_variables(event), None) is not None for event in events)

    def _all(self, events: tuple[Event, ...], prove: Any) -> Proof | None:
        found = NOTHING
        named, begun = self._activators()
        for event in events:
            met = self._fresh(self.claim, event, named, begun)
            known = {**named, event.alias: met.message} if event.alias is not None else named
            inner = prove(met, known, ())
            if inner is None:
                return None
            found = found.beside(inner) if found is not NOTHING else inner
        return found

    def _activators(self) -> tuple[Mapping[str, Message], tuple[Any, ...]]:
        """The messages that may have opened the claim's scope, by alias, and what is known of them: any that match."""
        named: dict[str, Message] = {}
        known: tuple[Any, ...] = ()
        for event in self.claim.stated.scope.activator:
            if event.alias is not None:
                met = self._fresh(self.claim, event, {}, known)
                named[event.alias], known = met.message, met.known
        return named, known

    # causes

    def _caused(self, met: Met, named: Mapping[str, Message], path: tuple[int, ...]) -> Proof | None:
        """How the behaviour follows from *met*."""
        if path and self._is_one_of(met, self.claim.stated.pattern.behaviour, named):
            return NOTHING
        return self._by_what_it_causes(met, path, partial(self._caused, named=named))

    def _by_what_it_causes(self, met: Met, path: tuple[int, ...], prove: Any) -> Proof | None:
        """What *prove*, called with ``path``, proves of all that some axiom promises to follow *met*."""
        if len(path) >= MOST_LINKS:
            return None
        for axiom in self._promising(PatternKind.CAUSES, path):
            event = self._matched(met, axiom, axiom.stated.pattern.trigger)
            if event is None or not self._arrives(met.topic, axiom):
                continue
            go_on = partial(prove, path=(*path, axiom.number))
            found = self._branches(axiom, event, met, axiom.stated.pattern.behaviour, go_on)
            if found is not None:
                return self._link(axiom).then(found)
        return None

    def _arrives(self, topic: str, axiom: Claim) -> bool:
        """Whether each message on *topic* comes to the node of *axiom*; of the configuration's own it is enough that it is published."""
        return not self.problem.network.loses and (not axiom.node or self.problem.hears(axiom.node, topic))

    # requires

    def _required(self, met: Met, named: Mapping[str, Message], path: tuple[int, ...]) -> Proof | None:
        """How what the behaviour needs follows from *met*, of whoever published it."""
        if path and self._is_one_of(met, self.claim.stated.pattern.trigger, named):
            return NOTHING
        if len(path) >= MOST_LINKS:
            return None
        found: Proof | None = None
        for node in self.problem.publishers(met.topic):
            inner = self._required_of(node, met, named, path)
            if inner is None:
                return None
            found = inner if found is None else found.beside(inner)
        return found

    def _required_of(self, node: str, met: Met, named: Mapping[str, Message], path: tuple[int, ...]) -> Proof | None:
        excluded = self._excluded(node, met)
        if excluded is not None:
            return excluded
        return self._by_what_it_requires(node, met, path, partial(self._required, named=named))

    def _by_what_it_requires(self, node: str, met: Met, path: tuple[int, ...], prove: Any) -> Proof | None:
        """What *prove*, called with ``path``, proves of all that some axiom of *node* demands before *met*."""
        if len(path) >= MOST_LINKS:
            return None
        for axiom in self._promising(PatternKind.REQUIRES, path):
            event = self._matched(met, axiom, axiom.stated.pattern.behaviour) if axiom.node in (node, "") else None
            if event is None:
                continue
            go_on = partial(prove, path=(*path, axiom.number))
            found = self._branches(axiom, event, met, axiom.stated.pattern.trigger, go_on)
            if found is not None:
                return self._link(axiom).then(found)
        return None

    # no

    def _impossible(self, met: Met, named: Mapping[str, Message], path: tuple[int, ...]) -> Proof | None:
        """Why nobody publishes *met*: it would demand what is impossible, or each publisher excludes it, or needs for it what is impossible."""
        impossible = partial(self._impossible, named={})
        found = self._by_what_it_causes(met, path, impossible)
        if found is not None:
            return found
        for node in self.problem.publishers(met.topic):
            inner = self._excluded(node, met) or self._by_what_it_requires(node, met, path, impossible)
            if inner is None:
                return None
            found = inner if found is None else found.beside(inner)
        return found

    def _excluded(self, node: str, met: Met) -> Proof | None:
        """Why *node* never publishes *met*: what its ``no`` axioms (and those of the configuration) say together."""
        used, parts = [], []
        for axiom in self._promising(PatternKind.NO, ()):
            if axiom.node not in (node, "") or axiom.stated.pattern.bound is not None:
                continue
            events = [event for event in axiom.stated.pattern.behaviour if axiom.name(event) == met.topic]
            parts += [Compiler(axiom, self.fields).holds(event, met.message, {}) for event in events]
            used += [axiom] if events else []
        if not used or not self._follows(met.known, z3.Or(*parts)):
            return None
        for axiom, part in zip(used, parts):  # one of them alone, where that is enough
            if len(used) == len(parts) and len(used) > 1 and self._follows(met.known, part):
                return self._link(axiom)
        found = NOTHING
        for axiom in used:
            found = found.then(self._link(axiom))
        return found

    # links

    def _promising(self, kind: PatternKind, path: tuple[int, ...]) -> list[Claim]:
        scope = self.claim.stated.scope.kind
        usable = (*self.axioms, *self.scoped) if self.within else self.axioms
        return [
            axiom
            for axiom in usable
            if axiom.stated.pattern.kind is kind
            and axiom.number not in path
            and (not self.within or axiom in self.scoped or joins(scope, kind))
        ]

    def _link(self, axiom: Claim) -> Proof:
        hops = 1 if axiom.node and axiom.stated.pattern.kind is not PatternKind.NO else 0
        window = 0 if axiom.stated.pattern.kind is PatternKind.NO else axiom.window
        return Proof(
            (f"{axiom.node or 'the configuration'}: {canonical(axiom.stated)}",), (axiom.number,), window, hops
        )

    def _matched(self, met: Met, axiom: Claim, events: tuple[Event, ...]) -> Event | None:
        """The event of *events* that *met* certainly is."""
        for event in events:
            if axiom.name(event) == met.topic and self._follows(
                met.known, Compiler(axiom, self.fields).holds(event, met.message, {})
            ):
                return event
        return None

    def _branches(self, axiom: Claim, first: Event, met: Met, events: tuple[Event, ...], go_on: Any) -> Proof | None:
        """A proof for each event that *axiom* says there is one of."""
        found: Proof | None = None
        for event in events:
            named = {first.alias: met.message} if first.alias is not None else {}
            inner = go_on(self._fresh(axiom, event, named, met.known))
            if inner is None:
                return None
            found = inner if found is None else found.beside(inner)
        return found

    def _is_one_of(self, met: Met, events: tuple[Event, ...], named: Mapping[str, Message]) -> bool:
        compiler = Compiler(self.claim, self.fields)
        return any(
            self.claim.name(event) == met.topic and self._follows(met.known, compiler.holds(event, met.message, named))
            for event in events
        )

    def _fresh(
        self, claim: Claim, event: Event, named: Mapping[str, Message] | None = None, known: tuple[Any, ...] = ()
    ) -> Met:
        """Any message that is one of *event*."""
        topic = claim.name(event)
        self.made += 1
        values: dict[str, Value] = {}
        ranges: list[Any] = []
        slots = {slot.key: slot for slot in self.fields.of(topic)}
        for slot in slots.values():
            term = _variable(slot, f"proof {self.made} {topic} {slot.key}")
            ranges += _range(slot, term)
            values[slot.key] = Value(slot.kind, term)
        values = {
            key: Value(value.kind, value.term, _there(slots, slots[key], values)) for key, value in values.items()
        }
        message = values.__getitem__
        return Met(topic, message, (*known, *ranges, Compiler(claim, self.fields).holds(event, message, named or {})))

    def _follows(self, known: tuple[Any, ...], goal: Any) -> bool:
        """Whether *goal* holds wherever all of *known* does."""
        self.questions += 1
        left = self.ends - time.monotonic()
        if self.questions > MOST_QUESTIONS or left <= 0:
            return False
        solver = z3.Solver()
        solver.set("timeout", max(1, int(min(left, 1.0) * 1000)))
        solver.add(*known, no(goal))
        return bool(solver.check() == z3.unsat)


def _there(slots: Mapping[str, Slot], slot: Slot, values: Mapping[str, Value]) -> Any:
    """Whether the items that a slot goes through are in their arrays."""
    lengths = {other.path: other for other in slots.values() if other.is_length}
    return both(
        *(values[lengths[slot.path[:n]].key].term > part for n, part in enumerate(slot.path) if isinstance(part, int))
    )
