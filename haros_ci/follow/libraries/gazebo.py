# SPDX-License-Identifier: Apache-2.0
"""What plug-ins of Gazebo are given: the element of the description (sdf/Element.hh), its parent, and the helper GazeboRos.

GazeboRos is a class of gazebo_plugins (gazebo_ros_utils.h): it reads parameters from the element, and has a node handle in the namespace
``<robotNamespace>``, else the model's name.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.graph.names import resolve
from haros_ci.index.types import STRINGS
from haros_ci.records import dataclass, field
from haros_ci.values.abstract import FALSE, NONE, TRUE, Cell, Known, Object, Opaque, Text, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

ELEMENT, PARAM, PARENT, HELPER = "sdf::Element", "sdf::Param", "gazebo::physics::Base", "gazebo::GazeboRos"
CLASSES = frozenset((ELEMENT, PARAM, PARENT, HELPER))
#: The field that has the element; the text of a parameter, the name of a parent; the helper's node handle.
SELF, HANDLE = OWN = ("(self)", "(handle)")
SPACE = "robotNamespace"
#: The field of a plug-in that has its name (extract/apis/gazebo.py).
HANDLE_NAME = "handleName"
#: The field that has the elements behind one.
REST = "(rest)"
DOUBTFUL = "it stands in the description under a condition that is not known"
UNREAD = "its value in the description is not known"
_NAMING = ("GetName", "Name")
_NUMBERS: Mapping[str, type] = {"int": int, "unsigned int": int, "double": float, "float": float}


@dataclass(frozen=True, slots=True)
class Sdf:
    """An element of a description; an attribute or *text* that is not known is None, as is whether it is *certain* to be there."""

    tag: str
    attributes: Mapping[str, str | None] = field(default_factory=dict)
    text: str | None = ""
    children: tuple[Sdf, ...] = ()
    certain: bool = True

    def child(self, name: str) -> Sdf | None:
        return next((child for child in self.children if child.tag == name), None)


def element(sdf: Sdf, rest: tuple[Sdf, ...] | None = None) -> Object:
    """The object that a plug-in is given for an element; *rest* are those that follow in the same one, if that is known."""
    fields: dict[str, Cell[Value]] = {SELF: Cell(Known(sdf))}
    if rest is not None:
        fields[REST] = Cell(Known(rest))
    return Object(ELEMENT, fields=fields)


def called(sdf: Sdf) -> Value:
    """The name of the plug-in of which *sdf* is the element."""
    return _known(sdf.attributes.get("name"))


def is_one_of_several(value: Value) -> bool:
    """Whether *value* is an element of which it is known what follows: a loop goes from one to the next."""
    return isinstance(value, Object) and value.name == ELEMENT and REST in value.fields


def _first(items: tuple[Sdf, ...], name: str | None) -> Value:
    """The first of *items*, of that *name* if one is given; a null pointer if there is none."""
    for number, item in enumerate(items):
        if name is None or item.tag == name:
            return element(item, items[number + 1 :]) if item.certain else Opaque(DOUBTFUL)
    return NONE


def parent(name: str | None) -> Object:
    """The model, sensor or world that a plug-in stands in, by its *name*; None if that is not known."""
    return Object(
        PARENT, fields={SELF: Cell(Known(name) if name is not None else Opaque("the name of the model is not known"))}
    )


def instance(kind: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """``GazeboRos(parent, sdf, name)``; None for another class."""
    if kind.rpartition("::")[2] != "GazeboRos" or len(args) < 2:
        return None
    handle = Object("ros::NodeHandle", namespace=_namespace(args[0].value, args[1].value))
    return Object(HELPER, fields={HANDLE: Cell(handle)})


def _namespace(model: Value, sdf: Value) -> Value:
    result = _sdf_of(sdf)
    provided = result.child(SPACE) if result is not None else None
    if provided is not None and provided.text is not None and provided.text.strip():
        return Known(resolve(provided.text.strip(), "/", "/"))
    if result is None or (provided is not None and provided.text is None):
        return Text(("/", Opaque(f"<{SPACE}> of the plug-in: {UNREAD}")))
    name = model.fields.get(SELF) if isinstance(model, Object) and model.name == PARENT else None
    if name is not None and isinstance(name.value, Known):
        return Known(resolve(name.value.of(str), "/", "/"))
    return Text(("/", Opaque("it is the name of the model, which is not known")))


def _sdf_of(value: Value) -> Sdf | None:
    held = value.fields.get(SELF) if isinstance(value, Object) and value.name == ELEMENT else None
    return held.value.of(Sdf) if held is not None and isinstance(held.value, Known) else None


def method(
    walk: Walk,
    frame: Frame,
    receiver: Object,
    name: str,
    args: tuple[PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
) -> Value | None:
    """A method of an object of these classes; None if there is no model of it."""
    if receiver.fields.keys().isdisjoint(OWN):
        return None  # such as one of a class of that name in the workspace
    targs = tuple(walk.type_in(targ, frame) if type(targ) is syntax.Type else targ for targ in targs)
    if receiver.name == HELPER:
        value: Value | None = receiver.fields[HANDLE].value if name == "node" and not args else None
        return value
    if receiver.name == PARENT:
        return receiver.fields[SELF].value if name in _NAMING and not args else None
    if receiver.name == PARAM:
        if name == "Get" and len(args) == 1 and not targs:
            return _into(walk, args[0], receiver.fields[SELF].value)
        if name in ("GetAsString", "Get"):
            return _as(receiver.fields[SELF].value, targs if name == "Get" else ())
        return None
    sdf = _sdf_of(receiver)
    if sdf is not None and name in ("GetFirstElement", "GetNextElement", "FindElement"):
        return _another(receiver, sdf, name, args)
    return _of_element(sdf, name, args, targs) if sdf is not None else None


def _into(walk: Walk, argument: PassedArgument, text: Value) -> Value | None:
    """``Get(variable)``: the variable has the value then."""
    if argument.cell is None:
        return None
    kind = argument.cell.type
    value = _as(text, (kind.bare(),)) if kind is not None else Opaque("the type of the variable is not known")
    walk.state.write(argument.cell, value)
    return TRUE


def _another(receiver: Object, sdf: Sdf, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """The first element, or the next one, perhaps of a name."""
    rest = receiver.fields[REST].value if REST in receiver.fields else None
    items = sdf.children if name != "GetNextElement" else rest.of(tuple) if isinstance(rest, Known) else None
    key = args[0].value.value if args and isinstance(args[0].value, Known) else None
    if items is None or (args and not isinstance(key, str)):
        return None
    return _first(items, key if isinstance(key, str) and key else None)


def _of_element(
    sdf: Sdf, name: str, args: tuple[PassedArgument, ...], targs: tuple[syntax.Argument, ...]
) -> Value | None:
    if not args:
        return _of_itself(sdf, name, targs)
    key = args[0].value.value if isinstance(args[0].value, Known) else None
    if not isinstance(key, str):
        return None
    child = sdf.child(key)
    if name == "HasElement":
        return _whether(child)
    if name == "HasAttribute":
        return TRUE if key in sdf.attributes else FALSE
    if name == "GetElement" and child is not None:
        return element(child, sdf.children[sdf.children.index(child) + 1 :])
    if name == "GetAttribute" and key in sdf.attributes:
        return Object(PARAM, fields={SELF: Cell(_known(sdf.attributes[key]))})
    return _value(sdf, child, key, args, targs) if name == "Get" else None


def _of_itself(sdf: Sdf, name: str, targs: tuple[syntax.Argument, ...]) -> Value | None:
    """What a method without arguments gives."""
    if name == "GetName":
        return Known(sdf.tag)
    if name == "GetValue":
        return Object(PARAM, fields={SELF: Cell(_text(sdf))})
    return _as(_text(sdf), targs) if name == "Get" else None


def _value(
    sdf: Sdf, child: Sdf | None, key: str, args: tuple[PassedArgument, ...], targs: tuple[syntax.Argument, ...]
) -> Value | None:
    """``Get<T>(key)``, and ``Get<T>(key, default)``, which is a pair."""
    if key in sdf.attributes:
        found = _as(_known(sdf.attributes[key]), targs)
    elif child is not None:
        found = _as(_text(child), targs)
    elif len(args) == 2:
        found = args[1].value
    else:
        found = Known("") if _kind(targs) in STRINGS else Opaque("the description has no such element")
    if len(args) == 1:
        return found
    return Object("std::pair", fields={"first": Cell(found), "second": Cell(_whether(child))})


def _whether(child: Sdf | None) -> Value:
    if child is not None and not child.certain:
        return Opaque(DOUBTFUL, None, syntax.Type("bool"))
    return TRUE if child is not None else FALSE


def _text(sdf: Sdf) -> Value:
    return _known(sdf.text if sdf.certain else None)


def _known(text: str | None) -> Value:
    return Known(text.strip()) if text is not None else Opaque(UNREAD)


def _kind(targs: tuple[syntax.Argument, ...]) -> str:
    return targs[0].name if len(targs) == 1 and type(targs[0]) is syntax.Type else ""


def _as(value: Value, targs: tuple[syntax.Argument, ...]) -> Value:
    """*value* as the template argument asks for it; a text without one."""
    kind = _kind(targs)
    if not isinstance(value, Known) or not kind or kind in STRINGS:
        return value
    if kind == "bool":
        truth = {"true": TRUE, "1": TRUE, "false": FALSE, "0": FALSE}.get(value.of(str).lower())
        return truth or Opaque("it is neither true nor false")
    try:
        return Known(_NUMBERS[kind](value.value))
    except (KeyError, ValueError):
        return Opaque(f"it is not read as a {kind}")
