# SPDX-License-Identifier: Apache-2.0
"""Nodes that cannot be followed: what is known of their type, else why there is nothing to follow."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from itertools import chain
from posixpath import basename
from typing import TYPE_CHECKING

from haros_ci.follow.ros.ros2_nodes import MANAGED
from haros_ci.graph.given_parameters import reason as reason_of
from haros_ci.graph.names import clean
from haros_ci.graph.parameters import Perhaps
from haros_ci.graph.ros2_process import RosNode
from haros_ci.graph.words import shell_words
from haros_ci.graph.words import split as words_of
from haros_ci.launch.ros2.python_programs import INTERPRETERS
from haros_ci.model.architecture import Node, Unknown
from haros_ci.model.build import Build
from haros_ci.model.location import Location
from haros_ci.systems.entries import main_of
from haros_ci.systems.known.command_lines import specialised
from haros_ci.systems.known.entry import KnownNode
from haros_ci.systems.known.instantiate import instantiate
from haros_ci.systems.other_ros import client_of
from haros_ci.systems.ros2_implicit import implicit
from haros_ci.values.abstract import Known, Value, data_of, opaque_of

if TYPE_CHECKING:
    from haros_ci.graph.given_parameters import Parameters
    from haros_ci.graph.ros2_process import RemappingRule
    from haros_ci.model.launch import LaunchedNode
    from haros_ci.systems.following import Types

#: Why the name of a ROS 2 node is not known.
UNNAMED = "the program names itself, and its code is not in the workspace"


def described(
    node: Node,
    types: Types,
    known: KnownNode | None,
    namespace: str,
    arguments: tuple[str, ...],
    parameter: Callable[[str], Value | None],
    remaps: Mapping[str, str],
) -> Node:
    """*node* with what is *known* of its type, if anything is; else with an unknown in place of endpoints."""
    if known is None:
        reason = why(types, node.package, node.type, 1, look_up(node) if node.kind == "nodelet" else None)
        return replace(node, unknowns=(*node.unknowns, Unknown("endpoints", reason, node.location)))

    ends = instantiate(
        specialised(known, arguments, 1),
        name=node.name,
        namespace=namespace,
        arguments=arguments,
        parameter=lambda full: as_data(parameter(full)),
        remap=lambda full: remaps.get(full, full),
    )
    return replace(node, endpoints=ends)


def as_data(value: Value | None) -> object | None:
    """The value of a parameter as data, None if it is not set, an Unknown if its value is no data or it may not be set."""
    if value is None:
        return None
    held, plain = data_of(value)
    if held:
        data: object = plain
        return data
    reason = opaque_of(value)
    field = "presence" if isinstance(value, Perhaps) else "value"
    message = reason.reason if reason else "it is not plain data"
    return Unknown(field, message, reason.location if reason else None)


def look_up(node: Node) -> str:
    """What a node type goes by: the name that a nodelet is loaded by, else the executable."""
    return f"{node.package}/{node.type}" if node.kind == "nodelet" and node.package else node.type


def why(types: Types, package: str, name: str, ros: int, nodelet: str | None) -> str:
    """Why a node that a launch file of that *ros* starts is not followed; *nodelet* is a nodelet's look-up name, None for a node."""
    programs = types.programs
    what = nodelet or f"{package}/{name}"
    if "?" in what:
        return "which program it is, is not known"
    if ros == 2 and not package:
        is_run = name in INTERPRETERS
        return (
            f"the program that {name} runs was not found in the workspace"
            if is_run
            else f"the code of {name} is not in the workspace"
        )
    build = programs.builds.get(package)
    if nodelet is None and name.startswith(f"{package}/"):  # a plug-in, such as a controller
        if build is None:
            return f"the code of {name} is not in the workspace"
        return f"{name} is in the workspace, but what calls it is not: it is not followed"
    if nodelet is not None:
        described_ones = (plugin for made in programs.builds.values() for plugin in made.plugins)
        classes = [plugin.type.strip() for plugin in described_ones if plugin.name == nodelet]
        if classes:
            return f"the class {classes[0]} of the nodelet {what} was not found in the workspace"
        if build is None:
            return f"the code of {what} is not in the workspace"
        return f"no plug-in description of the workspace names the nodelet {what}"
    if build is None:
        return f"the code of {what} is not in the workspace"
    for target in build.targets:
        if target.kind == "executable" and target.output == name:
            where = f"{target.location.path}:{target.location.line}"
            if main_of(programs, target) is not None:
                what = f"{what} ({where})"
                return f"{what} is built for tests only" if target.is_test else f"{what} is a program of the other ROS"
            if target.component:
                return f"{what} ({where}) runs {target.component}, a component of ROS 2, and is not followed here"
            return f"no main function was found in the sources of {what} ({where})"
    return _unbuilt(types, package, name, ros, build)


