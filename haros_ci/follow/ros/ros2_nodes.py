# SPDX-License-Identifier: Apache-2.0
"""Nodes of a ROS 2 process in the code: what constructs one, and which one an entry of an API row belongs to."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING

from haros_ci.follow import twins
from haros_ci.graph.given_parameters import Parameters
from haros_ci.graph.names import clean, pattern
from haros_ci.graph.parameters import Perhaps
from haros_ci.graph.ros2_process import RemappingRule, RosArguments, RosNode, from_arguments, named, ros_arguments
from haros_ci.model.api import Entry
from haros_ci.model.location import Location
from haros_ci.values.abstract import NONE, Cell, Choice, Known, Mapped, Object, Opaque, Pointer, Sequence, Value
from haros_ci.values.given import looked_at, marked

if TYPE_CHECKING:
    from haros_ci.follow.ros.selectors import Applied
    from haros_ci.follow.walk import Walk

#: The class of a node in the client libraries, by language's separator.
NODE = {"::": "rclcpp::Node", ".": "rclpy.node.Node"}
NODE_OPTIONS = "rclcpp::NodeOptions"
#: Methods that no other class has: what they are called on is a node.
UNMISTAKABLE = frozenset(
    "create_publisher create_subscription create_service create_client create_generic_publisher "
    "create_generic_subscription create_wall_timer declare_parameter declare_parameters".split()
)
#: Options of a node that say what it makes by itself.
SWITCHES = (
    "start_parameter_services",
    "enable_rosout",
    "start_parameter_event_publisher",
    "automatically_declare_parameters_from_overrides",
)
#: The options of nodes that a library makes beside the one that it is given, and what they switch off.
HIDDEN = Known("hidden")
#: The options of a row for a node that declares whatever it is given.
DECLARING = Known("declaring")
UNIQUE = "the library gives it another name each time"
HIDES = ("start_parameter_services", "start_parameter_event_publisher")
#: Of options: they are those that a component is given. Of a node: nothing is for it that the process is given.
CONTAINED, ALONE = "(contained)", "(alone)"
#: Of a node: it has parameters that it does not declare, or may have (rclcpp/node_options.hpp; rclpy/node.py).
UNDECLARED = "(undeclared)"
MAY_DECLARE = ("allow_undeclared_parameters", "automatically_declare_parameters_from_overrides")
#: Of a managed node: whether it offers services for its life cycle; it does where nothing is said.
MANAGED = "(managed)"
#: A parameter that a node's options may set.
OTHERS = Perhaps("it may be set in the node's options, which are not known")
#: The parameter of every node that says whether it takes its time from a topic.
SIM_TIME = "use_sim_time"
#: Fields of an object that hold its node, or the object that has it.
HOLDING = ("node", "node_")
#: The field of a node that holds the options that it was constructed with.
GIVEN = "(options)"
#: Libraries that declare no parameters on nodes but those of every node.
DECLARING_NOTHING = (
    "rclcpp::",
    "rclcpp_",
    "rclpy.",
    "std::",
    "boost::",
    "tf2_ros",
    "message_filters",
    "launch",
    "threading.",
)
UNKNOWN_NODE = "which node it belongs to is not known"


def construct(applied: Applied, entry: Entry, target: Object) -> None:
    """*target* becomes a node: under the name that it is given, unless its options or the process's arguments rename it."""
    from haros_ci.follow.ros.selectors import value_at

    walk = applied.walk
    process = walk.context.process
    assert process is not None
    if "parent" in entry.values:
        found = of_value(walk, value_at(applied, entry.values["parent"]))
        below = value_at(applied, entry.values["namespace"]) if "namespace" in entry.values else None
        text, why, where = pattern(below if below is not None else NONE)
        if found is not None:
            inner = found.expand(text) if not text.startswith(("/", "~")) else found.space
            target.node = RosNode(
                name=found.name,
                own=found.own,
                space=inner,
                kind=found.kind,
                class_name=found.class_name,
                location=applied.location,
                rules=found.rules,
                given=found.given,
                why=(why, where) if why is not None else found.why,
                main=found.whole,
                options=found.options,
            )
        return
    name = value_at(applied, entry.values["name"]) if "name" in entry.values else None
    if "anonymous" in entry.values and value_at(applied, entry.values["anonymous"]) != Known(False):
        name = Opaque(UNIQUE, applied.location)
    space = value_at(applied, entry.values["namespace"]) if "namespace" in entry.values else None
    options = value_at(applied, entry.values["options"]) if "options" in entry.values else None
    if isinstance(options, Object) or len(applied.args) == 1:
        target.fields[GIVEN] = Cell(options if isinstance(options, Object) else Object(NODE_OPTIONS))
    is_managed = value_at(applied, entry.values["lifecycle"]) == Known(True) if "lifecycle" in entry.values else False
    target.node = made(walk, target, name, space, options, applied.location, is_managed)


