# SPDX-License-Identifier: Apache-2.0
"""What C++ makes of braces: vectors, maps, objects, and arrays whose length need not be known."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import call_arguments, construct, conversions, copies
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.types import INTEGERS, MAPS, SEQUENCES, STRINGS, is_smart_pointer
from haros_ci.model.location import Location
from haros_ci.syntax import Type
from haros_ci.values.abstract import Cell, Character, Known, Mapped, Object, Sequence, Text, Value

#: Elements that an array whose length is not known may have.
GROWN = 64
#: The marks of the type of an array whose length is not known.
OPEN = "[]"


def arguments(
    walk: Walk, frame: Frame, kind: Type, items: tuple[syntax.Expression, ...]
) -> tuple[call_arguments.PassedArgument, ...]:
    """What stands in braces or brackets behind a variable of the resolved type *kind*; where that is nothing, a number begins with 0."""
    found = call_arguments.arguments(walk, frame, items)
    characters = [
        chr(a.value.of(Character)) for a in found if isinstance(a.value, Known) and issubclass(a.value.kind, Character)
    ]
    if kind.name in STRINGS and len(found) == len(characters) > 1:
        return (call_arguments.PassedArgument(Known("".join(characters))),)
    zero = conversions.zero_of(kind) if not found and call_arguments.is_scalar(kind) else None
    return found if zero is None else (call_arguments.PassedArgument(zero),)


def is_list(kind: Type) -> bool:
    """Whether a variable of that type may hold a list or map."""
    return kind.name in SEQUENCES or kind.name in MAPS or kind.name in ("auto", "")


def from_list(walk: Walk, frame: Frame, kind: Type, value: Value) -> Value:
    """Braces as a variable of the resolved type *kind* holds them: an array, vector, map or object."""
    if not isinstance(value, Sequence) or value.type is not None or not isinstance(value.content.value, tuple):
        return value
    cells = value.content.value
    if (single := conversions.in_braces(value, kind)) is not value:
        return single
    if "*" in kind.marks:
        return array(walk, frame, [cell.value for cell in cells], kind)
    if kind.name in SEQUENCES:
        return braced(walk, frame, kind, [cell.value for cell in cells])
    if kind.name in MAPS:
        return _pairs(walk, frame, kind, [cell.value for cell in cells])
    if kind.name in ("", "auto") or is_smart_pointer(kind):
        return value
    arguments = tuple(
        call_arguments.PassedArgument(cell.value, None, conversions.value_type(cell.value)) for cell in cells
    )
    return construct.create(walk, frame, kind.bare(), arguments, Location(frame.source.path))


def braced(walk: Walk, frame: Frame, kind: Type, values: list[Value]) -> Value:
    """A vector of the elements in braces."""
    inner = kind.of(0)
    first = values[0] if values else None
    if len(values) == 1 and isinstance(first, Sequence) and first.type is not None:
        return copies.copied(walk, first, kind.bare())
    is_text = inner is not None and inner.name in STRINGS
    counted = conversions.value_type(first) if first is not None else None
    if any(isinstance(v, Object) and "[of]" in v.fields for v in values) or (
        is_text and counted is not None and counted.name in INTEGERS
    ):
        return Sequence(Cell(walk.opaque("a list of unknown length", frame)), kind)
    return Sequence(Cell(tuple(Cell(fitted(walk, frame, inner, value), inner) for value in values)), kind)


def is_text(argument: call_arguments.PassedArgument) -> bool:
    """Whether an argument is a text, known or not."""
    kind = argument.type or conversions.value_type(argument.value)
    if isinstance(argument.value, (Text, Known)):
        return isinstance(argument.value, Text) or isinstance(argument.value.value, str)
    return (
        not isinstance(argument.value, Object) and kind is not None and kind.name in STRINGS and "*" not in kind.marks
    )


def map_of(walk: Walk, frame: Frame, kind: Type, arguments: tuple[call_arguments.PassedArgument, ...]) -> Value:
    """A map constructed from *arguments*: nothing, another map, or pairs in braces, with or without braces around all of them."""
    values = [argument.value for argument in arguments]
    only = values[0] if len(values) == 1 else None
    if isinstance(only, Mapped):
        return copies.copied(walk, only, kind)
    inside = only.content.value if isinstance(only, Sequence) and only.type is None else None
    if isinstance(inside, tuple) and all(_pair(cell.value) is not None for cell in inside):
        values = [cell.value for cell in inside]
    if any(_pair(value) is None for value in values):
        return Mapped(Cell(walk.opaque("a map that is built in a way that is not followed", frame)))
    return _pairs(walk, frame, kind, values)


def _pairs(walk: Walk, frame: Frame, kind: Type, values: list[Value]) -> Value:
    inner = kind.of(1)
    made: dict[object, Cell] = {}
    for value in values:
        pair = _pair(value)
        if isinstance(value, Mapped) and len(values) == 1:
            return copies.copied(walk, value, kind)
        key = pair[0].value if pair is not None else None
        if pair is None or not isinstance(key, Known) or not issubclass(key.kind, (str, int)):
            return Mapped(Cell(walk.opaque("a map with computed keys", frame)))
        made.setdefault(key.value, Cell(fitted(walk, frame, inner, pair[1].value), inner))
    return Mapped(Cell(made))


def _pair(value: Value) -> tuple[Cell, Cell] | None:
    """The two parts of a pair, or of braces that stand for one."""
    if isinstance(value, Object) and value.name == copies.PAIR and {"first", "second"} <= value.fields.keys():
        return value.fields["first"], value.fields["second"]
    content = value.content.value if isinstance(value, Sequence) and value.type is None else None
    return (content[0], content[1]) if isinstance(content, tuple) and len(content) == 2 else None


def fitted(walk: Walk, frame: Frame, kind: Type | None, value: Value) -> Value:
    """*value* as an element or member of the resolved type *kind* is initialised with it."""
    if kind is None:
        return value
    if isinstance(value, Sequence) and value.type is None:
        return from_list(walk, frame, kind, value)
    if (
        isinstance(value, Known)
        and issubclass(value.kind, str)
        and copies.is_by_value(kind)
        and kind.name not in STRINGS
    ):
        if walk.class_of(kind.name, frame.source) is not None:
            argument = call_arguments.PassedArgument(value, None, conversions.value_type(value))
            return construct.create(walk, frame, kind.bare(), (argument,), Location(frame.source.path))
    return conversions.converted(copies.copied(walk, value, kind), kind)


def array(walk: Walk, frame: Frame, values: list[Value], kind: Type) -> Value:
    """An array in braces; *kind* is that of a pointer to its elements."""
    inner = syntax.Type(kind.name, kind.arguments, kind.marks.replace("*", "", 1))
    if kind.name == "char" and "*" not in inner.marks:
        if len(values) == 1 and isinstance(values[0], Known) and isinstance(values[0].value, str):
            return values[0]
        return walk.opaque("an array of characters", frame, None, kind)
    cells = tuple(Cell(fitted(walk, frame, inner, value), inner) for value in values)
    return Sequence(Cell(cells), syntax.Type("std::array", (inner,), "" if len(cells) > 1 else OPEN))


def is_open(container: Value) -> bool:
    """Whether an array may have more elements than are known."""
    return isinstance(container, Sequence) and container.type is not None and container.type.marks == OPEN


def is_array_of_objects(walk: Walk, frame: Frame, kind: Type | None) -> bool:
    """Whether an uninitialised variable of this type, with an index, is an array of the workspace's objects."""
    if kind is None or kind.marks.count("*") != 1:
        return False
    return walk.class_of(kind.name, frame.source) is not None and not is_smart_pointer(kind)


def grown(walk: Walk, frame: Frame, container: Sequence, index: int) -> Cell | None:
    """The element *index* of an array whose length is not known, constructed if need be."""
    cells = container.content.value
    inner = container.type.of(0) if container.type is not None else None
    if inner is None or not 0 <= index < GROWN or not copies.is_by_value(inner):
        return None
    if walk.class_of(inner.name, frame.source) is None:
        return None
    held = cells if isinstance(cells, tuple) else ()
    whole = (*held, *(Cell(made(walk, frame, inner), inner) for _ in range(index + 1 - len(held))))
    walk.state.write(container.content, whole)
    return whole[index]


def made(walk: Walk, frame: Frame, kind: Type) -> Value:
    """A default-constructed value."""
    return construct.create(walk, frame, kind.bare(), (), Location(frame.source.path))
