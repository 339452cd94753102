# SPDX-License-Identifier: Apache-2.0
"""Remapping rules with the places they stand at, and the full names they have for one node."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from haros_ci.graph.names import resolve, resolve_target
from haros_ci.graph.ros2_process import NAMES, SPACES, RemappingRule, RosNode, rule_of, schemed
from haros_ci.model.architecture import Condition, RemapRule
from haros_ci.model.location import Location
from haros_ci.model.presence import ALWAYS, Presence


def written_rule(
    source: str,
    target: str,
    location: Location,
    *,
    conditions: tuple[Condition, ...] = (),
    is_global: bool = False,
    presence: Presence = ALWAYS,
) -> RemapRule:
    """The rule that a launch file writes, before it is known for which node."""
    return RemapRule(
        source=source, target=target, location=location, conditions=conditions, is_global=is_global, presence=presence
    )


def ros2_rules(
    rules: Iterable[RemappingRule], written: Iterable[RemapRule], location: Location
) -> tuple[RemapRule, ...]:
    """*rules* on the command line of a process, at *location*, then those *written* as remappings; none that names nodes."""
    found = [RemapRule(source=rule.source, target=rule.target, location=location, node=rule.node) for rule in rules]
    for remap_rule in written:
        rule = rule_of(f"{remap_rule.source}:={remap_rule.target}")
        if rule is not None:
            found.append(replace(remap_rule, source=rule.source, node=rule.node))
    return tuple(rule for rule in found if rule.source not in NAMES and rule.source not in SPACES)


def of_ros2_node(rules: Iterable[RemapRule], node: RosNode) -> tuple[RemapRule, ...]:
    """Those of *rules* that are for *node*, with full names."""
    last = node.name.rpartition("/")[2]
    return tuple(
        replace(
            rule,
            source_name=_whole(node.expand(schemed(rule.source)[1])),
            target_name=_whole(node.target(RemappingRule("", rule.source, rule.target))),
        )
        for rule in rules
        if rule.node in ("", last)
    )


def of_ros1_node(rules: Iterable[RemapRule], namespace: str, name: str) -> tuple[RemapRule, ...]:
    """*rules* with full names for the ROS 1 node of that full *name*."""
    return tuple(
        replace(
            rule,
            source_name=_whole(resolve(rule.source, namespace, name)),
            target_name=_whole(resolve_target(rule.target, namespace, name)),
        )
        for rule in rules
    )


def _whole(name: str) -> str | None:
    return None if "?" in name else name