def made(
    walk: Walk,
    target: Object,
    name: Value | None,
    space: Value | None,
    options: Value | None,
    location: Location,
    is_managed: bool = False,
) -> RosNode:
    """A node of the process by the name, namespace and options that its constructor is given."""
    process = walk.context.process
    assert process is not None
    text, why, where = pattern(name) if name is not None else ("?", "the code does not tell its name", location)
    options = options.cell.value if isinstance(options, Pointer) else options
    if options == HIDDEN:  # its options rename it to its own name, whatever the process is given
        options = Object(NODE_OPTIONS, fields={option: Cell(Known(False)) for option in HIDES})
        local, is_open, why = RosArguments((RemappingRule("", "__node", text),)), False, why or UNIQUE
    else:
        if options == DECLARING:
            options = Object(NODE_OPTIONS, fields={name: Cell(Known(True)) for name in MAY_DECLARE})
        if process.component is not None and not walk.nodes and _may_be_given(space, options):
            space = None if options is None else space
            options = options_for(walk)
            options.fields.update((name, Cell(Opaque("it may be set"))) for name in MAY_DECLARE)
        local, is_open = _arguments(options)
    above, space_why, space_where = pattern(space) if space is not None and space != NONE else ("", None, None)
    is_contained = process.component is not None and (isinstance(options, Opaque) or _flag(options, CONTAINED) is True)
    is_global = _flag(options, "use_global_arguments") is not False
    rules = (*local.rules, *(process.rules if is_global else ()))
    full, own = named(text, above, rules)
    unknown = None
    if is_open:
        full, own, unknown = "/?", "/?", ("the arguments in its options are not known", location)
    elif "?" in full:
        unknown = (why or space_why or "it is renamed to what is not known", where or space_where or location)
    switches = {switch: flag for switch in SWITCHES if (flag := _flag(options, switch)) is not None}
    if not is_contained and not is_global:
        switches[ALONE] = True
    if isinstance(options, Opaque) or any(
        _field(options, name) not in (None, NONE, Known(False)) for name in MAY_DECLARE
    ):
        switches[UNDECLARED] = True
    overrides = {key: looked_at(value) for key, value in _overrides(options).items()}
    provided = {**_parameters(local, full, location), **overrides}
    sim_time = provided.get(SIM_TIME)
    if isinstance(sim_time, Known) and issubclass(sim_time.kind, bool):
        switches[SIM_TIME] = sim_time.of(bool)
    node = RosNode(
        name=full,
        own=own,
        space=own,
        kind="lifecycle" if is_managed else "node",
        class_name=target.name,
        location=location,
        conditions=walk.around,
        rules=rules,
        given=provided,
        why=unknown,
        options=switches,
    )
    if not is_open and not is_contained:
        twins.made(walk, target, full, named(text, above, local.rules)[0], location)
    if not walk.quiet:
        known = next((n for n in walk.nodes if (n.name, n.location) == (full, location)), None)
        if known is None:
            walk.nodes.append(node)
    return node


def _may_be_given(space: Value | None, options: Value | None) -> bool:
    """Whether options that are not known (or what may be a namespace instead) are most likely those that the component is given."""
    return isinstance(options, Opaque) or (options is None and isinstance(space, Opaque))


def options_for(walk: Walk) -> Object:
    """The NodeOptions that a component is constructed with: what the container, or launch, gives it."""
    process = walk.context.process
    words: list[str] = ["--ros-args"]
    for rule in (process.component or ()) if process is not None else ():
        head = f"{rule.node}:{rule.source}" if rule.node else rule.source
        words += ["-r", f"{head}:={rule.target}"]
    cells: tuple[Cell, ...] = tuple(Cell(walk.context.marks.known(word)) for word in words)
    fields: dict[str, Cell] = {
        "arguments": Cell(Sequence(Cell(cells))),
        "use_global_arguments": Cell(Known(process is None or process.component is None)),
        CONTAINED: Cell(Known(True)),
    }
    return Object(NODE_OPTIONS, fields=fields)


def options_of(walk: Walk, node: Value | None) -> Value | None:
    """A copy of the options that a node was constructed with (``rclcpp::Node::get_node_options``); None if not known."""
    held = _field(node.cell.value if isinstance(node, Pointer) else node, GIVEN)
    return copied(held) if isinstance(held, Object) else None


def copied(held: Object) -> Object:
    """A copy of a node's options, whose words can be changed without those of *held*."""
    fields = {name: Cell(cell.value, cell.type) for name, cell in held.fields.items()}
    words = _field(held, "arguments")
    if isinstance(words, Sequence):
        content = words.content.value
        cells = tuple(Cell(cell.value, cell.type) for cell in content) if isinstance(content, tuple) else content
        fields["arguments"] = Cell(Sequence(Cell(cells), words.type))
    return Object(held.name, held.arguments, fields=fields)


def _field(value: Value | None, name: str) -> Value | None:
    if isinstance(value, Object) and name in value.fields:
        return value.fields[name].value
    return None


def _flag(options: Value | None, name: str) -> bool | None:
    held = _field(options, name)
    return held.of(bool) if isinstance(held, Known) and issubclass(held.kind, bool) else None


