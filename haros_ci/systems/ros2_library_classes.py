# SPDX-License-Identifier: Apache-2.0
"""Which C++ classes are for the nodes of others: in a public header, given a node or with one of their own, made by no process here."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Iterator, Mapping
from functools import partial

from haros_ci import syntax
from haros_ci.index.index import HEADERS, Index, Source
from haros_ci.index.relevance import Relevance
from haros_ci.index.types import pointee, resolve_type
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.syntax import Class, Function, Type
from haros_ci.systems.entries import files_of
from haros_ci.systems.following import Types
from haros_ci.systems.ros2_library import Library, Seen

#: What is a node in rclcpp, and how the names of what stands for a part of one begin.
NODES = frozenset(("rclcpp::Node", "rclcpp_lifecycle::LifecycleNode"))
PARTS = "rclcpp::node_interfaces::Node"
#: Methods that hand a node to an object that is there already.
STARTING = ("configure", "initialize", "initialise", "init")
#: Directories of what is not for others to use.
ASIDE = regex(r"^(tests?|testing|examples?)$|_(tests?|testing|examples?)$")


def libraries(types: Types, seen: Seen) -> Iterator[Library]:
    """The C++ classes of ROS 2 packages that are for the nodes of others, by name."""
    if 2 not in types.versions.values():
        return
    nodes = _taken(types, seen)
    bases = _all_bases(types.programs.cpp, nodes)
    taken = nodes | bases
    view = _View(
        types.programs.cpp,
        types.relevance["cpp", 2],
        seen,
        _libraries_by_source(types),
        frozenset(nodes - bases),
        _named_as_nodes(types.programs.cpp),
        {},
    )
    for name in sorted(dict.keys(view.index.classes)):
        around = name.rpartition("::")[0]
        if name in taken or around in view.index.classes:
            continue
        for source, definition in view.index.classes[name]:
            if types.versions.get(source.package or "") == 2 and _is_public(source.path):
                found = view.library(source, definition)
                if found is not None:
                    yield found
                    break


def _is_public(path: str) -> bool:
    parts = path.split("/")[:-1]
    return path.endswith(HEADERS) and "include" in parts and not any(map(ASIDE.search, parts))


def _taken(types: Types, seen: Seen) -> set[str]:
    """The classes that processes of the workspace load, or make as nodes."""
    tables = (types.components, types.hosted, types.ros2_programs)
    found = {entry.definition.name for table in tables for entry, _ in table.values() if entry.definition is not None}
    return found | {plugin.definition.name for plugin in types.plugins.values()} | seen.classes


def _named_as_nodes(index: Index) -> frozenset[str]:
    """The last parts of the names of nodes, and of all classes that have a class of such a name as a base."""
    derived: dict[str, set[str]] = {}
    for found in index.classes.values():
        for _, definition in found:
            for base in definition.bases:
                derived.setdefault(base.name.rpartition("::")[2], set()).add(definition.name.rpartition("::")[2])
    names: set[str] = set()
    waiting = [name.rpartition("::")[2] for name in NODES]
    while waiting:
        name = waiting.pop()
        if name not in names:
            names.add(name)
            waiting += derived.get(name, ())
    return frozenset(names)


def _all_bases(index: Index, names: Iterable[str]) -> set[str]:
    """The base classes of classes, and theirs."""
    found: set[str] = set()
    waiting = sorted(names)
    while waiting:
        for source, definition in index.classes.get(waiting.pop(), ()):
            new = {*_bases(index, source, definition)} - found
            found |= new
            waiting += sorted(new)
    return found


def _bases(index: Index, source: Source, definition: Class) -> Iterator[str]:
    scope = definition.name.rpartition("::")[0]
    for base in definition.bases:
        yield resolve_type(index, base, scope, source, frozenset(), {}).name


def _libraries_by_source(types: Types) -> Mapping[str, frozenset[str]]:
    """For each file of a library that can be linked, the files that this library is made of."""
    found: dict[str, frozenset[str]] = {}
    for _, build in sorted(types.programs.builds.items()):
        for target in build.targets:
            if target.kind == "library":
                files = files_of(types.programs, target)
                for path in (*target.sources, *target.conditional_sources):
                    found.setdefault(path, files)
    return found


@dataclass(frozen=True, slots=True)
class _View:
    """The C++ classes of the workspace, and what is needed to tell which of them are for others."""

    index: Index
    relevance: Relevance
    seen: Seen
    files: Mapping[str, frozenset[str]]
    #: The classes of its nodes that no other is derived from.
    particular: frozenset[str]
    #: The last parts of the names of classes that may be nodes.
    names: frozenset[str]
    lines: dict[str, list[int]]

    def library(self, source: Source, definition: Class) -> Library | None:
        """How others make *definition*, declared in *source*; None if it is not for their nodes."""
        short, nodes = definition.name.rpartition("::")[2], dict[int, Type]()
        constructors = [f for f in self._declared(definition, short, source) if self._bodies(f, source)]
        ways: list[tuple[tuple[int, ...], Function | None, Function | None, dict[int, Type]]] = []
        for function in constructors:
            nodes = self._nodes(function, definition, source)
            if nodes and self._is_for_others(nodes) and self._is_new(function, source):
                ways.append(((*self._rank(function, nodes, source), function.line), function, None, nodes))
        if not ways:
            first = min(constructors, key=lambda f: (*self._rank(f, {}, source), f.line), default=None)
            for method in (f for name in STARTING for f in self._declared(definition, name, source)):
                nodes = self._nodes(method, definition, source)
                if nodes and self._is_for_others(nodes) and self._is_new(method, source):
                    ways.append(((*self._rank(method, nodes, source), method.line), first, method, nodes))
        if not ways:  # it is a node, or has one of its own
            for function in constructors:
                if not self._nodes(function, definition, source) and self._is_new(function, source):
                    ways.append(((*self._rank(function, {}, source), function.line), function, None, {}))
        if not ways:
            return None
        _, constructor, started, nodes = min(ways, key=lambda way: way[0])
        bodies = [body for function in (started, constructor) if function for body in self._bodies(function, source)]
        home = bodies[0][0].path if bodies else source.path
        files = self.files.get(home, frozenset((home,)))
        more = partial(self._may_make_more, source, definition)
        return Library(source.package or "", source, definition, files, constructor, started, nodes, more)

    def _declared(self, definition: Class, name: str, source: Source) -> list[Function]:
        found = self.index.functions.get(f"{definition.name}::{name}", ())
        return [function for where, function in found if where.path == source.path]

    def _bodies(self, function: Function, source: Source) -> list[tuple[Source, Function]]:
        """The definitions of what *source* declares that a library, or the header itself, has."""
        tail = "::".join(function.name.split("::")[-2:])
        every = [*self.index.functions.get(function.name, ()), *self.index.by_tail.get(tail, ())]
        return [
            (where, item)
            for where, item in every
            if item.body is not None
            and len(item.parameters) == len(function.parameters)
            and (item.owner == function.owner or f"::{function.owner}".endswith(f"::{item.owner}"))
            and (where.path == source.path or where.path in self.files or where.path.endswith(HEADERS))
        ]

    def _is_new(self, function: Function, source: Source) -> bool:
        """Whether a function may make something where no process of the workspace has, by itself or by code of its own files.

        What it makes by way of other classes is modelled for these.
        """
        bodies = self._bodies(function, source)
        if any(self._is_made_in(self.seen, body, where) for where, body in bodies):
            return False
        short = function.name.rpartition("::")[2]
        if any(init.name.rpartition("::")[2] == short for _, body in bodies for init in body.inits):  # to another one
            others = [
                other_function
                for where, other_function in self.index.functions.get(function.name, ())
                if where.path == source.path
            ]
            bodies = [*bodies, *(body for other in others for body in self._bodies(other, source))]
        return self._reaches_new(bodies, source, (self.seen,))

    def _reaches_new(self, bodies: list[tuple[Source, Function]], source: Source, known: tuple[Seen, ...]) -> bool:
        near = {source.path, *(where.path for where, _ in bodies)}
        for path in tuple(near):
            near |= {other for other in self.index.reach(path) if self._is_private(other, source)}
        relevance = self.relevance.within(frozenset(near))

        def counts(item: Function, where: Source) -> bool:
            return not any(self._is_made_in(seen, item, where) for seen in known)

        return any(relevance.reaches(body, where, counts) for where, body in bodies)

    def _may_make_more(self, source: Source, definition: Class, own: Seen) -> bool:
        """Whether a method, which whoever uses the class may call, makes something that has not been made."""
        short = definition.name.rpartition("::")[2]
        methods = (
            function
            for function in source.program.functions
            if function.owner == definition.name and function.name.rpartition("::")[2].lstrip("~") != short
        )
        return any(self._reaches_new(self._bodies(method, source), source, (self.seen, own)) for method in methods)

    def _is_private(self, path: str, source: Source) -> bool:
        return self.index.sources[path].package == source.package and "include" not in path.split("/")

    def _is_made_in(self, seen: Seen, function: Function, source: Source) -> bool:
        return seen.between(source.path, function.line, self._end(function, source))

    def _rank(self, function: Function, nodes: Mapping[int, Type], source: Source) -> tuple[int, int, int]:
        """The less the sooner: a node itself before parts of one; then how many arguments have no default, of classes first."""
        parts = sum(kind.name.startswith(PARTS) for kind in nodes.values())
        unknown = [p for number, p in enumerate(function.parameters) if number not in nodes and p.default is None]
        kinds = [
            pointee(resolve_type(self.index, p.type, function.owner, source, frozenset(), {})).name for p in unknown
        ]
        return parts, sum(kind in self.index.classes for kind in kinds), len(unknown)

    def _end(self, function: Function, source: Source) -> float:
        lines = self.lines.get(source.path)
        if lines is None:
            lines = sorted(
                {other_function.line for other_function in source.program.functions if other_function.kind != "lambda"}
            )
            self.lines[source.path] = lines
        at = bisect_right(lines, function.line)
        return lines[at] if at < len(lines) else float("inf")

    def _nodes(self, function: Function, definition: Class, source: Source) -> dict[int, Type]:
        """The parameters that take a node, or a part of one, by number."""
        found: dict[int, Type] = {}
        for number, parameter in enumerate(function.parameters):
            if self.names.isdisjoint(part for word in _words(parameter.type) for part in word.split("::")) and not any(
                "node" in word.lower() for word in _words(parameter.type)
            ):
                continue
            if pointee(parameter.type).name in (*function.templates, *definition.templates):
                found[number] = syntax.Type("rclcpp::Node")
                continue
            kind = pointee(resolve_type(self.index, parameter.type, definition.name, source, frozenset(), {}))
            if self._is_node(kind.name):
                found[number] = kind
        return found

    def _is_for_others(self, nodes: Mapping[int, Type]) -> bool:
        """Whether no parameter takes one particular node of the workspace."""
        return self.particular.isdisjoint(kind.name for kind in nodes.values())

    def _is_node(self, name: str) -> bool:
        return any(one in NODES or one.startswith(PARTS) for one in (name, *_all_bases(self.index, (name,))))


def _words(kind: Type) -> Iterator[str]:
    yield kind.name
    for inner in kind.arguments:
        if isinstance(inner, syntax.Type):
            yield from _words(inner)
