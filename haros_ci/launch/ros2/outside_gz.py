# SPDX-License-Identifier: Apache-2.0
"""The launch files of ros_gz, which start the new Gazebo's server, bring models to it and bridge its topics.

Only what matters for the system is here (https://github.com/gazebosim/ros_gz/tree/jazzy, ros_gz_sim/launch and ros_gz_bridge/launch).
"""

from __future__ import annotations

from collections.abc import Callable

from haros_ci.model.launch_actions import Action, ParameterSource, Phrase, Substitution, Test
from haros_ci.model.location import Location

#: The launch files, without their ends.
BRIDGE = "$(find-pkg-share ros_gz_bridge)/launch/ros_gz_bridge.launch"
SERVER, SPAWN = (f"$(find-pkg-share ros_gz_sim)/launch/gz_{item}.launch" for item in ("server", "spawn_model"))
#: Arguments of ``create``, each by the parameter that it sets.
MODEL = {
    "world": "world",
    "file": "file",
    "string": "model_string",
    "topic": "topic",
    "name": "entity_name",
    **{name: name for name in ("allow_renaming", "x", "y", "z", "R", "P", "Y")},
}


def value(name: str) -> Substitution:
    return Substitution("var", ((name,),))


def argument(name: str, default: str, place: Location) -> Action:
    return Action(kind="arg", location=place, phrases=(("name", (name,)), ("default", (default,) if default else ())))


def _test(kind: str, name: str, place: Location) -> Test:
    return Test(kind=kind, phrases=((value(name),),), text=name, location=place)


def _parameters(names: dict[str, str], place: Location) -> tuple[ParameterSource, ...]:
    values = tuple(((name,), (value(text),)) for name, text in names.items())
    return (ParameterSource(kind="values", location=place, values=values),)


def _program(
    package: str, executable: str, plugin: str, name: Phrase, space: Phrase, parameters: dict[str, str], place: Location
) -> tuple[Action, ...]:
    """A node, or its component in a container of its own or of others, as ``use_composition`` and ``create_own_container`` say."""
    set_parameters = _parameters(parameters, place)
    naming = tuple((key, phrase) for key, phrase in (("name", name), ("namespace", space)) if phrase)
    component = Action(
        kind="component",
        location=place,
        phrases=(("package", (package,)), ("plugin", (plugin,)), *naming),
        parameters=set_parameters,
    )
    composed, own = _test("if", "use_composition", place), "create_own_container"
    container = (("package", ("rclcpp_components",)), ("executable", ("component_container",)))
    called = (value("container_name"),)
    return (
        Action(
            kind="node",
            location=place,
            phrases=(("package", (package,)), ("executable", (executable,)), *naming),
            parameters=set_parameters,
            tests=(_test("unless", "use_composition", place),),
        ),
        Action(
            kind="container",
            location=place,
            phrases=(*container, ("name", called), ("handle", (f"{place.path}:{place.line}:{package}",))),
            children=(component,),
            tests=(composed, _test("if", own, place)),
        ),
        Action(
            kind="load",
            location=place,
            phrases=(("target", called),),
            children=(component,),
            tests=(composed, _test("unless", own, place)),
        ),
    )


def _composition(place: Location) -> tuple[Action, ...]:
    provided = (("container_name", "ros_gz_container"), ("create_own_container", "False"), ("use_composition", "False"))
    return tuple(argument(name, default, place) for name, default in provided)


def _bridge(place: Location) -> tuple[Action, ...]:
    arguments = (
        *(argument(item, "", place) for item in ("bridge_name", "config_file", "namespace")),
        *_composition(place),
    )
    name, space = (value("bridge_name"),), (value("namespace"),)
    provided = {"config_file": "config_file"}
    return (
        *arguments,
        *_program("ros_gz_bridge", "bridge_node", "ros_gz_bridge::RosGzBridge", name, space, provided, place),
    )


def _server(place: Location) -> tuple[Action, ...]:
    names = {item: item for item in ("world_sdf_file", "world_sdf_string")}
    arguments = (*(argument(name, "", place) for name in names), *_composition(place))
    return (*arguments, *_program("ros_gz_sim", "gzserver", "ros_gz_sim::GzServer", ("gz_server",), (), names, place))


def _spawned(place: Location) -> tuple[Action, ...]:
    phrases = (("package", ("ros_gz_sim",)), ("executable", ("create",)))
    provided = {name: passed for name, passed in MODEL.items() if len(name) > 1}  # its place is of no consequence
    node = Action(kind="node", location=place, phrases=phrases, parameters=_parameters(provided, place))
    return (*(argument(item, "False" if item == "allow_renaming" else "", place) for item in provided.values()), node)


def _includes(*files: str) -> Callable[[Location], tuple[Action, ...]]:
    """Includes of *files*, which take their arguments from the file that includes them."""

    def actions(place: Location) -> tuple[Action, ...]:
        return tuple(Action(kind="include", location=place, phrases=(("file", (f"{file}.py",)),)) for file in files)

    return actions


_SIM = "$(find-pkg-share ros_gz_sim)/launch/ros_gz_"
FILES: dict[str, Callable[[Location], tuple[Action, ...]]] = {
    f"{name}{end}": actions
    for name, actions in (
        (BRIDGE, _bridge),
        (SERVER, _server),
        (SPAWN, _spawned),
        (f"{_SIM}sim.launch", _includes(SERVER, BRIDGE)),
        (f"{_SIM}spawn_model.launch", _includes(BRIDGE, SPAWN)),
    )
    for end in ("", ".py")
}
