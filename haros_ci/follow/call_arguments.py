# SPDX-License-Identifier: Apache-2.0
"""The arguments of a call, evaluated once: values, cells, types, keywords."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import assignments, conversions, expressions, handed_out, static_types
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.types import INTEGERS, REALS
from haros_ci.records import dataclass
from haros_ci.syntax import Expression, Type
from haros_ci.values.abstract import Cell, Known, Mapped, Object, Value


@dataclass(frozen=True, slots=True, eq=False)
class PassedArgument:
    """An argument: its value, its cell where it is an lvalue, its static type, its keyword in Python, whether it is ``std::ref(x)``.

    *is_array* says of a text of C++ that it is a ``const char*``: a literal, or what ``c_str()`` gives; *is_lent* that a call
    gives a reference to it, as ``back()`` does.
    """

    value: Value
    cell: Cell | None = None
    type: Type | None = None
    keyword: str = ""
    is_wrapped: bool = False
    is_array: bool = False
    is_lent: bool = False


def is_scalar(kind: Type) -> bool:
    """Whether a default-constructed variable of the type has no value."""
    name = kind.name
    return name in INTEGERS or name in REALS or name in ("bool", "void", "") or set(name.split()) <= INTEGERS


def arguments(walk: Walk, frame: Frame, written: tuple[Expression, ...]) -> tuple[PassedArgument, ...]:
    """The arguments of a call, evaluated from left to right; unpacked sequences are spread where known."""
    result: list[PassedArgument] = []
    is_open = False  # what stands behind an unpacked list that is not known has no place that is known
    for expression in written:
        if type(expression) is syntax.Star:
            items = static_types.elements(walk, frame, expression.value)
            if items is None:
                result.append(PassedArgument(walk.opaque(UNPACKED, frame), keyword="*"))
                is_open = True
            elif not is_open:
                result += [PassedArgument(item.value if isinstance(item, Cell) else item) for item in items]
            continue
        if type(expression) is syntax.DoubleStar:
            argument_value = expressions.evaluate(walk, frame, expression.value)
            cells = argument_value.content.value if isinstance(argument_value, Mapped) else _data(argument_value)
            named = (
                {key: cell for key, cell in cells.items() if isinstance(key, str)} if isinstance(cells, dict) else {}
            )
            if isinstance(cells, dict) and len(named) == len(cells):
                result += [PassedArgument(cell.value, cell, None, key) for key, cell in named.items()]
            else:
                result.append(PassedArgument(walk.opaque(UNPACKED, frame), keyword="**"))
            continue
        keyword = ""
        if type(expression) is syntax.Keyword:
            keyword, expression = expression.name, expression.value
        wrapped = handed_out.wrapped(walk, expression) if type(expression) is syntax.Call else None
        expression = wrapped or expression
        walk.references = None
        cell, value = expressions.located(walk, frame, expression)
        kind = cell.type if cell is not None and cell.type is not None else None
        if kind is None and type(expression) in TYPED:
            kind = static_types.static_type(walk, frame, expression)
        if is_open and not keyword:
            result.append(PassedArgument(walk.opaque(UNPACKED, frame), keyword="*"))
            continue
        shown, is_array = kind or conversions.value_type(value), _is_array(expression)
        is_lent = value.__class__ is Object and type(expression) is syntax.Call and _is_lent(walk, expression)
        result.append(PassedArgument(value, cell, shown, keyword, wrapped is not None, is_array, is_lent))
    return tuple(result)


def _is_lent(walk: Walk, expression: syntax.Call) -> bool:
    return walk.references is not None or syntax.name_of(expression.callee) in assignments.ACCESSORS


def _is_array(expression: Expression) -> bool:
    if type(expression) is syntax.Call and type(expression.callee) is syntax.Member:
        return expression.callee.name in ("c_str", "data")
    return type(expression) is syntax.String


def _data(value: Value) -> dict[object, Cell] | None:
    """The entries of plain data, as of parameters: one for each key; None if it is no dictionary."""
    held = value.value if isinstance(value, Known) and value.kind is dict else None
    return {key: Cell(Known(item)) for key, item in held.items()} if isinstance(held, dict) else None


#: Why an argument is not known.
UNPACKED = "unpacked arguments"
LVALUES = (syntax.Name, syntax.Member, syntax.Subscript, syntax.Dereference)


TYPED = frozenset((syntax.String, syntax.Number, syntax.Boolean, syntax.Operation, syntax.Cast))
