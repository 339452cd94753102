# SPDX-License-Identifier: Apache-2.0
"""What a check sees: one configuration as a system of nodes, topics, services, actions and parameters that refer to each other."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import TypeVar

from haros_ci.checking.coexistence import can_meet, in_doubt
from haros_ci.checking.given import Given, Names, give, taken_in
from haros_ci.checking.kinds import ACTION, SERVICE, TOPIC, WORDS
from haros_ci.checking.whole import PackageTables, Whole
from haros_ci.model.architecture import (
    Architecture,
    Configuration,
    Endpoint,
    Node,
    Parameter,
    Qos,
)
from haros_ci.model.launch_facts import ConstructUse, LaunchFact
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.model.presence import Presence
from haros_ci.model.workspace import Workspace

Fact = TypeVar("Fact")


class End:
    """One end of a topic, service, action or parameter, with the node that has it (docs/model.md says what each attribute is)."""

    __slots__ = ("conditions", "node", "raw")

    def __init__(self, node: SystemNode, raw: Endpoint) -> None:
        self.node = node
        self.raw = raw
        #: The statements around the call that may not hold, outermost first.
        self.conditions = raw.conditions if raw.is_ruled_out else in_doubt(raw.conditions)

    @property
    def kind(self) -> str:
        return self.raw.kind

    @property
    def word(self) -> str:
        """The kind in words: ``publisher``."""
        return WORDS[self.raw.kind]

    @property
    def name(self) -> str:
        """Resolved and remapped; ``?`` stands for what is not known."""
        return self.raw.name

    @property
    def original_name(self) -> str:
        """Resolved, before remapping."""
        return self.raw.original_name

    @property
    def type(self) -> str | None:
        """The message, service, action or parameter type; None if it is not known."""
        return self.raw.type if self.raw.type is None or "?" not in self.raw.type else None

    @property
    def qos(self) -> Qos | None:
        return self.raw.qos

    @property
    def location(self) -> Location:
        """Where its call stands; where its node is started, if the source is not at hand."""
        return self.raw.location or self.node.location

    @property
    def in_source(self) -> bool:
        """Whether its call stands in the workspace."""
        return self.raw.location is not None and self.raw.source in ("source", "exact-tier")

    @property
    def implicit(self) -> bool:
        """Whether the client library makes it for every node."""
        return self.raw.implicit

    @property
    def known(self) -> bool:
        """Whether its whole name is known."""
        return "?" not in self.raw.name

    @property
    def presence(self) -> Presence:
        return self.node.presence

    @property
    def role(self) -> str:
        """What it is, whatever it is called: ``publishers demo/talker``."""
        return f"{self.raw.kind} {self.node.type}"

    def __str__(self) -> str:
        return f"{self.word} of {self.node.name}"


class SystemNode:
    """A node of the system with its ends. *is_default* is False for one that only other launch arguments bring."""

    def __init__(self, raw: Node, is_default: bool = True) -> None:
        self.raw = raw
        self.is_default = is_default
        self.ends = tuple(End(self, endpoint) for endpoint in raw.endpoints)
        self._of: dict[tuple[str, ...], tuple[End, ...]] = {}
        #: The parameters that it is given from outside (ROS 2).
        self.given: tuple[Given, ...] = ()

    @property
    def name(self) -> str:
        return self.raw.name

    @property
    def known(self) -> bool:
        """Whether its whole name is known."""
        return "?" not in self.raw.name

    @property
    def package(self) -> str:
        return self.raw.package

    @property
    def type(self) -> str:
        """``package/executable``, or package and class of a nodelet or component."""
        return f"{self.raw.package}/{self.raw.type}"

    @property
    def kind(self) -> str:
        """node, nodelet, component, lifecycle or library."""
        return self.raw.kind

    @property
    def ros(self) -> int:
        return self.raw.ros

    @property
    def location(self) -> Location:
        """Where it is started, else where its program begins."""
        return self.raw.location or Location(".")

    @property
    def is_launched(self) -> bool:
        """Whether a launch file starts it (so *location* is in that file)."""
        return self.raw.source == "launch"

    @property
    def presence(self) -> Presence:
        return getattr(self.raw, "presence", ())

    @property
    def role(self) -> str:
        return self.type

    @cached_property
    def complete(self) -> bool:
        """Whether all its ends are known: it was followed from its source, and nothing remained unknown."""
        return (
            bool(self.ends)
            and not any(unknown.field == "endpoints" for unknown in self.raw.unknowns)
            and all(end.raw.source != "known-node" for end in self.ends)
        )

    @cached_property
    def names(self) -> Names:
        """The names of its parameters (ROS 2)."""
        return Names(self)

    def of(self, *kinds: str) -> tuple[End, ...]:
        """Its ends of these kinds."""
        found = self._of.get(kinds)
        if found is None:
            found = self._of[kinds] = tuple(end for end in self.ends if end.raw.kind in kinds)
        return found

    def __str__(self) -> str:
        return self.raw.name


class Channel:
    """A topic, service or action of one name: *givers* (publishers, servers) and *takers* (subscribers, clients)."""

    __slots__ = ("givers", "kind", "name", "takers")

    def __init__(self, kind: str, name: str, givers: tuple[End, ...], takers: tuple[End, ...]) -> None:
        self.kind = kind
        self.name = name
        self.givers = givers
        self.takers = takers

    @property
    def publishers(self) -> tuple[End, ...]:
        return self.givers

    @property
    def subscribers(self) -> tuple[End, ...]:
        return self.takers

    @property
    def servers(self) -> tuple[End, ...]:
        return self.givers

    @property
    def clients(self) -> tuple[End, ...]:
        return self.takers

    @property
    def ends(self) -> tuple[End, ...]:
        return (*self.givers, *self.takers)

    @property
    def types(self) -> tuple[str, ...]:
        """The known types of its ends, sorted."""
        return tuple(sorted({end.type for end in self.ends if end.type is not None}))

    def pairs(self) -> Iterator[tuple[End, End]]:
        """Each giver with each taker that can exist at the same time."""
        yield from can_meet(self.givers, self.takers)

    def __str__(self) -> str:
        return self.name


class System:
    """One configuration. Names that are not wholly known (``?``) are in no channel; ask ``nodes`` for all ends."""

    def __init__(
        self,
        configuration: Configuration,
        architecture: Architecture,
        workspace: Workspace | None = None,
        tables: PackageTables | None = None,
    ) -> None:
        """With *tables*, those of the architecture's packages, all its systems have the same ones."""
        self.raw = configuration
        self.workspace = workspace
        self._tables = tables or PackageTables(architecture.packages)
        self.packages = self._tables.by_name
        alternatives = getattr(configuration, "alternatives", ())
        self.nodes: tuple[SystemNode, ...] = (
            *(SystemNode(node) for node in configuration.nodes),
            *(SystemNode(node, is_default=False) for node in alternatives),
        )
        self.given: tuple[Given, ...] = give(self)
        #: All systems of the architecture.
        self.whole = Whole((self,))

    @property
    def name(self) -> str:
        return self.raw.name

    @property
    def packages_by_path(self) -> Mapping[str, Package]:
        """The packages by their root-relative directories, ``.`` for the root."""
        return self._tables.by_path

    @property
    def launch(self) -> tuple[str, ...]:
        """The launch files, ``package/path``; () for a node type alone."""
        return self.raw.launch

    @property
    def is_launched(self) -> bool:
        return bool(self.raw.launch)

    @property
    def closed(self) -> bool:
        """Whether nothing outside this configuration takes part (``closed: true`` in the project file)."""
        return self.raw.closed

    @property
    def ros(self) -> int:
        """That of its nodes; of launch files that start none what the evaluation of the launched file tells."""
        return next((node.ros for node in self.nodes), next((fact.ros for fact in self.facts(LaunchFact)), 1))

    @property
    def arguments(self) -> Mapping[str, str]:
        """The launch arguments with the values that they have by default."""
        return dict(self.raw.arguments)

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """What is set from outside, in this configuration or under other launch arguments."""
        return (*self.raw.parameters, *getattr(self.raw, "alternative_parameters", ()))

    @cached_property
    def taken(self) -> frozenset[tuple[Location, str]]:
        """The places and keys of parameters that some node has, or may have, which is given them there."""
        return taken_in(self)

    @cached_property
    def ends(self) -> tuple[End, ...]:
        return tuple(end for node in self.nodes for end in node.ends)

    @cached_property
    def topics(self) -> tuple[Channel, ...]:
        return self._channels("topic", TOPIC)

    @cached_property
    def services(self) -> tuple[Channel, ...]:
        return self._channels("service", SERVICE)

    @cached_property
    def actions(self) -> tuple[Channel, ...]:
        return self._channels("action", ACTION)

    @cached_property
    def complete(self) -> bool:
        """Whether all ends of every node are known, with their names: an end that is not in the model does not exist."""
        kinds = (*TOPIC, *SERVICE, *ACTION)
        return all(node.complete and node.known and all(e.known for e in node.of(*kinds)) for node in self.nodes)

    def facts(self, kind: type[Fact]) -> tuple[Fact, ...]:
        """What the launch files of this configuration say, of one kind (haros_ci/model/launch_facts.py)."""
        return tuple(fact for fact in getattr(self.raw, "launch_facts", ()) if isinstance(fact, kind))

    @cached_property
    def refused(self) -> frozenset[str]:
        """The launch files of this configuration that launch refuses: they have constructs of the other ROS version."""
        return frozenset(use.location.path for use in self.facts(ConstructUse) if use.kind == "foreign" and use.stops)

    @cached_property
    def is_refused(self) -> bool:
        """Whether launch refuses the launched file itself: a leftover of the other ROS version, of which nothing starts."""
        return any(use.kind == "foreign" and use.stops and not use.included for use in self.facts(ConstructUse))

    def _channels(self, kind: str, kinds: tuple[str, str]) -> tuple[Channel, ...]:
        found: dict[str, tuple[list[End], list[End]]] = {}
        for end in self.ends:
            if end.raw.kind in kinds and end.known:
                found.setdefault(end.name, ([], []))[kinds.index(end.kind)].append(end)
        return tuple(Channel(kind, name, tuple(g), tuple(t)) for name, (g, t) in sorted(found.items()))


def systems(architecture: Architecture, workspace: Workspace | None = None) -> Iterator[System]:
    """Every configuration as a system, in the architecture's order, but for programs that no build installs."""
    ones = (configuration for configuration in architecture.configurations if not configuration.is_loose)
    tables = PackageTables(architecture.packages)
    found = tuple(System(configuration, architecture, workspace, tables) for configuration in ones)
    whole = Whole(found)
    for system in found:
        system.whole = whole
    yield from found
