# SPDX-License-Identifier: Apache-2.0
"""The descriptions that spawners of ROS 2 bring to a simulator: of a file, of a text that a command prints, of a topic."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from haros_ci.graph.given_parameters import Parameters
from haros_ci.graph.names import clean, resolve
from haros_ci.graph.ros2_process import RosNode
from haros_ci.graph.words import CommandLineArguments
from haros_ci.model.launch import LaunchedNode, LaunchedSystem
from haros_ci.model.launch_facts import CommandUse
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.substitutions.names import quoted
from haros_ci.systems.ros2_system import started_by
from haros_ci.systems.simulation.simulators import of_file_or_model, option
from haros_ci.systems.simulation.trees import DescriptionTree, DescriptionTrees
from haros_ci.values.abstract import Known, Value, opaque_of

DESCRIPTION = "robot_description"
PUBLISHER = "robot_state_publisher"


@dataclass(frozen=True, slots=True)
class Descriptions:
    """Finds what spawners bring: *publishers* are the nodes that publish a description, by topic, *commands* the launch file's, by what is said of them."""

    trees: DescriptionTrees
    environment: Mapping[str, str]
    publishers: Mapping[str, list[LaunchedNode]]
    commands: Mapping[str, str]

    def of_spawner(self, spawner: LaunchedNode, words: CommandLineArguments, called: str) -> DescriptionTree:
        """The description that a spawner, which calls itself *called*, brings to the simulator."""
        tree = of_file_or_model(self.trees, words.rest)
        if tree is not None:
            return tree
        who = spawner.name or spawner.type
        topic = option(words.rest, "-topic")
        if topic is None or "?" in topic:
            return DescriptionTree(None, f"what {who} spawns is not known")
        itself = itself_of(spawner, called)
        return self._published(itself.remap(resolve(topic, spawner.namespace or "/", itself.name)), who)

    def of_text(self, text: str, spawner: LaunchedNode) -> DescriptionTree:
        """The description that a spawner is given as *text* on its command line."""
        if "?" not in text:
            return self.trees.of_text(text, spawner.location)
        tree = self._printed(unknown.reason for unknown in spawner.unknowns)
        return tree or DescriptionTree(None, f"the text that {spawner.name or spawner.type} spawns is not known")

    def of_parameter(self, value: Value | None, location: Location, who: str) -> DescriptionTree:
        """The description that the *value* of a parameter is, which the node *who* spawns."""
        if isinstance(value, Known) and isinstance(value.value, str):
            return self.trees.of_text(value.value, location)
        why = opaque_of(value) if value is not None else None
        tree = self._printed((why.reason,) if why is not None else ())
        return tree or DescriptionTree(
            None, f"the description that {who} spawns is not known: {why.reason if why else 'nothing sets it'}"
        )

    def _printed(self, reasons: Iterable[str]) -> DescriptionTree | None:
        """What a command prints that is why something is not known; None where that is no command, or may be several."""
        reported = set(reasons)
        found = {text for key, text in self.commands.items() if any(key in reason for reason in reported)}
        return self.trees.of_command(found.pop(), self.environment) if len(found) == 1 else None

    def _published(self, name: str, who: str) -> DescriptionTree:
        """The description on the topic called *name*, which the node *who* spawns."""
        publishers = self.publishers.get(name, ())
        if len(publishers) != 1:
            count = "several nodes publish" if publishers else "no node is known to publish"
            return DescriptionTree(None, f"{count} the description that {who} spawns on {name}")
        publisher = publishers[0]
        value = Parameters(publisher.parameters).get(itself_of(publisher, PUBLISHER).name, DESCRIPTION)
        return self.of_parameter(value, publisher.location, who)


def descriptions(launched: LaunchedSystem, trees: DescriptionTrees, environment: Mapping[str, str]) -> Descriptions:
    """Those of what was *launched*."""
    commands = {_said(fact.text): fact.text for fact in launched.facts if isinstance(fact, CommandUse)}
    publishers: dict[str, list[LaunchedNode]] = {}
    for other_node in launched.nodes:
        if other_node.type == PUBLISHER:
            node = itself_of(other_node, PUBLISHER)
            publishers.setdefault(node.remap(node.expand(DESCRIPTION)), []).append(other_node)
    return Descriptions(trees, environment, publishers, commands)


def itself_of(launched: LaunchedNode, default: str) -> RosNode:
    """The node that is *launched*, which calls itself *default*."""
    space = launched.namespace or "/"
    name = clean(f"{space}/{launched.name or default}")
    return RosNode(name, space, space, "node", "", launched.location, rules=started_by(launched).rules)


def _said(command: str) -> str:
    """Why a value is not known that a command prints (``launch.ros2.substitutions``)."""
    return f"printed by the command {quoted(command)}"