def _arguments(options: Value | None) -> tuple[RosArguments, bool]:
    """The arguments in a node's options, and whether there may be others."""
    held = _field(options, "arguments")
    if held is None or held == NONE:
        return RosArguments(), False
    words: list[str] = []
    if isinstance(held, Known) and issubclass(held.kind, list):
        words = [str(word) for word in held.of(list)]
    elif isinstance(held, Sequence) and isinstance(held.content.value, tuple):
        words = [pattern(marked(cell.value))[0] for cell in held.content.value]
    else:
        return RosArguments(), True
    return ros_arguments(words), False


def _parameters(local: RosArguments, node: str, location: Location) -> dict[str, Value]:
    """What the arguments in a node's own options give it; ``?`` stands for what files may say."""
    provided = Parameters(from_arguments(local, location))
    found: dict[str, Value] = {name: provided.get(node, name) or NONE for name in provided.of(node)}
    if local.files:
        found["?"] = Perhaps("a parameter file in the node's options may set it", location)
    return found


def _overrides(options: Value | None) -> dict[str, Value]:
    """The parameters in a node's options: ``parameter_overrides``, ``append_parameter_override``; ``?`` for others."""
    held = _field(options, "parameter_overrides")
    found: dict[str, Value] = {}
    appended, value = _field(options, "appended_name"), _field(options, "appended_value")
    if appended is not None and value is not None:
        found[str(appended.value) if isinstance(appended, Known) else "?"] = value
    if isinstance(held, Mapped) and isinstance(held.content.value, dict):
        return found | {str(key): cell.value for key, cell in held.content.value.items()}
    from haros_ci.follow.ros.ros2_selectors import listed

    items = listed(held) if held is not None and held != NONE else ()
    for item in (None,) if items is None else items:
        name = item["name"] if item is not None else None
        if item is not None and isinstance(name, Known) and "default" in item:
            found[str(name.value)] = item["default"]
        else:
            found["?"] = OTHERS
    if isinstance(found.get("?"), Known):
        found["?"] = OTHERS
    return found


def of_value(walk: Walk, value: Value | None, depth: int = 0) -> RosNode | None:
    """The node that a value is, or has; None if that is not known."""
    if isinstance(value, Pointer):
        value = value.cell.value
    if not isinstance(value, Object) or depth > 3:
        return None
    if isinstance(value.node, RosNode):
        return value.node
    for name in HOLDING:
        if name in value.fields:
            inner = of_value(walk, value.fields[name].value, depth + 1)
            if inner is not None:
                return inner
    return None


def handed(walk: Walk, name: str, values: Iterable[Value]) -> None:
    """Nodes among *values* are handed to the function or class *name*, which is not seen and may declare parameters on them."""
    if walk.context.process is not None and not name.startswith(DECLARING_NOTHING):
        for value in values:
            found = of_value(walk, value)
            for node in walk.nodes:
                if found is not None and node.name == found.name:
                    node.options[UNDECLARED] = True


def remapped(walk: Walk, node: RosNode, name: str) -> str:
    """What the absolute *name*, with marks, is remapped to; where marks hide which rule is for it, it depends on what they stand for."""
    marks = walk.context.marks
    found = node.remap(name)
    whole = marks.real(name)
    if whole == name and marks.real(node.name) == node.name:
        return found
    message = _as_named(walk, node).remap(clean(whole))
    if message == clean(marks.real(found)):
        return found
    marks.looked_at(name + node.name)
    return message


def _as_named(walk: Walk, node: RosNode) -> RosNode:
    """*node* with the names that it is given instead of their marks."""
    real = walk.context.marks.real
    name, own, space = (clean(real(text)) for text in (node.name, node.own, node.space))
    rules = tuple(replace(rule, target=real(rule.target)) for rule in node.rules)
    main = _as_named(walk, node.main) if node.main is not None else None
    return replace(node, name=name, own=own, space=space, rules=rules, main=main)


#: Why there is no node: the pointer to it is null, so nothing is made on it.
NO_NODE = "there is no node: it is null"


def of_entry(applied: Applied, entry: Entry) -> tuple[RosNode | None, str]:
    """The node that an entry is made on: what ``namespace`` selects, else the receiver; and why it is not known."""
    from haros_ci.follow.ros.selectors import value_at

    walk = applied.walk
    chosen = value_at(applied, entry.values["namespace"]) if "namespace" in entry.values else applied.receiver
    if isinstance(chosen, Choice):
        every = [of_value(walk, option) for option in chosen.options]
        if every and every[0] is not None and all(node is every[0] for node in every):
            return every[0], ""
        return None, "it belongs to one of several nodes"
    found = of_value(walk, chosen)
    if found is not None:
        return found, ""
    if chosen == NONE:
        return None, NO_NODE
    if isinstance(chosen, Object) and chosen.definition is not None and chosen is applied.receiver:
        chosen.node = made(walk, chosen, None, None, None, chosen.location or applied.location)
        return chosen.node, ""
    return None, chosen.reason if isinstance(chosen, Opaque) else UNKNOWN_NODE
