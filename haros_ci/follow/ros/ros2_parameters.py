# SPDX-License-Identifier: Apache-2.0
"""What a ROS 2 node has for a parameter: what it has declared or set itself, else what it is given from outside."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow.ros import ros2_nodes
from haros_ci.graph.given_parameters import NO_NAME, fits
from haros_ci.graph.names import pattern
from haros_ci.graph.ros2_process import RosNode
from haros_ci.index.ros_types import ros2_parameter_type
from haros_ci.values.abstract import NONE, TRUE, Cell, Known, Object, Opaque, Sequence, Value, join
from haros_ci.values.state import Held

if TYPE_CHECKING:
    from haros_ci.follow.made import MadeEntity
    from haros_ci.follow.ros.selectors import Applied
    from haros_ci.follow.walk import Walk
    from haros_ci.model.api import Entry

#: The type that a parameter has which is read so (rclcpp/parameter.hpp), or by that member (rcl_interfaces/ParameterValue).
READ_AS = {
    "as_bool": "bool",
    "as_int": "int",
    "as_double": "double",
    "as_string": "str",
    "as_byte_array": "bytes",
    "as_bool_array": "bool[]",
    "as_integer_array": "int[]",
    "as_double_array": "double[]",
    "as_string_array": "str[]",
    "bool_value": "bool",
    "integer_value": "int",
    "double_value": "double",
    "string_value": "str",
    "byte_array_value": "bytes",
    "bool_array_value": "bool[]",
    "integer_array_value": "int[]",
    "double_array_value": "double[]",
    "string_array_value": "str[]",
}
#: What reads it as the type of a template argument.
READ_BY = frozenset(("get_value", "get"))
#: Beginnings of names of parameters that a node may declare by itself, besides ``use_sim_time`` (rclcpp/node_impl.hpp).
BY_ITSELF = ("qos_overrides.", "start_type_description_service")
#: The class of what ``get_parameter`` returns.
PARAMETER = "rclcpp::Parameter"
#: Why it is not known what a callback reads that holds a switch.
SWITCHED = "it may be set while the node runs"
#: Marks a parameter of a list: a loop over it asks for the name, and reads it in another way in each branch.
LISTED = "[listed]"


def parameter(applied: Applied, node: RosNode, name: str, is_declared: bool = False) -> Value | None:
    """What *node* has for a parameter: what it has declared or set itself, else what it is given; None if nothing.

    Where it *is_declared* now, only what it has for certain counts: of the rest this is the first declaration. So it is
    of a name of which parts are not known: another one has those of its own.
    """
    own = applied.walk.declared.value
    if isinstance(own, Opaque):
        return own
    held = own.get(f"{node.whole.name}:{name}")
    if held is not None and not (is_declared and ("?" in name or not held.is_certain)):
        return None if held.value == NONE else held.value
    if "?" in name and _has_like(own, node, name):
        return Opaque(NO_NAME, applied.location)
    return given(applied, node, name)


def is_telling(name: str) -> bool:
    """Whether a name of which some parts are not known (``?.topic``) tells one parameter from others."""
    return len(name.rpartition("?")[2]) > 1


def _has_like(own: Mapping[str, Held], node: RosNode, name: str) -> bool:
    """Whether the node has declared or set a parameter of a known name that may be the one of which parts are known."""
    whole = f"{node.whole.name}:"
    result = (full[len(whole) :] for full in own if full.startswith(whole))
    return any("?" not in item and fits(item, name) for item in result)


def given(applied: Applied, node: RosNode, name: str) -> Value | None:
    """What *node* is given for a parameter from outside; ``use_sim_time`` is false where nobody sets it (rclcpp/time_source.cpp)."""
    found = _set_outside(applied, node, name)
    return Known(False) if found is None and name == ros2_nodes.SIM_TIME else found


def _set_outside(applied: Applied, node: RosNode, name: str) -> Value | None:
    own = node.whole.given
    if name in own and name != "?":
        return own[name]
    if "?" in name and any(fits(item, name) for item in own):
        return Opaque(NO_NAME, node.location)
    is_alone = node.whole.options.get(ros2_nodes.ALONE)
    found = None if is_alone else applied.walk.context.parameter(f"{node.whole.name}:{name}")
    if "?" not in own:
        return found
    return own["?"] if found is None else Opaque("a parameter file in the node's options may set it", node.location)


def is_declared(applied: Applied, node: RosNode | None, name: Value) -> Value:
    """Whether the node has declared the parameter of that name; one that is known in parts is another each time."""
    text, why, _ = pattern(name)
    own = applied.walk.declared.value
    is_told = why is None or is_telling(text)
    if node is None or not is_told or isinstance(own, Opaque):
        return applied.walk.opaque("whether the parameter is declared", applied.frame, applied.location.line)
    has = _has_declared(own, node, text)
    if has is None:
        return applied.walk.opaque("whether the parameter is declared", applied.frame, applied.location.line)
    if not has and node.whole.options.get("automatically_declare_parameters_from_overrides"):
        found = given(applied, node, text)
        return Known(found is not None) if not isinstance(found, Opaque) else found
    return Known(has)


def _has_declared(own: Mapping[str, Held], node: RosNode, name: str) -> bool | None:
    """Whether the node has declared a parameter itself; None where that is not known."""
    held = own.get(f"{node.whole.name}:{name}") if "?" not in name else None
    is_held = held is not None and held.value != NONE
    if name == ros2_nodes.SIM_TIME or (held is not None and is_held and held.is_certain):
        return True
    if name.startswith(BY_ITSELF) or is_held or ("?" in name and _has_like(own, node, name)):
        return None
    return False


def remember(applied: Applied, full: str, value: Value) -> None:
    walk = applied.walk
    own = walk.declared.value
    if isinstance(own, Opaque):
        return
    name = full.partition(":")[2]
    if "?" in name and not is_telling(name):
        return  # one more under a name that is not known; the others stay as they are
    before = own.get(full) if "?" in name else None  # which may be another one of which the same parts are known
    walk.state.write(walk.declared, {**own, full: Held(join(before.value, value) if before is not None else value)})


def while_running(applied: Applied, entry: Entry, full: str, value: Value | None) -> Value | None:
    """What the node reads: a switch that is off, and that a callback reads again, may be set while the node runs, unless it is declared read-only.

    One that is on stays on: what it switches on is known then, and stays so.
    """
    walk = applied.walk
    if entry.kind != "getters" or not walk.is_called_back or not isinstance(value, Known):
        return value
    if value.kind is not bool or value.of(bool):
        return value
    if full.endswith(f":{ros2_nodes.SIM_TIME}") or any(
        made.read_only is not False for _, made in walk.made.of("parameters", full)
    ):
        return value
    return Opaque(SWITCHED, applied.location, syntax.Type("bool"))


def gotten(applied: Applied, found: list[tuple[Value, Value | None]]) -> Value:
    """What ``get_parameters`` returns: a parameter for each of the names, with its value as far as it is known."""
    if not found:
        return applied.walk.opaque("which parameters are read is not known", applied.frame, applied.location.line)
    name = "rclpy.parameter.Parameter" if applied.frame.source.separator == "." else PARAMETER
    cells: list[Cell] = []
    for text, value in found:
        fields: dict[str, Cell] = {"name": Cell(text), LISTED: Cell(TRUE)}
        if value is not None:
            fields["value"] = Cell(value)
        cells.append(Cell(Object(name, fields=fields, location=applied.location)))
    return Sequence(Cell(tuple(cells)), syntax.Type("std::vector", (syntax.Type(PARAMETER),)))


def read_as(walk: Walk, parameter: Value, name: str, kinds: tuple[syntax.Argument, ...] = ()) -> None:
    """What ``get_parameter`` has returned is read by *name*, as a template argument if that says so: that is its type."""
    kind = READ_AS.get(name)
    if kind is None and name in READ_BY and kinds and type(kinds[0]) is syntax.Type:
        kind = ros2_parameter_type(kinds[0])
    if kind is None or walk.quiet or not isinstance(parameter, Object) or "name" not in parameter.fields:
        return
    text = pattern(parameter.fields["name"].value)[0]
    for key, made in walk.made.of("getters", parameter.location):
        if made.written == text and made.type is None and not _is_uncertain(walk, parameter, text, made):
            walk.made[key] = replace(made, type=kind)


def _is_uncertain(walk: Walk, parameter: Object, text: str, made: MadeEntity) -> bool:
    """Whether a parameter of a list that was read may be another one, or is read as this where nothing comes to it."""
    return LISTED in parameter.fields and ("?" in text or walk.ruled_out() > made.dead)
