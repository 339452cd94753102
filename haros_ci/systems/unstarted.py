# SPDX-License-Identifier: Apache-2.0
"""What no launch file starts: ROS 2 node types by themselves, and the configurations that they make."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from haros_ci.follow.libraries import yaml as library_yaml
from haros_ci.follow.ros import behavior_trees
from haros_ci.model.architecture import Configuration, Node
from haros_ci.model.workspace import Problem
from haros_ci.systems import (
    gazebo_plugins,
    loose_scripts,
    other_ros,
    ros1_controllers,
    ros2_controllers,
    ros2_hosts,
    ros2_system,
    system,
)
from haros_ci.systems.following import Types
from haros_ci.systems.system import Job


def ros2_alone(types: Types, started: set[tuple[str, str]], launched: Iterable[Job]) -> Iterator[Job]:
    """What is started by itself: of ROS 2 executables, components that no executable runs, plug-ins with a node.

    *launched* is what launch files start, *started* the packages and types of that.
    """
    tables = (types.components, types.ros2_programs)
    running = {id(table[pair][0]) for table in tables for pair in started if pair in table}
    for package, name in sorted(types.ros2_programs):
        entry = types.ros2_programs[package, name][0]
        if (package, name) not in started and id(entry) not in running:
            running.add(id(entry))
            yield ros2_system.alone(types, package, name)
    for package, name in sorted(types.components):
        if id(types.components[package, name][0]) not in running:
            yield ros2_system.alone(types, package, name, is_component=True)
    for package, name in sorted(types.hosted):
        yield ros2_system.plugin(types, package, name)
    yield from ros2_controllers.jobs(types, launched)
    yield from ros1_controllers.jobs(types, launched)
    yield from gazebo_plugins.jobs(types, launched)
    yield from ros2_hosts.hosts(types)
    yield from loose_scripts.jobs(types, launched)


def lost(types: Types) -> Iterator[Problem]:
    """What is said of programs that are of the other ROS than their package."""
    yield from other_ros.problems({*types.left_out.items(), *loose_scripts.of_other_ros(types)})


def configurations(
    done: Iterable[tuple[tuple[tuple[Node, ...], Any], Job]], problems: dict[Problem, None], taken: set[str]
) -> Iterator[Configuration]:
    """A configuration for each of what was followed by itself; what went wrong is added to *problems*. *taken* are the names that there are."""
    for (nodes, report), job in done:
        node = nodes[0]
        own = f"{node.package}/"
        name = node.type if job.is_loaded and node.type.startswith(own) else f"{own}{node.type}"
        if job.is_loaded:
            if node.kind == system.PROGRAM:
                continue
            problems.update(dict.fromkeys(report))
            name = f"{name} ({job.label})"
        elif job.label == loose_scripts.SCRIPT:
            if _makes(nodes):
                problems.update(dict.fromkeys(report))
                yield Configuration(name=f"{name} ({job.label})", nodes=nodes, is_loose=True)
            continue
        elif job.label:
            if not _has_any(node, job.label):
                continue
            name = f"{name} ({job.label})"
        elif node.kind == system.PROGRAM:
            continue
        else:
            problems.update(dict.fromkeys(report))
            name = f"{name} (nodelet)" if node.kind == "nodelet" and name in taken else name
        taken.add(name)
        yield Configuration(name=name, nodes=nodes)


def _makes(nodes: Iterable[Node]) -> bool:
    """Whether there is a node that makes something itself."""
    return any(not end.implicit for node in nodes if node.kind != system.PROGRAM for end in node.endpoints)


def _has_any(node: Node, label: str) -> bool:
    """Whether plug-ins or trees of any name are made in the node."""
    reason = library_yaml.ANY if label == ros2_system.PLUGINS else behavior_trees.ANY
    return any(unknown.reason == reason for unknown in node.unknowns)
