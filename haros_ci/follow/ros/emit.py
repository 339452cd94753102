# SPDX-License-Identifier: Apache-2.0
"""From an entry of an API row to what it makes: names resolved, types found, unknowns with their reasons."""

from __future__ import annotations

from math import ceil, floor, fmod, isfinite
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import conversions, thrown
from haros_ci.follow.libraries import python_modules
from haros_ci.follow.made import MadeEntity, make
from haros_ci.follow.ros import own_name, paces, ros2_emit
from haros_ci.follow.ros.ends import UNNAMED
from haros_ci.follow.ros.own_names import own_names
from haros_ci.follow.walk import Renamed, Walk
from haros_ci.graph.names import clean, pattern, resolve
from haros_ci.index.common_messages import COMMON
from haros_ci.index.ros_types import SERIALISED, WRAPPERS, data_type, message_type, parameter_type, ros2_type
from haros_ci.index.types import pointee
from haros_ci.model.api import Entry
from haros_ci.model.architecture import KINDS
from haros_ci.model.location import Location
from haros_ci.syntax import Type
from haros_ci.values.abstract import NONE, Cell, Choice, Known, Library, Object, Opaque, Value, data_of, opaque_of

if TYPE_CHECKING:
    from haros_ci.follow.ros.selectors import Applied

Unknowns = list[tuple[str, str, Location | None]]
PARAMETERS = ("getters", "setters")


#: Why it is not known what a server of dynamic_reconfigure writes.
RECONFIGURED = "its server writes what is set or its default in the .cfg, and later what somebody asks it for"
#: The types of data that a parameter of roscpp may have to be read as another.
_READ: dict[str, tuple[type, ...]] = {"bool": (bool,), "int": (int, float), "double": (int, float), "str": (str,)}


def emit(applied: Applied, entry: Entry) -> Value | None:  # noqa: C901 - one branch for each kind of endpoint
    """Make one endpoint (or name the node); for a getter, the value that it reads is returned."""
    walk = applied.walk
    if walk.context.process is not None:
        return ros2_emit.emit(applied, entry)
    if entry.kind == "node":
        from haros_ci.follow.ros.selectors import value_at

        own = value_at(applied, entry.values["name"]) if "name" in entry.values else None
        anonymous = value_at(applied, entry.values["anonymous"]) if "anonymous" in entry.values else Known(False)
        if own is not None and own_name.named(walk, own, anonymous, applied.frame):
            raise Renamed
        return None
    if entry.kind not in KINDS:
        paces.emit(applied, entry)
        return None
    unknowns: Unknowns = []
    name, written = _name(applied, entry, unknowns)
    if name == "" and not unknowns:
        return None  # no name, no topic: a filter's subscriber that gets its topic later
    value, default = _value(applied, entry, unknowns)
    endpoint_type = _type(applied, entry, unknowns, default)
    if endpoint_type == "bool" and isinstance(value, str) and applied.frame.source.program.language != "python":
        value, default = True, Known(True)  # param<bool>(name, "false"): a pointer that is not null
    if entry.kind == "setters" and entry.each is not None:
        unknowns.append(("value", RECONFIGURED, applied.location))
    queue = latched = None
    if entry.kind in ("publishers", "subscribers"):
        queue = _integer(applied, entry, "queue_size", unknowns)
    if entry.kind == "publishers":
        latched = _flag(applied, entry, unknowns)
    if entry.unsure:
        unknowns.append(("conditions", entry.unsure, applied.location))
    raises = bool(walk.turning) and _raises(applied, entry, name, default)
    make(
        walk,
        MadeEntity(
            kind=entry.kind,
            name=name,
            type=endpoint_type,
            location=applied.location,
            conditions=tuple(walk.conditions),
            queue_size=queue,
            latched=latched,
            value=None if entry.each is not None else value,
            implicit=entry.implicit,
            is_exact=applied.is_exact,
            is_behind=applied.is_behind,
            unknowns=tuple(unknowns),
            written=written,
            is_strict=entry.strict and not (walk.trying or walk.dead or applied.frame.is_dead),
        ),
    )
    walk.is_raised = walk.is_raised or raises
    if entry.kind == "setters" and entry.each is None:
        _set(applied, walk.context.remap(name), default if default is not None else NONE)
    if entry.kind != "getters":
        return None
    from haros_ci.follow.ros.api_rows import parameter_value

    found = parameter_value(applied, walk.context.remap(name), default)
    if walk.trials and entry.strict:
        thrown.is_read(walk, found, thrown.KEY)
    if found is not None and found is not default and applied.frame.source.separator == "::":
        found = _fitting(found, endpoint_type, default)
    if entry.each is not None:
        _remember(applied, entry, found)
    return found


def _raises(applied: Applied, entry: Entry, name: str, default: Value | None) -> bool:
    """Whether a parameter is read that nothing sets, which ends a loop."""
    from haros_ci.follow.ros.api_rows import parameter_value

    if not entry.strict or entry.kind != "getters" or applied.frame.is_dead:
        return False
    walk = applied.walk
    found = parameter_value(applied, walk.context.remap(name), default)
    return thrown.raises(walk, name, applied.location, found is not None)


