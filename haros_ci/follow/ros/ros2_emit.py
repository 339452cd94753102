# SPDX-License-Identifier: Apache-2.0
"""From an entry of a ROS 2 API row to what it makes: names on the node that it belongs to, QoS, declared parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import conversions, thrown
from haros_ci.follow.made import MadeEntity, Range, make
from haros_ci.follow.ros import forwarding, paces, qos_calls, qos_overrides, ros2_nodes, ros2_parameters, ros2_selectors
from haros_ci.follow.ros.possible_names import ONE_OF_NAMES, possible_names
from haros_ci.graph.given_parameters import NO_NAME
from haros_ci.graph.names import UNKNOWN, pattern
from haros_ci.graph.ros2_process import GIVEN, NO_DEFAULT, RosNode
from haros_ci.index.ros_types import is_hidden, ros2_data_type, ros2_parameter_type
from haros_ci.model.api import Entry
from haros_ci.model.architecture import KINDS
from haros_ci.model.location import Location
from haros_ci.values.abstract import (
    NONE,
    Cell,
    Choice,
    Known,
    Library,
    Mapped,
    Object,
    Opaque,
    Pointer,
    Sequence,
    Value,
    data_of,
    opaque_of,
)
from haros_ci.values.given import Given, marked

if TYPE_CHECKING:
    from haros_ci.follow.ros.selectors import Applied

Unknowns = list[tuple[str, str, Location | None]]
#: What is in a list that is empty by default, of a parameter of which the name is not known.
MORE = "names that parameters may add"
#: Why a name is not known that is empty as things are, in a branch that is not taken.
NOT_EMPTY = "as things are it is empty, and this is not made"
#: Why a name is not known that is a slash alone: rmw refuses it (rmw/validate_full_topic_name.h).
SLASH_ALONE = "as things are it is '/', which is no name of a topic or service"
PARAMETERS = frozenset(("getters", "setters", "parameters"))


def emit(applied: Applied, entry: Entry) -> Value | None:
    """Make one endpoint; for what reads or declares a parameter, the value that it has is returned."""
    from haros_ci.follow.ros.selectors import value_at

    if entry.kind not in KINDS:
        paces.emit(applied, entry)
        return None
    walk = applied.walk
    node, why_not = ros2_nodes.of_entry(applied, entry)
    if why_not == ros2_nodes.NO_NODE:
        return None
    provided = value_at(applied, entry.values["name"]) if "name" in entry.values else None
    if isinstance(provided, Choice) and entry.kind not in PARAMETERS:
        names = possible_names(provided)
        if any(isinstance(option, Known) for option in names):
            for option in names:
                with walk.doubted(ONE_OF_NAMES):
                    _named(applied, entry, option, node, why_not)
            return None
        provided = names[0] if len(names) == 1 else provided
    return _named(applied, entry, provided, node, why_not)


def _named(applied: Applied, entry: Entry, provided: Value | None, node: RosNode | None, why_not: str) -> Value | None:
    """Make the endpoint that has the name *provided*."""
    from haros_ci.follow.ros.emit import interface_type
    from haros_ci.follow.ros.selectors import value_at

    walk = applied.walk
    unknowns: Unknowns = []
    result = provided if provided is not None else Opaque("it is not given", applied.location)
    text, why, where = pattern(result if entry.kind in PARAMETERS else marked(result))
    if entry.kind in PARAMETERS and entry.each is not None:
        text = text.removeprefix(".")
    if why is None and text in ("", "/") and entry.kind not in PARAMETERS:
        if not text and (provided != Known("") or not (walk.dead or applied.frame.is_dead)):
            return None  # no name, no topic: a filter's subscriber that gets its topic later
        text, why, where = UNKNOWN, SLASH_ALONE if text else NOT_EMPTY, applied.location
    if entry.kind in PARAMETERS:
        return _parameter(applied, entry, node, why_not, (text, why, where))
    if why is not None:
        unknowns.append(("name", why, where or applied.location))
    if node is None:
        if not text.startswith("/"):
            unknowns.append(("name", why_not, applied.location))
        name = text if text.startswith("/") else f"/?/{text.removeprefix('~/')}"
    else:
        is_open = (
            why is not None and text.startswith("?") and not isinstance(provided, Choice)
        )  # it may begin with a slash
        name = node.expand(f"/{text}" if is_open else text)
        if "?" in name and why is None and node.why is not None:
            unknowns.append(("name", *node.why))
    qos, not_known = qos_calls.of_call(applied, entry)
    if not_known is not None:
        unknowns.append(("qos", not_known[0], not_known[1] or applied.location))
    place = forwarding.place(walk, text, applied.location)
    if qos is not None and node is not None and "options" in entry.values and entry.kind in qos_overrides.ENDS:
        options = value_at(applied, entry.values["options"])
        qos, said_of_it = qos_overrides.apply(applied, entry.kind, node, name, options, qos, place)
        unknowns += said_of_it
    endpoint_type = interface_type(applied, entry, unknowns)
    if entry.unsure:
        unknowns.append(("conditions", entry.unsure, applied.location))
    make(
        walk,
        MadeEntity(
            kind=entry.kind,
            name=name,
            type=endpoint_type,
            location=place,
            conditions=tuple(walk.conditions),
            implicit=entry.implicit,
            is_exact=applied.is_exact,
            is_behind=applied.is_behind,
            unknowns=tuple(unknowns),
            node=node.whole if node is not None else None,
            qos=qos,
            written=text,
        ),
    )
    return None


def _parameter(  # noqa: C901 - one branch for each way to declare a parameter
    applied: Applied, entry: Entry, node: RosNode | None, why_not: str, name: tuple[str, str | None, Location | None]
) -> Value | None:
    from haros_ci.follow.ros.selectors import TypeValue, in_type, value_of

    walk = applied.walk
    unknowns: Unknowns = []
    text, why, where = name
    if why is not None:
        unknowns.append(("name", why, where or applied.location))
    if node is None:
        unknowns.append(("name", why_not, applied.location))
    elif node.why is not None and why is None:
        unknowns.append(("name", *node.why))
    full = f"{node.whole.name if node is not None else '/?'}:{text}"
    found = value_of(applied, entry.values["value"]) if "value" in entry.values else None
    default, data = found if not isinstance(found, TypeValue) else None, None
    kind = value_of(applied, entry.values["type"]) if "type" in entry.values else None
    default = _unwrapped(default)
    default = in_type(applied, entry, default) if default is not None else None
    word = ros2_selectors.type_word(default)
    if word is not None:  # a type in place of a default value
        default = None
    if default is not None and default != NONE:
        known, data = data_of(default)
        if not known:
            reason = opaque_of(default)
            message = reason.reason if reason else "it is not plain data"
            unknowns.append(("value", message, (reason and reason.location) or applied.location))
            data = None
    declared = word
    if declared is not None:
        pass
    elif isinstance(kind, TypeValue):
        declared = ros2_parameter_type(kind.type)
    elif isinstance(kind, Library):
        declared = ros2_selectors.type_word(kind)
    elif isinstance(kind, Known):
        declared = ros2_parameter_type(syntax.Type(str(kind.value))) or str(kind.value)
    is_type_hidden = isinstance(kind, TypeValue) and is_hidden(kind.type)
    if declared is None and default is not None and not is_type_hidden:
        declared = ros2_data_type(data) if data is not None else ros2_parameter_type(conversions.value_type(default))
    is_told = why is None or ros2_parameters.is_telling(text)
    value, effective = _effective(applied, node, text if is_told else None, default, entry.kind)
    if declared is None and entry.kind == "parameters" and not is_type_hidden:
        declared = ros2_data_type(value.held if isinstance(value, Given) else effective)
    if declared is None and ("type" in entry.values or "value" in entry.values):
        unknowns.append(("type", "the type of the parameter is not known", applied.location))
    read_only, limits = _descriptor(applied, entry, unknowns, declared)
    if entry.kind == "parameters" and effective is None and value is not None and value != NONE:
        why_not_known = opaque_of(value)
        message = why_not_known.reason if why_not_known else "it is not plain data"
        unknowns.append(("effective", message, (why_not_known and why_not_known.location) or applied.location))
    if declared == "double" and isinstance(data, int) and not isinstance(data, bool):
        data = float(data)
    if entry.unsure:
        unknowns.append(("conditions", entry.unsure, applied.location))
    is_strict = entry.strict and (entry.kind != "parameters" or declared is not None)  # a name alone throws nothing
    raises = bool(walk.turning) and _raises(applied, entry, node, full, value is not None)
    make(
        walk,
        MadeEntity(
            kind=entry.kind,
            name=full,
            type=declared,
            location=forwarding.place(walk, text, applied.location),
            conditions=tuple(walk.conditions),
            value=data,
            implicit=entry.implicit,
            is_exact=applied.is_exact,
            is_behind=applied.is_behind,
            unknowns=tuple(unknowns),
            node=node.whole if node is not None else None,
            effective=effective if entry.kind == "parameters" else None,
            read_only=read_only,
            range=limits,
            written=text,
            is_dynamic=entry.kind == "parameters" and _is_dynamic(applied, entry),
            is_strict=is_strict and not (walk.trying or walk.dead or applied.frame.is_dead),
        ),
    )
    walk.is_raised = walk.is_raised or raises
    if walk.trials and entry.strict and entry.kind == "getters" and _is_undeclared(applied, node, text, value):
        thrown.throws(walk, thrown.UNDECLARED)
    if entry.kind == "setters" or entry.kind == "parameters":
        stored = default if entry.kind == "setters" else value
        if (
            stored is None
            and entry.kind == "parameters"
            and (word is not None or applied.frame.source.separator == "::")
        ):
            # without a value from outside the declaration or reading throws
            stored = Opaque(NO_DEFAULT, applied.location)
        ros2_parameters.remember(applied, full, stored if stored is not None else NONE)
    return ros2_parameters.while_running(applied, entry, full, value)


def _is_undeclared(applied: Applied, node: RosNode | None, name: str, value: Value | None) -> bool:
    if value is not None or node is None or "?" in name or node.whole.options.get(ros2_nodes.UNDECLARED):
        return False
    return ros2_parameters.is_declared(applied, node, Known(name)) == Known(False)


def _raises(applied: Applied, entry: Entry, node: RosNode | None, full: str, is_set: bool) -> bool:
    """Whether a parameter is read that is not declared, which ends a loop."""
    if not entry.strict or entry.kind != "getters" or applied.frame.is_dead or node is None:
        return False
    return not node.whole.options.get(ros2_nodes.UNDECLARED) and thrown.raises(
        applied.walk, full, applied.location, is_set
    )


def _unwrapped(value: Value | None) -> Value | None:
    """What a ParameterValue or Parameter holds."""
    if isinstance(value, Pointer):
        value = value.cell.value
    if isinstance(value, Object) and "value" in value.fields:
        return value.fields["value"].value
    return value


def _effective(
    applied: Applied, node: RosNode | None, name: str | None, default: Value | None, kind: str
) -> tuple[Value | None, object]:
    """The value that the parameter has, and as data: what is set or given from outside, else the default.

    Where it is declared now, what other ways have declared does not count; one that is not declared cannot be read.
    """
    if name is None or node is None:
        return Opaque(NO_NAME, applied.location), None
    found = ros2_parameters.parameter(applied, node, name, kind == "parameters")
    is_read = kind == "getters" and "?" not in name
    if is_read and found is not None and ros2_parameters.is_declared(applied, node, Known(name)) == Known(False):
        found = Opaque("it is given from outside, but the node is not seen to declare it", applied.location)
    if kind == "getters" and found is None and node.whole.kind == GIVEN and node.why is not None:
        found = Opaque(*node.why)  # it may have declared it
    value = found if found is not None else default
    if value is None:
        return None, None
    if found is None and kind == "parameters" and _is_empty(value) and "?" in name:
        assert isinstance(value, Sequence)  # of what is an element of a list itself, a list may have any
        value = Sequence(Cell(Opaque(MORE, applied.location)), value.type)
    if isinstance(value, Given):
        return value, value.made()
    known, data = data_of(value)
    if known and isinstance(value, Sequence):
        value = Known(data)  # of each reading it is a copy
    return value, data if known else None


#: The range that counts for a type (__check_parameter_value_in_range in rclcpp's node_parameters.cpp); of another type either may.
_RANGES = {"int": ("integer_range",), "double": ("floating_point_range",)}


def _descriptor(
    applied: Applied, entry: Entry, unknowns: Unknowns, declared: str | None
) -> tuple[bool | None, Range | None]:
    """Whether a parameter is read-only, and its range, as a ParameterDescriptor says for the type *declared*."""
    from haros_ci.follow.ros.selectors import value_at

    found = value_at(applied, entry.values["descriptor"]) if "descriptor" in entry.values else None
    if isinstance(found, Pointer):
        found = found.cell.value
    if entry.kind != "parameters":
        return None, None
    if found is None or (isinstance(found, Sequence) and found.content.value == ()):
        return False, None
    if not isinstance(found, Object):
        reason = found.reason if isinstance(found, Opaque) else "the descriptor is not known"
        unknowns += [(field, reason, applied.location) for field in ("read_only", "range")]
        return None, None
    flag = found.fields.get("read_only")
    read_only: bool | None = False
    if flag is not None and flag.value != NONE:
        read_only = bool(flag.value.value) if isinstance(flag.value, Known) else None
    if read_only is None:
        unknowns.append(("read_only", "what the descriptor says is not known", applied.location))
    for name in _RANGES.get(declared or "", ("floating_point_range", "integer_range")):
        cell = found.fields.get(name)
        first = _first(cell.value) if cell is not None else None
        if first is not None:
            limits = _number(first, "from_value"), _number(first, "to_value"), _number(first, "step")
            if None in limits[:2]:
                unknowns.append(("range", "what the descriptor says is not known", applied.location))
            return read_only, limits
        if cell is not None and isinstance(cell.value, (Opaque, Sequence)) and not _is_empty(cell.value):
            unknowns.append(("range", "what the descriptor says is not known", applied.location))
    return read_only, None


def _is_dynamic(applied: Applied, entry: Entry) -> bool:
    """Whether a parameter's type is not fixed by its declaration, as a ParameterDescriptor says, or may say."""
    from haros_ci.follow.ros.selectors import value_at

    found = value_at(applied, entry.values["descriptor"]) if "descriptor" in entry.values else None
    if isinstance(found, Pointer):
        found = found.cell.value
    if not isinstance(found, Object):
        return found is not None and not _is_empty(found)
    flag = found.fields.get("dynamic_typing")
    return flag is not None and flag.value not in (NONE, Known(False))


def _is_empty(value: Value) -> bool:
    return isinstance(value, Sequence) and value.content.value == ()


def _first(value: Value) -> Object | None:
    content = value.content.value if isinstance(value, (Sequence, Mapped)) else None
    first = content[0].value if isinstance(content, tuple) and content else None
    return first if isinstance(first, Object) else None


def _number(value: Object, name: str) -> float | None:
    cell = value.fields.get(name)
    held = cell.value.value if cell is not None and isinstance(cell.value, Known) else None
    return float(held) if isinstance(held, (int, float)) and not isinstance(held, bool) else None
