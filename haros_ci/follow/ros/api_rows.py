# SPDX-License-Identifier: Apache-2.0
"""API rows applied to calls: which row fits, what its templates select, what the call makes, returns and stores."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import beside, callbacks, conversions, handles, partials
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import objects as library_objects
from haros_ci.follow.ros import (
    behavior_tree_ports,
    behavior_trees,
    ros2_nodes,
    ros2_parameters,
    ros2_selectors,
    selectors,
)
from haros_ci.follow.ros.emit import emit
from haros_ci.follow.walk import Walk
from haros_ci.graph.names import clean
from haros_ci.graph.parameters import SetByNode
from haros_ci.index.ros_types import parameter_type
from haros_ci.index.types import SEQUENCES, STRINGS, pointee
from haros_ci.model.api import Entry, Row
from haros_ci.model.location import Location
from haros_ci.model.once import once
from haros_ci.syntax import Type
from haros_ci.values.abstract import (
    FALSE,
    NONE,
    TRUE,
    Callable,
    Cell,
    Known,
    Library,
    Object,
    Opaque,
    Pointer,
    Sequence,
    Text,
    Value,
    join,
)
from haros_ci.values.state import joined

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: How the names of functions end that register what is called when parameters are set.
UPDATES = frozenset(("_callback", "_set_callback"))
HANDLES = frozenset(("ros::NodeHandle",))
#: Methods that no other class has: a receiver of unknown type is taken for a node handle.
UNMISTAKABLE = frozenset(
    "advertise advertiseService serviceClient getParam getParamCached setParam hasParam searchParam deleteParam".split()
)
CAMERAS = frozenset(("advertiseCamera", "subscribeCamera"))


def handle(name: str, count: int, is_typed: bool) -> str:
    """The class of ROS 1 that only has a method of that *name* with *count* arguments: a publisher without a type in its call is one of images."""
    if name in CAMERAS or (name == "advertise" and count > 1 and not is_typed):
        return "image_transport::ImageTransport"
    return "ros::NodeHandle" if name in UNMISTAKABLE else ""


def call(
    walk: Walk,
    frame: Frame,
    name: str,
    receiver: Value | None,
    args: tuple[PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
    types: tuple[syntax.Argument, ...] | None = None,
) -> Value | None:
    """The value of a call that a row describes; None if no row does."""
    row = select(walk, name, args)
    if row is None:
        return None
    if name.startswith(behavior_trees.SPACE):
        modelled = behavior_trees.call(walk, frame, name, receiver, args, targs, location)
        if modelled is not None:
            return modelled
    if types is None:
        types = tuple(walk.type_in(t, frame) if type(t) is syntax.Type else t for t in targs)
    made: Object | None = None
    returns = row.returns
    if returns is not None and all(isinstance(part, str) for part in returns.parts):
        made = Object("".join(str(part) for part in returns.parts), types, location=location)
    elif returns is None and (any(e.kind in ("handle", "node") for e in row.makes) or (row.fills and not receiver)):
        made = Object(name, types, location=location)
    is_class = re.split(r"::|\.", name)[-1][:1].isupper()
    if made is None and is_class and receiver is None and row.transparent is None and returns is None:
        made = Object(name, types, location=location)
    args, types, is_exact = _filled(walk, name, args, types, location)
    applied = selectors.Applied(walk, frame, row, receiver, args, types, location, is_exact=is_exact)
    parameter = _apply(applied, made)
    if row.transparent is not None:
        through = selectors.value_at(applied, row.transparent)
        return through if through is not None else NONE
    if made is not None:
        return made
    if returns is not None:
        found = selectors.value_at(
            selectors.Applied(walk, frame, row, receiver, args, types, location, None, parameter), returns
        )
        if found is not None:
            return found.held if isinstance(found, SetByNode) else found
        of_object = any(not isinstance(part, str) and part[0][0].startswith("this.") for part in returns.parts)
        reason = f"what {name} returns is not known" if of_object else "a parameter that is not set"
        return walk.opaque(reason, frame, location.line)
    if (
        any(entry.kind == "getters" and entry.each is None for entry in row.makes)
        and "value" not in row.makes[0].values
    ):
        return (
            FALSE
            if parameter is None
            else walk.opaque("it is set", frame, location.line)
            if isinstance(parameter, Opaque)
            else TRUE
        )
    return walk.opaque(f"what {name} returns", frame, location.line)


def construct(
    walk: Walk, frame: Frame, this: Object, kind: Type, args: tuple[PassedArgument, ...], location: Location
) -> None:
    """What constructing a library's class makes; nothing if no row knows it."""
    row = select(walk, kind.name, args)
    if row is not None:
        _apply(selectors.Applied(walk, frame, row, this, args, kind.arguments, location), this)
    elif kind.name.startswith(behavior_trees.SPACE):
        behavior_tree_ports.configured(this, args)


