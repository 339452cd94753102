# SPDX-License-Identifier: Apache-2.0
"""Gazebo in ROS 1: its plug-ins work in the simulator's own node, and ``spawn_model`` brings models to it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from haros_ci.graph.names import clean, resolve
from haros_ci.graph.parameters import ParameterServer
from haros_ci.graph.words import CommandLineArguments, split
from haros_ci.model.architecture import Node, Parameter
from haros_ci.model.launch import Launched, Started
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.systems.following import Types
from haros_ci.systems.gazebo_plugins import PLUGIN, GazeboPlugin, started
from haros_ci.systems.outside import as_data
from haros_ci.systems.ros1_controllers import LOADED
from haros_ci.systems.simulation.built import given, moved, under
from haros_ci.systems.simulation.endpoints import ros1_endpoints
from haros_ci.systems.simulation.ros1_loaded import OwnController, followed, with_controllers
from haros_ci.systems.simulation.ros1_managers import Asked, asked, controllers
from haros_ci.systems.simulation.simulators import (
    PACKAGE,
    SERVERS,
    SimulatorPlugins,
    completed,
    gather,
    of_file_or_model,
    of_server,
    option,
    spawned_by,
    unpredictable,
)
from haros_ci.systems.simulation.trees import DescriptionTree, DescriptionTrees
from haros_ci.systems.system import Job
from haros_ci.systems.system import launched as launched_job

SPAWNERS = frozenset(("spawn_model", "spawn_urdf", "spawn_gazebo_model"))
#: Plug-ins of the server's command line that make nothing but what the data on known nodes says of the simulator.
ACCOUNTED = frozenset(("gazebo_ros_api_plugin", "gazebo_ros_paths_plugin"))


def simulation(
    types: Types, launched: Launched, server: ParameterServer, trees: DescriptionTrees, environment: Mapping[str, str]
) -> Simulation:
    """What is simulated of what was *launched*. *server* has the parameters that are set."""
    servers = [node for node in launched.nodes if node.package == PACKAGE and node.type in SERVERS]
    requested = tuple(asked(launched.nodes, trees.text_of))
    ours = followed(types, requested, server)
    if not servers:
        return Simulation(types, server, [], requested, ours)
    parameters: dict[str, list[Parameter]] = {}
    for parameter in launched.parameters:
        parameters.setdefault(parameter.name, []).append(parameter)
    spawners = [
        (node, split(node.arguments)) for node in launched.nodes if node.package == PACKAGE and node.type in SPAWNERS
    ]
    models = _Models(len(servers) == 1, spawners, parameters, trees, environment)
    return Simulation(
        types,
        server,
        [(other_started, models.found(other_started, types.gazebo)) for other_started in servers],
        requested,
        ours,
    )


@dataclass(frozen=True, slots=True)
class Simulation:
    """The simulators of a configuration with their plug-ins."""

    types: Types
    parameters: ParameterServer
    servers: list[tuple[Started, SimulatorPlugins]]
    #: The controllers that are asked for.
    asked: tuple[Asked, ...] = ()
    #: Those of them that the workspace builds.
    ours: tuple[OwnController, ...] = ()

    def jobs(self) -> Iterator[Job]:
        """The plug-ins that the workspace builds, each to be followed in the simulator's node."""
        for server, into in self.servers:
            host = launched_job(self.types, server, self.parameters).node
            for use, plugin, spawned in into.built:
                yield started(self.types, plugin, given(use, spawned), under(host, use, spawned), self.parameters)
        for own in self.ours:
            yield own.job

    def complete(self, nodes: Sequence[Node]) -> tuple[Node, ...]:
        """*nodes*, where each simulator has what its plug-ins make."""
        if self.ours:
            of_managers = [node for node in nodes if node.kind == LOADED]
            rest = self._simulated([node for node in nodes if node.kind != LOADED])
            return with_controllers(rest, of_managers, self.ours)
        return self._simulated(nodes)

    def _simulated(self, nodes: Sequence[Node]) -> tuple[Node, ...]:
        if not self.servers:
            return tuple(nodes)
        by_place: dict[tuple[str, Location | None], SimulatorPlugins] = {
            (s.name, s.location): into for s, into in self.servers
        }
        reasons = tuple(unpredictable(nodes, SPAWNERS))
        plugins = [node for node in nodes if node.kind == PLUGIN]
        done = []
        for node in nodes:
            into = by_place.get((node.name, node.location)) if node.source == "launch" and node.ros == 1 else None
            if node.kind == PLUGIN:
                continue
            if into is None:
                done.append(node)
                continue
            for reason in reasons:
                into.lose(reason, node.location)
            done.append(self._completed(node, into, plugins))
        return tuple(done)

    def _completed(self, node: Node, into: SimulatorPlugins, plugins: Sequence[Node]) -> Node:
        """The simulator *node* with what is loaded *into* it, *plugins* that the workspace builds included."""
        made = [
            end
            for use, known, spawned in into.uses
            for end in ros1_endpoints(use, known, node, spawned, lambda name: as_data(self.parameters.get(name)))
        ]
        own = [plugin for plugin in plugins if (plugin.name, plugin.location) == (node.name, node.location)]
        made += [end for plugin in own for end in moved(plugin, node)]
        names = frozenset(own.name for own in self.ours)
        made += controllers(node, made, self.asked, self.parameters, self.types.known, into, names)
        more = tuple(why for plugin in own for why in plugin.unknowns if why.field == "endpoints")
        return completed(replace(node, unknowns=(*node.unknowns, *more)), made, into.lost)


