# SPDX-License-Identifier: Apache-2.0
"""Selectors of rows in ROS 2: names of the node that a call is on, keyword arguments, items of lists of parameters."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from haros_ci.follow import braces, conversions
from haros_ci.follow.libraries import tuples
from haros_ci.follow.ros import ros2_nodes
from haros_ci.graph.ros2_process import RosNode
from haros_ci.index.ros_types import ros2_data_type, ros2_parameter_type
from haros_ci.syntax import Type
from haros_ci.values.abstract import (
    NONE,
    Cell,
    Known,
    Library,
    Mapped,
    Object,
    Opaque,
    Pointer,
    Sequence,
    Text,
    Value,
    data_of,
)

if TYPE_CHECKING:
    from haros_ci.follow.ros.selectors import Applied

#: What rclpy calls the option that rclcpp calls ``arguments``.
_OPTIONS = {"cli_args": "arguments"}
#: Classes of rclcpp that hold a parameter's value.
PARAMETERS = ("rclcpp::ParameterValue", "rclcpp::Parameter")
#: Types of data that are those of a parameter.
SCALARS = frozenset((bool, int, float, str))
#: Members of rcl_interfaces/msg/ParameterType and of rclpy's Parameter.Type, without their prefix.
TYPES = {
    "BOOL": "bool",
    "INTEGER": "int",
    "DOUBLE": "double",
    "STRING": "str",
    "BYTE_ARRAY": "bytes",
    "BOOL_ARRAY": "bool[]",
    "INTEGER_ARRAY": "int[]",
    "DOUBLE_ARRAY": "double[]",
    "STRING_ARRAY": "str[]",
}


def node_name(applied: Applied, part: str) -> Value:
    """The receiver's name (``name``, ``base_name``) or namespace (``namespace``, ``sub_namespace``, ``effective_namespace``)."""
    node = ros2_nodes.of_value(applied.walk, applied.receiver)
    if node is None:
        return applied.walk.opaque("the name of a node that is not known", applied.frame, applied.location.line)
    own = node.whole
    texts = {
        "name": own.name,
        "base_name": own.name.rpartition("/")[2],
        "namespace": own.own,
        "sub_namespace": node.space[len(own.own) :].strip("/") if node.main is not None else "",
        "effective_namespace": node.space,
    }
    return known_text(applied, texts[part], node)


def known_text(applied: Applied, text: str, node: RosNode) -> Value:
    """A text in which ``?`` stands for what is not known of a node's name."""
    if "?" not in text:
        return applied.walk.context.marks.known(text)
    text = applied.walk.context.marks.looked_at(text)
    why = Opaque(*(node.why or ("the name of the node is not known", node.location)))
    head, _, tail = text.partition("?")
    return Text(tuple(part for part in (head, why, tail) if part != ""))


def keywords(applied: Applied) -> Object:
    """The keyword arguments of a call as an object's members."""
    provided = {arg.keyword: Cell(arg.value) for arg in applied.args if arg.keyword and arg.keyword[0] != "*"}
    return Object("keywords", fields={_OPTIONS.get(name, name): cell for name, cell in provided.items()})


def items(applied: Applied, value: object) -> list[Mapping[str, Value] | None]:
    """The items of a list of parameters: texts, tuples of a name and more, objects with ``name`` and ``value``."""
    found = listed(value)
    if found is None:
        reason = value.reason if isinstance(value, Opaque) else "it is no list"
        applied.walk.gaps.setdefault(f"a list of parameters is not known: {reason}", applied.location)
        return []
    return [*found]


def entries(applied: Applied, value: object) -> list[Mapping[str, Value] | None]:
    """The entries of a map of names and defaults, each perhaps with a descriptor, as C++ has it (rclcpp/node.hpp)."""
    content = value.content.value if isinstance(value, (Mapped, Sequence)) else value
    if isinstance(content, dict):
        return [_entry(applied, Known(str(name)), cell) for name, cell in content.items()]
    found: list[Mapping[str, Value] | None] = []
    for pair in content if isinstance(content, tuple) else ():
        inside = pair.value.content.value if isinstance(pair.value, Sequence) else None
        if not isinstance(inside, tuple) or len(inside) != 2:
            content = None
            break
        found.append(_entry(applied, inside[0].value, inside[1]))
    if isinstance(content, tuple):
        return found
    reason = content.reason if isinstance(content, Opaque) else "it is no map"
    applied.walk.gaps.setdefault(f"a map of parameters is not known: {reason}", applied.location)
    return []