def _filled(
    walk: Walk, name: str, args: tuple[PassedArgument, ...], types: tuple[syntax.Argument, ...], location: Location
) -> tuple[tuple[PassedArgument, ...], tuple[syntax.Argument, ...], bool]:
    """The arguments with what only the exact tier knows of them; what is known already stays as it is."""
    if walk.exact is None or location.line is None or location.column is None:
        return args, types, False
    result = walk.exact(location.path, location.line, location.column, name.rpartition("::")[2], len(args))
    if result is None:
        return args, types, False
    filled = []
    for argument, (kind, value) in zip(args, result[0], strict=False):
        known = argument.value
        if isinstance(known, Opaque) and value is not None:
            known = Known(value)
        blank = argument.type is None or argument.type.name in ("", "auto")
        filled.append(replace(argument, value=known, type=syntax.Type(kind) if blank and kind else argument.type))
    if not types and all(kind is not None for kind in result[1]):
        types = tuple(syntax.Type(kind) for kind in result[1] if kind is not None)
    return (*filled, *args[len(filled) :]), types, True


def names_of(row: Row) -> tuple[str, ...]:
    """The qualified names of the class or function that a row tells of, and of the class that it gives."""
    owner, _, _ = row.call.rpartition("::")
    names = [row.call]
    if owner.rpartition("::")[2][:1].isupper():
        names.append(owner)
    if row.returns is not None and all(isinstance(part, str) for part in row.returns.parts):
        names.append("".join(str(part) for part in row.returns.parts))
    return tuple(name for name in names if "::" in name)


@once
def all_names(rows: tuple[Row, ...]) -> frozenset[str]:
    """The names of all rows."""
    return frozenset(name for row in rows for name in names_of(row))


def select(walk: Walk, name: str, args: tuple[PassedArgument, ...]) -> Row | None:
    """The first row for *name* whose conditions hold."""
    for row in walk.rows.get(name, ()):
        if row.is_class or (row.args and len(args) not in row.args):
            continue
        if all(_has_type(selectors.given(args, where), kind, walk) for where, kind in row.when):
            return row
    return None


def _has_type(argument: PassedArgument | None, expected: str, walk: Walk) -> bool:
    if argument is None:
        return False
    value = argument.value.cell.value if isinstance(argument.value, Pointer) else argument.value
    kind = conversions.value_type(value) or argument.type
    name = pointee(kind).name if kind is not None else ""
    if expected == "rclcpp::ParameterType" and isinstance(value, Library):
        return value.name.rpartition("::")[2].startswith("PARAMETER_")
    if expected == "string":
        return (
            isinstance(value, Text)
            or (isinstance(value, Known) and issubclass(value.kind, str))
            or name in STRINGS
            or name == "char"
        )
    if expected == "function":
        return isinstance(value, (Callable,)) or name in ("boost::function", "std::function", "function")
    if expected == "list":
        return isinstance(value, Sequence) or name in SEQUENCES or name == "list"
    if expected == "bool":
        return (isinstance(value, Known) and issubclass(value.kind, bool)) or name == "bool"
    if expected in ("true", "false"):
        return isinstance(value, Known) and value.kind in (bool, int) and bool(value.value) is (expected == "true")
    if expected == "int":
        return parameter_type(kind) == "int"
    if expected == "double":
        return name in ("double", "float")
    if isinstance(value, Library) and value.name.rpartition(".")[0] == expected:
        return True
    if isinstance(value, Object):
        return value.name == expected or expected in library_objects.owners(walk, value)
    return name == expected


