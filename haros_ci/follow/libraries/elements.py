# SPDX-License-Identifier: Apache-2.0
"""Elements that C++ containers construct in place from the arguments of a call ([sequence.reqmts], [map.modifiers])."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci.follow import bases, braces, call_arguments, construct, copies
from haros_ci.follow.frames import Frame
from haros_ci.follow.ros import api_rows
from haros_ci.follow.walk import Walk
from haros_ci.model.location import Location
from haros_ci.syntax import Type
from haros_ci.values.abstract import Choice, Library, Object, Opaque, Sequence, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: Classes of libraries whose construction does something, beside node handles.
THREADS = frozenset(("std::thread", "std::jthread", "boost::thread"))
#: Methods that construct their element, or that convert what they are given to it.
ADDING = frozenset(("push_back", "emplace_back", "push_front", "emplace_front", "emplace", "insert", "push"))
AT_A_PLACE = frozenset(("emplace", "insert"))
#: The first argument of a constructor of a pair that is given two tuples.
PIECEWISE = "std::piecewise_construct"


def constructed(
    walk: Walk, frame: Frame, kind: Type | None, name: str, arguments: tuple[PassedArgument, ...]
) -> tuple[PassedArgument, ...]:
    """What the method *name* of a sequence of *kind* adds: the object that is made of *arguments*, or these themselves."""
    if kind is None or name not in ADDING or not _is_made(walk, frame, kind):
        return arguments
    where = 1 if name in AT_A_PLACE and arguments and _is_place(arguments[0].value) else 0
    of = arguments[where:]
    if len(of) == 1 and isinstance(of[0].value, Sequence) and of[0].value.type is None and name.startswith("push"):
        return (call_arguments.PassedArgument(braces.from_list(walk, frame, kind, of[0].value)),)
    if (len(of) == 1 and _is_one(walk, kind, of[0].value)) or (len(of) != 1 and not name.startswith("emplace")):
        return arguments
    made = construct.create(walk, frame, kind.bare(), of, Location(frame.source.path))
    return (*arguments[:where], call_arguments.PassedArgument(made))


def mapped(
    walk: Walk, frame: Frame, kind: Type | None, name: str, arguments: tuple[PassedArgument, ...]
) -> tuple[PassedArgument, ...]:
    """The key and the value that ``emplace`` and ``try_emplace`` of a map with values of *kind* put in, made of *arguments*."""
    inner = kind.of(1) if kind is not None else None
    if inner is None or name not in ("emplace", "try_emplace") or not arguments or not _is_made(walk, frame, inner):
        return arguments
    key, of = arguments[0], arguments[1:]
    if len(of) == 2 and isinstance(key.value, Library) and key.value.name == PIECEWISE:
        keys, values = (_parts(argument.value) for argument in of)
        if values is None or keys is None or len(keys) != 1:
            return arguments
        key, of = keys[0], values
    elif (name == "emplace" and not of) or (len(of) == 1 and _is_one(walk, inner, of[0].value)):
        return arguments
    made = construct.create(walk, frame, inner.bare(), of, Location(frame.source.path))
    return key, call_arguments.PassedArgument(made)


def _parts(value: Value) -> tuple[PassedArgument, ...] | None:
    cells = value.content.value if isinstance(value, Sequence) else None
    if not isinstance(cells, tuple):
        return None
    return tuple(call_arguments.PassedArgument(cell.value, cell, cell.type) for cell in cells)


def _is_made(walk: Walk, frame: Frame, kind: Type) -> bool:
    """Whether elements of that type are objects whose construction may make something."""
    is_of_library = kind.name in THREADS or kind.name in api_rows.HANDLES
    return copies.is_by_value(kind) and (is_of_library or walk.class_of(kind.name, frame.source) is not None)


def _is_one(walk: Walk, kind: Type, value: Value) -> bool:
    """Whether *value* is an element itself, or may be one."""
    if isinstance(value, Object):
        of = walk.class_of(kind.name, value.definition[0]) if value.definition is not None else None
        is_derived = of is not None and value.definition is not None and bases.derives(walk, value.definition, of[1])
        return value.name == kind.name or is_derived
    is_braces = isinstance(value, Sequence) and value.type is None
    return isinstance(value, (Opaque, Choice)) or is_braces


def _is_place(value: Value) -> bool:
    return isinstance(value, Object) and "[of]" in value.fields
