# SPDX-License-Identifier: Apache-2.0
"""Remapping rules that an earlier rule for the same name comes before (rcl takes the first that matches)."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, RemapRule, System, SystemNode, together


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
        "set for all nodes of the group, it comes first"
        if first.is_global and not second.is_global
        else "it comes first"
    )
    yield Finding(
        at=second.location,
        message=(
            f"{second.source} is remapped to {second.target} for {node}, but it is already remapped to {first.target}, and the "
            f"first rule is taken: this one does nothing ({why})"
        ),
        about=(node, second.source_name or ""),
        related=((first.location, f"remapped to {first.target}"),),
        presence=presence,
    )


CHECK = Check(
    id="shadowed-remap",
    summary="Each name of a node is remapped once.",
    level=Level.WARNING,
    tags=("remappings", "launch"),
    run=check,
)
