# SPDX-License-Identifier: Apache-2.0
"""Abstract values: what is known of a value while a program is followed without running it.

A value is ``Known`` data, ``Text`` with unknown parts, a ``Choice`` of several, an object, a sequence, a function, a
class, or ``Opaque`` with its reason. ``join`` is what both branches of a statement allow; it never prefers one of them.
"""

from __future__ import annotations

from collections.abc import Callable as Function_
from collections.abc import Mapping
from math import isfinite, prod
from typing import TypeVar, Union

from haros_ci import syntax
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.syntax import Class, Function, Type
from haros_ci.syntax.source import Source
from haros_ci.values.cells import Cell as Cell
from haros_ci.values.cells import Closure, Named
from haros_ci.values.cells import tick as tick
from haros_ci.values.questions import QUESTIONS

Plain = TypeVar("Plain")
#: More possible values than this are joined to an unknown one.
CHOICES = 8
#: Attributes of Python objects that are set on some paths only: to read them on others is an error, but where a base class outside may set them.
UNSET = "the attribute is not set before"
UNSET_OR_INHERITED = "the attribute is not set before, or by a base class"
#: Longer texts are not put together, nor those of more parts.
TEXT_LIMIT, PARTS = 4_000, 100
#: Longer lists are not put together.
LIST_LIMIT = 1_000
#: Sequences inside sequences that are taken for data.
NESTED = 20


class Character(int):
    """A char of C++: a number that text shows as the character."""


@dataclass(frozen=True, slots=True)
class Known:
    """Data: None, bool, int, float, str, or JSON-like lists and dicts, as read from YAML. Lists are never changed."""

    value: object

    @property
    def kind(self) -> type:
        """The type of the data; of what is given from outside it may be asked without looking at the value (``values.given``)."""
        return type(self.value)

    def of(self, kind: type[Plain]) -> Plain:
        """The data as that of the *kind* that it is known to have."""
        data = self.value
        if not isinstance(data, kind):
            raise TypeError(f"the data is no {kind.__name__}")
        return data

    def ask(self, question: str, operand: object = None) -> int:
        """The answer to one of ``values.questions.QUESTIONS``; TypeError where the data is not of the kind that it is about."""
        return QUESTIONS[question](self.value, operand)


@dataclass(frozen=True, slots=True)
class Opaque:
    """Not known: *reason* for a person, *location* where it came in, *type* its static type (canonical) or None."""

    reason: str
    location: Location | None = None
    type: Type | None = None


@dataclass(frozen=True, slots=True)
class Partial(Opaque):
    """The content of a sequence of which *some* cells are elements for sure, and each of the *others* on some paths.

    *last* is the last element, where that is known. With *is_all* there are but *some*, in any order."""

    some: tuple[Cell, ...] = ()
    others: tuple[Cell, ...] = ()
    last: Cell | None = None
    is_all: bool = False


@dataclass(frozen=True, slots=True)
class Text:
    """A text of known and opaque parts, in turn."""

    parts: tuple[str | Opaque, ...]

    @property
    def unknown(self) -> Opaque:
        """The first part that is not known."""
        return next(part for part in self.parts if isinstance(part, Opaque))


@dataclass(frozen=True, slots=True)
class Choice:
    """One of several known values; there is no telling which."""

    options: tuple[Value, ...]


@dataclass(slots=True, eq=False)
class Object:
    """An instance of class *name* (canonical, without template arguments); ``definition`` is None for a library's."""

    name: str
    arguments: tuple[syntax.Argument, ...] = ()
    definition: tuple[Source, Class] | None = None
    fields: dict[str, Cell] = field(default_factory=dict)
    location: Location | None = None
    templates: Mapping[str, syntax.Argument] = field(default_factory=dict)
    #: The node handle's namespace, where the object is one: a value.
    namespace: Value | None = None
    #: The ROS 2 node that the object is (``ros2_process.RosNode``).
    node: Named | None = None
    #: Less than that of each cell that is made later.
    born: int = field(default_factory=tick)


@dataclass(slots=True, eq=False)
class Sequence:
    """A list or vector: one cell that holds a tuple of cells, or an Opaque where the elements are not known."""

    content: Cell[Elements]
    type: Type | None = None
    #: What its ``end()`` is, so that it is equal to itself.
    end: Object | None = None


