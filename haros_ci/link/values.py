# SPDX-License-Identifier: Apache-2.0
"""Abstract values: what is known of a value while a program is followed without running it.

A value is ``Known`` data, ``Text`` with unknown parts, a ``Choice`` of several, an object, a sequence, a function, a
class, or ``Opaque`` with its reason. ``join`` is what both branches of a statement allow; it never prefers one of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Union

from haros_ci.model.location import Location
from haros_ci.model.program import Class, Function, Type

#: More possible values than this are not kept apart.
CHOICES = 8


@dataclass(frozen=True, slots=True)
class Known:
    """Data: None, bool, int, float, str, or JSON-like lists and dicts, as read from YAML. Lists are never changed."""

    value: Any


@dataclass(frozen=True, slots=True)
class Opaque:
    """Not known: *reason* for a person, *location* where it came in, *type* its static type (canonical) or None."""

    reason: str
    location: Location | None = None
    type: Type | None = None


@dataclass(frozen=True, slots=True)
class Text:
    """A text of known and opaque parts, in turn."""

    parts: tuple[str | Opaque, ...]


@dataclass(frozen=True, slots=True)
class Choice:
    """One of several known values; there is no telling which."""

    options: tuple[Value, ...]


@dataclass(slots=True, eq=False)
class Cell:
    """A variable, member or element: it holds a Value, and may have a declared type.

    The content of a sequence or map is a cell, too: of a tuple of cells, of a dict. Written through ``State.write`` only.
    """

    value: Any
    type: Type | None = None


@dataclass(slots=True, eq=False)
class Object:
    """An instance of class *name* (canonical, without template arguments); ``definition`` is None for a library's."""

    name: str
    arguments: tuple[Type, ...] = ()
    definition: Any = None
    fields: dict[str, Cell] = field(default_factory=dict)
    location: Location | None = None
    templates: Mapping[str, Type] = field(default_factory=dict)
    #: The node handle's namespace, where the object is one: a value.
    namespace: Value | None = None


@dataclass(slots=True, eq=False)
class Sequence:
    """A list or vector: one cell that holds a tuple of cells, or an Opaque where the elements are not known."""

    content: Cell
    type: Type | None = None
    #: What its ``end()`` is, so that it is equal to itself.
    end: Object | None = None


@dataclass(slots=True, eq=False)
class Mapped:
    """A dict or map: one cell that holds a mapping from keys to cells, or an Opaque."""

    content: Cell


@dataclass(frozen=True, slots=True, eq=False)
class Pointer:
    """The address of a variable that is no object (a pointer to an object is the object)."""

    cell: Cell


@dataclass(frozen=True, slots=True, eq=False)
class Callable:
    """A function with what is bound to it: *this*, leading arguments, the frame of a lambda."""

    source: Any
    function: Function
    this: Object | None = None
    #: Bound arguments in place; None is a placeholder.
    bound: tuple[Value | None, ...] = ()
    frame: Any = None
    templates: Mapping[str, Type] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Library:
    """A name of a library: a function, class or module without source in the workspace; *this* is a method's receiver."""

    name: str
    this: Any = None


@dataclass(frozen=True, slots=True, eq=False)
class ClassValue:
    """A class of the workspace as a value."""

    source: Any
    definition: Class


@dataclass(frozen=True, slots=True, eq=False)
class Module:
    """A Python module of the workspace as a value."""

    source: Any


Value = Union[Known, Opaque, Text, Choice, Object, Sequence, Mapped, Pointer, Callable, Library, ClassValue, Module]

NONE = Known(None)
TRUE = Known(True)
FALSE = Known(False)


def join(one: Value, other: Value) -> Value:
    """What may hold when either may: the same value, a choice of known ones, or Opaque."""
    if one is other or (type(one) is type(other) and not isinstance(one, (Known, Opaque)) and one == other):
        return one
    if isinstance(one, Known) and isinstance(other, Known) and same(one.value, other.value):
        return one
    if isinstance(one, Opaque):
        return one
    if isinstance(other, Opaque):
        return other
    options: list[Value] = list(one.options) if isinstance(one, Choice) else [one]
    for option in other.options if isinstance(other, Choice) else (other,):
        if not any(
            option is seen
            or (isinstance(option, Known) and isinstance(seen, Known) and same(option.value, seen.value))
            or (isinstance(option, Text) and option == seen)
            for seen in options
        ):
            options.append(option)
    if len(options) > CHOICES:
        return Opaque("it may be one of many values")
    return options[0] if len(options) == 1 else Choice(tuple(options))


def same(one: Any, other: Any) -> bool:
    """Equality that keeps True, 1 and 1.0 apart."""
    return type(one) is type(other) and bool(one == other)


def concatenate(values: tuple[Value, ...]) -> Value:
    """Text from parts; numbers are written as C++ streams and Python write them."""
    parts: list[str | Opaque] = []
    for index, value in enumerate(values):
        if isinstance(value, Choice):
            chosen: Value | None = None
            for option in value.options:
                whole = concatenate((*values[:index], option, *values[index + 1 :]))
                chosen = whole if chosen is None else join(chosen, whole)
            return chosen if chosen is not None else Opaque("no value")
        if isinstance(value, Known) and isinstance(value.value, (str, int, float)):
            parts.append(written(value.value))
        elif isinstance(value, Text):
            parts.extend(value.parts)
        elif isinstance(value, Opaque):
            parts.append(value)
        else:
            parts.append(Opaque("it is not text"))
    merged: list[str | Opaque] = []
    for part in parts:
        if isinstance(part, str) and merged and isinstance(merged[-1], str):
            merged[-1] += part
        elif part != "":
            merged.append(part)
    if not merged:
        return Known("")
    if len(merged) == 1:
        return Known(merged[0]) if isinstance(merged[0], str) else merged[0]
    return Text(tuple(merged))


def written(value: Any) -> str:
    """A scalar as text."""
    if isinstance(value, bool):
        return "1" if value else "0"
    return str(value)


def opaque_of(value: Value) -> Opaque | None:
    """The first reason why *value* is not known as data; None if it is."""
    if isinstance(value, Known):
        return None
    if isinstance(value, Opaque):
        return value
    if isinstance(value, Text):
        return next(part for part in value.parts if isinstance(part, Opaque))
    if isinstance(value, Choice):
        shown = ", ".join(sorted(repr(o.value) for o in value.options if isinstance(o, Known)))
        return Opaque(f"it may be one of {shown}" if shown else "it may be one of several values")
    return Opaque("it is not plain data")


def data_of(value: Value) -> tuple[bool, Any]:
    """(True, data) for what is wholly known, sequences and maps included."""
    if isinstance(value, Known):
        return True, value.value
    if isinstance(value, Sequence) and isinstance(value.content.value, tuple):
        items = [data_of(cell.value) for cell in value.content.value]
        return all(known for known, _ in items), [item for _, item in items]
    if isinstance(value, Mapped) and isinstance(value.content.value, dict):
        pairs = {key: data_of(cell.value) for key, cell in value.content.value.items()}
        return all(known for known, _ in pairs.values()), {key: item for key, (_, item) in pairs.items()}
    if isinstance(value, Object) and "_value" in value.fields:  # an XmlRpcValue that holds one of several things
        inner = value.fields["_value"].value
        if isinstance(inner, Object) and len(inner.fields) == 1:
            return data_of(next(iter(inner.fields.values())).value)
    return False, None
