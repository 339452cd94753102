# SPDX-License-Identifier: Apache-2.0
"""Controllers and robot hardware of ros_control (ROS 1) in the workspace: each by itself, on the node that loads it.

They have node handles of the process that has the controller manager: the manager's own, and one below it by the name that the controller
is loaded under (controller_manager.cpp, controller.h, combined_robot_hw.cpp of ros-controls/ros_control).
"""

from __future__ import annotations

from collections.abc import Callable as Callable_
from collections.abc import Hashable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial

from haros_ci import syntax
from haros_ci.follow import activation, callbacks, construct, methods
from haros_ci.follow.call_arguments import PassedArgument
from haros_ci.follow.follow import Entry
from haros_ci.follow.frames import Frame
from haros_ci.follow.ros.ends import endpoints
from haros_ci.follow.walk import Walk
from haros_ci.graph.parameters import ParameterServer, Perhaps
from haros_ci.index.index import Source
from haros_ci.model.architecture import Node, Unknown
from haros_ci.model.build import PluginClass
from haros_ci.model.launch import Started
from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass
from haros_ci.syntax import Class, Function
from haros_ci.systems.entries import base_of, described_classes
from haros_ci.systems.following import Instance, Types, incomplete, run_node
from haros_ci.systems.ros2_system import PLUGINS, size_of
from haros_ci.systems.system import PROGRAM, Job
from haros_ci.values.abstract import Callable, Known, Object, Opaque, Text, Value

#: Base classes of plug-ins, and what is called of them after ``init``.
CONTROLLER, HARDWARE = "controller_interface::ControllerBase", "hardware_interface::RobotHW"
LATER: Mapping[str, tuple[str, ...]] = {
    CONTROLLER: ("starting", "update", "stopping", "waiting", "aborting"),
    HARDWARE: ("prepareSwitch", "doSwitch", "read", "write"),
}
#: What initialises either: a controller may have several of these.
FIRST = ("initRequest", "init")
HANDLE = "ros::NodeHandle"
#: Why the name of the node is not known, nor that of what is below the plug-in's own name.
HOST = "it is the node of the process that has the controller manager"
OWN = "it is called as whoever loads it says"
GIVEN = Perhaps("whoever loads it may set it")
#: How the names of base classes begin that make nothing.
PLAIN = ("controller_interface::", "hardware_interface::", "std::", "boost::")


#: The kind of what is no node, but a controller that a spawner asks for: its node has what it makes on the node of its manager.
LOADED = "controller"


@dataclass(frozen=True, slots=True)
class PluginOfControl:
    """A class that a description names *plugin*: its *base* class is one of ``LATER``, and it is made of *files*."""

    plugin: PluginClass
    base: str
    source: Source
    definition: Class
    files: frozenset[str]


def described(types: Types) -> dict[str, PluginOfControl]:
    """The classes that plug-in descriptions of ROS 1 packages name, by these names."""
    builds = types.programs.builds.items()
    if not any(_base(plugin) for package, build in builds if _is_ros1(types, package) for plugin in build.plugins):
        return {}
    found: dict[str, PluginOfControl] = {}
    for plugin, source, definition, files in described_classes(types.programs):
        base = _base(plugin)
        if base and _is_ros1(types, plugin.package):
            found.setdefault(plugin.name, PluginOfControl(plugin, base, source, definition, files))
    return found


def jobs(types: Types, launched: Iterable[Job] = ()) -> Iterator[Job]:
    """The classes that are none of the *launched*, each by itself, in the order of their packages and names."""
    seen: set[Hashable] = {job.group for job in launched if job.node.kind == LOADED}
    found = {}
    for item in described(types).values():
        if id(item.definition) not in seen:
            seen.add(id(item.definition))
            begin = partial(_begin, item.source, item.definition, item.base, None)
            entry = Entry(item.source, definition=item.definition, begin=begin, label="(ros_control)")
            found[item.plugin.package, item.plugin.name] = entry, item.plugin.type.strip(), item.files
    for (package, name), (entry, kind, files) in sorted(found.items(), key=lambda item: item[0]):
        yield _job(types, entry, files, package, name, kind)


