# SPDX-License-Identifier: Apache-2.0
"""A configuration under the names that its running graph shows: in ROS 1 what nodelets make belongs to their manager."""

from __future__ import annotations

from dataclasses import replace

from haros_ci.model.architecture import Architecture, Configuration, Endpoint, Node


def as_running(found: Architecture) -> Architecture:
    """*found* with the endpoints of ROS 1 nodelets on the node of their process, as ``rosnode info`` and the master tell them.

    A nodelet of which the process is not known stays; one whose manager is started elsewhere stands under the manager's name.
    """
    return replace(found, configurations=tuple(map(_configuration, found.configurations)))


def _configuration(configuration: Configuration) -> Configuration:
    hosted: dict[str, list[Node]] = {}
    for node in configuration.nodes:
        if _is_hosted(node):
            hosted.setdefault(node.process or "", []).append(node)
    if not hosted:
        return configuration
    nodes: list[Node] = []
    for node in configuration.nodes:
        if not _is_hosted(node):
            nodes.append(_hosting(node, hosted.pop(node.name, [])))
    for name, inside in hosted.items():
        manager = Node(name=name, kind="node", package="nodelet", type="nodelet", location=inside[0].location, ros=1)
        nodes.append(_hosting(replace(manager, process=name, source=inside[0].source), inside))
    return replace(configuration, nodes=tuple(sorted(nodes, key=lambda node: node.name)))


def _is_hosted(node: Node) -> bool:
    return (
        node.ros == 1
        and node.kind == "nodelet"
        and node.process is not None
        and node.process != node.name
        and "?" not in node.process
    )


def _hosting(manager: Node, inside: list[Node]) -> Node:
    if not inside:
        return manager
    ends: list[Endpoint] = list(manager.endpoints)
    for node in inside:
        ends += [replace(end, conditions=(*node.conditions, *end.conditions)) for end in node.endpoints]
    unknowns = (*manager.unknowns, *(unknown for node in inside for unknown in node.unknowns))
    return replace(manager, endpoints=tuple(dict.fromkeys(ends)), unknowns=tuple(dict.fromkeys(unknowns)))
