# SPDX-License-Identifier: Apache-2.0
"""Python classes and objects that calls make: ``collections.namedtuple`` and ``types.SimpleNamespace`` (docs.python.org)."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import comprehensions
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.syntax import Class, Field, Type
from haros_ci.values.abstract import Cell, ClassValue, Known, Object, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

NAMED_TUPLE, NAMESPACE = "collections.namedtuple", "types.SimpleNamespace"
#: More fields are none that somebody writes.
MOST = 200


def called(walk: Walk, frame: Frame, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """The class that ``namedtuple`` gives, or the object of ``SimpleNamespace``; None where its fields are not known, and of other functions."""
    if name == NAMED_TUPLE:
        return _named_tuple(walk, frame, args)
    if name != NAMESPACE or not all(argument.keyword.isidentifier() for argument in args):
        return None
    definition = _definition(walk, frame, NAMESPACE, ())
    fields = {argument.keyword: Cell(argument.value) for argument in args}
    return Object(definition.name, (), (frame.source, definition), fields)


def _named_tuple(walk: Walk, frame: Frame, args: tuple[PassedArgument, ...]) -> ClassValue | None:
    if len(args) != 2 or any(argument.keyword for argument in args):  # with defaults, or renamed
        return None
    title, written = (argument.value for argument in args)
    words = _words(written)
    if words is None or not isinstance(title, Known) or len(words) > MOST or not all(map(str.isidentifier, words)):
        return None
    return ClassValue(frame.source, _definition(walk, frame, f"{NAMED_TUPLE} {title.value}", tuple(words)))


def _words(value: Value) -> list[str] | None:
    """The names of the fields: in one text or in a list."""
    if isinstance(value, Known) and isinstance(value.value, str):
        return re.split(r"[\s,]+", value.value.strip(" \t\n,"))
    items = comprehensions.items(value)
    words = [item.value for item in items or () if isinstance(item, Known) and isinstance(item.value, str)]
    return words if items is not None and len(words) == len(items) else None


def _definition(walk: Walk, frame: Frame, name: str, fields: tuple[str, ...]) -> Class:
    """The class, the same each time; it is called as no class that is written can be."""
    key = ("made", frame.source.path, name, fields)
    if key not in walk.found:
        base = (Type("typing.NamedTuple"),) if fields else ()
        declared = tuple(Field(field, Type("object"), None, 0, 0) for field in fields)
        walk.found[key] = syntax.Class(f"[{name}]", base, declared, 0, 0)
    found: Class = walk.found[key]
    return found
