# SPDX-License-Identifier: Apache-2.0
"""Templates of API rows: what their selectors find at a call."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import conversions, handles, members
from haros_ci.follow.frames import Frame
from haros_ci.follow.ros import name_selectors, ros2_listed, ros2_nodes, ros2_selectors
from haros_ci.follow.ros.own_names import own_names
from haros_ci.follow.ros.selected_types import TypeValue as TypeValue
from haros_ci.follow.ros.selected_types import callback_type, hidden_type, is_open
from haros_ci.follow.walk import Walk
from haros_ci.index.ros_types import is_hidden, parameter_type
from haros_ci.model.api import Entry, Row, Template
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.values import iterators
from haros_ci.values.abstract import (
    Choice,
    ClassValue,
    Known,
    Library,
    Object,
    Opaque,
    Pointer,
    Sequence,
    Value,
    concatenate,
)

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument


#: What a template or selector finds: None if nothing is there.
Found = Value | TypeValue | None


@dataclass(frozen=True, slots=True, eq=False)
class Applied:
    """A row at one call: what its templates may select from."""

    walk: Walk
    frame: Frame
    row: Row
    receiver: Value | None
    args: tuple[PassedArgument, ...]
    types: tuple[syntax.Argument, ...]
    location: Location
    item: Mapping[str, Value] | None = None
    parameter: Value | None = None
    #: Whether the exact tier has filled a blank of the call.
    is_exact: bool = False

    @property
    def is_behind(self) -> bool:
        """Whether the call, or one around it, stands behind an early way out that is taken as things are."""
        return self.frame.is_dead or self.walk.beyond > 0


def given(args: tuple[PassedArgument, ...], where: str) -> PassedArgument | None:
    if where.isdigit():
        positional = [argument for argument in args if not argument.keyword]
        return positional[int(where)] if int(where) < len(positional) else None
    return next((argument for argument in args if argument.keyword == where), None)


def config_name(value: Found, walk: Walk) -> str:
    """``pkg::NameConfig`` of a dynamic_reconfigure type, in C++ and in Python (``pkg.cfg.NameConfig``).

    A name without its package (its header is included by another) is the one of that name in the workspace.
    """
    if isinstance(value, TypeValue):
        name = value.type.name
    elif isinstance(value, Library):
        name = value.name
    elif isinstance(value, ClassValue):
        name = value.definition.name
    else:
        return ""
    parts = name.replace(".", "::").split("::")
    name = "::".join((parts[0], parts[-1])) if len(parts) > 2 and "cfg" in parts else name
    if name not in walk.configs:
        last = name.rpartition("::")[2]
        named = [known for known in walk.configs if known.endswith(f"::{last}")]
        return named[0] if len(named) == 1 else name
    return name


def value_of(applied: Applied, template: Template) -> Found:
    """What a template stands for: a Value, a TypeValue if it is one selector of a type, None if nothing is there."""
    parts = template.parts
    if len(parts) == 1 and not isinstance(parts[0], str):
        alternatives, default = parts[0]
        for alternative in alternatives:
            found = select_value(applied, alternative)
            if found is not None:
                return found
        unpacked = next((a.value for a in applied.args if a.keyword in ("*", "**")), None)
        if unpacked is not None:
            return unpacked
        return literal(default) if default is not None else None
    if len(parts) == 1 and isinstance(parts[0], str):
        return literal(parts[0])
    if not parts:
        return Known("")
    values: list[Value] = []
    for part in parts:
        if isinstance(part, str):
            values.append(Known(part))
            continue
        found = value_of(applied, Template((part,)))
        if isinstance(found, TypeValue):
            found = Known(found.type.name)
        values.append(found if found is not None else applied.walk.opaque("an argument is missing", applied.frame))
    return concatenate(tuple(values))


def in_type(applied: Applied, entry: Entry, found: Value) -> Value:
    """What C++'s braces mean as the default of a parameter, of the type that the call tells; any other value as it is."""
    if not isinstance(found, Sequence) or applied.frame.source.separator == "." or "type" not in entry.values:
        return found
    kind = value_of(applied, entry.values["type"])
    return conversions.in_braces(found, kind.type) if isinstance(kind, TypeValue) else found


def value_at(applied: Applied, template: Template) -> Value | None:
    """What a template stands for where a value is expected: a type is none that is known."""
    found = value_of(applied, template)
    return Opaque("it is not plain data") if isinstance(found, TypeValue) else found


@cache
def literal(text: str) -> Known:
    """A literal of a row: true, false, none, a number or text."""
    if text in ("true", "false"):
        return Known(text == "true")
    try:
        return Known(int(text))
    except ValueError:
        try:
            return Known(float(text))
        except ValueError:
            return Known(text)


