# SPDX-License-Identifier: Apache-2.0
"""The calls that make endpoints as HAROS's queries see them (``metamodel.py``: RosPrimitiveCall)."""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING, Any, ClassVar

from haros_ci.model.architecture import Endpoint, Node
from haros_ci.model.location import Location as Place
from haros_ci.query.places import RosName, SourceCondition, readers
from haros_ci.query.values import NOTHING, UNKNOWN, QueryEntity, QueryList, Value

if TYPE_CHECKING:
    from haros_ci.query.source import SourceModel

LOOPS = ("for", "while", "do")
#: Lists of calls of a node type, by the kind of endpoint; and what HAROS calls them.
CALLS = {
    "advertise": ("publishers", "AdvertiseCall"),
    "subscribe": ("subscribers", "SubscribeCall"),
    "service": ("servers", "AdvertiseServiceCall"),
    "client": ("clients", "ServiceClientCall"),
    "read_param": ("getters", "GetParamCall"),
    "write_param": ("setters", "SetParamCall"),
}


class RosCall(QueryEntity):
    """A call that makes an endpoint (HAROS: RosPrimitiveCall): its name as written, in the namespace of its handle."""

    __slots__ = ("end", "kind", "node", "world")
    KIND = "RosPrimitiveCall"
    ATTRIBUTES: ClassVar[dict[str, Any]] = {
        **readers("name", "namespace", "type", "full_name", "conditions", "control_depth", "repeats", "location", "location2"),
        **readers("queue_size", "latched", "value"),
        "rostype": attrgetter("type"),
        "default_value": attrgetter("value"),
        "source": attrgetter("end.source"),
    }  # fmt: skip
    METHODS: ClassVar[dict[str, Any]] = {"variables": (0, 0, lambda self: NOTHING)}

    def __init__(self, kind: str, node: Node, end: Endpoint, world: SourceModel) -> None:
        self.kind = kind
        self.node = node
        self.end = end
        self.world = world

    @property
    def name(self) -> str:
        written = RosName(self.end.original_name, self.end.written).given
        return str(written) if written is not UNKNOWN else self.end.original_name.rpartition("/")[2]

    @property
    def namespace(self) -> str:
        """What the handle puts in front: "" for the node's namespace, ``~`` for its own name, else a path."""
        full, value = self.end.original_name, self.end.written
        if value is None or value[:1] in ("/", "~") or not full.endswith(f"/{value}"):
            return ""
        prefix, own = full[: -len(value) - 1], self.node.name
        if prefix == own or prefix.startswith(f"{own}/"):
            return f"~{prefix[len(own) + 1 :]}"
        space = own.rpartition("/")[0]
        return prefix[len(space) + 1 :] if prefix == space or prefix.startswith(f"{space}/") else prefix

    @property
    def full_name(self) -> str:
        name, space = self.name, self.namespace
        return name if not space or name.startswith("/") else f"{space.removesuffix('/')}/{name}"

    @property
    def type(self) -> Value:
        return self.end.type or UNKNOWN

    @property
    def conditions(self) -> QueryList:
        return QueryList.of(SourceCondition(one, self.world) for one in self.end.conditions)

    @property
    def control_depth(self) -> int:
        return len(self.end.conditions)

    @property
    def repeats(self) -> bool:
        return any(one.statement in LOOPS for one in self.end.conditions)

    queue_size = property(attrgetter("end.queue_size"))
    latched = property(lambda self: bool(self.end.latched))

    @property
    def value(self) -> Value:
        from haros_ci.query.system import plain

        return plain(self.end.value)

    @property
    def location(self) -> Value:
        return self.world.location(self.end.location)

    @property
    def location2(self) -> Value:
        return self.world.location2(self.end.location)

    @property
    def place(self) -> Place | None:
        return self.end.location

    def words(self) -> str:
        return f"{self.kind}({self.name}, {self.namespace}, {self.type})"