def _entry(applied: Applied, name: Value, cell: Cell) -> Mapping[str, Value]:
    """What a map has under *name*: a default, or a pair of it and a descriptor."""
    from haros_ci.follow.ros.selectors import TypeValue, select_value

    value, kind = cell.value, cell.type
    template = select_value(applied, "<0>")
    if isinstance(template, TypeValue):
        kind = template.type
    elif isinstance(value, Object) and kind is not None:
        kind = kind.of(0)
    parts = _default_and_descriptor(value, kind)
    if parts is None:
        return {"name": name, "default": _initialised(applied, value, kind)}
    return {"name": name, "default": _initialised(applied, parts[0], kind), "descriptor": parts[1]}


def _default_and_descriptor(value: Value, kind: Type | None) -> tuple[Value, Value] | None:
    """The parts of a pair, or of braces that stand for one: those of a list have no list in them, and a number has no two parts."""
    if isinstance(value, Object) and value.name == tuples.PAIR and value.fields.keys() >= set(tuples.PARTS):
        first, second = (value.fields[part].value for part in tuples.PARTS)
        return first, second
    inside = value.content.value if isinstance(value, Sequence) and value.type is None else None
    if not isinstance(inside, tuple) or len(inside) != 2:
        return None
    first, second = inside[0].value, inside[1].value
    shown = conversions.value_type(second)
    is_descriptor = shown is not None and shown.name.rpartition("::")[2] == "ParameterDescriptor"
    is_one = kind is not None and conversions.zero_of(kind) is not None
    return (first, second) if is_descriptor or is_one or isinstance(first, Sequence) else None


def _initialised(applied: Applied, value: Value, kind: Type | None) -> Value:
    """A default as one of type *kind* is initialised with it."""
    if kind is not None and isinstance(value, Sequence) and value.type is None:
        return braces.from_list(applied.walk, applied.frame, kind, value)
    return conversions.converted(value, kind)


def listed(value: object) -> list[Mapping[str, Value]] | None:
    """The items of a list of parameters; None if it is not known."""
    cells = value.content.value if isinstance(value, (Sequence, Mapped)) else None
    if isinstance(value, Known) and issubclass(value.kind, (list, tuple)):
        cells = tuple(Cell(Known(item)) for item in _parts(value))
    if isinstance(cells, dict):
        return [{"name": Known(str(name)), "default": cell.value} for name, cell in cells.items()]
    if not isinstance(cells, tuple):
        return None
    return [_item(cell.value) for cell in cells]


def _parts(value: Known) -> Iterable[object]:
    return value.value if isinstance(value.value, (list, tuple)) else ()


def _item(value: Value) -> Mapping[str, Value]:
    if isinstance(value, Pointer):
        value = value.cell.value
    if isinstance(value, Object) and "name" in value.fields:
        return _item_of(value.fields)
    parts: list[Value] = []
    if isinstance(value, Sequence) and isinstance(value.content.value, tuple):
        parts = [cell.value for cell in value.content.value]
    elif isinstance(value, Known) and issubclass(value.kind, (list, tuple)):
        parts = [Known(part) for part in _parts(value)]
    if not parts:
        return {"name": value}
    found = {"name": parts[0]}
    if len(parts) > 1:
        found["type" if type_word(parts[1]) else "default"] = parts[1]
    if len(parts) > 2:
        found["descriptor"] = parts[2]
    return found


def _item_of(fields: Mapping[str, Cell]) -> Mapping[str, Value]:
    """The item that an object is: rclpy's Parameter has a type, too (rclpy/parameter.py)."""
    members = {"name": "name", "type": "type_", "default": "value"}
    found = {key: fields[member].value for key, member in members.items() if member in fields}
    return found if type_word(found.get("type")) else {key: item for key, item in found.items() if key != "type"}


def type_word(value: object) -> str | None:
    """The parameter type that a constant stands for: ``Parameter.Type.STRING``, ``rclcpp::PARAMETER_DOUBLE``."""
    if not isinstance(value, Library):
        return None
    last = value.name.rpartition("::")[2].rpartition(".")[2].removeprefix("PARAMETER_")
    return TYPES.get(last)


def type_constant(value: Value | None) -> Library | None:
    """``get_type()`` of a ParameterValue or Parameter, or of what it holds: the constant of that type; None if not known."""
    if isinstance(value, Object):
        held = value.fields.get("value")
        value = held.value if held is not None and value.name in PARAMETERS else None
    if value is None or isinstance(value, Library) or value == NONE:
        return None
    if isinstance(value, Known) and value.kind in SCALARS:  # the type tells, and the value is looked at by nobody
        known, data = True, value.kind()
    else:
        known, data = data_of(value)
    word = (ros2_data_type(data) if known else None) or ros2_parameter_type(conversions.value_type(value))
    constant = next((name for name, type_name in TYPES.items() if type_name == word), None)
    return Library(f"rclcpp::ParameterType::PARAMETER_{constant}") if constant is not None else None
