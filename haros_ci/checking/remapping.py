# SPDX-License-Identifier: Apache-2.0
"""The remapping rule that an end has its name from, and where one goes to change the name."""

from __future__ import annotations

from haros_ci.checking.check import Place
from haros_ci.checking.system import End
from haros_ci.model.architecture import RemapRule
from haros_ci.model.location import Location


def rule_of(end: End) -> RemapRule | None:
    """The rule that renamed *end*; None if it has the name that its code gives it, or where the rule stands is not known."""
    if end.name == end.original_name:
        return None
    wanted = (end.original_name, end.name)
    return next((rule for rule in end.node.raw.rules if (rule.source_name, rule.target_name) == wanted), None)


def named_at(end: End) -> Location:
    """Where *end* gets its name: at the remapping rule if there is one, else at its call."""
    rule = rule_of(end)
    return end.location if rule is None else rule.location


def way_to(end: End) -> tuple[Place, ...]:
    """From the start of the node over the remapping rule to the call, as far as their places are known."""
    rule = rule_of(end)
    steps = [(end.node.location, f"{end.node} is started")] if end.node.is_launched else []
    if rule is not None:
        steps.append((rule.location, f"{end.original_name} is remapped to {end.name}"))
    if end.in_source:
        steps.append((end.location, f"{end.word} {end.original_name}"))
    return tuple(steps) if len(steps) > 1 else ()