def loaded(
    types: Types, item: PluginOfControl, spaces: tuple[str, str], by: Started, parameter: Callable_[[str], Value | None]
) -> Job:
    """A controller that a spawner *by* asks for; its handles are in *spaces*, that of the manager and its own, and *parameter* gives what is set.

    Its node has the kind ``LOADED``, the name of its own space, and what it makes.
    """
    place = by.location
    begin = partial(_begin, item.source, item.definition, item.base, spaces)
    label = f"(ros_control {spaces[0]} {spaces[1]})"
    entry = Entry(item.source, definition=item.definition, begin=begin, label=label)
    package, name = item.plugin.package, item.plugin.name
    kind = item.plugin.type.strip()
    node = Node(
        name=spaces[1],
        kind=LOADED,
        package=package,
        type=name,
        location=place,
        process="/?",
        class_name=kind,
        conditions=by.conditions,
    )

    def follow() -> tuple[tuple[Node, ...], tuple[Problem, ...]]:
        followed = run_node(types, entry, item.files, Instance("/?", "/", None, {}, "/?"), parameter)
        ends = endpoints(followed.made, lambda made: made.name, parameter)
        unknowns = incomplete(followed, entry, Location(item.source.path, item.definition.line))
        return (replace(node, endpoints=ends, unknowns=unknowns),), followed.problems

    return Job(node, id(item.definition), follow, size_of(types, item.files))


def _base(plugin: PluginClass) -> str:
    name = base_of(plugin)
    return name if name in LATER else ""


def _is_ros1(types: Types, package: str) -> bool:
    return types.versions.get(package) != 2


def _job(types: Types, entry: Entry, files: frozenset[str], package: str, name: str, kind: str) -> Job:
    assert entry.definition is not None
    place = Location(entry.source.path, entry.definition.line)
    node = Node(name="/?", kind="node", package=package, type=name, location=place, process="/?", class_name=kind)
    server = ParameterServer(())

    def parameter(full: str) -> Value | None:
        return GIVEN if "?" in full else server.get(full)

    def follow() -> tuple[tuple[Node, ...], tuple[Problem, ...]]:
        followed = run_node(types, entry, files, Instance("/?", "/", None, {}, "/?"), parameter)
        ends = endpoints(followed.made, lambda item: item.name, server.get)
        unknowns = (*incomplete(followed, entry, place), Unknown("name", HOST, place))
        made = replace(node, kind=node.kind if ends else PROGRAM, endpoints=ends, unknowns=unknowns)
        return (made,), followed.problems

    return Job(node, id(entry), follow, size_of(types, files), label=PLUGINS, is_loaded=True)


def _begin(
    source: Source, definition: Class, base: str, spaces: tuple[str, str] | None, walk: Walk, frame: Frame
) -> None:
    """Construct the class, hand it its node handles in these *spaces*, and let the rest be called later."""
    location = Location(source.path, definition.line)
    this = Object(definition.name, (), (source, definition), location=location)
    outside = next(
        (
            library_base
            for library_base in methods.library_bases(walk, source, definition)
            if not library_base.startswith(PLAIN)
        ),
        None,
    )
    if outside is not None:
        message = f"the base class {outside} is not in the workspace: what it makes and calls is not known"
        walk.gaps.setdefault(message, location)
    construct.initialise(walk, frame, this, (source, definition), {}, (), location)
    for name in FIRST:
        for where, function in _overloads(walk, this, name):
            method = Callable(where, function, this, templates=this.templates)
            activation.invoke(walk, frame, method, _arguments(walk, function, where, location, spaces))
    for name in LATER[base]:
        found = methods.method_of(walk, this, name)
        if found is not None:
            callbacks.register(walk, found)


def _overloads(walk: Walk, this: Object, name: str) -> list[tuple[Source, Function]]:
    """The methods of that name that take node handles, those with fewer of them first, as they are called."""
    first = methods.method_of(walk, this, name)
    if first is None:
        return []
    declared = walk.index.functions.get(first.function.name, ())
    kinds: dict[int, tuple[Source, Function]] = {}
    for where, function in ((first.source, first.function), *declared):
        if function.owner == first.function.owner and (count := len(_handles(walk, function, where))):
            kinds.setdefault(count, (where, function))
    return [kinds[count] for count in sorted(kinds)]


def _handles(walk: Walk, function: Function, source: Source) -> list[int]:
    """The numbers of the parameters that are node handles."""
    inner = Frame(source, function.owner, function)
    return [
        number
        for number, parameter in enumerate(function.parameters)
        if walk.type_in(parameter.type, inner).name == HANDLE
    ]


def _arguments(
    walk: Walk, function: Function, source: Source, location: Location, spaces: tuple[str, str] | None
) -> tuple[PassedArgument, ...]:
    """The last node handle is below the plug-in's own name, one before it the manager's; what else is given is not known."""
    handles = _handles(walk, function, source)
    inner = Frame(source, function.owner, function)
    found = []
    for number, parameter in enumerate(function.parameters):
        kind = walk.type_in(parameter.type, inner)
        if number in handles:
            own: Value = Known(spaces[1]) if spaces else Text(("/", Opaque(OWN, location)))
            space = own if number == handles[-1] else Known(spaces[0] if spaces else "/")
            found.append(PassedArgument(Object(HANDLE, namespace=space), None, syntax.Type(HANDLE)))
        else:
            found.append(PassedArgument(walk.opaque("what a plug-in is given", inner, function.line, kind), None, kind))
    return tuple(found)
