# SPDX-License-Identifier: Apache-2.0
"""A configuration as HAROS's queries see it, with its nodes and everything that they share."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from operator import attrgetter
from typing import Any, ClassVar

from haros_ci.model.architecture import Configuration
from haros_ci.model.location import Location as Place
from haros_ci.query.fault import QueryError
from haros_ci.query.links import LINKS
from haros_ci.query.places import RuntimeLocation, kept, readers
from haros_ci.query.resources import NodeInstance, QueryAction, QueryParameter, Resource, Service, Topic
from haros_ci.query.source import DependencySet, SourceModel
from haros_ci.query.values import DEEPEST, QueryEntity, QueryList, QueryRecord, Value

KINDS: dict[str, type[Resource]] = {
    "topics": Topic,
    "services": Service,
    "actions": QueryAction,
    "parameters": QueryParameter,
}


class Collection(QueryEntity):
    """The nodes, topics, services, actions or parameters of a configuration (HAROS: ResourceCollection)."""

    __slots__ = ("all", "by_name", "cache")
    KIND = "ResourceCollection"
    ATTRIBUTES: ClassVar[dict[str, Any]] = readers("all", "enabled", "unresolved", "conditional", "counter")
    METHODS: ClassVar[dict[str, Any]] = {
        "get": (1, 2, lambda self, name, conditional=True: self.get(name, conditional)),
        "get_all": (1, 2, lambda self, name, conditional=True: self.get_all(name, conditional)),
        "get_collisions": (0, 0, lambda self: len(self.all) - len(self.counter)),
    }

    def __init__(self, resources: Iterable[Resource]) -> None:
        self.all = QueryList.of(resources)
        self.cache: dict[str, Value] = {}
        self.by_name: dict[str, list[Resource]] = {}
        for one in self.all:
            self.by_name.setdefault(one.full, []).append(one)

    @property
    def items(self) -> QueryList:
        return self.all

    @kept
    def enabled(self) -> QueryList:
        return QueryList.of(one for one in self.all if not one.conditions)

    @kept
    def conditional(self) -> QueryList:
        return QueryList.of(one for one in self.all if one.conditions)

    @kept
    def unresolved(self) -> QueryList:
        return QueryList.of(one for one in self.all if one.unresolved)

    @kept
    def counter(self) -> QueryRecord:
        """How many there are of each name."""
        return QueryRecord({name: len(found) for name, found in self.by_name.items()})

    def get_all(self, name: Value, conditional: Value = True) -> QueryList:
        return QueryList.of(one for one in self.by_name.get(name, ()) if conditional or not one.conditions)

    def get(self, name: Value, conditional: Value = True) -> Value:
        """The last one with that name, as in HAROS."""
        return (self.get_all(name, conditional) or (None,))[-1]


class QuerySystem(QueryEntity):
    """A configuration. What it has is made when something asks for it."""

    __slots__ = ("_made", "cache", "hpl", "made", "world")
    KIND = "Configuration"
    ATTRIBUTES: ClassVar[dict[str, Any]] = {
        **readers("id", "name", "nodes", *KINDS, "roslaunch", "launch_commands", "user_attributes", "location", "dependencies"),
        "arguments": lambda self: QueryRecord(dict(self.made.arguments)),
        "environment": lambda self: QueryRecord({}),
        "hpl_properties": lambda self: QueryList.of(self.hpl[0]),
        "hpl_assumptions": lambda self: QueryList.of(self.hpl[1]),
    }  # fmt: skip
    METHODS: ClassVar[dict[str, Any]] = {
        "get_collisions": (0, 0, lambda self: self.collision_count),
        "get_remaps": (0, 0, lambda self: self.remap_count),
        "get_unresolved": (0, 0, lambda self: sum(len(one.unresolved) for one in self.collections())),
        "get_conditional": (0, 0, lambda self: sum(len(one.conditional) for one in self.collections())),
    }

    def __init__(
        self, made: Configuration, world: SourceModel, hpl: tuple[tuple[str, ...], tuple[str, ...]] = ((), ())
    ) -> None:
        self.made = made
        self.world = world
        self.hpl = hpl
        self._made: dict[str, Collection] = {}
        self.cache: dict[str, Value] = {}

    @property
    def id(self) -> str:
        return f"configuration:{self.made.name}"

    name = property(attrgetter("made.name"))

    @property
    def location(self) -> RuntimeLocation:
        return RuntimeLocation(self)

    def collections(self) -> tuple[Collection, ...]:
        """Those that HAROS has."""
        return (self.nodes, self.topics, self.services, self.parameters)

    @kept
    def remap_count(self) -> int:
        return len({pair for node in self.nodes.all for pair in node.made.remaps})

    @kept
    def collision_count(self) -> int:
        """How many resources have a name that another one has as well."""
        names = [one.full for collection in self.collections() for one in collection.all]
        return len(names) - len(set(names))

    def part(self, name: str) -> Collection:
        if not self._made:
            self._made = _resources(self)
        return self._made[name]

    nodes = property(lambda self: self.part("nodes"))
    topics = property(lambda self: self.part("topics"))
    services = property(lambda self: self.part("services"))
    actions = property(lambda self: self.part("actions"))
    parameters = property(lambda self: self.part("parameters"))

    def launch_places(self) -> tuple[Place, ...]:
        """Its launch files, where they stand in the workspace."""
        found = []
        for item in self.made.launch:
            package, _, inside = item.partition("/")
            home = self.world.packages.get(package)
            root = home.made.path if home is not None else package
            found.append(Place(inside if root == "." else f"{root}/{inside}"))
        return tuple(found)

    @property
    def place(self) -> Place | None:
        places = self.launch_places() or tuple(p for node in self.nodes.all for p in node.places())
        return next(iter(places), None)

    @kept
    def roslaunch(self) -> QueryList:
        files = self.world.files
        return QueryList.of(files[place.path] for place in self.launch_places() if place.path in files)

    @property
    def launch_commands(self) -> QueryList:
        verb = "ros2 launch" if any(node.ros == 2 for node in self.made.nodes) else "roslaunch"
        commands = ((verb, item.partition("/")) for item in self.made.launch)
        return QueryList.of(QueryList.of((v, f"{p} {f.rpartition('/')[2]}"), True) for v, (p, _, f) in commands)

    @kept
    def dependencies(self) -> DependencySet:
        return DependencySet(QueryList.of(dict.fromkeys(node.package for node in self.made.nodes), True))

    @kept
    def user_attributes(self) -> Value:
        data = self.made.user_data
        return plain(data) if isinstance(data, Mapping) else QueryRecord({})

    def __eq__(self, other: object) -> bool:
        return self.made.name == other.made.name if isinstance(other, QuerySystem) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.made.name)

    def words(self) -> str:
        return f"Configuration {self.made.name}"


def _resources(system: QuerySystem) -> dict[str, Collection]:
    """Everything of a configuration; what the client library makes for every node, and what an action consists of, is left out.

    Ends with the same name meet; one whose name is not known meets no other.
    """
    nodes = [NodeInstance(node, system) for node in system.made.nodes]
    found: dict[str, dict[object, Resource]] = {kind: {} for kind in KINDS}
    for number, made in enumerate(system.made.parameters):
        key: object = made.name if made.name not in found["parameters"] else number
        found["parameters"][key] = QueryParameter(made.name, system, made)
    for node in nodes:
        for end in node.made.endpoints:
            if end.implicit or end.kind not in LINKS:
                continue
            link_class, name, kind = LINKS[end.kind]
            key = end.name if "?" not in end.name else (len(found[kind]), end.name)
            resource = found[kind].get(key)
            if resource is None:
                resource = found[kind][key] = KINDS[kind](end.name, system)
            link = link_class(end, node, resource)
            node.links.setdefault(name, []).append(link)
            resource.links.setdefault(name, []).append(link)
    return {"nodes": Collection(nodes), **{kind: Collection(found[kind].values()) for kind in KINDS}}


def plain(value: Any, depth: int = 0) -> Value:
    """A value of YAML or of the code as a value of a query; None for anything else."""
    if value is None or isinstance(value, (bool, int, float)):
        return value
    if isinstance(value, str):
        return value[:10_000]
    if depth >= DEEPEST - 2:
        return None
    try:
        if isinstance(value, Mapping):
            return QueryRecord({str(key): plain(item, depth + 1) for key, item in value.items()})
        if isinstance(value, (list, tuple)):
            return QueryList.of(plain(item, depth + 1) for item in value)
    except QueryError:
        return None
    return str(value)[:1000]
