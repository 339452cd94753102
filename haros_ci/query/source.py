# SPDX-License-Identifier: Apache-2.0
"""Packages, files, node types and their calls as HAROS's queries see them (``metamodel.py``)."""

from __future__ import annotations

from collections.abc import Iterable
from operator import attrgetter
from typing import Any, ClassVar

from haros_ci.model.architecture import Configuration, Node
from haros_ci.model.location import Location as Place
from haros_ci.model.package import Package as ModelPackage
from haros_ci.model.package import SourceFile as ModelFile
from haros_ci.query.calls import CALLS, RosCall
from haros_ci.query.places import Location2, QueryLocation, kept, readers
from haros_ci.query.values import NOTHING, QueryEntity, QueryList, Value

SCOPES = ("file", "node", "package", "repository", "project")


class SourceModel:
    """What stands in the workspace: packages, files, node types; made once for all queries."""

    def __init__(
        self, packages: Iterable[ModelPackage], files: Iterable[ModelFile], configurations: Iterable[Configuration]
    ) -> None:
        self.packages = {one.name: QueryPackage(one, self) for one in packages}
        self.roots = {one.made.path: one for one in self.packages.values()}
        self.files = {one.path: QuerySourceFile(one, self) for one in files}
        self.nodes: dict[tuple[str, str], SourceNode] = {}
        self.systems: tuple[Any, ...] = ()  # a System each
        for configuration in configurations:
            for node in configuration.nodes:
                key = (node.package, node.type)
                self.nodes.setdefault(key, SourceNode(key, self)).made.append(node)

    def package_of(self, path: str) -> QueryPackage | None:
        """The innermost package that the file at *path* is in."""
        directory = path
        while directory:
            directory = directory.rpartition("/")[0]
            if directory in self.roots:
                return self.roots[directory]
        return self.roots.get(".")

    def location(self, place: Place | None) -> QueryLocation | None:
        if place is None:
            return None
        return QueryLocation(place, self.package_of(place.path), self.files.get(place.path))

    def location2(self, place: Place | None) -> Location2:
        if place is None:
            return Location2(None, None, None, None)
        package = self.package_of(place.path)
        if package is None:
            return Location2(None, place.path, place.line, place.column)
        return Location2(package.name, package.inside(place.path), place.line, place.column)


class SourceEntity(QueryEntity):
    """What HAROS calls a SourceObject: it has an id, and is equal to what has the same one."""

    __slots__ = ()
    id: str

    def __eq__(self, other: object) -> bool:
        return self.id == other.id if isinstance(other, SourceEntity) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.id)

    def words(self) -> str:
        return self.id

    @property
    def place(self) -> Place | None:
        """Where a finding about it stands."""
        return None


class QueryPackage(SourceEntity):
    __slots__ = ("cache", "id", "made", "world")
    KIND = "Package"
    ATTRIBUTES: ClassVar[dict[str, Any]] = {
        **readers(
            "id", "name", "path", "version", "is_metapackage", "source_files", "nodes", "size", "lines", "file_count",
            "dependencies", "scope", "location", "topological_tier", "build_type", "ros",
        ),
        **{name: (lambda self: NOTHING) for name in ("authors", "maintainers", "licenses")},
        **{name: (lambda self: None) for name in ("project", "repository", "website", "vcs_url", "bug_url", "sloc")},
        "description": lambda self: "",
    }  # fmt: skip

    def __init__(self, made: ModelPackage, world: SourceModel) -> None:
        self.made = made
        self.world = world
        self.id = f"package:{made.name}"
        self.cache: dict[str, Value] = {}

    name = property(attrgetter("made.name"))
    path = property(attrgetter("made.path"))
    version = property(attrgetter("made.version"))
    build_type = property(attrgetter("made.build_type"))
    ros = property(attrgetter("made.ros"))
    is_metapackage = property(attrgetter("made.is_metapackage"))
    scope = "package"

    def inside(self, path: str) -> str:
        """The part of *path* below the package."""
        return path if self.made.path == "." else path.removeprefix(f"{self.made.path}/")

    @property
    def place(self) -> Place | None:
        return Place("package.xml" if self.made.path == "." else f"{self.made.path}/package.xml")

    @property
    def location(self) -> Value:
        return self.world.location(self.place)

    @kept
    def source_files(self) -> QueryList:
        return QueryList.of((one for one in self.world.files.values() if one.made.package == self.made.name), True)

    @kept
    def nodes(self) -> QueryList:
        return QueryList.of((one for key, one in self.world.nodes.items() if key[0] == self.made.name), True)

    @property
    def file_count(self) -> int:
        return len(self.source_files)

    @kept
    def size(self) -> int:
        return sum(one.made.size for one in self.source_files)

    @kept
    def lines(self) -> int:
        return sum(one.made.lines for one in self.source_files)

    @kept
    def dependencies(self) -> Value:
        names = dict.fromkeys(one.name for one in self.made.dependencies)
        return DependencySet(QueryList.of(names, True))

    @kept
    def topological_tier(self) -> int:
        """1 for what depends on no package of the workspace, else one more than the highest of those; -1 in a circle."""
        tiers: dict[str, int] = {}
        waiting = dict(self.world.packages)
        level = 0
        while waiting:
            level += 1
            ready = [
                name
                for name, one in waiting.items()
                if not any(d.name in waiting and d.name != name for d in one.made.dependencies)
            ]
            if not ready:
                break
            for name in ready:
                tiers[name] = level
                del waiting[name]
        return tiers.get(self.made.name, -1)


