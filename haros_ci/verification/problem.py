# SPDX-License-Identifier: Apache-2.0
"""What is verified: the nodes of a system, the properties that are taken for granted, and those that are in question."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

from haros_ci.behaviour.messages import Typed
from haros_ci.behaviour.tree import Event, Expression, Property
from haros_ci.monitoring.predicates import Constants
from haros_ci.records import dataclass, field

#: Nanoseconds of a millisecond, the unit of times in formulas.
MILLISECOND = 1_000_000
#: Who publishes on topics that no node of the system publishes on.
ENVIRONMENT = "the environment"


class NotModelled(Exception):
    """A construct of a property that formulas do not have; the message names it."""


def _unknown(event: Event, expression: Expression) -> Typed:
    return None


def _no_constant(event: Event, expression: Expression) -> None:
    return None


@dataclass(frozen=True, slots=True, eq=False)
class Claim:
    """A property: of *node* (its name), or of the configuration ("").

    *names* are what its topics are called when the system runs, where that differs. *typed* says what a field of an event is, *constants*
    the values of those that are constants of the message.
    """

    number: int
    title: str
    stated: Property
    names: Mapping[str, str] = field(default_factory=dict)
    node: str = ""
    typed: Callable[[Event, Expression], Typed] = _unknown
    constants: Constants = _no_constant

    def name(self, event: Event) -> str:
        """What the topic of *event* is called when the system runs."""
        return self.names.get(event.topic, event.topic)

    @property
    def topics(self) -> frozenset[str]:
        return frozenset(self.name(event) for event in self.stated.events)

    @property
    def promised(self) -> frozenset[str]:
        """The topics of its behaviour."""
        return frozenset(self.name(event) for event in self.stated.pattern.behaviour)

    @property
    def window(self) -> int | None:
        """Its bound in nanoseconds; None without one."""
        bound = self.stated.pattern.bound
        return None if bound is None else round(bound.seconds * 1000 * MILLISECOND)


@dataclass(frozen=True, slots=True)
class Member:
    """A node: the topics that it publishes on, and those that it subscribes to with the length of the queue (None: not known; 0: without end)."""

    name: str
    publishes: frozenset[str]
    subscribes: Mapping[str, int | None]


@dataclass(frozen=True, slots=True)
class Network:
    """How messages come to subscribers: at once, or (*is_async*) *low* to *high* nanoseconds after they were published, in their order.

    With *loses* a message can be lost if as many others as its queue holds are published before it arrives.
    """

    is_async: bool = False
    low: int = 0
    high: int | None = None
    loses: bool = False


@dataclass(frozen=True, slots=True)
class Limits:
    """*depth* is the most events of a run, *budget* the seconds for each property, *memory* megabytes for all."""

    depth: int = 12
    budget: float = 10.0
    memory: int = 2_000


@dataclass(frozen=True, slots=True)
class Problem:
    """The *members* of a system, the *axioms*, and the *claims* that are in question."""

    members: tuple[Member, ...]
    axioms: tuple[Claim, ...]
    claims: tuple[Claim, ...]
    network: Network = Network()
    limits: Limits = Limits()

    def publishers(self, topic: str) -> tuple[str, ...]:
        """The nodes that publish on *topic*; the environment where there is none. A node promises what it publishes, also where the model lacks that."""
        found = [member.name for member in self.members if topic in member.publishes]
        found += [axiom.node for axiom in self.axioms if self.is_lent(axiom, topic)]
        return tuple(dict.fromkeys(found)) or (ENVIRONMENT,)

    def is_lent(self, axiom: Claim, topic: str) -> bool:
        """Whether the node of *axiom* promises something on *topic* on which the model does not have it."""
        if not axiom.node or topic not in axiom.promised:
            return False
        member = self.member(axiom.node)
        return member is not None and topic not in member.publishes and topic not in member.subscribes

    def member(self, name: str) -> Member | None:
        return next((member for member in self.members if member.name == name), None)

    def settled(self) -> Problem:
        """The same problem, in which nodes publish on what they are lent."""

        def whole(member: Member) -> Member:
            own = (axiom for axiom in self.axioms if axiom.node == member.name)
            lent = {topic for axiom in own for topic in axiom.promised if self.is_lent(axiom, topic)}
            return replace(member, publishes=member.publishes | lent)

        return replace(self, members=tuple(map(whole, self.members)))

    def hears(self, node: str, topic: str) -> bool:
        """Whether properties of *node* mean the messages that it receives on *topic*, where they depend on it."""
        member = self.member(node)
        return member is not None and (topic in member.subscribes or topic not in member.publishes)


def events_of(claim: Claim) -> Iterator[tuple[Event, bool]]:
    """The events of a claim, and whether they are behaviour."""
    scope, pattern = claim.stated.scope, claim.stated.pattern
    for event in (*scope.activator, *scope.terminator, *pattern.trigger):
        yield event, False
    for event in pattern.behaviour:
        yield event, True