@dataclass(slots=True, eq=False)
class Mapped:
    """A dict or map: one cell that holds a mapping from keys to cells, or an Opaque."""

    content: Cell[Entries]
    #: What its ``end()`` is, so that it is equal to itself.
    end: Object | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Pointer:
    """The address of a variable that is no object (a pointer to an object is the object)."""

    cell: Cell


@dataclass(frozen=True, slots=True, eq=False)
class Callable:
    """A function with what is bound to it: *this*, leading arguments, the frame of a lambda."""

    source: Source
    function: Function
    this: Object | None = None
    #: Bound arguments in place; None is a placeholder.
    bound: tuple[Value | None, ...] = ()
    frame: Closure | None = None
    templates: Mapping[str, syntax.Argument] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Library:
    """A name of a library: a function, class or module without source in the workspace; *this* is a method's receiver."""

    name: str
    this: Value | None = None


@dataclass(frozen=True, slots=True, eq=False)
class ClassValue:
    """A class of the workspace as a value."""

    source: Source
    definition: Class


@dataclass(frozen=True, slots=True, eq=False)
class Module:
    """A Python module of the workspace as a value."""

    source: Source


#: The content of a sequence; that of a map, by the data of its keys.
Elements = tuple[Cell, ...] | Opaque
Entries = dict[object, Cell] | Opaque
Value = Union[Known, Opaque, Text, Choice, Object, Sequence, Mapped, Pointer, Callable, Library, ClassValue, Module]


#: Data and texts of which nothing is given from outside.
PLAIN = frozenset((Known, Text))
NONE, TRUE, FALSE = Known(None), Known(True), Known(False)


def join(one: Value, other: Value) -> Value:
    """What may hold when either may: the same value, a choice of known ones, or Opaque."""
    if one is other or (type(one) is type(other) and not isinstance(one, (Known, Opaque)) and one == other):
        return one
    if isinstance(one, Known) and isinstance(other, Known) and one.kind is other.kind and one == other:
        return one
    if isinstance(one, Opaque):
        return other if _is_error(one, other) else one
    if isinstance(other, Opaque):
        return one if _is_error(other, one) else other
    options: list[Value] = list(one.options) if isinstance(one, Choice) else [one]
    for option in other.options if isinstance(other, Choice) else (other,):
        if not any(
            option is seen
            or (isinstance(option, Known) and isinstance(seen, Known) and option.kind is seen.kind and option == seen)
            or (isinstance(option, Text) and option == seen)
            for seen in options
        ):
            options.append(option)
    if len(options) > CHOICES:
        return Opaque("it may be one of many values")
    return options[0] if len(options) == 1 else Choice(tuple(options))


def _is_error(unset: Opaque, other: Value) -> bool:
    """Whether Python does not go on where *unset* is read, so that *other* is what is meant."""
    plain = isinstance(other, (Known, Text, Choice, Opaque))
    return unset.reason == UNSET or (unset.reason == UNSET_OR_INHERITED and not plain)


def same(one: object, other: object) -> bool:
    """Equality that distinguishes True, 1 and 1.0."""
    return type(one) is type(other) and bool(one == other)


def concatenate(values: tuple[Value, ...], show: Function_[[Value], str | Opaque] | None = None) -> Value:
    """Text from parts, scalars as *show* writes them (as C++ streams do by default); Opaque where it is too long."""
    choices = [len(value.options) for value in values if isinstance(value, Choice)]
    if prod(choices) > CHOICES:
        return Opaque("it may be one of many values")
    for index, value in enumerate(values):
        if isinstance(value, Choice):
            chosen: Value | None = None
            for option in value.options:
                whole = concatenate((*values[:index], option, *values[index + 1 :]), show)
                chosen = whole if chosen is None else join(chosen, whole)
            return chosen if chosen is not None else Opaque("no value")
    for value in values:
        if isinstance(value, (Known, Text)) and value.__class__ not in PLAIN:
            joined: Value = value.joined(values, show)  # type: ignore[union-attr]  # of values.given, which opens this module
            return joined
    parts, length = list[str | Opaque](), 0
    for value in values:
        found = value.parts if isinstance(value, Text) else ((show or streamed)(value),)
        length += sum(len(part) if isinstance(part, str) else 1 for part in found)
        if length > TEXT_LIMIT or len(parts) > PARTS:
            return Opaque("it is a long text")
        for part in found:
            if isinstance(part, str) and parts and isinstance(parts[-1], str):
                parts[-1] += part
            elif part != "":
                parts.append(part)
    if not parts:
        return Known("")
    if len(parts) == 1:
        return Known(parts[0]) if isinstance(parts[0], str) else parts[0]
    return Text(tuple(parts))


