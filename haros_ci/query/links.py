# SPDX-License-Identifier: Apache-2.0
"""The ends of topics, services, actions and parameters as HAROS's queries see them: links from a node to a resource."""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING, Any, ClassVar

from haros_ci.model.architecture import Endpoint
from haros_ci.model.location import Location as Place
from haros_ci.query.places import QueryQos, RosName, SourceCondition, readers
from haros_ci.query.values import UNKNOWN, QueryEntity, QueryList, Value

if TYPE_CHECKING:
    from haros_ci.query.resources import NodeInstance, Resource

COMMON = (
    "node", "rosname", "type", "conditions", "source_location", "location2", "location", "configuration", "name",
)  # fmt: skip


class QueryLink(QueryEntity):
    """An end of *resource* in *node*. Every link is equal to itself only."""

    __slots__ = ("end", "node", "resource")
    FORM: ClassVar[str] = ""

    def __init__(self, end: Endpoint, node: NodeInstance, resource: Resource) -> None:
        self.end = end
        self.node = node
        self.resource = resource

    @property
    def rosname(self) -> RosName:
        """The name before remapping."""
        return RosName(self.end.original_name, self.end.written)

    @property
    def name(self) -> str:
        """The name after remapping, in full."""
        return self.end.name

    @property
    def type(self) -> Value:
        return self.end.type or UNKNOWN

    @property
    def conditions(self) -> QueryList:
        return QueryList.of(SourceCondition(one, self.node.system.world) for one in self.end.conditions)

    @property
    def source_location(self) -> Value:
        return self.node.system.world.location(self.end.location)

    @property
    def location2(self) -> Value:
        return self.node.system.world.location2(self.end.location)

    @property
    def location(self) -> Value:
        return self.node.location

    @property
    def configuration(self) -> Value:
        return self.node.system

    @property
    def value(self) -> Value:
        from haros_ci.query.system import plain

        return plain(self.end.value)

    @property
    def effective(self) -> Value:
        from haros_ci.query.system import plain

        return plain(self.end.effective)

    @property
    def queue_size(self) -> Value:
        """The queue's size; in ROS 2 the depth, where the history is not kept whole."""
        qos = self.end.qos
        if self.end.queue_size is not None or qos is None or qos.history == "keep_all":
            return self.end.queue_size
        return qos.depth if isinstance(qos.depth, int) else None

    @property
    def latched(self) -> Value:
        """Whether late subscribers get the last message; in ROS 2, by durability."""
        qos = self.end.qos
        if self.end.latched is not None or qos is None or qos.durability == "?":
            return self.end.latched
        return qos.durability == "transient_local"

    @property
    def qos(self) -> Value:
        return QueryQos(self.end.qos) if self.end.qos is not None else None

    @property
    def range(self) -> Value:
        return QueryList.of(self.end.range, True) if self.end.range is not None else None

    @property
    def place(self) -> Place | None:
        """Where a finding about it stands."""
        return self.end.location or self.node.made.location

    def words(self) -> str:
        return self.FORM.format(self.node.id, self.resource.id, self.type)


def attributes(*more: str, **named: str) -> dict[str, Any]:
    return {
        **readers(*COMMON, *more),
        **{name: attrgetter(path) for name, path in named.items()},
        "source": attrgetter("end.source"),
    }


class PublishLink(QueryLink):
    __slots__ = ()
    KIND = "PublishLink"
    FORM = "Publication of node '{}' to topic '{}' of type '{}'"
    ATTRIBUTES: ClassVar[dict[str, Any]] = attributes(
        "queue_size", "latched", "qos", topic="resource", topic_name="end.name"
    )


class SubscribeLink(QueryLink):
    __slots__ = ()
    KIND = "SubscribeLink"
    FORM = "Subscription of node '{}' to topic '{}' of type '{}'"
    ATTRIBUTES: ClassVar[dict[str, Any]] = attributes("queue_size", "qos", topic="resource", topic_name="end.name")


class ServiceLink(QueryLink):
    __slots__ = ()
    KIND = "ServiceLink"
    FORM = "Service({}, {}, {})"
    ATTRIBUTES: ClassVar[dict[str, Any]] = attributes(
        "qos", service="resource", topic_name="end.name", service_name="end.name"
    )


class ClientLink(QueryLink):
    __slots__ = ()
    KIND = "ClientLink"
    FORM = "Client({}, {}, {})"
    ATTRIBUTES: ClassVar[dict[str, Any]] = ServiceLink.ATTRIBUTES


class ActionServerLink(QueryLink):
    __slots__ = ()
    KIND = "ActionServerLink"
    FORM = "ActionServer({}, {}, {})"
    ATTRIBUTES: ClassVar[dict[str, Any]] = attributes(action="resource", topic_name="end.name", action_name="end.name")


class ActionClientLink(QueryLink):
    __slots__ = ()
    KIND = "ActionClientLink"
    FORM = "ActionClient({}, {}, {})"
    ATTRIBUTES: ClassVar[dict[str, Any]] = ActionServerLink.ATTRIBUTES


class ReadLink(QueryLink):
    __slots__ = ()
    KIND = "ReadLink"
    FORM = "Read({}, {}, {})"
    ATTRIBUTES: ClassVar[dict[str, Any]] = attributes("value", parameter="resource", param_name="end.name")


class WriteLink(QueryLink):
    __slots__ = ()
    KIND = "WriteLink"
    FORM = "Write({}, {}, {})"
    ATTRIBUTES: ClassVar[dict[str, Any]] = ReadLink.ATTRIBUTES


class DeclareLink(QueryLink):
    """A ROS 2 node's declaration of a parameter: *value* is its default, *effective* what it has when started."""

    __slots__ = ()
    KIND = "DeclareLink"
    FORM = "Declare({}, {}, {})"
    ATTRIBUTES: ClassVar[dict[str, Any]] = attributes(
        "value", "effective", "range", parameter="resource", param_name="end.name", read_only="end.read_only"
    )


#: By the kind of endpoint: the link, the list of a node and of a resource that it is in, and the kind of resource.
LINKS: dict[str, tuple[type[QueryLink], str, str]] = {
    "publishers": (PublishLink, "publishers", "topics"),
    "subscribers": (SubscribeLink, "subscribers", "topics"),
    "servers": (ServiceLink, "servers", "services"),
    "clients": (ClientLink, "clients", "services"),
    "action_servers": (ActionServerLink, "action_servers", "actions"),
    "action_clients": (ActionClientLink, "action_clients", "actions"),
    "getters": (ReadLink, "reads", "parameters"),
    "setters": (WriteLink, "writes", "parameters"),
    "parameters": (DeclareLink, "declarations", "parameters"),
}
