# SPDX-License-Identifier: Apache-2.0
"""Plug-ins of Gazebo that the workspace builds: classes that a library registers, which a simulator constructs and loads.

What is called, and with what, is that of gazebo/common/Plugin.hh of gazebo-classic (``Load``, ``Init``, ``Reset``) and of gz/sim/System.hh of
gz-sim (``Configure``, ``PreUpdate``, ``Update``, ``PostUpdate``, ``Reset``).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial

from haros_ci.follow import activation, callbacks, construct, methods
from haros_ci.follow.call_arguments import PassedArgument
from haros_ci.follow.follow import Entry
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries.gazebo import HANDLE_NAME, Sdf, called, element, parent
from haros_ci.follow.ros.ends import by, endpoints
from haros_ci.follow.walk import Walk
from haros_ci.graph.given_parameters import Parameters
from haros_ci.graph.parameters import ParameterServer
from haros_ci.index.index import Source
from haros_ci.keeping.kept import digest_of
from haros_ci.model.architecture import Node, Unknown
from haros_ci.model.build import Target
from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass
from haros_ci.syntax import Class, Function
from haros_ci.systems import ros2_system
from haros_ci.systems.entries import Programs, files_of
from haros_ci.systems.following import Instance, Types, incomplete, run_node
from haros_ci.systems.ros2_processes import Started
from haros_ci.systems.ros2_system import PLUGINS, size_of
from haros_ci.systems.system import PROGRAM, Job
from haros_ci.values.abstract import Cell, Object, Value

#: The macros that register a plug-in, by where it stands in a world or description.
_CLASSIC = {f"GZ_REGISTER_{item.upper()}_PLUGIN": item for item in ("world", "model", "sensor", "visual", "system")}
REGISTERING = {**_CLASSIC, "GZ_ADD_PLUGIN": "gz", "IGNITION_ADD_PLUGIN": "gz"}
#: Methods of the classes for cameras and lasers.
_FRAMES = (
    "OnNewFrame",
    "OnNewImageFrame",
    "OnNewDepthFrame",
    "OnNewRGBPointCloud",
    "OnNewLaserScans",
    "OnNewLaserFrame",
)
#: What the simulator calls first, in order, and later; of the new Gazebo and of Gazebo Classic.
FIRST: Mapping[bool, tuple[str, ...]] = {True: ("Configure",), False: ("Load", "Init")}
LATER: Mapping[bool, tuple[str, ...]] = {
    True: ("PreUpdate", "Update", "PostUpdate", "Reset"),
    False: ("Reset", *_FRAMES),
}
#: The kind of what is no node, but what a plug-in makes on one.
PLUGIN = "plugin"
#: Why the name of the node is not known.
HOST = "it is the node of the simulator that loads it"
#: How the names of base classes begin that make nothing in ROS.
PLAIN = (
    *("gazebo::", "gz::", "ignition::", "std::", "boost::"),
    *("ModelPlugin", "WorldPlugin", "SensorPlugin", "VisualPlugin", "SystemPlugin"),
    *("CameraPlugin", "DepthCameraPlugin", "MultiCameraPlugin", "RayPlugin", "GpuRayPlugin"),
)


_Result = tuple[tuple[Node, ...], tuple[Problem, ...]]


@dataclass(frozen=True, slots=True)
class GazeboPlugin:
    """A class that a *library* of a *package* registers to stand *at* a place, made of *files*."""

    package: str
    library: str
    at: str
    source: Source
    definition: Class
    files: frozenset[str]


def built(programs: Programs) -> dict[str, list[GazeboPlugin]]:
    """The plug-ins of the workspace by the name of their library, as descriptions have it without ``lib`` and ``.so``."""
    registering = {path for path, source in programs.sources.items() if _registered(source)}
    found: dict[str, list[GazeboPlugin]] = {}
    if not registering:
        return found
    for package, build in sorted(programs.builds.items()):
        for target in build.targets:
            if target.kind != "library" or target.is_test:
                continue
            own = {*target.sources, *target.conditional_sources} & programs.sources.keys()
            places = registering & own.union(*(programs.cpp.reach(path) for path in own))
            files = files_of(programs, target) if places else frozenset[str]()
            for path in sorted(places):
                found.setdefault(target.output, []).extend(_of(programs, package, target, path, files))
    return found


def _registered(source: Source) -> list[tuple[str, str]]:
    """What a file registers: where it stands, and the class as it is written."""
    return [
        (REGISTERING[macro], arguments[0].strip())
        for macro, arguments, _, _ in source.program.registered
        if macro in REGISTERING and arguments
    ]


def _of(programs: Programs, package: str, target: Target, path: str, files: frozenset[str]) -> Iterator[GazeboPlugin]:
    for at, written in _registered(programs.sources[path]):
        owner = _class_of(programs, written, path)
        if owner is not None:
            yield GazeboPlugin(package, target.output, at, *owner, files)


def _class_of(programs: Programs, written: str, path: str) -> tuple[Source, Class] | None:
    """The class that is *written* in a registration in the file at *path*: the one of that name that the file can see."""
    name = written.removeprefix("::")
    reached = {path, *programs.cpp.reach(path)}
    found = [
        owner
        for item, owners in programs.cpp.classes.items()
        if item == name or item.endswith(f"::{name}")
        for owner in owners
        if owner[0].path in reached and (owner[1].bases or owner[1].fields)
    ]
    return min(found, key=lambda owner: (owner[1].name.count("::"), owner[0].path), default=None)


@dataclass(frozen=True, slots=True)
class Given:
    """What the simulator gives to a plug-in: its element of the description, and the *name* of what it stands in, if that is known."""

    sdf: Sdf
    name: str | None


def started(types: Types, gazebo_plugin: GazeboPlugin, parameter: Given, host: Node, server: ParameterServer) -> Job:
    """A plug-in in the simulator's node *host* of ROS 1; its node has the kind ``PLUGIN``, and the endpoints that *host* has by it."""
    begin = partial(_begin, gazebo_plugin.source, gazebo_plugin.definition, parameter, gazebo_plugin.at == "gz")
    label = f"(gazebo {digest_of(parameter)[:16]})"
    entry = Entry(gazebo_plugin.source, definition=gazebo_plugin.definition, begin=begin, label=label)
    node = replace(
        host,
        kind=PLUGIN,
        package=gazebo_plugin.package,
        type=gazebo_plugin.library,
        class_name=gazebo_plugin.definition.name,
    )
    instance = Instance(host.name, host.name.rpartition("/")[0] or "/", None, dict(host.remaps), host.name)

    def follow() -> _Result:
        followed = run_node(types, entry, gazebo_plugin.files, instance, server.get)
        ends = endpoints(followed.made, by(instance.remaps), server.get)
        unknowns = (
            *node.unknowns,
            *incomplete(followed, entry, Location(gazebo_plugin.source.path, gazebo_plugin.definition.line)),
        )
        return (replace(node, endpoints=ends, unknowns=unknowns),), followed.problems

    return Job(node, id(gazebo_plugin.definition), follow, size_of(types, gazebo_plugin.files))


