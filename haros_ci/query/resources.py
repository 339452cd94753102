# SPDX-License-Identifier: Apache-2.0
"""Nodes, topics, services, actions and parameters as HAROS's queries see them (``metamodel.py``: Resource)."""

from __future__ import annotations

from collections.abc import Iterator
from operator import attrgetter
from typing import TYPE_CHECKING, Any, ClassVar

from haros_ci.model.architecture import Condition, Node
from haros_ci.model.architecture import Parameter as ModelParameter
from haros_ci.model.location import Location as Place
from haros_ci.query.links import LINKS, QueryLink
from haros_ci.query.places import RosName, SourceCondition, kept, readers
from haros_ci.query.values import UNKNOWN, QueryEntity, QueryList, QueryRecord, Value

if TYPE_CHECKING:
    from haros_ci.query.system import QuerySystem

COMMON = (
    "id", "name", "namespace", "rosname", "conditions", "enabled", "disabled", "conditional", "unresolved", "location",
    "resource_type", "configuration", "type", "location2",
)  # fmt: skip


#: The lists of ends, in the order in which they are gone through: who gives stands before who takes.
ORDER = tuple(dict.fromkeys(name for _, name, _ in LINKS.values()))


def resolve_name(self: Resource, name: Value) -> Value:
    """A name as this resource would resolve it (HAROS ``Resource.resolve_name``)."""
    text = str(name or "")
    if not text:
        return self.namespace
    if text.startswith("~"):
        return f"{self.id}/{text[1:]}"
    return text if text.startswith("/") else f"{self.namespace.rstrip('/')}/{text}"


class Resource(QueryEntity):
    """What has a name in a configuration; equal to what has the same name there, if that is known."""

    __slots__ = ("cache", "full", "links", "system")
    TYPE: ClassVar[str] = ""
    METHODS: ClassVar[dict[str, Any]] = {
        "resolve_name": (1, 1, resolve_name),
        "traceability": (0, 0, lambda self: self.traceability()),
        "traceability2": (0, 0, lambda self: QueryList.of(self.system.world.location2(p) for p in self.places())),
    }

    def __init__(self, full: str, system: QuerySystem) -> None:
        self.full = full
        self.system = system
        self.links: dict[str, list[QueryLink]] = {}
        self.cache: dict[str, Value] = {}

    @property
    def id(self) -> str:
        return self.full

    @property
    def name(self) -> str:
        return self.full.rpartition("/")[2]

    @property
    def namespace(self) -> str:
        return self.full.rpartition("/")[0] or "/"

    @property
    def rosname(self) -> RosName:
        first = next(iter(self.all_links()), None)
        return RosName(self.full, first.end.written if first is not None else None)

    @property
    def unresolved(self) -> bool:
        return "?" in self.full

    @property
    def enabled(self) -> bool:
        return not self.conditions

    @property
    def disabled(self) -> bool:
        return False

    @property
    def conditional(self) -> bool:
        return bool(self.conditions)

    @property
    def configuration(self) -> Value:
        return self.system

    @property
    def location(self) -> Value:
        return self.system.location

    @property
    def location2(self) -> Value:
        return self.system.world.location2(self.place)

    @property
    def resource_type(self) -> str:
        return self.TYPE

    @kept
    def conditions(self) -> QueryList:
        return self.conditions_of_ends()

    def conditions_of_ends(self) -> QueryList:
        """None if an end in an unconditional node has none, else those of all ends, and of the nodes if all have some."""
        found: list[Condition] = []
        is_conditional = True
        for link in self.all_links():
            of_node = link.node.made.conditions
            if not of_node:
                is_conditional = False
                if not link.end.conditions:
                    return QueryList.of(())
            found += [*link.end.conditions, *(of_node if is_conditional else ())]
        return QueryList.of(SourceCondition(one, self.system.world) for one in dict.fromkeys(found))

    def all_links(self) -> Iterator[QueryLink]:
        for kind in ORDER:
            yield from self.links.get(kind, ())

    def of(self, kind: str) -> QueryList:
        if kind not in self.cache:
            self.cache[kind] = QueryList.of(self.links.get(kind, ()))
        return self.cache[kind]  # type: ignore[no-any-return]  # the cache holds what the method returns

    def places(self) -> tuple[Place, ...]:
        """Where its ends stand, the main one first."""
        return tuple(dict.fromkeys(link.place for link in self.all_links() if link.place is not None))

    @property
    def place(self) -> Place | None:
        return next(iter(self.places()), None)

    def traceability(self) -> QueryList:
        return QueryList.of(self.system.world.location(place) for place in self.places())

    @kept
    def types(self) -> QueryList:
        """The types of its ends that are known."""
        known = dict.fromkeys(link.end.type for link in self.all_links() if link.end.type is not None)
        return QueryList.of(known or (UNKNOWN,), True)

    @property
    def type(self) -> Value:
        return self.types[0]

    def __eq__(self, other: object) -> bool:
        if self is other:
            return True
        if not (self.__class__ is other.__class__ and isinstance(other, Resource)):
            return NotImplemented
        return self.full == other.full and "?" not in self.full and self.system == other.system

    def __hash__(self) -> int:
        return hash(self.full)

    def words(self) -> str:
        return f"{self.KIND}('{self.full}', {self.type})"


def listed(*names: str) -> dict[str, Any]:
    return {name: (lambda self, name=name: self.of(name)) for name in names}


