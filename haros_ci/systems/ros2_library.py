# SPDX-License-Identifier: Apache-2.0
"""Classes of ROS 2 libraries that others make, for nodes of theirs: what each brings into such a node.

The node is a placeholder: its name is not known, its namespace is ``/`` as that of every node by itself.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable as Callable_
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import partial

from haros_ci import syntax
from haros_ci.follow import activation, callbacks, construct, methods
from haros_ci.follow.call_arguments import PassedArgument
from haros_ci.follow.follow import Entry
from haros_ci.follow.frames import Frame
from haros_ci.follow.ros import ros2_nodes
from haros_ci.follow.walk import Walk
from haros_ci.graph.given_parameters import Parameters
from haros_ci.graph.ros2_process import GIVEN, RosNode
from haros_ci.index.index import Source
from haros_ci.index.types import pointee
from haros_ci.model.architecture import LIBRARY, Node, Unknown
from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass, field
from haros_ci.syntax import Class, Function, Type
from haros_ci.systems import ros2_system
from haros_ci.systems.following import Types
from haros_ci.systems.ros2_processes import Started
from haros_ci.systems.system import PROGRAM, Job
from haros_ci.values.abstract import Callable, Object

#: Why the name of the node is not known.
USER = "it is the node of whoever uses the class"
#: Why what a method makes may not be made.
CALLED = "it is made when a method of the class is called, which nothing in the workspace does"
#: Why there may be more.
METHODS = "what the methods of the class make is made when they are called"
OPTIONS = "rclcpp::NodeOptions"


@dataclass(frozen=True, slots=True)
class Seen:
    """What the processes of the workspace make: *lines* by file, sorted, and the *places*; the *classes* of their nodes."""

    lines: Mapping[str, list[int]]
    places: frozenset[tuple[str, Location]]
    classes: frozenset[str]

    def between(self, path: str, first: int, end: float) -> bool:
        """Whether anything is made from the line *first* of a file to before the line *end*."""
        lines = self.lines.get(path, [])
        at = bisect_left(lines, first)
        return at < len(lines) and lines[at] < end


@dataclass(frozen=True, slots=True, eq=False)
class Library:
    """A class, the *constructor* that is called, and the *method* that gets the node afterwards, if one does.

    *nodes* are the types of the parameters of either that get the node, by number. Without any the class is a node itself,
    or makes one of its own.
    """

    package: str
    source: Source
    definition: Class
    files: frozenset[str]
    constructor: Function | None
    method: Function | None = None
    nodes: Mapping[int, Type] = field(default_factory=dict)
    #: Whether its methods may make something beside what is seen already.
    may_make_more: Callable_[[Seen], bool] = lambda seen: False
    #: Those of its methods that make something when whoever uses it calls them (Python).
    called: tuple[Function, ...] = ()


def seen_in(nodes: Iterable[Node], is_all: bool = False) -> Seen:
    """What *nodes* have made, and of which classes they are; what is ruled out counts where *is_all*."""
    lines: dict[str, set[int]] = {}
    places: set[tuple[str, Location]] = set()
    classes: set[str] = set()
    for node in nodes:
        classes.add(node.class_name or "")
        for end in node.endpoints:
            counts = is_all or not end.is_ruled_out
            if counts and end.location is not None and end.location.line is not None and not end.implicit:
                lines.setdefault(end.location.path, set()).add(end.location.line)
                places.add((end.kind, end.location))
    return Seen({path: sorted(found) for path, found in lines.items()}, frozenset(places), frozenset(classes))


def tells(nodes: Iterable[Node], seen: Seen) -> bool:
    """Whether *nodes* have something, known at least in part, that no process of the workspace makes at the same place as things are."""
    return any(
        (end.kind, end.location) not in seen.places and (end.type is not None or end.name.strip("/?:") != "")
        for node in nodes
        for end in node.endpoints
        if not end.implicit and not end.is_ruled_out
    )


def job(types: Types, library: Library) -> Job:
    """The class by itself, in the node of whoever uses it."""
    place = Location(library.source.path, library.definition.line)
    name = f"{library.source.module}.{library.definition.name}" if library.source.module else library.definition.name
    node = Node(
        name="/?",
        kind=LIBRARY,
        package=library.package,
        type=name,
        location=place,
        process="/?",
        class_name=name,
        ros=2,
    )
    entry, started = _entry(library), Started((), Parameters(()), (), False)

    def follow() -> tuple[tuple[Node, ...], tuple[Problem, ...]]:
        nodes, problems = ros2_system.nodes_of(types, entry, library.files, node, started, False)
        if nodes[0].kind == PROGRAM:
            return nodes, problems
        first, *others = nodes
        if not library.nodes and (first.location == place or first.location is None or first.location.line is None):
            return (replace(node, kind=PROGRAM),), problems  # what it makes is on a node that it gets from elsewhere
        own = tuple(end for end in first.endpoints if not (library.nodes and end.implicit and end.location == place))
        more = (Unknown("endpoints", METHODS, place),) if library.may_make_more(seen_in(nodes, is_all=True)) else ()
        first = replace(first, endpoints=own, unknowns=(*first.unknowns, *more))
        return tuple(replace(one, kind=LIBRARY) for one in (first, *others)), problems

    sources = types.programs.sources
    size = sum(len(sources[path].program.functions) for path in library.files if path in sources)
    return Job(node, (id(entry), name), follow, size, label=LIBRARY)


def _entry(library: Library) -> Entry:
    count = len(library.constructor.parameters) if library.constructor is not None else 0
    numbers = ",".join(str(number) for number in sorted(library.nodes))
    method = library.method.name if library.method is not None else ""
    label = f"(library) {count} {numbers} {method}"
    return Entry(library.source, definition=library.definition, begin=partial(_begin, library), label=label)


def _begin(library: Library, walk: Walk, frame: Frame) -> None:
    """Construct the class with a node, where it takes one; of what else it is given only default arguments are known."""
    source, definition = library.source, library.definition
    location = Location(source.path, definition.line)
    provided = None
    if library.nodes:
        provided = RosNode("/?", "/", "/", GIVEN, "", location, why=(USER, location))
        walk.nodes.append(provided)
    found = methods.with_body(walk, [(source, library.constructor)]) if library.constructor is not None else None
    arguments = (
        _arguments(walk, library, found[1], provided if library.method is None else None) if found is not None else ()
    )
    templates = _templates(library, found[1] if found is not None else None)
    this = Object(definition.name, (), (source, definition), location=location, templates=templates)
    if source.separator == ".":
        construct.python_construct(walk, frame, this, arguments, location)
        for method in library.called:
            bound = Callable(source, method, this)
            callbacks.register(walk, bound, doubt=CALLED)
    else:
        construct.initialise(walk, frame, this, (source, definition), templates, arguments, location, chosen=found)
        callbacks.framework_entries(walk, this)
    if library.method is not None:
        where, function = methods.with_body(walk, [(source, library.method)])
        activation.invoke(walk, frame, Callable(where, function, this), _arguments(walk, library, function, provided))


def _templates(library: Library, constructor: Function | None) -> dict[str, syntax.Argument]:
    """What template parameters stand for: the node's for a node, all others for nothing that is known."""
    own = constructor.templates if constructor is not None else ()
    found: dict[str, syntax.Argument] = {name: syntax.Type(name) for name in (*library.definition.templates, *own)}
    taking = library.method or constructor
    for number, kind in library.nodes.items():
        name = pointee(taking.parameters[number].type).name if taking is not None else ""
        if name in found:
            found[name] = kind
    return found


def _arguments(
    walk: Walk, library: Library, function: Function, provided: RosNode | None
) -> tuple[PassedArgument, ...]:
    """The node for the parameters that take it, and options as a node by itself has them; by the names of parameters."""
    found = []
    for number, parameter in enumerate(function.parameters):
        kind = library.nodes.get(number) if provided is not None else None
        if kind is not None:
            own = parameter.type.name if library.source.separator == "." else kind.name
            found.append(
                PassedArgument(
                    Object(kind.name, (), walk.class_of(own or kind.name, library.source), node=provided),
                    None,
                    kind,
                    parameter.name,
                )
            )
        elif parameter.type.name.rpartition("::")[2] == "NodeOptions":
            found.append(PassedArgument(ros2_nodes.options_for(walk), None, syntax.Type(OPTIONS), parameter.name))
    return tuple(found)
