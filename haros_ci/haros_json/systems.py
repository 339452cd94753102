# SPDX-License-Identifier: Apache-2.0
"""``configurations.json``: nodes, topics, services, parameters and links, as HAROS's ``Configuration.to_JSON_object`` has them.

HAROS knows no actions: each is a service here, of the action's type. What a ROS 2 node declares is what it reads. What
the client library makes for every node is left out, as in queries.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from hashlib import sha256
from typing import Any

from haros_ci.declared.variables import variables
from haros_ci.haros_json.places import JsonPlaces
from haros_ci.haros_json.texts import name, words
from haros_ci.model.architecture import Condition, Node
from haros_ci.model.location import Location
from haros_ci.query.links import QueryLink
from haros_ci.query.resources import NodeInstance, QueryParameter, Resource
from haros_ci.query.system import QuerySystem
from haros_ci.records import dataclass
from haros_ci.report.model_json import plain

#: HAROS's lists of links, and ours that are in them.
LINKS = {
    "publishers": ("publishers",),
    "subscribers": ("subscribers",),
    "servers": ("servers", "action_servers"),
    "clients": ("clients", "action_clients"),
    "reads": ("reads", "declarations"),
    "writes": ("writes",),
}
#: What HAROS calls the resource at the end of a link of ours.
TYPES = {"node": "node", "topic": "topic", "service": "service", "action": "service", "param": "param"}
UNKNOWN = "?"


@dataclass(frozen=True, slots=True, kw_only=True)
class Object:
    """What an issue is about, as HAROS writes it: a resource, or the link of *node* to it. Names are escaped."""

    kind: str
    name: str
    uid: str
    node: str = ""
    node_uid: str = ""

    def of_query(self) -> dict[str, str]:
        """As in the queries of ``configurations.json``."""
        if not self.node:
            return {"name": self.name, "uid": self.uid, "resourceType": self.kind}
        ends = {self.kind: self.name, f"{self.kind}_uid": self.uid}
        return {"node": self.node, "node_uid": self.node_uid, **ends, "resourceType": "link"}

    def of_issue(self) -> dict[str, str]:
        """As in the resources of an issue, where HAROS leaves out links."""
        if not self.node:
            return {"name": self.name, "resourceType": self.kind}
        return {"node": self.node, self.kind: self.name, "resourceType": "link"}


class Shown:
    """A configuration with a uid for each of its resources: of its content, the same in every run."""

    def __init__(self, system: QuerySystem, id: str, places: JsonPlaces) -> None:
        self.system = system
        self.id = id
        self.places = places
        self.nodes = _sorted(system.nodes.all)
        self.topics = _sorted(system.topics.all)
        self.services = _sorted((*system.services.all, *system.actions.all))
        self.parameters = _sorted(system.parameters.all)
        counts: Counter[tuple[str, str]] = Counter()
        self.uids: dict[int, str] = {}
        self.by_name: dict[tuple[str, str], Resource] = {}
        for one in (*self.nodes, *self.topics, *self.services, *self.parameters):
            counts[one.TYPE, one.full] += 1
            key = "\0".join((system.made.name, one.TYPE, one.full, str(counts[one.TYPE, one.full])))
            self.uids[id_of(one)] = sha256(key.encode("utf-8", "surrogatepass")).hexdigest()[:16]
            self.by_name.setdefault((one.TYPE, one.full), one)
        self.unknowns = {id_of(one): tuple(variables(one.made)) for one in self.nodes}
        self._indices = {id_of(one): _places_in(one.made) for one in self.nodes}

    def object(self, entity: Resource | QueryLink) -> Object | None:
        """What *entity* is here; None if it is of another configuration."""
        resource = entity.resource if isinstance(entity, QueryLink) else entity
        uid = self.uids.get(id_of(resource))
        if uid is None:
            return None
        shown = Object(kind=TYPES[resource.TYPE], name=name(resource.full), uid=uid)
        if not isinstance(entity, QueryLink):
            return shown
        node = entity.node
        return Object(kind=shown.kind, name=shown.name, uid=uid, node=name(node.full), node_uid=self.uids[id_of(node)])

    def json(
        self, queries: Iterable[Mapping[str, Any]], environment: Iterable[str], sloc: Callable[[str], int]
    ) -> dict[str, Any]:
        """The entry of ``configurations.json``; *queries* are the issues that are about something in it.

        *environment* are the variables that the project file sets for it, *sloc* counts a file's lines that are not blank.
        """
        every = (*self.nodes, *self.topics, *self.services, *self.parameters)
        names = [one.full for one in every if UNKNOWN not in one.full]
        made = self.system.made
        packages = {node.package for node in made.nodes} | {item.partition("/")[0] for item in made.launch}
        return {
            "id": self.id,
            "launch": [self._launch(place, sloc) for place in self.system.launch_places()],
            "collisions": len(names) - len(set(names)),
            "remaps": len({pair for node in made.nodes for pair in node.remaps}),
            "dependencies": sorted(self.places.named(one) or name(one) for one in packages - {""}),
            "environment": sorted(name(one) for one in environment),
            "nodes": [self._node(one) for one in self.nodes],
            "topics": [self._channel(one, "publishers", "subscribers") for one in self.topics],
            "services": [self._channel(one, "servers", "clients") for one in self.services],
            "parameters": [self._parameter(one) for one in self.parameters],
            "links": {kind: list(self._links(kind)) for kind in LINKS},
            "hpl": {key: [str(plain(one)) for one in found] for key, found in zip(HPL, self.system.hpl, strict=True)},
            "unresolved": sum(UNKNOWN in one.full for one in every),
            "conditional": sum(bool(one.conditions) for one in every),
            "queries": list(queries),
        }

    def _launch(self, place: Location, sloc: Callable[[str], int]) -> dict[str, Any]:
        package, file = self.places.split(place.path)
        known = self.system.world.files.get(place.path)
        directory, _, own = file.rpartition("/")
        return {
            "name": name(own),
            "directory": name(directory),
            "package": package,
            "language": known.language if known is not None else "launch",
            "size": known.size if known is not None else 0,
            "timestamp": 0,
            "lines": known.lines if known is not None else 0,
            "sloc": sloc(place.path),
        }

    def _resource(self, one: Resource) -> dict[str, Any]:
        return {"uid": self.uids[id_of(one)], "name": name(one.full), "type": _type(one.type)}

    def _explained(self, one: Resource) -> dict[str, Any]:
        places = [self.places.location(place) for place in one.places()]
        return {"traceability": places, "variables": [words(text) for text in self._variables(one)]}

    def _node(self, one: NodeInstance) -> dict[str, Any]:
        ends = {kind: [name(link.resource.full) for link in _ends(one, kind)] for kind in LINKS}
        return {
            **self._resource(one),
            "args": words(one.argv),
            "conditions": self._conditions(condition.made for condition in one.conditions),
            **ends,
            **self._explained(one),
        }

    def _channel(self, one: Resource, *kinds: str) -> dict[str, Any]:
        return {
            **self._resource(one),
            "conditions": self._conditions(condition.made for condition in one.conditions),
            **{kind: [name(link.node.full) for link in _ends(one, kind)] for kind in kinds},
            **self._explained(one),
        }

    def _parameter(self, one: QueryParameter) -> dict[str, Any]:
        value = plain(one.made.value) if one.made is not None else None
        made = self._channel(one, "reads", "writes")
        return {**{key: made.pop(key) for key in ("uid", "name", "type")}, "value": value, **made}

    def _links(self, kind: str) -> Iterator[dict[str, Any]]:
        for node in self.nodes:
            for link in _ends(node, kind):
                end, resource = link.end, link.resource
                what = TYPES[resource.TYPE]
                made: dict[str, Any] = {
                    "node": name(node.full),
                    "node_uid": self.uids[id_of(node)],
                    "name": name(end.original_name),
                    "location": self.places.location(end.location),
                    "conditions": self._conditions(end.conditions),
                    what: name(resource.full),
                    f"{what}_uid": self.uids[id_of(resource)],
                    "type": _type(end.type),
                }
                if what == "topic":
                    made["queue"] = _whole(link.queue_size)
                if what == "param":
                    made["value"] = plain(end.value)
                if kind == "publishers":
                    made["latched"] = link.latched
                yield made

    def _conditions(self, conditions: Iterable[Condition]) -> list[dict[str, Any]]:
        return [
            {
                "statement": words(one.statement),
                "condition": words(one.condition),
                "location": self.places.location(one.location),
            }
            for one in conditions
        ]

    def _variables(self, one: Resource) -> list[str]:
        """The unknowns of a node as hints name them, or of the nodes at a resource, each behind its node's name."""
        if isinstance(one, NodeInstance):
            return [unknown.name for unknown in self.unknowns[id_of(one)]]
        found = []
        for link in one.all_links():
            at = self._indices[id_of(link.node)].get(id_of(link.end))
            known = self.unknowns[id_of(link.node)]
            found += [f"{link.node.full} {variable.name}" for variable in known if variable.index == at]
        return sorted(set(found))