class NodeInstance(Resource):
    __slots__ = ("made",)
    KIND = "NodeInstance"
    TYPE = "node"
    ATTRIBUTES: ClassVar[dict[str, Any]] = {
        **readers(*COMMON, "node", "launch", "argv", "remaps", "rt_outlinks", "package"),
        **listed(*ORDER),
        **{name: attrgetter(f"made.{name}") for name in ("kind", "container", "process", "ros", "source")},
        "variables": lambda self: QueryList.of(()),
    }

    def __init__(self, made: Node, system: QuerySystem) -> None:
        super().__init__(made.name, system)
        self.made = made

    @property
    def rosname(self) -> RosName:
        return RosName(self.full, self.name)

    @property
    def type(self) -> str:
        return f"{self.made.package}/{self.made.type}"

    @property
    def package(self) -> Value:
        return self.system.world.packages.get(self.made.package)

    @property
    def node(self) -> Value:
        return self.system.world.nodes.get((self.made.package, self.made.type))

    @property
    def launch(self) -> Value:
        place = self.made.location
        return self.system.world.files.get(place.path) if place is not None else None

    @property
    def argv(self) -> str:
        return self.made.arguments

    @kept
    def remaps(self) -> QueryRecord:
        return QueryRecord(dict(self.made.remaps))

    @kept
    def conditions(self) -> QueryList:
        return QueryList.of(SourceCondition(one, self.system.world) for one in self.made.conditions)

    @kept
    def rt_outlinks(self) -> QueryList:
        """The node, and those that its messages and calls reach, one after the other."""
        found = {id(self): self}
        waiting: list[NodeInstance] = [self]
        while waiting:
            one = waiting.pop(0)
            ends = [s for p in one.links.get("publishers", ()) for s in p.resource.links.get("subscribers", ())]
            ends += [s for c in one.links.get("clients", ()) for s in c.resource.links.get("servers", ())]
            for end in ends:
                if id(end.node) not in found:
                    found[id(end.node)] = end.node
                    waiting.append(end.node)
        return QueryList.of(found.values())

    def places(self) -> tuple[Place, ...]:
        if self.made.location is not None:
            return (self.made.location,)
        return super().places()[:1]

    def words(self) -> str:
        return f"NodeInstance {self.system.name}:{self.full}"


class Topic(Resource):
    __slots__ = ()
    KIND = "Topic"
    TYPE = "topic"
    ATTRIBUTES: ClassVar[dict[str, Any]] = {
        **readers(*COMMON, "types", "is_disconnected"),
        **listed("publishers", "subscribers"),
        "variables": lambda self: QueryList.of(()),
    }

    @property
    def is_disconnected(self) -> bool:
        """Whether it has ends of one kind only; False for one whose name is not known."""
        ends = bool(self.links.get("publishers")), bool(self.links.get("subscribers"))
        return ends[0] != ends[1] and "?" not in self.full


class Service(Resource):
    __slots__ = ()
    KIND = "Service"
    TYPE = "service"
    ATTRIBUTES: ClassVar[dict[str, Any]] = {
        **readers(*COMMON, "types", "is_disconnected", "server"),
        **listed("servers", "clients"),
        "variables": lambda self: QueryList.of(()),
    }

    @property
    def server(self) -> Value:
        """The last of its servers, as in HAROS; ``servers`` has all."""
        return next(reversed(self.links.get("servers", ())), None)

    @property
    def is_disconnected(self) -> bool:
        ends = bool(self.links.get("servers")), bool(self.links.get("clients"))
        return ends[0] != ends[1] and "?" not in self.full


class QueryAction(Resource):
    __slots__ = ()
    KIND = "Action"
    TYPE = "action"
    ATTRIBUTES: ClassVar[dict[str, Any]] = {
        **readers(*COMMON, "types", "is_disconnected"),
        "servers": lambda self: self.of("action_servers"),
        "clients": lambda self: self.of("action_clients"),
        "variables": lambda self: QueryList.of(()),
    }

    @property
    def is_disconnected(self) -> bool:
        ends = bool(self.links.get("action_servers")), bool(self.links.get("action_clients"))
        return ends[0] != ends[1] and "?" not in self.full


class QueryParameter(Resource):
    """A parameter that something sets, reads or declares; *made* is what sets it from outside."""

    __slots__ = ("made",)
    KIND = "Parameter"
    TYPE = "param"
    ATTRIBUTES: ClassVar[dict[str, Any]] = {
        **readers(*COMMON, "types", "value", "node_scope", "launch"),
        **listed("reads", "writes", "declarations"),
        "variables": lambda self: QueryList.of(()),
        "source": lambda self: self.made.source if self.made is not None else None,
    }

    def __init__(self, full: str, system: QuerySystem, made: ModelParameter | None = None) -> None:
        super().__init__(full, system)
        self.made = made

    @property
    def type(self) -> Value:
        return (self.made.type if self.made is not None else None) or self.types[0]

    @kept
    def value(self) -> Value:
        from haros_ci.query.system import plain

        return plain(self.made.value) if self.made is not None else None

    @kept
    def node_scope(self) -> bool:
        """Whether it is private to a node."""
        return any(self.full.startswith((f"{node.full}/", f"{node.full}:")) for node in self.system.nodes.items)

    @property
    def launch(self) -> Value:
        place = self.made.location if self.made is not None else None
        return self.system.world.files.get(place.path) if place is not None else None

    @kept
    def conditions(self) -> QueryList:
        if self.made is None:
            return Resource.conditions_of_ends(self)
        return QueryList.of(SourceCondition(one, self.system.world) for one in self.made.conditions)

    def places(self) -> tuple[Place, ...]:
        own = (self.made.origin or self.made.location) if self.made is not None else None
        return tuple(dict.fromkeys((*((own,) if own is not None else ()), *super().places())))