def _fitting(found: Value, kind: str | None, default: Value | None) -> Value | None:
    """What roscpp makes of a parameter that is read as *kind* (param.cpp, getImpl): one of another type counts as not set.

    Whole numbers are read as real ones, and real ones as the nearest whole ones.
    """
    if not isinstance(found, Known) or kind not in _READ:
        return found
    data = found.value
    if type(data) not in _READ[kind]:
        return default
    if kind == "int" and isinstance(data, float):
        if not isfinite(data):
            return Opaque("it is no number")
        return Known(floor(data) if fmod(data, 1.0) < 0.5 else ceil(data))
    return found


def _set(applied: Applied, name: str, value: Value) -> None:
    """The node finds afterwards what it has set, ``NONE`` for deleted; after a name that is not known, nothing for sure."""
    walk = applied.walk
    own = walk.server.value
    if isinstance(own, Opaque):
        return
    if not walk.context.is_asked(name):
        walk.state.write(walk.server, Opaque("a parameter is set under a name that is not known", applied.location))
        return
    known, data = data_of(value)
    below: dict[str, Value] = {other: NONE for other in own if other.startswith(f"{name}/")}
    walk.state.write(walk.server, {**own, **below, name: Known(data) if known else value})


def _remember(applied: Applied, entry: Entry, value: Value | None) -> None:
    """A dynamic_reconfigure parameter's value, for the callback that gets them all: switches and numbers are there to be changed, texts mostly name things."""
    from haros_ci.follow.ros.selectors import config_name, select_value

    assert entry.each is not None and applied.item is not None
    name = config_name(select_value(applied, entry.each[7:-1]), applied.walk)
    config = applied.walk.config_objects.setdefault(name, Object(name))
    member = applied.item["name"]
    name = member.of(str) if isinstance(member, Known) else ""
    if isinstance(value, Known) and not issubclass(value.kind, str):
        value = Opaque(RECONFIGURED, applied.location)
    config.fields[name] = Cell(value if value is not None else Opaque("a parameter that is not set"))


def _name(applied: Applied, entry: Entry, unknowns: Unknowns) -> tuple[str, str]:
    """The name in full, and as the call gives it; both empty where there is none."""
    from haros_ci.follow.handles import namespace_of
    from haros_ci.follow.ros.selectors import value_at

    own, above = own_names(applied)
    found = value_at(applied, entry.values["name"]) if "name" in entry.values else None
    if found is None:
        found = applied.walk.opaque("it is not given", applied.frame, applied.location.line)
    text, why, where = pattern(found)
    space: Value = Known(above)
    if "namespace" in entry.values:
        chosen = value_at(applied, entry.values["namespace"])
        if chosen is not None:
            space = namespace_of(applied, chosen)
    elif isinstance(applied.receiver, Object) and applied.receiver.namespace is not None:
        space = applied.receiver.namespace
        if isinstance(space, Opaque):
            space = namespace_of(applied, space)
    elif isinstance(applied.receiver, Object) and applied.receiver.name in ("ros::NodeHandle",):
        space = namespace_of(applied, applied.receiver)
    prefix, space_why, space_where = pattern(space)
    if why is None and not text and entry.kind in ("publishers", "subscribers"):
        return "", ""
    if why is not None:
        unknowns.append(("name", why, where or applied.location))
    elif space_why is not None and text[:1] not in ("/", "~"):
        unknowns.append(("name", space_why, space_where or applied.location))
    may_be_absolute = why is not None and text.startswith("?") and not isinstance(found, Choice)
    if may_be_absolute and entry.kind not in PARAMETERS:
        return clean(f"/{text}"), text
    return resolve(text, prefix, own), text


def _type(applied: Applied, entry: Entry, unknowns: Unknowns, default: Value | None) -> str | None:
    from haros_ci.follow.ros.selectors import TypeValue, value_of

    found = value_of(applied, entry.values["type"]) if "type" in entry.values else None
    result: str | None = None
    if isinstance(found, Library):
        found = TypeValue(syntax.Type(found.name))
    if entry.kind in PARAMETERS:
        if isinstance(found, TypeValue):
            result = parameter_type(found.type)
        elif isinstance(found, Known):
            result = parameter_type(syntax.Type(str(found.value))) or str(found.value)
        if result is None and default is not None and not isinstance(found, TypeValue):
            known, data = data_of(default)
            result = data_type(data) if known else None
        if result is None and ("type" in entry.values or "value" in entry.values):
            unknowns.append(("type", "the type of the variable is not known", applied.location))
        return result
    return interface_type(applied, entry, unknowns)


