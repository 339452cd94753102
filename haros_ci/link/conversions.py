# SPDX-License-Identifier: Apache-2.0
"""Values as variables of a type hold them, and the types that values show by themselves."""

from __future__ import annotations

import ast

from haros_ci.link.types import INTEGERS, REALS, STRINGS, is_smart_pointer, pointee
from haros_ci.link.values import (
    Callable,
    Choice,
    Known,
    Mapped,
    Object,
    Opaque,
    Pointer,
    Sequence,
    Text,
    Value,
    data_of,
)
from haros_ci.model.program import Type


def converted(value: Value, kind: Type | None) -> Value:
    """*value* as a variable of type *kind* holds it: an Opaque learns its type, numbers follow C++'s conversions."""
    if kind is None or kind[0] in ("", "auto"):
        return value
    if kind[0] == "XmlRpc::XmlRpcValue" and not isinstance(value, Opaque):
        known, data = data_of(value)
        return Known(data) if known else value
    if isinstance(value, Opaque):
        return value if value.type is not None and _is_class(value.type) else Opaque(value.reason, value.location, kind)
    if isinstance(value, Known):
        data, name = value.value, kind[0]
        if name in REALS and isinstance(data, (int, bool)):
            return Known(float(data))
        if name in INTEGERS and isinstance(data, float) and abs(data) < 2**63:
            return Known(int(data))
        if name in INTEGERS and isinstance(data, bool) and "*" not in kind[2]:
            return Known(int(data))
        if name == "bool" and isinstance(data, (int, float)):
            return Known(bool(data))
    return value


def _is_class(kind: Type) -> bool:
    return (
        kind[0] not in STRINGS
        and kind[0] not in INTEGERS
        and kind[0] not in REALS
        and kind[0] not in ("bool", "auto", "")
    )


def value_type(value: Value) -> Type | None:
    """The static type that a value shows by itself."""
    if isinstance(value, Known):
        for python, name in (
            (bool, "bool"),
            (int, "int"),
            (float, "double"),
            (str, "std::string"),
            (list, "list"),
            (dict, "dict"),
        ):
            if isinstance(value.value, python):
                return (name, (), "")
        return None
    if isinstance(value, Text):
        return ("std::string", (), "")
    if isinstance(value, Object):
        return (value.name, value.arguments, "")
    if isinstance(value, Opaque):
        return value.type
    if isinstance(value, Sequence):
        return value.type or ("list", (), "")
    if isinstance(value, Mapped):
        return ("dict", (), "")
    if isinstance(value, Choice):
        return value_type(value.options[0])
    if isinstance(value, Pointer):
        return value.cell.type or value_type(value.cell.value)
    if isinstance(value, Callable):
        return ("function", (), "")
    return None


def macro(body: str) -> Value:
    """An object-like macro's value, where it is a literal."""
    text = body.strip().strip("()").strip()
    try:
        found = ast.literal_eval(text.rstrip("fFlLuU") if not text.startswith(('"', "'")) else text)
    except (ValueError, SyntaxError, MemoryError, RecursionError):
        return Opaque(f"a macro: {text[:80]}")
    return Known(found) if isinstance(found, (str, int, float)) else Opaque(f"a macro: {text[:80]}")


def smart(kind: Type | None) -> Type | None:
    """What a smart pointer's type points to; None for other types."""
    return pointee(kind) if kind is not None and is_smart_pointer(kind) else None
