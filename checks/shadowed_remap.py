# SPDX-License-Identifier: Apache-2.0
"""Remapping rules that an earlier rule for the same name comes before (rcl takes the first that matches)."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, RemapRule, System, SystemNode, line_of, together


def check(system: System) -> Iterator[Finding]:
    for node in system.nodes:
        if node.ros != 2 or not node.is_launched:
            continue
        first: dict[str, RemapRule] = {}
        for rule in node.raw.rules:
            if rule.source_name is None or rule.target_name is None or rule.conditions:
                continue
            before = first.setdefault(rule.source_name, rule)
            if before.target_name != rule.target_name:
                yield from _finding(node, before, rule)


def _finding(node: SystemNode, first: RemapRule, second: RemapRule) -> Iterator[Finding]:
    presence = together(first.presence, second.presence)
    if presence is None:
        return
    why = (
        "the rule for all nodes of the group precedes it"
        if first.is_global and not second.is_global
        else "it stands before this one"
    )
    yield Finding(
        at=second.location,
        message=(
            f"{node}: the remapping of {second.source} to {second.target} has no effect, because an earlier rule "
            f"({line_of(first.location)}) remaps it to {first.target} ({why}); remove one of the two rules"
        ),
        about=(node, second.source_name or ""),
        related=((first.location, f"remapped to {first.target}"),),
        presence=presence,
    )


CHECK = Check(
    id="shadowed-remap",
    summary="Second remapping of the same name.",
    level=Level.WARNING,
    tags=("remappings", "launch"),
    run=check,
)