def _unbuilt(types: Types, package: str, name: str, ros: int, build: Build) -> str:
    """Why a node is not followed that is no target of its *package*."""
    what, programs = f"{package}/{name}", types.programs
    path = script_named(build, name)
    if path in types.left_out:
        client = types.left_out[path]
        return f"{what} ({path}) uses the client library of ROS {client}, but its package is taken for ROS {3 - client}"
    if path in programs.sources and client_of(programs, programs.sources[path]) == 3 - ros:
        return f"{what} ({path}) is a program of the other ROS"
    path = types.shell_script(package, name)
    if path:
        return f"{what} ({path}) is a shell script: what it starts is not known"
    return f"package {package} is in the workspace, but no C++ or Python program called {name} was found in it"


def script_named(build: Build, name: str) -> str:
    """The file of a package that is started by that *name* without being built; "" if there is none."""
    installed = (
        one.path for one in build.installed if one.kind == "program" and name == (one.name or basename(one.path))
    )
    points = (point.path for point in build.entry_points if point.name == name)
    scripts = (path for path in build.scripts if basename(path) == name)
    return next(chain(installed, points, scripts), "") or ""


def ros2_described(
    node: Node, types: Types, started: LaunchedNode, rules: tuple[RemappingRule, ...], provided: Parameters
) -> Node:
    """A ROS 2 *node* whose code is not in the workspace: with what is known of its type, if anything is."""
    known = types.known(node.package, node.type, 2)
    if known is None:
        reason = why(types, node.package, node.type, 2, None)
        unknowns = [*node.unknowns, Unknown("endpoints", reason, node.location)]
        if "?" in node.name and not any(unknown.field == "name" for unknown in unknowns):
            unknowns.append(Unknown("name", UNNAMED, node.location))
        return replace(node, unknowns=tuple(unknowns))
    last = started.name or known.node_name or "?"
    space = started.namespace or "/"
    full = clean(f"{space}/{last}")
    kind = "lifecycle" if known.lifecycle else node.kind
    itself = RosNode(full, space, space, kind, "", node.location or Location(""), rules=rules)

    def data(name: str) -> object | None:
        own, _, inner = name.partition(":")
        return as_data(provided.get(own, inner, under=node.conditions))

    def below(prefix: str) -> tuple[str, ...] | Unknown:
        if provided.unread is not None:
            return Unknown("presence", reason_of(provided.unread), provided.unread.location)
        return tuple(name for name in provided.of(full) if name.startswith(prefix))

    def file(path: str) -> object | None:
        value = types.read_yaml(path)
        held, plain = data_of(value) if value is not None else (False, None)
        return plain if held else None

    ends = instantiate(
        specialised(known, shell_words(started.arguments), 2, file),
        name=full,
        namespace=space,
        arguments=started_words(started),
        parameter=data,
        remap=itself.remap,
        ros=2,
        below=below,
        file=file,
    )
    sim = provided.get(full, "use_sim_time")
    added = implicit(full, kind, _options(known), sim.value if isinstance(sim, Known) else None, node.location, ())
    there = {(end.kind, end.name) for end in ends}
    extra = tuple(replace(end, source="known-node") for end in added if (end.kind, end.name) not in there)
    unknowns = list(node.unknowns)
    if "?" in full and not any(unknown.field == "name" for unknown in unknowns):
        unknowns.append(Unknown("name", UNNAMED, node.location))
    return replace(
        node, name=full, kind=kind, process=node.container or full, endpoints=(*ends, *extra), unknowns=tuple(unknowns)
    )


def _options(known: KnownNode) -> Mapping[str, bool]:
    """What the program of a known node constructs its node with, where that is not the default."""
    if known.plugin:  # a controller has no services for its life cycle: controller_interface_base.cpp
        return {MANAGED: False}
    if known.package == "rclcpp_components":  # component_manager.hpp, since Galactic
        return {"start_parameter_services": False, "start_parameter_event_publisher": False}
    return {}


def started_words(started: LaunchedNode) -> tuple[str, ...]:
    """The words of a launched node's arguments."""
    return words_of(started.arguments).rest
