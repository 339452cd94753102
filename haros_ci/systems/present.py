# SPDX-License-Identifier: Apache-2.0
"""Nodes that are there with other launch arguments only, beside those that can be there at the same time."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from typing import Any

from haros_ci.graph.names import clean
from haros_ci.graph.parameters import ParameterServer
from haros_ci.keeping.kept import Followed
from haros_ci.model.architecture import Parameter
from haros_ci.model.launch import Launched, LaunchedNode, LaunchedSystem, ParameterRule
from haros_ci.model.location import Location
from haros_ci.model.presence import Presence, together
from haros_ci.systems import ros2_system, system
from haros_ci.systems.controllers import with_controllers
from haros_ci.systems.following import Types
from haros_ci.systems.system import Job


def launched(types: Types, found: Launched) -> Iterator[Job]:
    """The alternatives of a ROS 1 launch file, each with the parameters that are set where it is there."""
    servers: dict[Presence, ParameterServer] = {}
    for alternative in found.alternatives:
        if alternative.is_test:
            continue
        if alternative.presence not in servers:
            servers[alternative.presence] = ParameterServer(_parameters(found, alternative.presence))
        yield system.launched(types, alternative, servers[alternative.presence])


def _parameters(found: Launched, presence: Presence) -> Iterable[Parameter]:
    """What is set with the launch arguments that *presence* asks for: others override what is set without them."""
    added = {
        parameter.name: parameter
        for parameter in found.alternative_parameters
        if together(presence, parameter.presence) == presence
    }
    for parameter in found.parameters:
        if parameter.name not in added and together(presence, parameter.presence) is not None:
            yield replace(parameter, presence=()) if parameter.presence else parameter
    yield from added.values()


def ros2_launched(
    types: Types,
    found: LaunchedSystem,
    rules_of: Callable[[str, Location], Iterable[ParameterRule]],
    managers: tuple[LaunchedNode, ...] = (),
) -> Iterator[Job]:
    """The alternatives of a ROS 2 launch file, with the controllers that they bring, each in a container that can be there.

    *managers* are the controller managers that simulators have.
    """
    if not found.alternatives:
        return
    count = len(with_controllers(found.nodes, rules_of, managers))
    by_name: dict[str, list[LaunchedNode]] = {}
    for alternative in (*found.alternatives, *found.nodes):
        if alternative.name is not None:
            by_name.setdefault(clean(f"{alternative.namespace or '/'}/{alternative.name}"), []).append(alternative)
    for node in with_controllers((*found.nodes, *found.alternatives), rules_of, managers)[count:]:
        fitting = [
            other_node
            for other_node in by_name.get(node.container or "", ())
            if together(node.presence, other_node.presence) is not None
        ]
        yield ros2_system.launched(types, node, {node.container or "": fitting[0]} if fitting else {})


def remember(types: Types, fresh: Iterable[tuple[Any, Followed]]) -> None:
    """What other processes have followed, where nodes are looked up in this one."""
    for key, followed in fresh:
        kept = types.followed.setdefault(key, [])
        if not any(followed is other for other in kept):
            kept.append(followed)