HPL = ("properties", "assumptions")


def id_of(entity: object) -> int:
    """The identity of an entity within one run; never written."""
    return id(entity)


def _places_in(node: Node) -> dict[int, int]:
    return {id_of(end): index for index, end in enumerate(node.endpoints)}


def _ends(one: Resource, kind: str) -> list[QueryLink]:
    """The links of *one* in HAROS's list *kind*, by name and place."""
    found = [link for own in LINKS[kind] for link in one.links.get(own, ())]
    return sorted(found, key=_key)


def _key(link: QueryLink) -> tuple[Any, ...]:
    end = link.end
    place = end.location.sort_key if end.location is not None else ()
    return (link.node.full, link.resource.full, end.original_name, place, end.kind)


def _sorted(resources: Iterable[Any]) -> list[Any]:
    def key(one: Resource) -> tuple[Any, ...]:
        return (
            one.full,
            one.TYPE,
            [place.sort_key for place in one.places()],
            [_key(link) for link in one.all_links()],
        )

    return sorted(resources, key=key)


def _type(text: Any) -> str | None:
    """A type's name; null where it is not known."""
    return None if text is None or text == UNKNOWN else name(str(text))


def _whole(value: Any) -> int | None:
    return plain(value) if isinstance(value, int) and not isinstance(value, bool) else None
