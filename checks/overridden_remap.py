# SPDX-License-Identifier: Apache-2.0
"""Remapping rules of a node that an earlier rule for the same name leaves nothing to do."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, RemapRule, System, line_of, together


def check(system: System) -> Iterator[Finding]:
    for node in system.nodes:
        first: dict[str, RemapRule] = {}
        for rule in node.raw.rules if node.ros == 2 and node.known else ():
            if rule.source_name is None or rule.target_name is None or rule.node:
                continue
            if any(scheme in rule.source for scheme in ("://", "?")):
                continue
            earlier = first.get(rule.source_name)
            if earlier is None:
                if not rule.conditions:
                    first[rule.source_name] = rule
            elif earlier.target_name != rule.target_name and earlier.location != rule.location:
                presence = together(earlier.presence, rule.presence, node.presence)
                if presence is not None:
                    where = " for all nodes" if earlier.is_global else ""
                    yield Finding(
                        at=rule.location,
                        message=(
                            f"{node}: the remapping of {rule.source_name} to {rule.target_name} has no effect, because an earlier "
                            f"rule{where} ({line_of(earlier.location)}) remaps it to {earlier.target_name}; remove one of the two "
                            "rules"
                        ),
                        about=(node, rule.source_name),
                        related=((earlier.location, f"leads to {earlier.target_name}"),),
                        presence=presence,
                    )


CHECK = Check(
    id="overridden-remap",
    summary="Remapping hidden by an earlier rule for the same name.",
    level=Level.WARNING,
    catalogue="L11",
    tags=("launch", "remapping"),
    run=check,
)