def select_value(applied: Applied, selector: str) -> Found:  # noqa: C901 - one branch for each form of a selector
    """What one alternative of a selector finds: a Value, a TypeValue, or None."""
    walk = applied.walk
    if selector[0].isdigit():
        where, *members = selector.split(".")
        argument = given(applied.args, where)
        return _members(applied, argument.value, members) if argument is not None else None
    if selector[0] == "<":
        return _template_argument(applied.types, int(selector[1:-1]))
    if selector.startswith("this<"):
        this = applied.receiver
        return _template_argument(this.arguments, int(selector[5:-1])) if isinstance(this, Object) else None
    if selector == "this" or selector.startswith("this."):
        if selector == "this.namespace":
            return handles.namespace_of(applied, applied.receiver)
        return _members(applied, applied.receiver, selector.split(".")[1:]) if applied.receiver is not None else None
    if selector.startswith("item."):
        return applied.item.get(selector[5:]) if applied.item is not None else None
    if selector == "parameter":
        return applied.parameter
    context = walk.context
    if context.process is not None:
        if selector == "node.options":
            return ros2_nodes.options_of(walk, applied.receiver)
        if selector.startswith("node."):
            return ros2_selectors.node_name(applied, selector[5:])
        if selector == "keywords":
            return ros2_selectors.keywords(applied)
    if selector in ("node.name", "node.namespace", "process.name", "process.namespace"):
        return Known(getattr(context, selector.replace("node.", "").replace(".", "_")))
    function, bracket, inside = selector.partition("(")
    if not bracket:
        argument = given(applied.args, selector.split(".")[0])
        return _members(applied, argument.value, selector.split(".")[1:]) if argument is not None else None
    inside = inside[:-1]
    where, _, index = inside.partition(",")
    if function == "handle":
        own, above = own_names(applied)
        return Object("ros::NodeHandle", namespace=Known(own if inside == "~" else above))
    if function == "parent":
        return name_selectors.parent(applied, inside)
    if function == "declared":
        return name_selectors.declared(applied, inside)
    if function in ("parameters", "prefixes"):
        prefixes, depth = (given(applied.args, part) for part in (where, index))
        return ros2_listed.listed(
            applied, prefixes.value if prefixes else None, depth.value if depth else None, function
        )
    if function == "search":
        return name_selectors.search(applied, inside)
    if function == "searched":
        return name_selectors.search_result(applied, inside)
    if function == "resolve":
        return name_selectors.resolved(applied, where, index)
    if function == "remap":
        return name_selectors.remapped(applied, inside)
    if function == "canonical":
        return name_selectors.canonical(applied, inside)
    if function == "above":
        return name_selectors.above(applied, inside)
    if function == "expand":
        return name_selectors.expanded(applied, *inside.split(","))
    if function == "typeof":
        return _first_type(applied, where.split("|"))
    found = next((f for f in (given(applied.args, part) for part in where.split("|")) if f is not None), None)
    if found is None:
        return None
    if function == "callback":
        return callback_type(walk, found, applied.args, int(index or 0))
    value = iterators.not_none(found.value) if isinstance(found.value, Choice) else found.value
    if isinstance(value, Library):
        return TypeValue(syntax.Type(value.name))
    if isinstance(value, ClassValue):
        return TypeValue(syntax.Type(value.definition.name))
    kind = found.type or conversions.value_type(found.value)
    return TypeValue(kind) if kind is not None else None


def _first_type(applied: Applied, selectors: list[str]) -> TypeValue | None:
    """The first type that parameters have among those of *selectors*; an explicit template argument decides, whatever it is."""
    other: TypeValue | None = None
    for selector in selectors:
        found = select_value(applied, selector) if selector[0] == "<" else None
        if isinstance(found, TypeValue) and is_hidden(found.type) and not is_open(applied, found.type):
            return found
        hidden = hidden_type(applied, given(applied.args, selector) if selector.isdigit() else None)
        if hidden is None and (kind := _type_of(applied, selector)) is not None:
            return kind
        other = other or hidden
    return other


def _type_of(applied: Applied, selector: str) -> TypeValue | None:
    """The type of an argument, if it is one that parameters have."""
    if selector[0] in "<t":
        found = select_value(applied, selector)
        return found if isinstance(found, TypeValue) and parameter_type(found.type) is not None else None
    argument = given(applied.args, selector)
    if argument is None:
        return None
    shown = conversions.value_type(argument.value)
    for kind in (argument.type, shown):
        is_array = (
            kind is not None and kind.name == "char" and parameter_type(shown) == "str"
        )  # its brackets are not in its type
        if kind is not None and parameter_type(kind) is not None and not is_array:
            return TypeValue(kind)
    return None


def _members(applied: Applied, value: Value, names: list[str]) -> Value | None:
    for name in names:
        if isinstance(value, Pointer):
            value = value.cell.value
        if isinstance(value, Object):
            cell = members.member(applied.walk, value, name, applied.frame)
            if cell is None:
                return None
            value = cell.value
        elif isinstance(value, Opaque):
            return value
        else:
            return None
    return value


def _template_argument(types: tuple[syntax.Argument, ...], index: int) -> TypeValue | None:
    found = types[index] if index < len(types) else None
    return TypeValue(found) if type(found) is syntax.Type else None