class DependencySet(QueryEntity):
    """The names of the packages that a package depends on."""

    __slots__ = ("packages",)
    KIND = "DependencySet"
    ATTRIBUTES: ClassVar[dict[str, Any]] = {
        **readers("packages"),
        **{name: (lambda self: NOTHING) for name in ("files", "arguments", "environment")},
    }

    def __init__(self, packages: QueryList) -> None:
        self.packages = packages


class QuerySourceFile(SourceEntity):
    __slots__ = ("id", "made", "world")
    KIND = "SourceFile"
    ATTRIBUTES: ClassVar[dict[str, Any]] = {
        **readers(
            "id", "name", "directory", "full_name", "dir_path", "path", "package", "language", "size", "lines",
            "scope", "location",
        ),
        **{name: (lambda self: None) for name in ("tree", "sloc", "timestamp")},
    }  # fmt: skip

    def __init__(self, made: ModelFile, world: SourceModel) -> None:
        self.made = made
        self.world = world
        package = world.packages.get(made.package or "")
        inside = made.path if package is None else package.inside(made.path)
        self.id = f"file:{made.package or ''}/{inside}"

    path = property(attrgetter("made.path"))
    size = property(attrgetter("made.size"))
    lines = property(attrgetter("made.lines"))
    scope = "file"

    @property
    def package(self) -> QueryPackage | None:
        return self.world.packages.get(self.made.package or "")

    @property
    def full_name(self) -> str:
        return self.made.path if self.package is None else self.package.inside(self.made.path)

    @property
    def name(self) -> str:
        return self.made.path.rpartition("/")[2]

    @property
    def directory(self) -> str:
        return self.full_name.rpartition("/")[0]

    @property
    def dir_path(self) -> str:
        return self.made.path.rpartition("/")[0]

    @property
    def language(self) -> str:
        """As HAROS has it: interfaces by their suffix."""
        return self.name.rpartition(".")[2] if self.made.language == "interface" else self.made.language

    @property
    def place(self) -> Place | None:
        return Place(self.made.path)

    @property
    def location(self) -> Value:
        return self.world.location(self.place)


class SourceNode(SourceEntity):
    """A type of node: an executable, or the class of a nodelet or component; its calls are those of all its instances."""

    __slots__ = ("_calls", "cache", "id", "key", "made", "world")
    KIND = "Node"
    ATTRIBUTES: ClassVar[dict[str, Any]] = {
        **readers(
            "id", "name", "package", "nodelet_class", "is_nodelet", "node_name", "language", "source_files",
            "instances", "scope", "location", *CALLS,
        ),
        **{name: (lambda self: NOTHING) for name in ("hpl_properties", "hpl_assumptions")},
        **{name: (lambda self: None) for name in ("rosname", "source_tree", "timestamp")},
    }  # fmt: skip
    METHODS: ClassVar[dict[str, Any]] = {"variables": (0, 0, lambda self: NOTHING)}
    scope = "node"

    def __init__(self, key: tuple[str, str], world: SourceModel) -> None:
        self.key = key
        self.world = world
        self.made: list[Node] = []
        self.id = f"node:{key[0]}/{key[1]}"
        self._calls: dict[str, QueryList] = {}
        self.cache: dict[str, Value] = {}

    @property
    def name(self) -> str:
        return self.key[1]

    @property
    def node_name(self) -> str:
        return f"{self.key[0]}/{self.key[1]}"

    @property
    def package(self) -> Value:
        return self.world.packages.get(self.key[0])

    @property
    def is_nodelet(self) -> bool:
        return self.made[0].kind in ("nodelet", "component")

    @property
    def nodelet_class(self) -> Value:
        return (self.made[0].class_name or self.key[1]) if self.is_nodelet else None

    @kept
    def instances(self) -> QueryList:
        """Its nodes in all configurations."""
        nodes = (node for system in self.world.systems for node in system.nodes.items)
        return QueryList.of(node for node in nodes if (node.made.package, node.made.type) == self.key)

    def calls(self, name: str) -> QueryList:
        """Its calls of one kind, each once."""
        if name not in self._calls:
            kind, called = CALLS[name]
            found: dict[object, RosCall] = {}
            for node in self.made:
                for end in node.endpoints:
                    if end.kind == kind and not end.implicit:
                        call = RosCall(called, node, end, self.world)
                        found.setdefault((end.location, call.name, call.type), call)
            self._calls[name] = QueryList.of(found.values())
        return self._calls[name]

    advertise = property(lambda self: self.calls("advertise"))
    subscribe = property(lambda self: self.calls("subscribe"))
    service = property(lambda self: self.calls("service"))
    client = property(lambda self: self.calls("client"))
    read_param = property(lambda self: self.calls("read_param"))
    write_param = property(lambda self: self.calls("write_param"))

    @kept
    def source_files(self) -> QueryList:
        """The files that its calls stand in."""
        paths = {e.location.path for node in self.made for e in node.endpoints if e.location is not None}
        return QueryList.of((self.world.files[path] for path in sorted(paths) if path in self.world.files), True)

    @property
    def language(self) -> Value:
        return self.source_files[0].language if self.source_files else None

    @property
    def place(self) -> Place | None:
        places = [e.location for node in self.made for e in node.endpoints if e.location is not None and not e.implicit]
        if places:
            return min(places, key=lambda place: place.sort_key)
        package = self.world.packages.get(self.key[0])
        return package.place if package is not None else self.made[0].location

    @property
    def location(self) -> Value:
        package = self.world.packages.get(self.key[0])
        return package.location if package is not None else None
