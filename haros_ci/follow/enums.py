# SPDX-License-Identifier: Apache-2.0
"""Members of Python's enumerations: ``E.A.value``, ``E.A.name``, ``E["A"]``, and all of them in a loop (docs.python.org/3/library/enum.html)."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import expressions, members, methods
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import Cell, ClassValue, Known, Library, Object, Value

#: The last parts of the names of classes whose subclasses are enumerations.
BASES = frozenset(("Enum", "IntEnum", "StrEnum", "Flag", "IntFlag"))
#: Enumerations of rclpy, each also with ``QoS`` before its name (rclpy/qos.py).
POLICIES = frozenset(("HistoryPolicy", "ReliabilityPolicy", "DurabilityPolicy", "LivelinessPolicy"))
#: What members have.
FIELDS = frozenset(("value", "name"))
MEMBER = "(enum)"


def is_enumeration(walk: Walk, value: Value) -> bool:
    """Whether *value* is a class that lists its members."""
    return isinstance(value, ClassValue) and any(
        base.rpartition(".")[2] in BASES for base in methods.library_bases(walk, value.source, value.definition)
    )


def field(walk: Walk, frame: Frame, expression: syntax.Member) -> Value | None:
    """``E.A.value`` or ``E.A.name``; None for another expression."""
    inner = expression.object
    if type(inner) is not syntax.Member or not isinstance(inner.object, (syntax.Name, syntax.Member)):
        return None
    owner = expressions.evaluate(walk, frame, inner.object)
    if not isinstance(owner, ClassValue) or not is_enumeration(walk, owner):
        return None
    if all(other_field.name != inner.name for other_field in owner.definition.fields):
        return None
    return Known(inner.name) if expression.name == "name" else _value(walk, owner, inner.name)


def elements(walk: Walk, value: Value) -> list[Value] | None:
    """The members of an enumeration, in their order; None for another value."""
    if not isinstance(value, ClassValue) or not is_enumeration(walk, value):
        return None
    names = [other_field.name for other_field in value.definition.fields if not other_field.name.startswith("_")]
    return [_member(walk, value, name) for name in names]


def named(walk: Walk, owner: Value, key: Value) -> Value | None:
    """``E["A"]``: a member by its name, also of a policy of rclpy (rclpy/qos.py); None of anything else, and for a name that is not known."""
    if not isinstance(key, Known) or not issubclass(key.kind, str):
        return None
    if isinstance(owner, Library):
        is_policy = owner.name.removeprefix("rclpy.qos.").removeprefix("QoS") in POLICIES
        return Library(f"{owner.name}.{key.value}") if is_policy else None
    name = key.of(str)
    if not isinstance(owner, ClassValue) or not is_enumeration(walk, owner):
        return None
    return _member(walk, owner, name) if any(field.name == name for field in owner.definition.fields) else None


def _member(walk: Walk, owner: ClassValue, name: str) -> Object:
    return Object(MEMBER, fields={"name": Cell(Known(name)), "value": Cell(_value(walk, owner, name))})


def _value(walk: Walk, owner: ClassValue, name: str) -> Value:
    cell = members.static_cell(walk, owner.source, owner.definition, name)
    return cell.value if cell is not None else walk.opaque("a member of an enumeration", Frame(owner.source, ""))
