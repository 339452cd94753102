# SPDX-License-Identifier: Apache-2.0
"""What a claim sees of a run, and when its scope is open.

A property of a node sees what the node receives where it depends on a topic, and what the node publishes where it promises something. One of the
configuration sees all that is published. What the activator of a scope holds is kept from step to step, as the monitor keeps it.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import z3

from haros_ci.behaviour.tree import Event
from haros_ci.monitoring.predicates import chains, key_of
from haros_ci.verification.fields import Slot
from haros_ci.verification.predicates import FALSE, TRUE, Compiler, Message, Value, both, no, one_of
from haros_ci.verification.problem import Claim
from haros_ci.verification.unrolling import Unrolling


class View:
    """A claim in a run. ``constraints`` define what its formulas are made of, and say of a loop that the scope is the same at both its ends."""

    def __init__(self, claim: Claim, run: Unrolling) -> None:
        self.claim, self.run = claim, run
        self.compiler = Compiler(claim, run.fields)
        self.constraints: list[Any] = []
        self._messages: dict[tuple[int, str], Message] = {}
        scope = claim.stated.scope
        self.begins = bool(scope.activator)
        self.kept = self._kept_values()
        self.opened: list[Any] = [FALSE if self.begins else TRUE]
        self.inside: list[Any] = []
        self.opening: list[Any] = []
        self.registers: list[Mapping[str, Message]] = [{}]
        self._walk()
        if run.is_looped:
            self._close_loop()

    def sees(self, step: int, event: Event, is_behaviour: bool) -> Any:
        """Whether there is a message on the topic of *event* at *step*."""
        topic, node = self.claim.name(event), self.claim.node
        if not node:
            return self.run.published(step, topic)
        member = self.run.problem.member(node)
        publishes = self.run.published(step, topic, node)
        if member is None or (is_behaviour and (topic in member.publishes or topic not in member.subscribes)):
            return publishes
        return self.run.received(step, topic, node) if self.run.problem.hears(node, topic) else publishes

    def message(self, step: int, event: Event) -> Message:
        """The message that *event* would be at *step*."""
        topic = self.claim.name(event)
        if (step, topic) not in self._messages:
            self._messages[step, topic] = lambda key: self.run.value(step, topic, key)
        return self._messages[step, topic]

    def is_one(self, step: int, event: Event, is_behaviour: bool, others: Mapping[str, Message]) -> Any:
        """Whether the event at *step* is one of *event*, given the messages of other aliases."""
        seen = self.sees(step, event, is_behaviour)
        if z3.is_false(seen):
            return FALSE
        return both(seen, self.compiler.holds(event, self.message(step, event), others))

    def _kept_values(self) -> tuple[tuple[Event, Slot], ...]:
        """What others ask of the activators."""
        found: dict[tuple[str, str], tuple[Event, Slot]] = {}
        for event in self.claim.stated.scope.activator:
            for other in self.claim.stated.events:
                for chain in chains(other.predicate, event.alias) if event.alias and other is not event else ():
                    slot = self.run.fields.slots.get((self.claim.name(event), key_of(chain)))
                    if slot is not None:
                        found[event.alias or "", slot.key] = (event, slot)
        return tuple(found.values())

    def _walk(self) -> None:
        scope = self.claim.stated.scope
        for step in self.run.steps:
            opened, known = self.opened[step], self.registers[step]
            begins = [both(no(opened), self.is_one(step, event, False, {})) for event in scope.activator]
            ends = one_of(*(self.is_one(step, event, False, known) for event in scope.terminator))
            inside = both(opened, no(ends))
            self.inside.append(inside)
            self.opening.append(one_of(*begins))
            self.opened.append(self._named(one_of(inside, self.opening[step]), step))
            self.registers.append(self._registers(step, begins) if self.kept else {})

    def _named(self, term: Any, step: int) -> Any:
        """A variable for a term that many others mention."""
        if z3.is_true(term) or z3.is_false(term):
            return term
        name = z3.FreshBool(f"open {step}")
        self.constraints.append(name == term)
        return name

    def _registers(self, step: int, begins: list[Any]) -> Mapping[str, Message]:
        """What is known of the activator behind *step*: of the message there if it opens the scope, else what was known before."""
        values: dict[tuple[str, str], Value] = {}
        for event, slot in self.kept:
            alias = event.alias or ""
            opens = begins[next(n for n, e in enumerate(self.claim.stated.scope.activator) if e is event)]
            new = self.run.value(step, slot.topic, slot.key)
            old = self._register(step, alias, slot)
            term = z3.FreshConst(new.term.sort(), f"kept {slot.key}")
            there = z3.FreshBool(f"kept there {slot.key}")
            self.constraints.append(term == z3.If(opens, new.term, old.term))
            self.constraints.append(there == one_of(both(opens, new.there), both(no(self.opening[step]), old.there)))
            values[alias, slot.key] = Value(slot.kind, term, there)
        aliases = {alias for alias, _ in values}
        return {alias: _kept_of(alias, values) for alias in aliases}

    def _register(self, step: int, alias: str, slot: Slot) -> Value:
        known = self.registers[step]
        return (
            known[alias](slot.key) if known else Value(slot.kind, self.run.value(0, slot.topic, slot.key).term, FALSE)
        )

    def _close_loop(self) -> None:
        """The scope is open behind the last step as it is before the first one of the loop, and by the same values."""
        last = self.run.length
        for step, begins in enumerate(self.run.loops):
            same = [self.opened[step] == self.opened[last]]
            for event, slot in self.kept:
                one, other = (self._register(at, event.alias or "", slot) for at in (step, last))
                same.append(
                    one_of(
                        no(self.opened[last]),
                        both(one.there == other.there, one_of(no(one.there), one.term == other.term)),
                    )
                )
            self.constraints.append(z3.Implies(begins, z3.And(*same)))

    def between(self, first: int, last: int) -> Any:
        """Whether the scope is open, without a break, from step *first* to *last*, both included."""
        key = (first, last)
        if key not in self._spans:
            self._spans[key] = TRUE if first > last else both(self.between(first, last - 1), self.inside[last])
        return self._spans[key]

    @cached_property
    def _spans(self) -> dict[tuple[int, int], Any]:
        return {}

    def to_end(self, first: int) -> Any:
        """Whether it is open from *first* to the last step."""
        return self.between(first, self.run.length - 1)

    @cached_property
    def from_loop(self) -> list[Any]:
        """Whether each step is in the loop, and the scope open from the loop's first step to it."""
        found: list[Any] = []
        for step in self.run.steps:
            before = found[-1] if found else FALSE
            found.append(both(self.inside[step], one_of(self.run.loops[step], before)))
        return found


def _kept_of(alias: str, values: Mapping[tuple[str, str], Value]) -> Message:
    return lambda key: values[alias, key]
