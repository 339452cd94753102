# SPDX-License-Identifier: Apache-2.0
"""The type hash of ROS 2 (REP 2016, RIHS01): SHA-256 over the type description as JSON.

A type description (type_description_interfaces/msg/TypeDescription) lists the fields of a type and of all that it refers to, sorted by
name, without constants and default values. Each service has a third part, its event; each action has two services, which send a goal
and get a result, and a message with feedback. rosidl gives a structure without fields one of its own.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from haros_ci.interfaces.definitions import Definitions, FieldType, field_type
from haros_ci.model.build import Interface, InterfaceField

#: A type's description: its fields in order.
Fields = list[dict[str, Any]]

#: type_description_interfaces/msg/FieldType; ``char`` of a .msg is an uint8 (rosidl_adapter).
_IDS = {
    "int8": 2, "uint8": 3, "int16": 4, "uint16": 5, "int32": 6, "uint32": 7, "int64": 8, "uint64": 9,
    "float32": 10, "float64": 11, "char": 3, "bool": 15, "byte": 16, "string": 17, "wstring": 18,
}  # fmt: skip
_NESTED = 1
_BOUNDED_STRING = 4
_FORMS = {"": 0, "array": 48, "bounded": 96, "sequence": 144}
_MEMBER_OF_EMPTY = "structure_needs_at_least_one_member"
_UUID, _TIME, _EVENT = (
    "unique_identifier_msgs/msg/UUID",
    "builtin_interfaces/msg/Time",
    "service_msgs/msg/ServiceEventInfo",
)
#: A safeguard: types that one type may refer to.
MAX_TYPES = 2_000


def rihs01(interface: Interface, known: Definitions) -> str | None:
    """The type hash of *interface*, ``RIHS01_`` and 64 digits; None if it, or a type in it, is not known for certain."""
    key = (interface.kind, interface.name)
    if key not in known.hashes:
        made = descriptions(interface, known)
        package, _, name = interface.name.partition("/")
        known.hashes[key] = None if made is None else hash_of(f"{package}/{interface.kind}/{name}", made)
    return known.hashes[key]


def hash_of(name: str, described: Mapping[str, Fields]) -> str | None:
    """The type hash of ``pkg/kind/T``, one of *described*."""
    referenced: set[str] = set()
    waiting = [name]
    while waiting:
        at = waiting.pop()
        if at not in described or len(referenced) > MAX_TYPES:
            return None
        new = {field["type"]["nested_type_name"] for field in described[at]} - referenced - {""}
        referenced |= new
        waiting += new
    text = json.dumps(
        {
            "type_description": {"type_name": name, "fields": described[name]},
            "referenced_type_descriptions": [
                {"type_name": item, "fields": described[item]} for item in sorted(referenced)
            ],
        }
    )
    return f"RIHS01_{hashlib.sha256(text.encode()).hexdigest()}"


def descriptions(interface: Interface, known: Definitions) -> dict[str, Fields] | None:
    """The types that *interface* is made of and refers to, by their full names; None if one is not known."""
    made: dict[str, Fields] = {}
    waiting: list[tuple[str, str]] = []
    if not _add(interface, made, waiting):
        return None
    while waiting:
        kind, name = waiting.pop()
        package, _, short = name.partition("/")
        if f"{package}/{kind}/{short}" in made:
            continue
        found = known.find(kind, name)
        if found is None or len(made) > MAX_TYPES or not _add(found, made, waiting):
            return None
    return made


def _add(interface: Interface, made: dict[str, Fields], waiting: list[tuple[str, str]]) -> bool:
    """Describe all types of *interface* itself into *made*; what they refer to goes to *waiting*."""
    if not interface.is_whole:
        return False
    package, _, name = interface.name.partition("/")
    whole = f"{package}/{interface.kind}/{name}"
    parts = [_fields(section, package, waiting) for section in interface.sections]
    if None in parts:
        return False
    described = [part for part in parts if part is not None]
    if interface.kind == "msg":
        made[whole] = described[0]
    elif interface.kind == "srv":
        _service(whole, described, made, waiting)
    else:
        _action(whole, described, made, waiting)
    return True


def _service(name: str, parts: Sequence[Fields], made: dict[str, Fields], waiting: list[tuple[str, str]]) -> None:
    request, response, event = (f"{name}{suffix}" for suffix in ("_Request", "_Response", "_Event"))
    made[name] = [
        _field("request_message", _NESTED, nested=request),
        _field("response_message", _NESTED, nested=response),
        _field("event_message", _NESTED, nested=event),
    ]
    made[request], made[response] = parts
    made[event] = [
        _field("info", _NESTED, nested=_EVENT),
        _field("request", _NESTED + _FORMS["bounded"], 1, nested=request),
        _field("response", _NESTED + _FORMS["bounded"], 1, nested=response),
    ]
    waiting.append(("msg", _EVENT.replace("/msg/", "/")))


def _action(name: str, parts: Sequence[Fields], made: dict[str, Fields], waiting: list[tuple[str, str]]) -> None:
    goal, result, feedback = (f"{name}{suffix}" for suffix in ("_Goal", "_Result", "_Feedback"))
    send, get, message = (f"{name}{suffix}" for suffix in ("_SendGoal", "_GetResult", "_FeedbackMessage"))
    made[goal], made[result], made[feedback] = parts
    of_goal = _field("goal_id", _NESTED, nested=_UUID)
    made[name] = [
        _field("goal", _NESTED, nested=goal),
        _field("result", _NESTED, nested=result),
        _field("feedback", _NESTED, nested=feedback),
        _field("send_goal_service", _NESTED, nested=send),
        _field("get_result_service", _NESTED, nested=get),
        _field("feedback_message", _NESTED, nested=message),
    ]
    accepted = [_field("accepted", _IDS["bool"]), _field("stamp", _NESTED, nested=_TIME)]
    _service(send, ([of_goal, _field("goal", _NESTED, nested=goal)], accepted), made, waiting)
    got = [_field("status", _IDS["int8"]), _field("result", _NESTED, nested=result)]
    _service(get, ([of_goal], got), made, waiting)
    made[message] = [of_goal, _field("feedback", _NESTED, nested=feedback)]
    waiting += (("msg", item.replace("/msg/", "/")) for item in (_UUID, _TIME))


def _fields(fields: Iterable[InterfaceField], package: str, waiting: list[tuple[str, str]]) -> Fields | None:
    made = []
    for field in fields:
        if field.is_constant:
            continue
        kind = field_type(field.type)
        if kind is None:
            return None
        if not kind.is_nested:
            id = _IDS.get(kind.base)
            if id is None:
                return None  # time and duration are not of ROS 2
            id += _BOUNDED_STRING if kind.length else 0
            made.append(_field(field.name, id + _FORMS[kind.form], kind.size, kind.length))
            continue
        base = _base(kind, field, package)
        owner, _, name = base.partition("/")
        made.append(_field(field.name, _NESTED + _FORMS[kind.form], kind.size, nested=f"{owner}/msg/{name}"))
        waiting.append(("msg", base))
    return made or [_field(_MEMBER_OF_EMPTY, _IDS["uint8"])]


def _base(kind: FieldType, field: InterfaceField, package: str) -> str:
    """``Header`` alone is a type of the package itself in ROS 2."""
    return f"{package}/Header" if field.written == "Header" else kind.base


def _field(name: str, id: int, size: int = 0, length: int = 0, nested: str = "") -> dict[str, Any]:
    return {
        "name": name,
        "type": {"type_id": id, "capacity": size, "string_capacity": length, "nested_type_name": nested},
    }
