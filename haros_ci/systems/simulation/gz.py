# SPDX-License-Identifier: Apache-2.0
"""The new Gazebo in ROS 2: no node itself, but some of its plug-ins are; ``create`` brings models to it.

What counts is ros_gz_sim/src/create.cpp of gazebosim/ros_gz: one of ``-file``, ``-param``, ``-string`` and ``-topic``, or the parameters of these names.
"""

from __future__ import annotations

from dataclasses import replace

from haros_ci.graph.given_parameters import Parameters
from haros_ci.graph.names import clean
from haros_ci.graph.words import CommandLineArguments, split
from haros_ci.model.architecture import Node
from haros_ci.model.launch import LaunchedNode
from haros_ci.systems.simulation.descriptions import Descriptions, itself_of
from haros_ci.systems.simulation.endpoints import Spawned
from haros_ci.systems.simulation.simulators import SimulatorPlugins, gather, option
from haros_ci.systems.simulation.trees import DescriptionTree
from haros_ci.values.abstract import Known

PACKAGES = ("ros_gz_sim", "ros_ign_gazebo")
SPAWNER = "create"
#: What the spawner calls itself.
CALLED = "ros_gz_sim"


def is_spawner(node: LaunchedNode) -> bool:
    """Whether a launched node brings a model to the new Gazebo."""
    return node.package in PACKAGES and node.type == SPAWNER


def found(texts: Descriptions, spawner: LaunchedNode) -> SimulatorPlugins:
    """The plug-ins of what a *spawner* brings that know ROS."""
    into = SimulatorPlugins()
    words = split(spawner.arguments)
    named = Parameters(spawner.parameters).get(itself_of(spawner, CALLED).name, "name")
    model = option(words.rest, "-name") or (str(named.value) if isinstance(named, Known) else None)
    spawned = Spawned(model="?" if not model or "?" in model else model)
    gather(texts.trees, _description(texts, spawner, words), spawned, 2, into, spawner.location)
    return into


def _description(texts: Descriptions, spawner: LaunchedNode, words: CommandLineArguments) -> DescriptionTree:
    provided = Parameters(spawner.parameters)
    itself = itself_of(spawner, CALLED)
    text, name = option(words.rest, "-string"), option(words.rest, "-param")
    if text is not None:
        return texts.of_text(text, spawner)
    if name is not None or provided.get(itself.name, "string") not in (None, Known("")):
        return texts.of_parameter(
            provided.get(itself.name, name or "string"), spawner.location, spawner.name or SPAWNER
        )
    more = list(words.rest)
    for item in ("file", "topic"):
        value = provided.get(itself.name, item)
        if isinstance(value, Known) and isinstance(value.value, str) and value.value:
            more += [f"-{item}", value.value]
    return texts.of_spawner(spawner, replace(words, rest=tuple(more)), CALLED)


def host(spawner: LaunchedNode, into: SimulatorPlugins) -> Node:
    """A node of the simulator's process for the plug-ins of what a *spawner* brings; the process is called as the first of them."""
    name = clean(f"/{into.uses[0][1].called or into.uses[0][0].name or '?'}")
    return Node(
        name=name,
        kind="node",
        package=spawner.package,
        type=spawner.type,
        location=spawner.location,
        conditions=spawner.conditions,
        presence=spawner.presence,
        process=name,
        source="known-node",
        ros=2,
    )