def _apply(applied: selectors.Applied, made: Object | None) -> Value | None:  # noqa: C901 - one branch for each kind of what a row makes
    """Make, fill, store and register what the row says; the value that its getter reads is returned."""
    walk, row = applied.walk, applied.row
    if row.unseen and not walk.quiet:
        walk.gaps.setdefault(row.unseen, applied.location)
    parameter: Value | None = None
    known = False
    for entry in row.makes:
        if entry.kind == "node" and walk.context.process is not None:
            target = made if made is not None else applied.receiver
            if isinstance(target, Object):
                ros2_nodes.construct(applied, entry, target)
                if applied.receiver is None:
                    applied = replace(applied, receiver=target)
            continue
        if entry.kind == "handle":
            target = made if made is not None else applied.receiver
            if isinstance(target, Object):
                target.namespace = handles.handle(applied, entry)
            continue
        found, is_read = _made(applied, entry)
        if is_read:
            parameter, known = found, True
    target = made if made is not None else applied.receiver
    with_parameter = applied if parameter is None else replace(applied, parameter=parameter)
    if isinstance(target, Object):
        for name, template in row.fills:
            value = selectors.value_of(with_parameter, template)
            if value is not None:
                filled = value if not isinstance(value, selectors.TypeValue) else Library(value.type.name)
                if name in target.fields:
                    walk.state.write(target.fields[name], filled)
                else:
                    target.fields[name] = Cell(filled)
    for where, template in row.sets:
        argument = selectors.given(applied.args, where)
        if argument is None:
            continue
        cell = argument.cell
        if cell is None and isinstance(argument.value, Pointer):
            cell = argument.value.cell
        if cell is None:
            continue
        value = selectors.value_of(with_parameter, template)
        if value is not None and not isinstance(value, selectors.TypeValue):
            value = conversions.converted(value.held if isinstance(value, SetByNode) else value, cell.type)
            walk.state.put(cell, joined(cell.value, value) if isinstance(parameter, SetByNode) else value)
        elif not known:
            walk.state.write(
                cell, walk.opaque("it is filled by a call", applied.frame, applied.location.line, cell.type)
            )
    for where in row.calls:
        value = selectors.select_value(applied, where)
        if value is not None and not isinstance(value, selectors.TypeValue):
            for called in partials.given(row.call, value, applied.args):
                callbacks.register(walk, called, applied.args, row.call.rpartition("_parameters")[2] in UPDATES)
            if row.call.startswith(beside.BEGINNING):
                beside.note(walk, value)
            if isinstance(value, Opaque) and applied.frame.source.separator == ".":
                walk.gaps.setdefault(f"what it calls back is not known: {value.reason}", applied.location)
    return parameter


def _made(applied: selectors.Applied, entry: Entry) -> tuple[Value | None, bool]:
    """Make what *entry* says, of each of its items: what its getter reads, or the list of these, and whether it has one."""
    items = _items(applied, entry)
    values = [emit(applied if item is None else replace(applied, item=item), entry) for item in items]
    if entry.kind in ("getters", "parameters") and entry.each is None:
        return values[0], True
    if entry.kind == "getters" and entry.each is not None and entry.each.startswith("items("):
        names = [item["name"] for item in items if item is not None]
        return ros2_parameters.gotten(applied, list(zip(names, values, strict=True))), True
    return None, False


def _items(applied: selectors.Applied, entry: Entry) -> list[Mapping[str, Value] | None]:
    if entry.each is None:
        return [None]
    inside = re.fullmatch(r"(config|keys|items)\((.+)\)", entry.each)
    if inside is None:
        return []
    every = (selectors.select_value(applied, part) for part in inside[2].split("|"))
    value = next((item for item in every if item is not None), None)
    if inside[1] == "items":
        return ros2_selectors.items(applied, value)
    if inside[1] == "keys":
        return ros2_selectors.entries(applied, value)
    name = selectors.config_name(value, applied.walk)
    config = applied.walk.configs.get(name)
    if config is None:
        if name:
            message = f"the parameters of {name} are in a .cfg that is not in the workspace"
            applied.walk.gaps.setdefault(message, applied.location)
        return []
    return [
        {"name": Known(p.name), "type": Known(p.type), "default": Known(p.default), "group": Known(p.group)}
        for p in config.parameters
    ]


def parameter_value(applied: selectors.Applied, name: str, default: Value | None) -> Value | None:
    """What reading parameter *name* gives: what the configuration sets, else the default; None if there is neither."""
    if not applied.walk.context.is_asked(name):
        return Opaque("the parameter's name is not known")
    found = applied.walk.parameter(clean(name))
    if found is None:
        if default is None and applied.walk.context.process is None:
            applied.walk.absent.append(clean(name))
        return default
    if isinstance(found, SetByNode) and default is not None:
        return default if found.is_default_first else join(default, found.held)
    return found
