# SPDX-License-Identifier: Apache-2.0
"""Members of Python's enumerations: ``E.A.value``, ``E.A.name``, and all of them in a loop (docs.python.org/3/library/enum.html)."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import expressions, members, methods
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import Cell, ClassValue, Known, Object, Value

#: The last parts of the names of classes whose subclasses are enumerations.
BASES = frozenset(("Enum", "IntEnum", "StrEnum", "Flag", "IntFlag"))
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
    return [
        Object(MEMBER, fields={"name": Cell(Known(name)), "value": Cell(_value(walk, value, name))}) for name in names
    ]


def _value(walk: Walk, owner: ClassValue, name: str) -> Value:
    cell = members.static_cell(walk, owner.source, owner.definition, name)
    return cell.value if cell is not None else walk.opaque("a member of an enumeration", Frame(owner.source, ""))
