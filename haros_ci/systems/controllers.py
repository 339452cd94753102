# SPDX-License-Identifier: Apache-2.0
"""Controllers of ros2_control: nodes in a controller manager's process, loaded because a ``spawner`` asks for them.

What counts is controller_manager/spawner.py and controller_manager.cpp of ros-controls/ros2_control: a controller is called as the
spawner says, in the manager's namespace, and its class is the manager's parameter ``<name>.type``, which the spawner sets
from the parameter files that it is given.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace

from haros_ci.graph.given_parameters import Parameters
from haros_ci.graph.names import clean
from haros_ci.graph.words import shell_words
from haros_ci.model.architecture import Unknown
from haros_ci.model.launch import LaunchedNode, ParameterRule
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.values.abstract import Known, Opaque

PACKAGE = "controller_manager"
MANAGER, SPAWNERS = "ros2_control_node", ("spawner", "spawner.py")
#: The spawner of the releases before Humble: a manager's name without a slash is in the global namespace (``make_absolute``), not in the spawner's.
FORMER = "spawner.py"
#: What the manager is called unless something says otherwise.
DEFAULT = "controller_manager"
#: The option of a spawner that names a controller whose own options follow.
CONTROLLER = "--controller"
#: Options of a spawner that a value follows, by what they are short for.
TAKING = {
    "-c": "--controller-manager",
    "-n": "--namespace",
    "-p": "--param-file",
    "-t": "--controller-type",
    **{
        name: name
        for name in (
            "--controller-manager",
            "--namespace",
            "--param-file",
            "--controller-type",
            "--controller-ros-args",
            "--controller-manager-timeout",
            "--switch-timeout",
            "--service-call-timeout",
        )
    },
}


#: The kind of what is no node, but ``ros2 control load_controller`` (launch/ros2/node.py), and the options that a value follows there.
LOADING = "loading"
VERB_TAKING = {
    "-c": "--controller-manager",
    **{name: name for name in ("--controller-manager", "--set-state", "--state", "--spin-time")},
}


@dataclass(slots=True)
class _Asked:
    """A controller that a spawner asks for, and what it is given there."""

    name: str
    files: list[str]
    ros_arguments: list[str]


def with_controllers(
    nodes: tuple[LaunchedNode, ...],
    rules_of: Callable[[str, Location], Iterable[ParameterRule]],
    simulated: tuple[LaunchedNode, ...] = (),
) -> tuple[LaunchedNode, ...]:
    """*nodes*, each spawner of them under its own name, and the controllers that they bring; each controller once.

    A controller is of kind ``node``; its container is the manager. *rules_of* reads a parameter file that is named at a place. *simulated*
    are the managers that simulators have.
    """
    if not any(_is_spawner(node) or node.kind == LOADING for node in nodes):
        return nodes
    managers = _managers((*simulated, *nodes))
    found: list[LaunchedNode] = []
    places: dict[tuple[str | None, ...], int] = {}

    def add(node: LaunchedNode) -> None:
        places.setdefault((node.name, node.namespace, node.container), len(found))
        found.append(node)

    for node in nodes:
        if node.kind != LOADING and not _is_spawner(node):
            add(node)
            continue
        options, requested = (_loaded if node.kind == LOADING else _requested)(_words(node.arguments))
        if node.name is None and requested and "?" not in requested[0].name:
            node = replace(node, name=f"spawner_{requested[0].name}")
        if node.kind != LOADING:
            add(node)
        for item in requested:
            made = _controller(node, item, options, managers, rules_of)
            known = places.get((made.name, made.namespace, made.container))
            if known is None:
                add(made)
            elif len(made.conditions) < len(found[known].conditions):
                found[known] = made
    return tuple(found)


def _managers(nodes: Iterable[LaunchedNode]) -> dict[str, LaunchedNode]:
    """The controller managers of *nodes* by full name."""
    return {
        clean(f"{node.namespace or '/'}/{node.name or DEFAULT}"): node
        for node in nodes
        if node.package == PACKAGE and node.type == MANAGER
    }


def _is_spawner(node: LaunchedNode) -> bool:
    return node.package == PACKAGE and node.type in SPAWNERS


def _words(text: str) -> list[str]:
    words = shell_words(text)
    return words[: words.index("--ros-args")] if "--ros-args" in words else words


def _requested(words: Iterable[str]) -> tuple[dict[str, str], list[_Asked]]:
    """The options of a spawner with one value each, and the controllers in order (``parse_native_args``)."""
    options: dict[str, str] = {}
    files: list[str] = []
    arguments: list[str] = []
    found: list[_Asked] = []
    one = None
    for option, value in _options(words, TAKING, CONTROLLER):
        if option == CONTROLLER:
            one = _Asked(value, [], [])
            found.append(one)
        elif option == "--param-file":
            (files if one is None else one.files).append(value)
        elif option == "--controller-ros-args":
            (arguments if one is None else one.ros_arguments).append(value)
        elif option:
            options[option] = value
        elif value:
            found.append(_Asked(value, [], []))
    for requested in found:
        requested.files[:0] = files
        requested.ros_arguments[:0] = arguments
    return options, found


def _loaded(words: Iterable[str]) -> tuple[dict[str, str], list[_Asked]]:
    """The same of ``ros2 control load_controller``: one controller, perhaps with a parameter file (ros2controlcli)."""
    pairs = tuple(_options(words, VERB_TAKING))
    options = {option: value for option, value in pairs if option}
    plain = [value for option, value in pairs if not option]
    return options, [_Asked(plain[0], plain[1:2], [])] if plain else []


def _options(words: Iterable[str], taking: Mapping[str, str], differing: str = "") -> Iterator[tuple[str, str]]:
    """The options *taking* a value, with it, and "" with each word that is no option; the value of *differing* is always a word of its own."""
    option = ""
    for word in words:
        name, sign, value = word.partition("=")
        if option:
            yield option, word
            option = ""
        elif word in taking or (differing and word == differing):
            option = taking.get(word, word)
        elif sign and name in taking:
            yield taking[name], value
        elif not word.startswith("-"):
            yield "", word


def _controller(
    spawner: LaunchedNode,
    requested: _Asked,
    options: dict[str, str],
    managers: dict[str, LaunchedNode],
    rules_of: Callable[[str, Location], Iterable[ParameterRule]],
) -> LaunchedNode:
    called = options.get("--controller-manager", DEFAULT)
    space = "/" if spawner.type == FORMER else options.get("--namespace", spawner.namespace or "/")
    full = clean(called if called.startswith("/") else f"/{space}/{called}")
    manager = managers.get(full)
    namespace = full.rpartition("/")[0] or "/"
    own = clean(f"{namespace}/{requested.name}")
    rules = [*(manager.parameters if manager is not None else ()), *spawner.parameters]
    for path in requested.files:
        rules += rules_of(path, spawner.location)
    provided = Parameters(rules)
    kind, why = _type(requested.name, own, full, options, provided, manager is not None)
    unknowns: list[Unknown] = []
    if why is not None:
        unknowns.append(Unknown("type", why.reason, why.location or spawner.location))
    if "?" in own:
        unknowns.append(Unknown("name", "what the spawner is told is not known", spawner.location))
    return LaunchedNode(
        kind="node",
        package=kind.partition("/")[0],
        type=kind,
        location=spawner.location,
        name=requested.name,
        namespace=namespace,
        container=full,
        parameters=tuple(rules),
        remaps=manager.remaps if manager is not None else (),
        ros_arguments=" ".join(requested.ros_arguments),
        conditions=spawner.conditions,
        presence=spawner.presence,
        unknowns=tuple(unknowns),
    )


def _is_name(text: str) -> bool:
    """Whether *text* may be what a plug-in is looked up by: ``package/Class``, or its type where the description gives no name."""
    return "/" in text or "::" in text


def _type(
    name: str, own: str, manager: str, options: dict[str, str], provided: Parameters, is_started: bool
) -> tuple[str, Opaque | None]:
    """``package/Class`` of a controller, ``?`` with the reason if it is not known."""
    if "?" in name:
        return "?", None
    if "--controller-type" in options:
        return options["--controller-type"], None
    values = (provided.get(own, "type"), provided.get(manager, f"{name}.type"))
    for value in values:
        if isinstance(value, Known) and isinstance(value.value, str) and _is_name(value.value):
            return value.value, None
    for value in values:
        if isinstance(value, Opaque):
            return "?", value
    what = f"nothing sets the parameter {name}.type of {manager}"
    return "?", Opaque(what if is_started else f"{what}, which no launch file starts")
