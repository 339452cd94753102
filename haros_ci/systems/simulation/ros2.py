# SPDX-License-Identifier: Apache-2.0
"""Gazebo Classic in ROS 2: each plug-in makes a node in the simulator's process, and ``spawn_entity.py`` brings models to it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from haros_ci.graph.names import clean, resolve
from haros_ci.graph.ros2_process import Parameters, RosNode
from haros_ci.graph.words import Words, split
from haros_ci.model.architecture import Node
from haros_ci.model.launch import LaunchedNode, LaunchedSystem
from haros_ci.model.launch_facts import CommandUse
from haros_ci.substitutions.names import quoted
from haros_ci.systems.known.entry import KnownNode
from haros_ci.systems.ros2_system import started_by
from haros_ci.systems.simulation.endpoints import Spawned, by_simulated_time, on_server, ros2_nodes
from haros_ci.systems.simulation.simulators import (
    PACKAGE,
    SERVERS,
    Completes,
    Found,
    command_line,
    completed,
    gather,
    option,
    others,
)
from haros_ci.systems.simulation.table import plugins, silent
from haros_ci.systems.simulation.trees import Tree, Trees
from haros_ci.values.abstract import Known, opaque_of

SPAWNERS = frozenset(("spawn_entity.py",))
DESCRIPTION = "robot_description"
PUBLISHER = "robot_state_publisher"


def simulation(
    launched: LaunchedSystem,
    nodes: Sequence[LaunchedNode],
    trees: Trees,
    environment: Mapping[str, str],
    known: Callable[[str, str, int], KnownNode | None],
) -> Completes | None:
    """What completes the simulators of the *nodes* that were *launched*; None if there is none."""
    servers = [each for each in nodes if each.package == PACKAGE and each.type in SERVERS]
    if not servers:
        return None
    commands = {_printed(fact.text): fact.text for fact in launched.facts if isinstance(fact, CommandUse)}
    return _Simulation(tuple(nodes), servers, trees, environment, known, commands).complete


def _printed(command: str) -> str:
    """Why a value is not known that a command prints (``launch.ros2.substitutions``)."""
    return f"printed by the command {quoted(command)}"


@dataclass(frozen=True, slots=True)
class _Simulation:
    nodes: tuple[LaunchedNode, ...]
    servers: list[LaunchedNode]
    trees: Trees
    environment: Mapping[str, str]
    known: Callable[[str, str, int], KnownNode | None]
    commands: Mapping[str, str]

    def complete(self, nodes: Sequence[Node]) -> tuple[Node, ...]:
        by_place = {(each.type, each.location): each for each in self.servers}
        done: list[Node] = []
        for node in nodes:
            place = node.location
            started = by_place.get((node.type, place)) if place and node.package == PACKAGE and node.ros == 2 else None
            if started is None:
                done.append(node)
                continue
            into = self._found(started)
            for name in others(nodes, SPAWNERS):
                into.lose(f"{name} may bring models while it runs", node.location)
            done += self._with_plugins(node, started, into)
        return tuple(done)

    def _with_plugins(self, server: Node, started: LaunchedNode, into: Found) -> list[Node]:
        """The *server* with what its plug-ins make on it, and the nodes that the plug-ins make in its process."""
        rules = started_by(started).rules
        made: dict[str, Node] = {}
        for use, known, spawned in into.uses:
            beside = self.known(*known.beside, 2) if known.beside is not None else None
            for each in ros2_nodes(use, known, server, spawned, rules, beside):
                made.setdefault(each.name, each)
        line = command_line(split(started.arguments).rest)
        named = [plugins(2)[name] for name in line.plugins if name in plugins(2)]
        own = [end for each in named if each.at == "system" for end in on_server(each, server, rules)]
        return [by_simulated_time(completed(server, own, into.lost)), *made.values()]

    def _found(self, server: LaunchedNode) -> Found:
        into = Found()
        line = command_line(split(server.arguments).rest)
        if line.world is None:
            into.lose("which world it is given is not known", server.location)
        else:
            gather(self.trees, self.trees.of_world(line.world), Spawned(), 2, into, server.location)
        for library in line.plugins:
            known = plugins(2).get(library)
            if (known is None or known.at != "system") and library not in silent():
                into.lose(f"what the plug-in {library} makes is not known", server.location)
        for each in self.nodes:
            if each.package == PACKAGE and each.type in SPAWNERS:
                conditions = tuple(c for c in each.conditions if c not in server.conditions)
                words = split(each.arguments)
                model = option(words.rest, "-entity") or "?"
                space = option(words.rest, "-robot_namespace")
                spawned = Spawned(model="?" if "?" in model else model, namespace=space, conditions=conditions)
                gather(self.trees, self._description(each, words), spawned, 2, into, each.location)
        return into

    def _description(self, spawner: LaunchedNode, words: Words) -> Tree:
        """The description that a spawner brings to the simulator."""
        topic, file, model = (option(words.rest, name) for name in ("-topic", "-file", "-database"))
        who = spawner.name or spawner.type
        if file is not None:
            return self.trees.of_file(file)
        if model is not None:
            return self.trees.of_model(f"model://{model}")
        if topic is None or "?" in topic:
            return Tree(None, f"what {who} spawns is not known")
        space = spawner.namespace or "/"
        itself = _node(spawner, "spawn_entity")
        return self._published(itself.remap(resolve(topic, space, itself.name)), who)

    def _published(self, name: str, who: str) -> Tree:
        """The description on the topic called *name*, which the node *who* spawns."""
        publishers = [each for each in self.nodes if each.type == PUBLISHER and _publishes(each, name)]
        if len(publishers) != 1:
            count = "several nodes publish" if publishers else "no node is known to publish"
            return Tree(None, f"{count} the description that {who} spawns on {name}")
        return self._of_publisher(publishers[0], who)

    def _of_publisher(self, publisher: LaunchedNode, who: str) -> Tree:
        """The description that a ``robot_state_publisher`` is given as its parameter."""
        value = Parameters(publisher.parameters).get(_node(publisher, PUBLISHER).name, DESCRIPTION)
        if isinstance(value, Known) and isinstance(value.value, str):
            return self.trees.of_text(value.value, publisher.location)
        why = opaque_of(value) if value is not None else None
        command = next((text for said, text in self.commands.items() if why is not None and said in why.reason), None)
        if command is not None:
            return self.trees.of_command(command, self.environment)
        return Tree(None, f"the description that {who} spawns is not known: {why.reason if why else 'nothing sets it'}")


def _node(launched: LaunchedNode, default: str) -> RosNode:
    space = launched.namespace or "/"
    name = clean(f"{space}/{launched.name or default}")
    return RosNode(name, space, space, "node", "", launched.location, rules=started_by(launched).rules)


def _publishes(launched: LaunchedNode, name: str) -> bool:
    node = _node(launched, PUBLISHER)
    return node.remap(node.expand(DESCRIPTION)) == name
