# SPDX-License-Identifier: Apache-2.0
"""Which axioms open and close together with a claim, so that what they promise within their scope is within the claim's.

That is so where the events of both scopes are the same, and both see the same messages at the same time: in an instant network, of nodes that receive
these topics, or are the only ones that publish on them. The values that opened the scope must not matter to the axiom.
"""

from __future__ import annotations

from haros_ci.behaviour.meaning import free_variables
from haros_ci.behaviour.text import event_text
from haros_ci.behaviour.tree import Event, PatternKind, ScopeKind
from haros_ci.verification.problem import Claim, Problem


def shares_scope(problem: Problem, claim: Claim, axiom: Claim) -> bool:
    """Whether an opening of *axiom*'s scope is one of *claim*'s, and the other way round; False for what holds globally."""
    ours, theirs = claim.stated.scope, axiom.stated.scope
    if ours.kind is ScopeKind.GLOBALLY or theirs.kind is not ours.kind or problem.network.is_async:
        return False
    if _events(claim, ours.activator) != _events(axiom, theirs.activator):
        return False
    if _events(claim, ours.terminator) != _events(axiom, theirs.terminator):
        return False
    if not all(_sees(problem, axiom, event) for event in (*theirs.activator, *theirs.terminator)):
        return False
    aliases = {event.alias for event in theirs.activator}
    pattern = axiom.stated.pattern
    return not any(
        variable.name in aliases
        for event in (*pattern.trigger, *pattern.behaviour)
        for variable in free_variables(event)
    )


def _events(claim: Claim, events: tuple[Event, ...]) -> frozenset[tuple[str, str]]:
    """What the events are, in the names of the running system; predicates that are written in the same way mean the same on one topic."""
    return frozenset((claim.name(event), event_text(event).partition(event.topic)[2]) for event in events)


def _sees(problem: Problem, axiom: Claim, event: Event) -> bool:
    """Whether the property means each message on the topic of *event*."""
    topic = axiom.name(event)
    return not axiom.node or problem.hears(axiom.node, topic) or problem.publishers(topic) == (axiom.node,)


def joins(scope: ScopeKind, kind: PatternKind) -> bool:
    """Whether what a global axiom promises (*kind*) of a message within an opening of *scope* is within it, too: what comes later where nothing
    closes it, what came before where nothing opened it. What never comes does not come there either."""
    later, earlier = scope is ScopeKind.AFTER, scope is ScopeKind.UNTIL
    return {PatternKind.CAUSES: later, PatternKind.REQUIRES: earlier}.get(kind, True)
