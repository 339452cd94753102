# SPDX-License-Identifier: Apache-2.0
"""Iterators of C++ containers whose elements are known: where each stands, what it leads to, how it moves on."""

from __future__ import annotations

from haros_ci.syntax import Type
from haros_ci.values.abstract import (
    FALSE,
    NONE,
    TRUE,
    Cell,
    Choice,
    ClassValue,
    Known,
    Library,
    Mapped,
    Module,
    Object,
    Opaque,
    Partial,
    Sequence,
    Value,
)

#: The classes of an iterator in front of an element, and of the one behind the last.
ITERATOR, END = "[iterator]", "[end]"


def end_of(container: Sequence | Mapped) -> Object:
    """``c.end()``: one object for each container, so that it is equal to itself."""
    if container.end is None:
        container.end = Object(END, fields={"[of]": Cell(container)})
    return container.end


def at(container: Sequence | Mapped, position: int) -> Object:
    """An iterator in front of the element at *position*, or the end."""
    content = container.content.value
    if not isinstance(content, Opaque) and position == len(content):
        return end_of(container)
    return Object(ITERATOR, fields={"[of]": Cell(container), "[at]": Cell(Known(position))})


def found(container: Mapped, key: Value) -> Object | None:
    """``m.find(key)`` in a map that is known; None if that is not known."""
    pairs = container.content.value
    if not isinstance(pairs, dict) or not isinstance(key, Known) or not isinstance(key.value, (str, int)):
        return None
    keys = list(pairs)
    return at(container, keys.index(key.value)) if key.value in pairs else end_of(container)


def pointed(value: Object) -> Cell | None:
    """The cell of the element in front of which an iterator stands; None if that is not known."""
    place = value.fields.get("[at]")
    if place is None:
        return _one_of(value.fields["[of]"].value) if value.name == ITERATOR else None
    container, number = value.fields["[of]"].value, place.value.value if isinstance(place.value, Known) else None
    content = container.content.value if isinstance(container, (Sequence, Mapped)) else None
    if not isinstance(number, int):
        return None
    if isinstance(content, tuple):
        return content[number] if number < len(content) else None
    if isinstance(content, dict) and number < len(content):
        key, cell = list(content.items())[number]
        return Cell(Object("std::pair", fields={"first": Cell(Known(key)), "second": cell}))
    return None


def kind(value: Object) -> Type | None:
    """The type of the elements that an iterator goes through; None if that is not known."""
    container = value.fields["[of]"].value
    result = container.type if isinstance(container, Sequence) else None
    return result.of(0) if result is not None else None


def _one_of(container: Value) -> Cell | None:
    """An element of a list that is not known: one of the objects that are or may be in it; None if there may be others."""
    content = container.content.value if isinstance(container, Sequence) else None
    if not isinstance(content, Partial):
        return None
    every = dict.fromkeys(option for cell in (*content.some, *content.others) for option in options(cell.value))
    if not every or not all(isinstance(value, Object) and value.definition is not None for value in every):
        return None
    return Cell(Choice(tuple(every)) if len(every) > 1 else next(iter(every)))


def options(value: Value) -> tuple[Value, ...]:
    """What a value may be."""
    return value.options if isinstance(value, Choice) else (value,)


def not_null(value: Choice) -> Value:
    """Of what a pointer may be what has methods: on a null pointer none is called."""
    every = tuple(option for option in value.options if option != NONE)
    return value if len(every) == len(value.options) else every[0] if len(every) == 1 else Choice(every)


def moved(value: Object, steps: int) -> Object | None:
    """An iterator that many elements further on; None if there is none."""
    place = position(value)
    if place is None:
        is_of_list = value.name == ITERATOR and isinstance(value.fields["[of]"].value, (Sequence, Mapped))
        return value if is_of_list else None  # which stands at any of them
    container = value.fields["[of]"].value
    content = container.content.value if isinstance(container, (Sequence, Mapped)) else None
    if not isinstance(container, (Sequence, Mapped)) or not isinstance(content, (tuple, dict)):
        return None
    return at(container, place + steps) if 0 <= place + steps <= len(content) else None


def position(value: Value) -> int | None:
    """Where an iterator of a known container stands: the number of elements in front of it."""
    if not isinstance(value, Object) or value.definition is not None or "[of]" not in value.fields:
        return None
    container = value.fields["[of]"].value
    if not isinstance(container, (Sequence, Mapped)) or not isinstance(container.content.value, (tuple, dict)):
        return None
    place = value.fields.get("[at]")
    if place is None:
        return len(container.content.value) if value.name == END else None
    number = place.value.value if isinstance(place.value, Known) else None
    return number if isinstance(number, int) else None


def compared(symbol: str, left: Value, right: Value) -> Value | None:
    """``==`` and ``!=`` of two iterators of one container; None if either is none, or not known."""
    one, other = position(left), position(right)
    if one is None or other is None or not isinstance(left, Object) or not isinstance(right, Object):
        return None
    if left.fields["[of]"].value is not right.fields["[of]"].value:
        return None
    return TRUE if (one == other) is (symbol == "==") else FALSE


def not_none(value: Choice) -> Value:
    """What has members, is called or is a type: of what may be a name of a library or stand for none the name.

    ``except ImportError: it = None``, or ``it = object``, of which no member but those of all classes is used.
    """
    rest = tuple(option for option in value.options if option not in (NONE, Library("object")))
    if len(rest) == len(value.options) or not any(isinstance(item, (Library, ClassValue, Module)) for item in rest):
        return value
    return rest[0] if len(rest) == 1 else Choice(rest)


def class_meant(value: Value) -> Value:
    """The class that a class is derived from, or one made of, where the name of it is bound again if an import fails."""
    return not_none(value) if isinstance(value, Choice) else value
