# SPDX-License-Identifier: Apache-2.0
"""``std::optional`` and ``boost::optional``: a variable holds what is inside, or none (en.cppreference.com/w/cpp/utility/optional)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import call_arguments, construct
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.types import STRINGS
from haros_ci.model.location import Location
from haros_ci.syntax import Type
from haros_ci.values import iterators
from haros_ci.values.abstract import FALSE, NONE, TRUE, Cell, Choice, Known, Library, Opaque, Text, Value, join

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

CLASSES = frozenset(("std::optional", "boost::optional"))
#: What stands for none.
EMPTY = frozenset(("std::nullopt", "boost::none"))
#: Methods that ask for what is inside, and all of the optional itself.
READERS = frozenset("value value_or get_value_or has_value is_initialized".split())
METHODS = READERS | {"emplace"}


def is_one(kind: Type | None) -> bool:
    """Whether a variable of this type is an optional."""
    return kind is not None and kind.name in CLASSES


def created(
    walk: Walk, frame: Frame, kind: Type, arguments: tuple[PassedArgument, ...], location: Location
) -> Value | None:
    """What ``std::optional<T>(arguments)`` holds where a T is made of them: behind ``std::in_place``, or of plain data where T is a class."""
    first, held = arguments[0].value if arguments else NONE, kind.of(0)
    if isinstance(first, Library) and first.name.rpartition("::")[2] == "in_place":
        return inside(walk, frame, kind, arguments[1:], location)
    is_plain = isinstance(first, (Known, Text)) and first != NONE
    if not is_plain or held is None or held.name in STRINGS or call_arguments.is_scalar(held):
        return None
    return inside(walk, frame, kind, arguments, location)


def inside(
    walk: Walk, frame: Frame, kind: Type, arguments: tuple[PassedArgument, ...], location: Location
) -> Value | None:
    """A T made of *arguments*, as ``emplace`` does, where *kind* is the optional's type."""
    held = kind.of(0)
    return construct.create(walk, frame, held.bare(), arguments, location) if held is not None else None


def method(
    walk: Walk, frame: Frame, cell: Cell, name: str, arguments: tuple[PassedArgument, ...], location: Location
) -> Value:
    """One of ``METHODS`` of the optional in *cell*."""
    if name != "emplace":
        return read(walk, frame, cell.value, name, arguments, location)
    made = inside(walk, frame, cell.type, arguments, location) if cell.type is not None else None
    walk.state.write(cell, made if made is not None else walk.opaque("what emplace makes is not known", frame))
    return cell.value


def read(
    walk: Walk, frame: Frame, value: Value, name: str, arguments: tuple[PassedArgument, ...], location: Location
) -> Value:
    """One of ``READERS`` of an optional that holds *value*."""
    is_open = isinstance(value, Opaque) or (isinstance(value, Choice) and NONE in value.options)
    if name in ("has_value", "is_initialized"):
        unknown = walk.opaque("whether an optional has a value", frame, location.line, syntax.Type("bool"))
        return unknown if is_open else FALSE if value == NONE else TRUE
    there = iterators.not_null(value) if isinstance(value, Choice) else value
    if name == "value" or not arguments:
        return walk.opaque("the optional has no value", frame, location.line) if value == NONE else there
    if isinstance(value, Opaque) or value == NONE:
        return value if isinstance(value, Opaque) else arguments[0].value
    return join(there, arguments[0].value) if is_open else there