def interface_type(applied: Applied, entry: Entry, unknowns: Unknowns) -> str | None:
    """The message, service or action type of an endpoint: ``pkg/T``, in ROS 2 ``pkg/msg/T``; None if it is not known."""
    from haros_ci.follow.ros.selectors import TypeValue, value_of

    found = value_of(applied, entry.values["type"]) if "type" in entry.values else None
    result: str | None = None
    if isinstance(found, Library):
        found = TypeValue(syntax.Type(found.name))
    is_ros2 = applied.walk.context.process is not None
    if isinstance(found, TypeValue):
        found = TypeValue(
            _meant(applied.walk, python_modules.opened(applied.walk, applied.frame, found.type, entry.kind))
        )
        result = ros2_type(found.type) if is_ros2 else message_type(found.type)
        if result is not None and not is_ros2 and not _is_interface(applied, found.type, result):
            result = None
        if (
            result is not None
            and not is_ros2
            and entry.kind == "servers"
            and not found.type.name.endswith(("::Request", "::Response"))
        ):
            result = _service(found.type, result)
        if result is None and found.type.name:
            unknowns.append(("type", f"{found.type.name} is no message type that is known", applied.location))
            return None
    elif isinstance(found, Known) and issubclass(found.kind, str):
        result = found.of(str)
    if result is not None and not is_ros2 and entry.kind in ("action_servers", "action_clients"):
        result = result.removesuffix("Action")
    if result is None:
        reason = found.reason if isinstance(found, Opaque) else "the call does not tell it"
        unknowns.append(("type", reason, applied.location))
    return result


def _meant(walk: Walk, kind: Type) -> Type:
    """*kind*, pointers looked through, or the type that it is another name of in a library (``alias`` of a row)."""
    inner = pointee(kind)
    alias = next((row.alias for row in walk.rows.get(inner.name, ()) if row.alias), "")
    return syntax.Type(alias) if alias else kind


def _is_interface(applied: Applied, kind: Type, result: str) -> bool:
    """Whether ``a/B`` may be a message, service or action: no class of the workspace, and no member of one."""
    index = applied.walk.index
    package, _, name = result.partition("/")
    if applied.frame.source.program.language == "python" or name in COMMON.get(package, ()):
        return True
    inner = pointee(kind)
    while inner.name in WRAPPERS and (held := inner.of(0)) is not None:
        inner = pointee(held)
    if result in SERIALISED.values():
        return True
    if package != package.lower() and package not in COMMON:  # REP 144: packages are in lower case
        return any(f"{package}::{name}" in included.values() for included in index.included.values())
    heads = (inner.name, inner.name.rpartition("::")[0], f"{package}::{name}", package)
    return not any(head in index.classes or head in index.aliases for head in heads)


def _service(kind: Type, result: str) -> str:
    """The service of a callback's ``pkg::NameRequest`` or ``pkg::NameResponse``, the classes behind its two halves."""
    while kind.name in WRAPPERS and (held := kind.of(0)) is not None:
        kind = pointee(kind)
        kind = pointee(held)
    if kind.name.endswith(("::Request", "::Response")) or "::" not in kind.name:
        return result
    for half in ("Request", "Response"):
        if result.endswith(half) and not result.endswith(f"/{half}"):
            return result.removesuffix(half)
    return result


def _value(applied: Applied, entry: Entry, unknowns: Unknowns) -> tuple[object, Value | None]:
    from haros_ci.follow.ros.selectors import TypeValue, in_type, value_of

    if entry.kind not in PARAMETERS or "value" not in entry.values:
        return None, None
    found = value_of(applied, entry.values["value"])
    if found is None or isinstance(found, TypeValue):
        return None, None
    found = in_type(applied, entry, found)
    known, data = data_of(found)
    if known and not _is_unnamed(applied.walk, data):
        return data, found
    why = Opaque(UNNAMED) if known else opaque_of(found)
    unknowns.append(
        ("value", why.reason if why else "it is not plain data", (why and why.location) or applied.location)
    )
    return None, found


def _is_unnamed(walk: Walk, data: object) -> bool:
    """Whether a text is made of the node's own name, or its namespace, of which a part is not known."""
    if not isinstance(data, str) or "?" not in data:
        return False
    return any("?" in own and own in data for own in (walk.context.name, walk.context.namespace))


def _integer(applied: Applied, entry: Entry, key: str, unknowns: Unknowns) -> int | None:
    from haros_ci.follow.ros.selectors import value_of

    if key not in entry.values:
        return None
    found = value_of(applied, entry.values[key])
    if found is None:
        return None
    if isinstance(found, Known) and issubclass(found.kind, (int, float)) and not isinstance(found.value, bool):
        if isinstance(found.value, (int, float)) and isfinite(found.value):
            return int(found.value)
        found = Opaque("it is infinite")
    if isinstance(found, Known) and found.value is None:
        return None
    why = opaque_of(found)
    unknowns.append((key, why.reason if why else "it is no number", (why and why.location) or applied.location))
    return None


def _flag(applied: Applied, entry: Entry, unknowns: Unknowns) -> bool | None:
    from haros_ci.follow.ros.selectors import value_of

    found = value_of(applied, entry.values["latched"]) if "latched" in entry.values else None
    if found is None:
        return False
    known = conversions.flag(found)
    if known is not None:
        return known
    why = opaque_of(found)
    unknowns.append(("latched", why.reason if why else "it is no flag", (why and why.location) or applied.location))
    return None
