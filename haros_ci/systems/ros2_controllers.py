# SPDX-License-Identifier: Apache-2.0
"""Controllers and hardware components of ros2_control in the workspace: plug-ins that a controller manager constructs and brings up.

What is called, and in which order, is that of controller_interface_base.cpp, controller_manager.cpp and
hardware_component_interface.cpp of ros-controls/ros2_control: a controller's node is made, with options of its own, before ``on_init``;
it offers no services for its life cycle.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial

from haros_ci import syntax
from haros_ci.follow import activation, callbacks, construct, methods
from haros_ci.follow.call_arguments import PassedArgument
from haros_ci.follow.follow import Entry
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import objects as library_objects
from haros_ci.follow.ros import api_rows, ros2_nodes
from haros_ci.follow.walk import Walk
from haros_ci.graph.given_parameters import Parameters
from haros_ci.graph.names import pattern
from haros_ci.graph.ros2_process import NAMES
from haros_ci.index.index import Source
from haros_ci.model.architecture import Node
from haros_ci.model.build import PluginClass
from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem
from haros_ci.syntax import Class
from haros_ci.systems import ros2_system
from haros_ci.systems.entries import Programs, base_of, described_classes
from haros_ci.systems.following import Controller, Types
from haros_ci.systems.ros2_processes import Started
from haros_ci.systems.system import PROGRAM, Job
from haros_ci.values.abstract import Cell, Object, Opaque, Pointer, Sequence, Value
from haros_ci.values.given import marked

#: Base classes of plug-ins, and the class of the framework that both kinds of each have (as in extract/apis/ros2_control.py).
CONTROLLERS = frozenset(
    ("controller_interface::ControllerInterface", "controller_interface::ChainableControllerInterface")
)
CONTROLLER = "controller_interface::ControllerInterfaceBase"
COMPONENTS = frozenset(f"hardware_interface::{item}Interface" for item in ("System", "Actuator", "Sensor"))
HARDWARE = "hardware_interface::HardwareComponentInterface"
#: The field that holds the node there, and what stands for the declarations that come before ``on_init``.
NODE, DECLARED = "ros2_control_node", f"{CONTROLLER}::declared_before_on_init"
#: Methods that are called later (controller_interface_base.hpp, chainable_controller_interface.hpp, system_interface.hpp).
LATER = (
    *("on_configure", "on_activate", "command_interface_configuration", "state_interface_configuration"),
    *("on_export_reference_interfaces", "on_export_reference_interfaces_list"),
    *("on_export_state_interfaces", "on_export_state_interfaces_list", "on_set_chained_mode"),
    *("update", "update_reference_from_subscribers", "update_and_write_commands"),
    *("export_state_interfaces", "export_command_interfaces", "prepare_command_mode_switch"),
    *("perform_command_mode_switch", "read", "write"),
    *("on_deactivate", "on_cleanup", "on_shutdown", "on_error"),
)
#: Why the name of a node is not known.
CALLED = "a controller is called as whoever loads it says"
COMPONENT = "a hardware component is called as the robot description says"
RATE = "it is the controller manager's"
#: How the names of base classes begin that have no endpoints.
PLAIN = (
    "controller_interface::",
    "hardware_interface::",
    "rclcpp",
    "std::",
    "semantic_components::",
    "realtime_tools::",
)


def controllers(programs: Programs, versions: Mapping[str, int | None]) -> dict[str, Controller]:
    """The controllers and hardware components that plug-in descriptions of ROS 2 packages name, by look-up name."""
    found: dict[str, Controller] = {}
    entries: dict[int, Entry] = {}
    every = (
        plugin for package, build in programs.builds.items() if versions.get(package) == 2 for plugin in build.plugins
    )
    if not any(_base(plugin) for plugin in every):
        return found
    for plugin, source, definition, files in described_classes(programs):
        base = _base(plugin)
        is_controller = base in CONTROLLERS
        if base and versions.get(plugin.package) == 2:
            begin = partial(_begin, source, definition, base)
            entry = entries.setdefault(
                id(definition), Entry(source, definition=definition, begin=begin, label="(ros2_control)")
            )
            found.setdefault(
                plugin.name, Controller(plugin.package, plugin.name, plugin.type.strip(), entry, files, is_controller)
            )
    return found


def _base(plugin: PluginClass) -> str:
    """The base class of a plug-in description, if it is one of those that a controller manager loads."""
    name = base_of(plugin)
    return name if name in CONTROLLERS or name in COMPONENTS else ""


def jobs(types: Types, launched: Iterable[Job]) -> Iterator[Job]:
    """The classes that none of the *launched* is, each by itself."""
    running = {id(types.controllers[job.node.type].entry) for job in launched if job.is_loaded}
    for _, controller in sorted(types.controllers.items()):
        if id(controller.entry) not in running:
            running.add(id(controller.entry))
            yield _alone(types, controller)


def _alone(types: Types, controller: Controller) -> Job:
    definition = controller.entry.definition
    assert definition is not None
    place = Location(controller.entry.source.path, definition.line)
    node = Node(
        name="/?",
        kind="node",
        package=controller.package,
        type=controller.name,
        location=place,
        process="/?",
        class_name=controller.type,
        ros=2,
    )
    started = Started((), Parameters(()), (), is_component=True)

    def follow() -> tuple[tuple[Node, ...], tuple[Problem, ...]]:
        nodes, problems = ros2_system.nodes_of(types, controller.entry, controller.files, node, started, False)
        if not controller.is_controller:  # whose node most releases do not have
            nodes = tuple(one for one in nodes if one.name != "/?" or any(not end.implicit for end in one.endpoints))
        return nodes or (replace(node, kind=PROGRAM),), problems

    size = ros2_system.size_of(types, controller.files)
    return Job(node, id(controller.entry), follow, size, label=ros2_system.PLUGINS, is_loaded=True)


def _begin(source: Source, definition: Class, base: str, walk: Walk, frame: Frame) -> None:
    """Construct the class, give it its node, and call what the manager calls."""
    location = Location(source.path, definition.line)
    this = Object(definition.name, (), (source, definition), location=location)
    node = _node(walk, base in CONTROLLERS, location)
    for name in (NODE, "node_"):
        this.fields[name] = Cell(node)
    _know_base(walk, this, base, location)
    construct.initialise(walk, frame, this, (source, definition), {}, (), location)
    _give(walk, this, node, base)
    if base in CONTROLLERS:
        rate = PassedArgument(Opaque(RATE, location, syntax.Type("int")))
        api_rows.call(walk, frame, DECLARED, this, (rate,), (), location)
    begins = methods.method_of(walk, this, "on_init") or methods.method_of(walk, this, "init")
    if begins is not None:
        activation.invoke(walk, frame, begins, ())
    for name in LATER:
        method = methods.method_of(walk, this, name)
        if method is not None:
            callbacks.register(walk, method, (), name in callbacks.TEARDOWN, name in callbacks.SETUP)


def _node(walk: Walk, is_controller: bool, location: Location) -> Object:
    """The node of a controller or hardware component, under the name that it is loaded by.

    A controller is given its name beside its options, in which no release has a rule for it (``determine_controller_node_options`` in
    controller_manager.cpp); so another node that is made with them has a name of its own. Those of a component have such a rule
    (hardware_component_interface.cpp).
    """
    options = ros2_nodes.options_for(walk)
    for item in ros2_nodes.MAY_DECLARE:
        options.fields[item] = Cell(Opaque("whether it is set depends on the release", location))
    node = Object("rclcpp_lifecycle::LifecycleNode" if is_controller else "rclcpp::Node", location=location)
    node.fields[ros2_nodes.GIVEN] = Cell(options)
    name = Opaque(CALLED if is_controller else COMPONENT, location)
    node.node = ros2_nodes.made(walk, node, name, None, options, location, is_controller)
    node.node.options[ros2_nodes.MANAGED] = False
    if is_controller:
        node.fields[ros2_nodes.GIVEN] = Cell(_unnamed(options))
    return node


def _unnamed(options: Object) -> Object:
    """A copy of a node's options without the rules that name the node."""
    result = ros2_nodes.copied(options)
    words = result.fields["arguments"].value
    cells = words.content.value if isinstance(words, Sequence) else None
    if isinstance(cells, tuple):
        named = {at for at, cell in enumerate(cells) if _is_naming(cell.value)}
        kept = tuple(cell for at, cell in enumerate(cells) if at not in named and at + 1 not in named)
        result.fields["arguments"] = Cell(Sequence(Cell(kept)))
    return result


def _is_naming(word: Value) -> bool:
    return pattern(marked(word))[0].partition(":=")[0] in NAMES


def _know_base(walk: Walk, this: Object, base: str, location: Location) -> None:
    """What the plug-in description says of a class that inherits from classes of other packages."""
    owners = library_objects.owners(walk, this)
    outside = next((owner for owner in owners if not owner.startswith(PLAIN)), None)
    if outside is not None:
        message = f"the base class {outside} is not in the workspace: what it makes and calls is not known"
        walk.gaps.setdefault(message, location)
    framework = CONTROLLER if base in CONTROLLERS else HARDWARE
    if outside is not None and framework not in owners:
        owners.append(framework)


def _give(walk: Walk, this: Object, node: Object, base: str) -> None:
    """The node for the members of the framework's own class, where that is in the workspace."""
    framework = CONTROLLER if base in CONTROLLERS else HARDWARE
    if framework not in walk.index.classes:
        return
    hidden = this.fields["impl_"].value if "impl_" in this.fields else None
    for holder in (this, hidden.cell.value if isinstance(hidden, Pointer) else hidden):
        if isinstance(holder, Object) and "node_" in holder.fields:
            walk.state.write(holder.fields["node_"], node)
