# SPDX-License-Identifier: Apache-2.0
"""Plug-ins that nothing in the workspace is seen to load: one configuration per plug-in, on the node of the program that loads it.

Such a program constructs a plug-in and calls what it overrides, the methods that initialise it first: layers of costmaps, planners, kinematics
solvers, capabilities of move_group, plug-ins of rqt. The program is not known, so neither is the name of its node, and that node has more than the model shows.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

from haros_ci import syntax
from haros_ci.follow import activation, callbacks, construct, methods
from haros_ci.follow.call_arguments import PassedArgument
from haros_ci.follow.follow import Entry
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries.given_away import BEGINNING
from haros_ci.follow.ros.ends import endpoints
from haros_ci.follow.walk import Walk
from haros_ci.graph.given_parameters import Parameters
from haros_ci.graph.parameters import ParameterServer, Perhaps
from haros_ci.graph.ros2_process import GIVEN, RosNode
from haros_ci.index.index import Source, is_test
from haros_ci.index.types import pointee
from haros_ci.model.architecture import Node, Unknown
from haros_ci.model.build import PluginClass
from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass
from haros_ci.syntax import Class, Function
from haros_ci.systems import ros1_controllers, ros2_controllers, ros2_entries, ros2_system
from haros_ci.systems.entries import NODELET, base_of, described_classes
from haros_ci.systems.following import Instance, Types, incomplete, run_node
from haros_ci.systems.ros2_library import Seen
from haros_ci.systems.ros2_processes import Started
from haros_ci.systems.system import PROGRAM, Job
from haros_ci.values.abstract import Cell, Object, Opaque, Text, Value

#: Bases of plug-ins that have a place of their own.
ELSEWHERE = frozenset(
    (
        NODELET,
        ros2_entries.FACTORY,
        *ros1_controllers.LATER,
        *ros2_controllers.CONTROLLERS,
        *ros2_controllers.COMPONENTS,
    )
)
#: Why the name of the node is not known, and why it may have more.
HOST = "it is the node of whoever loads the plug-in"
MORE = "whoever loads the plug-in has endpoints of its own"
OWN = "it depends on whoever loads the plug-in"
#: Of a parameter whose name is not known, or in ROS 2 of any.
SET = "whoever loads it may set it"
HANDLE, NODE = "ros::NodeHandle", "rclcpp_lifecycle::LifecycleNode"
NODES = frozenset(("rclcpp::Node", NODE))
#: Members of base classes that hold the node (nav2_costmap_2d/layer.hpp, moveit's planning_request_adapter.h and others).
MEMBERS = ("node_", "node")
#: How ends of names of pointers look that are types of a node's class.
POINTERS = ("::SharedPtr", "::WeakPtr", "::ConstSharedPtr", "::ConstWeakPtr", "::UniquePtr")
#: As many are followed.
MOST = 300


@dataclass(frozen=True, slots=True, eq=False)
class Plugin:
    """A class that a plug-in description names, and the files of its library."""

    described: PluginClass
    source: Source
    definition: Class
    files: frozenset[str]


def jobs(types: Types, seen: Seen) -> Iterator[Job]:
    """The plug-ins that may make something, of which nothing was *seen*, in the order of their packages and names."""
    found: dict[tuple[str, str], Plugin] = {}
    known: set[int] = set()
    for plugin in (*_cpp(types), *_python(types)):
        described = plugin.described
        if base_of(described) in ELSEWHERE or (described.package, described.type.strip()) in types.hosted:
            continue
        if id(plugin.definition) not in known and not is_test(plugin.source.path) and _is_new(types, seen, plugin):
            known.add(id(plugin.definition))
            found[described.package, described.name] = plugin
    for (package, _), plugin in sorted(found.items(), key=lambda item: item[0])[:MOST]:
        yield _ros2(types, plugin) if types.versions.get(package) == 2 else _ros1(types, plugin)


def _cpp(types: Types) -> Iterator[Plugin]:
    for described, source, definition, files in described_classes(types.programs):
        yield Plugin(described, source, definition, files | {source.path})


def _python(types: Types) -> Iterator[Plugin]:
    """Classes of Python: a description has the module and the class (rqt_gui_py)."""
    for _, build in sorted(types.programs.builds.items()):
        for described in build.plugins:
            module, _, name = described.type.strip().rpartition(".")
            for source, definition in types.programs.python.classes.get(name, ()) if module else ():
                if source.module == module:
                    yield Plugin(described, source, definition, frozenset((source.path,)))


def _is_new(types: Types, seen: Seen, plugin: Plugin) -> bool:
    """Whether a method of its may make something, and none was seen to."""
    ros = 2 if types.versions.get(plugin.described.package) == 2 else 1
    relevance = types.relevance.get((plugin.source.program.language, ros))
    if relevance is None:
        return False
    index = types.programs.python if plugin.source.separator == "." else types.programs.cpp
    makes = False
    for where, function in _methods(index.functions, plugin):
        lines = sorted(
            other_function.line
            for other_function in where.program.functions
            if other_function.line > function.line and other_function.kind != "lambda"
        )
        if seen.between(where.path, function.line, lines[0] if lines else float("inf")):
            return False
        makes = makes or relevance.makes(function, where)
    return makes


def _methods(functions: dict[str, list[tuple[Source, Function]]], plugin: Plugin) -> Iterator[tuple[Source, Function]]:
    """The methods of a class that have a body."""
    separator, name = plugin.source.separator, plugin.definition.name
    short = {
        function.name for path in (plugin.source,) for function in path.program.functions if function.owner == name
    }
    for full in sorted(short):
        if full.startswith(f"{name}{separator}"):
            for where, function in functions.get(full, ()):
                if function.owner == name and function.body is not None and where.package == plugin.source.package:
                    yield where, function


def _ros1(types: Types, plugin: Plugin) -> Job:
    node, entry, place = _parts(plugin, 1)
    server = ParameterServer(())
    provided = Perhaps(SET)

    def parameter(full: str) -> Value | None:
        return provided if "?" in full else server.get(full)

    def follow() -> tuple[tuple[Node, ...], tuple[Problem, ...]]:
        followed = run_node(types, entry, plugin.files, Instance("/?", "/", None, {}, "/?"), parameter)
        ends = endpoints(followed.made, lambda item: item.name, server.get)
        unknowns = (
            *incomplete(followed, entry, place),
            Unknown("name", HOST, place),
            Unknown("endpoints", MORE, place),
        )
        made = replace(node, kind=node.kind if ends else PROGRAM, endpoints=ends, unknowns=unknowns)
        return (made,), followed.problems

    return Job(node, id(entry), follow, ros2_system.size_of(types, plugin.files), label=ros2_system.PLUGINS)


def _ros2(types: Types, plugin: Plugin) -> Job:
    node, entry, place = _parts(plugin, 2)
    started = Started((), Parameters(()), (), False)

    def follow() -> tuple[tuple[Node, ...], tuple[Problem, ...]]:
        nodes, problems = ros2_system.nodes_of(types, entry, plugin.files, node, started, False)
        first, *others = nodes
        own = tuple(end for end in first.endpoints if not (end.implicit and end.location == place))
        if not own:
            return (replace(node, kind=PROGRAM),), problems
        more = Unknown("endpoints", MORE, place)
        return (replace(first, endpoints=own, unknowns=(*first.unknowns, more)), *others), problems

    return Job(node, id(entry), follow, ros2_system.size_of(types, plugin.files), label=ros2_system.PLUGINS)


def _parts(plugin: Plugin, ros: int) -> tuple[Node, Entry, Location]:
    """The node before anything is known of it, where it begins, and the place of the class."""
    described, place = plugin.described, Location(plugin.source.path, plugin.definition.line)
    begin = partial(_begin, plugin, ros)
    entry = Entry(plugin.source, definition=plugin.definition, begin=begin, label="(plug-in)")
    kind = described.type.strip()
    node = Node(name="/?", kind="node", package=described.package, type=kind, location=place, process="/?")
    return replace(node, class_name=kind, ros=ros), entry, place


def _begin(plugin: Plugin, ros: int, walk: Walk, frame: Frame) -> None:
    """Construct the class, initialise it, and let the rest be called later."""
    source, definition = plugin.source, plugin.definition
    location = Location(source.path, definition.line)
    this = Object(definition.name, (), (source, definition), location=location)
    outside = next(iter(methods.library_bases(walk, source, definition)), None)
    if outside is not None and outside != "object":
        message = f"the base class {outside} is not in the workspace: what it makes and calls is not known"
        walk.gaps.setdefault(message, location)
    provided = _node(walk, source, location) if ros == 2 else None
    if source.separator == ".":
        context = (
            Object("(context)", fields={"node": Cell(provided)}) if provided is not None else Opaque(OWN, location)
        )
        construct.python_construct(walk, frame, this, (PassedArgument(context),), location)
        return
    if provided is not None:
        this.fields.update((name, Cell(provided)) for name in MEMBERS)
    construct.initialise(walk, frame, this, (source, definition), {}, (), location)
    callbacks.framework_entries(walk, this)
    if provided is not None:
        _give(walk, this, provided)
    _call(walk, frame, plugin, this, provided)


def _give(walk: Walk, this: Object, provided: Object) -> None:
    """The node for the members of base classes in the workspace, which others set."""
    for name in MEMBERS:
        cell = this.fields.get(name)
        if cell is not None and cell.type is not None and _class(pointee(cell.type)) in NODES:
            walk.state.write(cell, provided)


def _call(walk: Walk, frame: Frame, plugin: Plugin, this: Object, provided: Object | None) -> None:
    """Initialise the plug-in, and let its other methods be called back."""
    location = Location(plugin.source.path, plugin.definition.line)
    for name in sorted(_overridden(walk, plugin), key=lambda item: item not in BEGINNING):
        found = methods.method_of(walk, this, name)
        if found is None or not walk.relevance.makes(found.function, found.source):
            continue
        arguments = _arguments(walk, found.function, found.source, provided, location)
        if name in BEGINNING:
            activation.invoke(walk, frame, found, arguments)
        else:
            callbacks.register(walk, replace(found, bound=(*found.bound, *(argument.value for argument in arguments))))


def _node(walk: Walk, source: Source, location: Location) -> Object:
    """The node of whoever loads the plug-in."""
    others = {"?": Perhaps(SET, location)}
    node = RosNode("/?", "/", "/", GIVEN, "", location, given=others, why=(HOST, location))
    walk.nodes.append(node)
    return Object(NODE if source.separator == "::" else "rclpy.node.Node", node=node)


def _overridden(walk: Walk, plugin: Plugin) -> list[str]:
    """The last parts of the names of methods that are called from outside: the virtual ones, and those that no method of the class calls."""
    own = list(_methods(walk.index.functions, plugin))
    called = {name.lstrip(".") for where, function in own for name in walk.relevance.calls_of(function, where)}
    short = plugin.definition.name.rpartition("::")[2]
    virtual = {f.name for f in plugin.source.program.functions if f.is_virtual and f.owner == plugin.definition.name}
    found: dict[str, None] = {}
    for _, function in own:
        last = function.name.rpartition("::")[2]
        if last.lstrip("~") != short and (function.name in virtual or last in BEGINNING or last not in called):
            found[last] = None
    return list(found)


def _arguments(
    walk: Walk, function: Function, source: Source, provided: Object | None, location: Location
) -> tuple[PassedArgument, ...]:
    """The node for the parameters that take one; what else is given is not known."""
    inner = Frame(source, function.owner, function)
    found = []
    for parameter in function.parameters:
        kind = pointee(walk.type_in(parameter.type, inner))
        name = _class(kind)
        if name == HANDLE:
            space = Text(("/", Opaque(OWN, location)))
            found.append(PassedArgument(Object(HANDLE, namespace=space), None, syntax.Type(HANDLE), parameter.name))
        elif name in NODES and provided is not None:
            found.append(PassedArgument(provided, None, syntax.Type(NODE), parameter.name))
        else:
            found.append(
                PassedArgument(
                    walk.opaque("what a plug-in is given", inner, function.line, kind), None, kind, parameter.name
                )
            )
    return tuple(found)


def _class(kind: syntax.Type) -> str:
    """The name of a class, also where a type of it that is a pointer is meant."""
    return next((kind.name.removesuffix(end) for end in POINTERS if kind.name.endswith(end)), kind.name)