def jobs(types: Types, launched: Iterable[Job]) -> Iterator[Job]:
    """The classes of all plug-ins that are none of the *launched*, each by itself."""
    seen = {job.group for job in launched if job.node.kind == PLUGIN}
    for library, every in sorted(types.gazebo.items()):
        for item in every:
            if id(item.definition) not in seen:
                seen.add(id(item.definition))
                name = library if len(every) == 1 else item.definition.name.rpartition("::")[2]
                yield _alone(types, item, f"{item.package}/{name}")


def _alone(types: Types, gazebo_plugin: GazeboPlugin, name: str) -> Job:
    """A plug-in by itself, called by its library, or by its class where that has several."""
    begin = partial(_begin, gazebo_plugin.source, gazebo_plugin.definition, None, gazebo_plugin.at == "gz")
    entry = Entry(gazebo_plugin.source, definition=gazebo_plugin.definition, begin=begin, label="(gazebo)")
    place = Location(gazebo_plugin.source.path, gazebo_plugin.definition.line)
    ros = 2 if types.versions.get(gazebo_plugin.package) == 2 else 1
    node = Node(
        name="/?",
        kind="node",
        package=gazebo_plugin.package,
        type=name,
        location=place,
        process="/?",
        class_name=gazebo_plugin.definition.name,
        ros=ros,
    )
    follow = partial(_of_ros2 if ros == 2 else _of_ros1, types, entry, gazebo_plugin, node)
    return Job(node, id(entry), follow, size_of(types, gazebo_plugin.files), label=PLUGINS, is_loaded=True)


def _of_ros1(types: Types, entry: Entry, gazebo_plugin: GazeboPlugin, node: Node) -> _Result:
    server = ParameterServer(())
    followed = run_node(types, entry, gazebo_plugin.files, Instance("/?", "/", None, {}, "/?"), server.get)
    ends = endpoints(followed.made, lambda item: item.name, server.get)
    unknowns = (*incomplete(followed, entry, node.location), Unknown("name", HOST, node.location))
    return (replace(node, kind=node.kind if ends else PROGRAM, endpoints=ends, unknowns=unknowns),), followed.problems


def _of_ros2(types: Types, entry: Entry, gazebo_plugin: GazeboPlugin, node: Node) -> _Result:
    started = Started((), Parameters(()), (), is_component=True)
    nodes, problems = ros2_system.nodes_of(types, entry, gazebo_plugin.files, node, started, False)
    makes = any(not end.implicit for one in nodes for end in one.endpoints)
    return (nodes if makes else (replace(node, kind=PROGRAM),)), problems


def _begin(source: Source, definition: Class, parameter: Given | None, is_new: bool, walk: Walk, frame: Frame) -> None:
    """Construct the class, hand it what the simulator hands it, and let the rest be called later."""
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
    if parameter is not None:
        this.fields[HANDLE_NAME] = Cell(called(parameter.sdf))
    construct.initialise(walk, frame, this, (source, definition), {}, (), location)
    for name in FIRST[is_new]:
        found = methods.method_of(walk, this, name)
        if found is not None:
            activation.invoke(walk, frame, found, _arguments(walk, found.function, found.source, parameter))
    for name in LATER[is_new]:
        found = methods.method_of(walk, this, name)
        if found is not None:
            callbacks.register(walk, found)


def _arguments(
    walk: Walk, function: Function, source: Source, given_parameter: Given | None
) -> tuple[PassedArgument, ...]:
    """What the simulator gives to a method: to ``Load`` what the plug-in stands in, and the element; else nothing is known of it."""
    inner = Frame(source, function.owner, function)
    values: list[Value] = []
    if given_parameter is not None and len(function.parameters) == 2:
        values = [parent(given_parameter.name), element(given_parameter.sdf)]
    found = []
    for number, parameter in enumerate(function.parameters):
        kind = walk.type_in(parameter.type, inner)
        what = walk.opaque("what the simulator gives to a plug-in", inner, function.line, kind)
        found.append(PassedArgument(values[number] if values else what, None, kind))
    return tuple(found)
