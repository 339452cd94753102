# SPDX-License-Identifier: Apache-2.0
"""Gazebo in ROS 2: each plug-in that knows ROS makes a node in the simulator's process, and spawners bring models to it.

Gazebo Classic is a node itself, to which ``spawn_entity.py`` brings models; the new Gazebo is none, and ``create`` brings models to it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from haros_ci.graph.ros2_process import RemappingRule
from haros_ci.graph.words import CommandLineArguments, split
from haros_ci.model.architecture import Node
from haros_ci.model.launch import LaunchedNode, LaunchedSystem, ParameterRule
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.systems.known.entry import KnownNode
from haros_ci.systems.ros2_system import started_by
from haros_ci.systems.simulation import gz, webots
from haros_ci.systems.simulation.descriptions import Descriptions, descriptions
from haros_ci.systems.simulation.endpoints import Spawned, by_simulated_time, on_server, ros2_nodes
from haros_ci.systems.simulation.managers import MANAGER, manager
from haros_ci.systems.simulation.simulators import (
    PACKAGE,
    SERVERS,
    SimulatorPlugins,
    completed,
    gather,
    of_server,
    option,
    spawned_by,
    unpredictable,
)
from haros_ci.systems.simulation.table import KnownPlugin, plugins, silent
from haros_ci.systems.simulation.trees import DescriptionTree, DescriptionTrees
from haros_ci.systems.simulation.uses import PluginUse

SPAWNERS = frozenset(("spawn_entity.py",))


def simulation(
    launched: LaunchedSystem,
    trees: DescriptionTrees,
    environment: Mapping[str, str],
    known: Callable[[str, str, int], KnownNode | None],
) -> Simulation | None:
    """What is simulated of what was *launched*; None if no simulator is in it. *known* looks up nodes that the data describes."""
    nodes = launched.nodes
    servers = [node for node in nodes if node.package == PACKAGE and node.type in SERVERS]
    created = [node for node in nodes if gz.is_spawner(node)]
    drivers = webots.drivers(nodes)
    if not (servers or created or drivers):
        return None
    texts = descriptions(launched, trees, environment)
    spawners = [(node, split(node.arguments)) for node in nodes if node.package == PACKAGE and node.type in SPAWNERS]
    brought = [
        (spawner, words, texts.of_spawner(spawner, words, "spawn_entity")) for spawner, words in spawners if servers
    ]
    return Simulation(
        [(server, _found(trees, server, brought)) for server in servers],
        [(node, found) for node in created if (found := gz.found(texts, node)).uses],
        known,
        drivers,
        texts,
    )


@dataclass(frozen=True, slots=True)
class Simulation:
    """The simulators of a configuration with their plug-ins, and spawners of the new Gazebo with those of what they bring."""

    servers: list[tuple[LaunchedNode, SimulatorPlugins]]
    created: list[tuple[LaunchedNode, SimulatorPlugins]]
    known: Callable[[str, str, int], KnownNode | None]
    #: Drivers of robots of Webots, and the descriptions that they are given.
    drivers: list[LaunchedNode]
    texts: Descriptions

    def managers(self, rules_of: Callable[[str, Location], Iterable[ParameterRule]]) -> tuple[LaunchedNode, ...]:
        """The controller managers that plug-ins make, as if a launch file started them; *rules_of* reads a parameter file."""
        return tuple(
            manager(use, known, spawned, by, rules_of)
            for by, use, known, spawned in self._uses()
            if known.beside == MANAGER
        )

    def complete(self, nodes: Sequence[Node]) -> tuple[Node, ...]:
        """*nodes* with what plug-ins make."""
        by_place = {(server.type, server.location): (server, into) for server, into in self.servers}
        reasons = tuple(unpredictable(nodes, SPAWNERS)) if self.servers else ()
        drivers = {(driver.location, webots.called(driver)): driver for driver in self.drivers}
        done: list[Node] = []
        for node in nodes:
            place = node.location
            driver = drivers.get((place, node.name)) if place and node.package == webots.PACKAGE else None
            if driver is not None and node.type == webots.DRIVER:
                done.append(webots.completed(node, driver, self.texts))
                continue
            started = by_place.get((node.type, place)) if place and node.package == PACKAGE and node.ros == 2 else None
            if started is None:
                done.append(node)
                continue
            server, into = started
            for reason in reasons:
                into.lose(reason, node.location)
            done += self._with_plugins(node, server, into)
        for spawner, into in self.created:
            done += self._made(gz.host(spawner, into), (), into)
        return tuple(done)

    def _uses(self) -> Iterator[tuple[LaunchedNode, PluginUse, KnownPlugin, Spawned]]:
        for by, into in (*self.servers, *self.created):
            for use, known, spawned in into.uses:
                yield by, use, known, spawned

    def _with_plugins(self, server: Node, started: LaunchedNode, into: SimulatorPlugins) -> list[Node]:
        """The *server* with what its plug-ins make on it, and the nodes that the plug-ins make in its process."""
        named = [plugins(2)[name] for name in into.libraries if name in _of_system()]
        rules = started_by(started).rules
        own = [end for plugin in named for end in on_server(plugin, server, rules)]
        return [by_simulated_time(completed(server, own, into.lost)), *self._made(server, rules, into)]

    def _made(self, host: Node, rules: tuple[RemappingRule, ...], into: SimulatorPlugins) -> list[Node]:
        """The nodes that plug-ins make in the process of *host*, under its *rules*."""
        made: dict[str, Node] = {}
        for use, known, spawned in into.uses:
            beside = self.known(*known.beside, 2) if known.beside is not None else None
            for node in ros2_nodes(use, known, host, spawned, rules, beside):
                made.setdefault(node.name, by_simulated_time(node) if node.package == MANAGER[0] else node)
        return list(made.values())


def _found(
    trees: DescriptionTrees,
    server: LaunchedNode,
    brought: Iterable[tuple[LaunchedNode, CommandLineArguments, DescriptionTree]],
) -> SimulatorPlugins:
    """The plug-ins of a *server*, with what is *brought* to it: each spawner with its command line and its description."""
    into = of_server(trees, server, 2, _of_system() | silent())
    for node, words, tree in brought:
        model, space = option(words.rest, "-entity"), option(words.rest, "-robot_namespace")
        spawned = spawned_by(node, server, model, space)
        gather(trees, tree, spawned, 2, into, node.location)
    return into


def _of_system() -> frozenset[str]:
    """The plug-ins of the table that stand on the server's command line."""
    return frozenset(name for name, plugin in plugins(2).items() if plugin.at == "system")
