# SPDX-License-Identifier: Apache-2.0
"""Remapping rules of a node that an earlier rule for the same name leaves nothing to do."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, RemapRule, System, SystemNode, is_idle, line_of, together


def check(system: System) -> Iterator[Finding]:
    # the same two rules given to several nodes, by a list or by an include, are one slip
    found: dict[tuple[Location, str, Location], list[tuple[SystemNode, RemapRule, RemapRule]]] = {}
    for node in system.nodes:
        if node.ros == 2 and node.known and node.is_launched:
            for earlier, rule in _hidden(node):
                found.setdefault((rule.location, rule.source, earlier.location), []).append((node, earlier, rule))
    for pairs in found.values():
        yield from _finding(pairs)


def _hidden(node: SystemNode) -> Iterator[tuple[RemapRule, RemapRule]]:
    """Rules of *node* with the earlier one that is taken; those for names that the node does not have are ineffective-remap's."""
    first: dict[str, RemapRule] = {}
    for rule in node.raw.rules:
        if rule.source_name is None or rule.target_name is None or rule.node or rule.conditions:
            continue
        if any(scheme in rule.source for scheme in ("://", "?")):
            continue
        earlier = first.setdefault(rule.source_name, rule)
        if earlier.target_name == rule.target_name or earlier.location == rule.location:
            continue
        if not is_idle(node, rule):
            yield earlier, rule


def _finding(pairs: list[tuple[SystemNode, RemapRule, RemapRule]]) -> Iterator[Finding]:
    possible = [
        (node, earlier, rule, presence)
        for node, earlier, rule in pairs
        for presence in [together(earlier.presence, rule.presence, node.presence)]
        if presence is not None
    ]
    if not possible:
        return
    node, earlier, rule, presence = possible[0]
    names = dict.fromkeys(node.name for node, *_ in possible)
    more = f" and {len(names) - 1} more nodes" if len(names) > 1 else ""
    where = " for all nodes of its group" if earlier.is_global and not rule.is_global else ""
    yield Finding(
        at=rule.location,
        message=(
            f"{node}{more}: the remapping of {rule.source} to {rule.target} has no effect, because an earlier rule{where} "
            f"({line_of(earlier.location)}) remaps it to {earlier.target}; remove one of the two rules"
        ),
        about=(node, *(name for name in names if name != node.name), rule.source_name or rule.source),
        apart=(rule.source,),
        related=((earlier.location, f"remaps {earlier.source} to {earlier.target}"),),
        presence=presence,
    )


CHECK = Check(
    id="overridden-remap",
    summary="Remapping hidden by an earlier rule for the same name.",
    level=Level.WARNING,
    catalogue="L11",
    aliases=("shadowed-remap",),
    tags=("launch", "remapping"),
    run=check,
)
