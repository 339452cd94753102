# SPDX-License-Identifier: Apache-2.0
"""std::tuple, std::pair and what structured bindings take apart (en.cppreference.com/w/cpp/language/structured_binding)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import call_arguments
from haros_ci.values.abstract import Cell, Object, Sequence, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

PAIR = "std::pair"
#: Its elements have no value before they are set, where they are numbers.
ARRAY = "std::array"
TUPLE = syntax.Type("std::tuple")
#: What std::get and structured bindings find a pair's parts under.
PARTS = ("first", "second")


def part(value: Object, number: object) -> Cell | None:
    """The part of a pair or of a struct of that *number*; None where there is none."""
    if not isinstance(number, int) or type(number) is not int:
        return None
    names: tuple[str, ...] = ()
    if value.name == PAIR:
        names = PARTS
    elif value.definition is not None and not value.definition[1].bases:
        names = tuple(field.name for field in value.definition[1].fields if not field.is_static)
    return value.fields.get(names[number]) if 0 <= number < len(names) else None


def got(targs: tuple[syntax.Argument, ...], args: tuple[PassedArgument, ...]) -> Value | None:
    """``std::get<0>(t)`` of a tuple or pair; None for all else."""
    number = targs[0].value if len(targs) == 1 and type(targs[0]) is syntax.Number else None
    if len(args) != 1 or type(number) is not int:
        return None
    value = args[0].value
    if isinstance(value, Object):
        found = part(value, number) if value.name == PAIR else None
        return found.value if found is not None else None
    cells = value.content.value if isinstance(value, Sequence) else None
    return cells[number].value if isinstance(cells, tuple) and 0 <= number < len(cells) else None


def made(args: tuple[PassedArgument, ...]) -> Value:
    """A tuple of *args*."""
    return Sequence(Cell(tuple(Cell(argument.value, argument.type) for argument in args)), TUPLE)


def number_of(kind: syntax.Type, place: int) -> int | None:
    """The number among the template arguments of a type (``std::array<T, 2>``), if it is one."""
    provided = kind.arguments[place] if place < len(kind.arguments) else None
    if type(provided) is syntax.Number and type(provided.value) is int:
        return provided.value
    return None


def is_unset(kind: syntax.Type, inner: syntax.Type) -> bool:
    """Whether the elements of a container that is made without values have none: the numbers of an array."""
    return kind.name == ARRAY and call_arguments.is_scalar(inner) and "*" not in inner.marks