@dataclass(frozen=True, slots=True)
class _Models:
    #: Whether there is one simulator only.
    is_alone: bool
    spawners: list[tuple[Started, CommandLineArguments]]
    #: What is set on the parameter server, by name.
    parameters: Mapping[str, list[Parameter]]
    trees: DescriptionTrees
    environment: Mapping[str, str]

    def found(self, server: Started, ours: Mapping[str, Sequence[GazeboPlugin]]) -> SimulatorPlugins:
        """The plug-ins of a *server*; *ours* are those that the workspace builds."""
        into = of_server(self.trees, server, 1, ACCOUNTED, ours)
        for spawner, words in self.spawners:
            self._spawn(spawner, words, server, into)
        return into

    def _spawn(self, spawner: Started, words: CommandLineArguments, server: Started, into: SimulatorPlugins) -> None:
        target = option(words.rest, "-gazebo_namespace")
        if target is not None and "?" not in target and clean(target) != server.name and not self.is_alone:
            return
        if target is None and not self.is_alone and server.name != "/gazebo":
            return
        space = option(words.rest, "-robot_namespace")
        if space is None:
            space = next((value for name, value in words.special if name == "ns"), spawner.namespace)
        spawned = spawned_by(spawner, server, option(words.rest, "-model"), space)
        gather(self.trees, self._description(spawner, words), spawned, 1, into, spawner.location)

    def _description(self, spawner: Started, words: CommandLineArguments) -> DescriptionTree:
        tree = of_file_or_model(self.trees, words.rest)
        if tree is not None:
            return tree
        parameter = option(words.rest, "-param")
        if parameter is None:
            return DescriptionTree(None, f"what {spawner.name} spawns is not known")
        name = resolve(parameter, spawner.namespace, spawner.name)
        parameters = self.parameters.get(name, ())
        if len(parameters) != 1 or parameters[0].conditions or "?" in parameter:
            why = "is set by no launch file" if not parameters else "is not known"
            return DescriptionTree(None, f"the parameter {name} that {spawner.name} spawns {why}")
        return self._text(parameters[0])

    def _text(self, parameter: Parameter) -> DescriptionTree:
        if parameter.command:
            return self.trees.of_command(parameter.command, self.environment)
        if isinstance(parameter.value, str) and not parameter.unknowns and parameter.location is not None:
            return self.trees.of_text(parameter.value, parameter.location)
        why = next((unknown.reason for unknown in parameter.unknowns), "it is no text")
        return DescriptionTree(None, f"the value of {parameter.name} is not known: {why}")