def streamed(value: Value) -> str | Opaque:
    """A scalar as C++ streams write it: six digits, true as 1, a character as itself."""
    if isinstance(value, Known) and isinstance(value.value, (str, int, float)):
        return written(value.value)
    return value if isinstance(value, Opaque) else Opaque("it is not text")


def converted_to_text(value: Value) -> str | Opaque:
    """A number as ``std::to_string`` writes it: six decimals, a character as its number."""
    if isinstance(value, Known) and isinstance(value.value, float):
        return f"{value.value:f}" if isfinite(value.value) else Opaque("it is no number")
    if isinstance(value, Known) and isinstance(value.value, int):
        return str(int(value.value))
    return value if isinstance(value, Opaque) else Opaque("it is no number")


def printed(value: Value) -> str | Opaque:
    """A scalar as Python's ``str`` writes it; Opaque where Python 2 and 3 differ, and of None, which no text is meant to name."""
    if isinstance(value, Known) and isinstance(value.value, int) and abs(value.value) >= 10**300:
        return Opaque("it is a long number")
    if isinstance(value, Known) and value.value is None:
        return Opaque("None is put into a text")
    if isinstance(value, Known) and isinstance(value.value, (str, int)):
        return str(value.value)
    if isinstance(value, Known) and isinstance(value.value, float):
        return repr(value.value) if float(f"{value.value:.12g}") == value.value else Opaque("its digits are not known")
    return value if isinstance(value, Opaque) else Opaque("it is not text")


def written(value: object) -> str:
    """A scalar as C++ streams write it."""
    if isinstance(value, bool):
        return "1" if value else "0"
    if isinstance(value, Character):
        return chr(value)
    return f"{value:g}" if isinstance(value, float) else str(value)


def opaque_of(value: object) -> Opaque | None:
    """The first reason why *value* is not known as data; None if it is."""
    if isinstance(value, Known):
        return None
    if isinstance(value, Opaque):
        return value
    if isinstance(value, Text):
        return value.unknown
    if isinstance(value, Choice):
        shown = ", ".join(sorted(repr(o.value) for o in value.options if isinstance(o, Known)))
        return Opaque(f"it may be one of {shown}" if shown else "it may be one of several values")
    if isinstance(value, Library) and value.this is None:
        return Opaque(f"{value.name} is not in the workspace")
    return Opaque("it is not plain data")


def data_of(value: Value) -> tuple[bool, object]:
    """(True, data) for what is wholly known and not too large, sequences and maps included."""
    return _data(value, NESTED, [LIST_LIMIT])


def _data(value: Value, depth: int, left: list[int]) -> tuple[bool, object]:
    left[0] -= 1
    if left[0] < 0 or depth < 0:
        return False, None
    if isinstance(value, Known):
        return True, int(value.value) if isinstance(value.value, Character) else value.value
    if isinstance(value, Sequence) and isinstance(value.content.value, tuple):
        items = []
        for cell in value.content.value:
            known, item = _data(cell.value, depth - 1, left)
            if not known:
                return False, None
            items.append(item)
        return True, items
    if isinstance(value, Mapped) and isinstance(value.content.value, dict):
        pairs = {}
        for key, cell in value.content.value.items():
            known, pairs[key] = _data(cell.value, depth - 1, left)
            if not known:
                return False, None
        return True, pairs
    if isinstance(value, Object) and "_value" in value.fields:  # an XmlRpcValue that holds one of several things
        inner = value.fields["_value"].value
        if isinstance(inner, Object) and len(inner.fields) == 1:
            return _data(next(iter(inner.fields.values())).value, depth - 1, left)
    return False, None
