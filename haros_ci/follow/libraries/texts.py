# SPDX-License-Identifier: Apache-2.0
"""Texts as C++ makes them: the forms of std::string's constructors, string streams and their manipulators."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.types import STRINGS
from haros_ci.values.abstract import (
    FALSE,
    TEXT_LIMIT,
    TRUE,
    Cell,
    Character,
    Known,
    Library,
    Object,
    Opaque,
    Text,
    Value,
    concatenate,
)

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: What is written for a manipulator that is no setting.
ENDS = {"std::endl": "\n", "endl": "\n", "std::flush": "", "flush": "", "std::ends": "\0"}
#: A string stream that starts with text and does not go to its end first.
AT_START = "[at the start]"
#: A string stream whose settings are not the first ones.
IS_SET = "[set]"

#: Methods that change a text and give it back by reference: ``a.append("b").insert(0, "c")``.
CHANGING = frozenset(("append", "assign", "insert", "erase", "replace"))


def changed(walk: Walk, cell: Cell, value: Value) -> Value:
    """Set the text in *cell*, which the call that does so refers to."""
    walk.state.write(cell, value)
    walk.references = (cell,)
    return value


def constructed(args: tuple[PassedArgument, ...]) -> Value:
    """``std::string(s)``, ``(s, n)``, ``(s, pos, n)``, ``(n, c)``; ``append`` and ``assign`` take the same."""
    kind = syntax.Type("std::string")
    values = [argument.value for argument in args]
    if not values:
        return Known("")
    if len(values) == 1:
        return values[0]
    data = [value.value if isinstance(value, Known) else None for value in values]
    if len(data) == 2 and isinstance(data[0], int) and isinstance(data[1], int):
        if 0 <= data[0] <= TEXT_LIMIT and 0 < data[1] < 0x110000:
            return Known(chr(data[1]) * data[0])
        return Opaque("its length is not known", None, kind)
    if isinstance(data[0], str) and all(isinstance(item, int) and item >= 0 for item in data[1:]):
        numbers = [item for item in data[1:] if isinstance(item, int)]
        type_ = args[0].type
        if len(numbers) == 2 and numbers[0] <= len(data[0]):
            return Known(data[0][numbers[0] : numbers[0] + numbers[1]])
        if len(numbers) == 1 and numbers[0] <= len(data[0]):
            is_object = (
                args[0].cell is not None and type_ is not None and type_.name in STRINGS and "*" not in type_.marks
            )
            if is_object:
                return Known(data[0][numbers[0] :])
            if args[0].is_array or (type_ is not None and "*" in type_.marks):
                return Known(data[0][: numbers[0]])
    return Opaque("a part of a text that is not known", None, kind)


def insert(walk: Walk, frame: Frame, stream: Object, value: Value) -> None:
    """``stream << value``; after a manipulator that sets something, what is written is not known."""
    text = stream.fields["[text]"]
    if isinstance(value, Library):
        if value.name in ENDS:
            value = Known(ENDS[value.name])
        else:
            change(walk, stream)
            return
    if AT_START in stream.fields and stream.fields[AT_START].value == TRUE:
        walk.state.write(text, walk.opaque("it is written over the stream's text", frame))
        return
    if IS_SET in stream.fields and stream.fields[IS_SET].value != FALSE:
        value = walk.opaque("it is written under the stream's settings", frame)
    walk.state.write(text, concatenate((text.value, value)))


def change(walk: Walk, stream: Object) -> None:
    """The stream has other settings from now on."""
    walk.state.write(stream.fields.setdefault(IS_SET, Cell(FALSE)), TRUE)


def start(walk: Walk, stream: Object, value: Value) -> None:
    """``stream.str(value)``: what is written next goes over it."""
    walk.state.write(stream.fields["[text]"], value)
    walk.state.write(stream.fields.setdefault(AT_START, Cell(FALSE)), FALSE if value == Known("") else TRUE)


def number(value: Value) -> Value:
    """A text of one character that is an element of another text, as the number that it is."""
    if isinstance(value, Known) and issubclass(value.kind, str) and len(value.of(str)) == 1:
        return Known(Character(ord(value.of(str)))) if ord(value.of(str)) < 128 else Opaque("its number is not known")
    return value


def is_text(value: Value) -> bool:
    return isinstance(value, Text) or (isinstance(value, Known) and issubclass(value.kind, str))
