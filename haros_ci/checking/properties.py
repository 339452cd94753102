# SPDX-License-Identifier: Apache-2.0
"""The properties of a project, held against its systems: which ends a topic of theirs has, which message, which fields."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property

from haros_ci.behaviour.clauses import Reader
from haros_ci.behaviour.comparing import Compared
from haros_ci.behaviour.deciding import Predicate, is_never
from haros_ci.behaviour.declared import Owner, Stated, in_project
from haros_ci.behaviour.meaning import bindings, mistakes
from haros_ci.behaviour.messages import Message, Messages, Scene
from haros_ci.behaviour.tree import Event, Place, Property
from haros_ci.checking.check import Finding
from haros_ci.checking.check import Place as Seen
from haros_ci.checking.interface_users import defined_in
from haros_ci.checking.kinds import ACTION, TOPIC
from haros_ci.checking.project import Project
from haros_ci.checking.system import End, System, SystemNode
from haros_ci.interfaces.definitions import Definitions
from haros_ci.results.rule import Level

#: Topics that client libraries and simulators are on, whoever is started.
OF_ALL = frozenset(("/rosout", "/rosout_agg", "/clock", "/tf", "/tf_static", "/parameter_events", "/diagnostics"))
#: How topics end that client libraries make beside others: dynamic_reconfigure, lifecycle nodes, nodelets.
_BESIDE = ("/parameter_descriptions", "/parameter_updates", "/transition_event", "/bond")
#: Packages whose nodes hold others, and are on no topics themselves.
CONTAINERS = frozenset(("nodelet", "rclcpp_components"))


class Properties:
    """What a project file states, and *stated* besides, with the systems that it is about."""

    def __init__(self, project: Project, stated: tuple[Stated, ...]) -> None:
        self.project = project
        self.stated = stated
        self._messages: dict[int, Messages] = {}
        self._scenes: dict[int, Mapping[int, Scene]] = {}

    @cached_property
    def sound(self) -> tuple[tuple[Stated, Property], ...]:
        """Those that can be read, and that the language allows."""
        return tuple(
            (item, item.parsed) for item in self.stated if item.parsed is not None and not mistakes(item.parsed)
        )

    @cached_property
    def matched(self) -> tuple[tuple[Stated, Property], ...]:
        """Those of the sound ones of which messages can match every predicate: from what never is anything follows."""
        return tuple(item for item in self.sound if not any(map(is_never, self._predicates(item[0]))))

    def _predicates(self, stated: Stated) -> Iterator[Predicate]:
        read = self.compared(stated).read
        return (read(event) for event, _ in self.scenes(stated))

    def systems(self, owner: Owner) -> tuple[System, ...]:
        """The systems that have what the property is about."""
        if owner.kind == "configuration":
            return tuple(system for system in self.project.systems if system.name == owner.name)
        if owner.kind == "node":
            return tuple(system for system in self.project.systems if any(n.type == owner.name for n in system.nodes))
        return tuple(self.project.systems)

    def nodes(self, owner: Owner) -> tuple[SystemNode, ...]:
        """The nodes whose messages the property is about."""
        found = (node for system in self.systems(owner) for node in system.nodes)
        return tuple(node for node in found if owner.kind != "node" or node.type == owner.name)

    def ends(self, owner: Owner, topic: str) -> tuple[End, ...]:
        """The publishers and subscribers that *topic* means; those of a node under any name that it has with or without remapping."""
        names = {topic if topic[0] in "/~" else f"/{topic}"}
        ends = (end for node in self.nodes(owner) for end in node.of(*TOPIC))
        if owner.kind == "node":
            return tuple(end for end in ends if names & node_names(end))
        return tuple(end for end in ends if end.name in names)

    def may_have(self, owner: Owner, topic: str) -> bool:
        """Whether the nodes can be on *topic*, as far as is known: also by what libraries make below topics (image_transport) and actions."""
        name = topic if topic.startswith("/") else f"/{topic}"
        if name in OF_ALL or name.endswith(_BESIDE) or self.ends(owner, topic):
            return True
        ends = (end for node in self.nodes(owner) for end in node.of(*TOPIC, *ACTION))
        return any(name.startswith(f"{item}/") for end in ends for item in node_names(end))

    def is_complete(self, owner: Owner) -> bool:
        """Whether all topics of the nodes are known, so that what is not there does not exist."""
        nodes = [node for node in self.nodes(owner) if node.package not in CONTAINERS]
        return bool(nodes) and all(
            node.complete and all(end.known for end in node.of(*TOPIC, *ACTION)) for node in nodes
        )

    def topics(self, owner: Owner) -> frozenset[str]:
        """The names of all topics that the nodes are on."""
        ends = (end for node in self.nodes(owner) for end in node.of(*TOPIC) if end.known and not end.implicit)
        return frozenset(end.name for end in ends)

    def message(self, owner: Owner, topic: str) -> Message | None:
        """The message of *topic*; None if it is not known, or if its ends do not agree on it."""
        ends = self.ends(owner, topic)
        types = {end.type for end in ends}
        ros = {end.node.ros for end in ends}
        if len(types) != 1 or len(ros) != 1:
            return None
        name = types.pop()
        return None if name is None else self.messages(ros.pop()).named(name)

    def messages(self, ros: int) -> Messages:
        """The definitions that code of this ROS version sees."""
        if ros not in self._messages:
            found = (item for item, of in defined_in(self.project) if of in (ros, None))
            self._messages[ros] = Messages(Definitions(found, ros))
        return self._messages[ros]

    def scenes(self, stated: Stated) -> Iterator[tuple[Event, Scene]]:
        """The events of a property, with what is known of their messages."""
        assert stated.parsed is not None
        kept = self._of(stated)
        for event, _ in bindings(stated.parsed):
            yield event, kept[id(event)]

    def compared(self, stated: Stated) -> Compared:
        """The property as it is compared with others."""
        assert stated.parsed is not None
        made = {
            id(event): Predicate(event.predicate, Reader(scene, event.alias)) for event, scene in self.scenes(stated)
        }
        return Compared(stated.parsed, lambda event: made[id(event)])

    def _of(self, stated: Stated) -> Mapping[int, Scene]:
        if id(stated) not in self._scenes:
            assert stated.parsed is not None
            made: dict[int, Scene] = {}
            for event, known in bindings(stated.parsed):
                own = self.message(stated.owner, event.topic)
                aliases = {name: self.message(stated.owner, item.topic) for name, item in known.items()}
                if event.alias is not None:
                    aliases[event.alias] = own
                made[id(event)] = Scene(self._any(stated.owner), own, aliases)
            self._scenes[id(stated)] = made
        return self._scenes[id(stated)]

    def _any(self, owner: Owner) -> Messages:
        return self.messages(next((node.ros for node in self.nodes(owner)), 1))


def node_names(end: End) -> frozenset[str]:
    """What a node's own properties can call its topic: with the names and the namespace that a launch file gives, or as rosrun starts it."""
    found = {end.name, end.original_name}
    namespace = end.node.name.rpartition("/")[0]
    executable = end.node.raw.type
    for name in tuple(found):
        if name.startswith(f"{end.node.name}/"):
            rest = name[len(end.node.name) :]
            found |= {f"~{rest}", f"~{rest[1:]}", f"/{executable}{rest}"}
        if namespace and name.startswith(f"{namespace}/"):
            found.add(name[len(namespace) :])
    return frozenset(found)


def stated_in(project: Project) -> tuple[Stated, ...]:
    """What the project file states."""
    path = project.project_file
    return in_project(project.text(path), path, lambda name: find_file(project, name))


def find_file(project: Project, name: str) -> tuple[str, str] | None:
    """Path and text of a file of properties by its name: ``package/path``, or a path from the root."""
    package, _, rest = name.partition("/")
    owner = project.package(package)
    for path in (owner.inside(rest) if owner is not None and rest else "", name):
        if path and path in project.workspace.names:
            return path, project.text(path)
    return None


def found(
    stated: Stated, at: Place, message: str, *names: str, related: tuple[Seen, ...] = (), level: Level | None = None
) -> Finding:
    """The finding that something is wrong with a part of a property."""
    identity = stated.identity
    return Finding(
        at=stated.at(at),
        message=message,
        about=(f"{stated.owner.kind} {stated.owner.name}".strip(), identity, *names),
        apart=(stated.owner.name, identity, *names),
        related=related,
        level=level,
    )
