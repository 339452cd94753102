# SPDX-License-Identifier: Apache-2.0
"""Gazebo Classic in ROS 2: each plug-in makes a node in the simulator's process, and ``spawn_entity.py`` brings models to it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
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
from haros_ci.systems.simulation.endpoints import by_simulated_time, on_server, ros2_nodes
from haros_ci.systems.simulation.simulators import (
    PACKAGE,
    SERVERS,
    Completes,
    Found,
    completed,
    gather,
    of_file_or_model,
    of_server,
    option,
    spawned_by,
    unpredictable,
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
    publishers: dict[str, list[LaunchedNode]] = {}
    for each in nodes:
        if each.type == PUBLISHER:
            publishers.setdefault(_topic_of(each), []).append(each)
    spawners = [(each, split(each.arguments)) for each in nodes if each.package == PACKAGE and each.type in SPAWNERS]
    return _Simulation(servers, spawners, publishers, trees, environment, known, commands).complete


def _printed(command: str) -> str:
    """Why a value is not known that a command prints (``launch.ros2.substitutions``)."""
    return f"printed by the command {quoted(command)}"


@dataclass(frozen=True, slots=True)
class _Simulation:
    servers: list[LaunchedNode]
    spawners: list[tuple[LaunchedNode, Words]]
    #: The nodes that publish a description, by topic.
    publishers: Mapping[str, list[LaunchedNode]]
    trees: Trees
    environment: Mapping[str, str]
    known: Callable[[str, str, int], KnownNode | None]
    commands: Mapping[str, str]

    def complete(self, nodes: Sequence[Node]) -> tuple[Node, ...]:
        by_place = {(each.type, each.location): each for each in self.servers}
        reasons = tuple(unpredictable(nodes, SPAWNERS))
        brought = [(each, words, self._description(each, words)) for each, words in self.spawners]
        done: list[Node] = []
        for node in nodes:
            place = node.location
            started = by_place.get((node.type, place)) if place and node.package == PACKAGE and node.ros == 2 else None
            if started is None:
                done.append(node)
                continue
            into = self._found(started, brought)
            for reason in reasons:
                into.lose(reason, node.location)
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
        named = [plugins(2)[name] for name in into.libraries if name in _of_system()]
        own = [end for each in named for end in on_server(each, server, rules)]
        return [by_simulated_time(completed(server, own, into.lost)), *made.values()]

    def _found(self, server: LaunchedNode, brought: Iterable[tuple[LaunchedNode, Words, Tree]]) -> Found:
        """The plug-ins of a *server*, with what is *brought* to it: each spawner with its command line and its description."""
        into = of_server(self.trees, server, 2, _of_system() | silent())
        for each, words, tree in brought:
            model, space = option(words.rest, "-entity"), option(words.rest, "-robot_namespace")
            spawned = spawned_by(each, server, model, space)
            gather(self.trees, tree, spawned, 2, into, each.location)
        return into

    def _description(self, spawner: LaunchedNode, words: Words) -> Tree:
        """The description that a spawner brings to the simulator."""
        tree = of_file_or_model(self.trees, words.rest)
        if tree is not None:
            return tree
        who = spawner.name or spawner.type
        topic = option(words.rest, "-topic")
        if topic is None or "?" in topic:
            return Tree(None, f"what {who} spawns is not known")
        space = spawner.namespace or "/"
        itself = _node(spawner, "spawn_entity")
        return self._published(itself.remap(resolve(topic, space, itself.name)), who)

    def _published(self, name: str, who: str) -> Tree:
        """The description on the topic called *name*, which the node *who* spawns."""
        publishers = self.publishers.get(name, ())
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


def _topic_of(launched: LaunchedNode) -> str:
    """The topic that a ``robot_state_publisher`` publishes its description on."""
    node = _node(launched, PUBLISHER)
    return node.remap(node.expand(DESCRIPTION))


def _of_system() -> frozenset[str]:
    """The plug-ins of the table that stand on the server's command line."""
    return frozenset(name for name, each in plugins(2).items() if each.at == "system")
