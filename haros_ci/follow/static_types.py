# SPDX-License-Identifier: Apache-2.0
"""Static types of expressions, as declared; and the elements that a loop goes through."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import conversions, enums, expressions
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import ordering, python_numbers
from haros_ci.follow.walk import Walk
from haros_ci.index.types import SEQUENCES
from haros_ci.syntax import Expression, Type
from haros_ci.values import iterators
from haros_ci.values.abstract import (
    LIST_LIMIT,
    Cell,
    ClassValue,
    Known,
    Mapped,
    Object,
    Opaque,
    Partial,
    Pointer,
    Sequence,
    Value,
)
from haros_ci.values.state import certain, possible


def elements(walk: Walk, frame: Frame, expression: Expression) -> list[Value | Cell] | None:
    """The elements that a loop goes through; None if they are not known."""
    found, others, _ = some_elements(walk, frame, expression)
    return found if others is None else None


def some_elements(
    walk: Walk, frame: Frame, expression: Expression
) -> tuple[list[Value | Cell], tuple[Cell, ...] | None, bool]:
    """Elements that a loop goes through for sure, objects that are elements on some paths (None if these are all), and whether those come in this order.

    Where a branch is not taken, a text stands for the list that the branch is for: its letters are no elements.
    """
    value = expressions.evaluate(walk, frame, expression)
    if isinstance(value, Pointer):
        value = value.cell.value
    if frame.source.separator == "::":
        ordering.put(walk, value)
    if isinstance(value, Sequence) and isinstance(value.content.value, Opaque):
        if isinstance(value.content.value, Partial) and value.content.value.is_all:
            return list(value.content.value.some), None, False
        items = list[Value | Cell](certain(value.content.value))
        return items, objects(value.content.value), not items
    if isinstance(value, ClassValue) and (every := enums.elements(walk, value)) is not None:
        return [*every], None, True
    is_dead = bool(walk.dead or frame.is_dead)
    found = (
        None if is_dead and isinstance(value, Known) and issubclass(value.kind, str) else _all_elements(frame, value)
    )
    return ([], (), True) if found is None else (found, None, True)


def objects(content: Opaque) -> tuple[Cell, ...]:
    """Of the possible elements of a list those that are objects of the workspace."""
    every = ((cell, iterators.options(cell.value)) for cell in possible(content))
    return tuple(
        cell
        for cell, options in every
        if all(isinstance(option, Object) and option.definition is not None for option in options)
    )


def _all_elements(frame: Frame, value: Value) -> list[Value | Cell] | None:
    python = frame.source.separator == "."
    if isinstance(value, Sequence) and isinstance(value.content.value, tuple):
        return list(value.content.value)
    if isinstance(value, Mapped) and isinstance(value.content.value, dict):
        if not python:
            pairs = value.content.value.items()
            return [Object("std::pair", fields={"first": Cell(Known(key)), "second": cell}) for key, cell in pairs]
        return [Known(key) for key in value.content.value]
    if isinstance(value, Known) and issubclass(value.kind, (list, dict)):
        return [Known(item) for item in (value.value if isinstance(value.value, (list, dict)) else ())]
    if isinstance(value, Known) and issubclass(value.kind, str) and python:
        return [Known(item) for item in value.of(str)] if len(value.of(str)) <= LIST_LIMIT else None
    return None


def element_type(walk: Walk, frame: Frame, expression: Expression) -> Type | None:
    """The static type of a container's elements."""
    kind = static_type(walk, frame, expression)
    if kind is not None and kind.name in SEQUENCES and kind.arguments:
        return kind.of(0)
    return None


def member_called(
    walk: Walk, frame: Frame, callee: Expression, targs: tuple[syntax.Argument, ...]
) -> tuple[Expression, tuple[syntax.Argument, ...]]:
    """``decltype(a)::element_type::make`` with the class that it stands for, and this class's template arguments."""
    if type(callee) is not syntax.Name or not callee.name.startswith("decltype("):
        return callee, targs
    inside, _, rest = callee.name[9:].partition(")")
    name = inside.removeprefix("this->").strip()
    kind = static_type(walk, frame, syntax.Name(name)) if name.isidentifier() and rest.startswith("::") else None
    if kind is None:
        return callee, targs
    head, _, last = rest[2:].rpartition("::")
    owner = walk.type_in(syntax.Type(f"{kind.name}::{head}" if head else kind.name, kind.arguments, ""), frame)
    return syntax.Name(f"{owner.name}::{last}"), targs or owner.arguments


def static_type(walk: Walk, frame: Frame, expression: Expression) -> Type | None:
    """The declared (resolved) type of *expression*; what it makes and changes is not kept."""
    before, mark = walk.state.last_mark, walk.state.mark()
    walk.quiet += 1
    try:
        return _static_type(walk, frame, expression)
    finally:
        walk.quiet -= 1
        walk.state.undo(mark)
        walk.state.last_mark = before


def _static_type(walk: Walk, frame: Frame, expression: Expression) -> Type | None:
    literal = LITERAL_TYPES.get(type(expression))
    if literal is not None:
        return literal
    if type(expression) is syntax.Number:
        return syntax.Type("int") if isinstance(expression.value, int) else syntax.Type("double")
    if (
        type(expression) is syntax.Address
        or type(expression) is syntax.Dereference
        or type(expression) is syntax.Keyword
    ):
        return _static_type(walk, frame, expression.value)
    if type(expression) is syntax.Cast:
        return walk.type_in(expression.type, frame)
    if type(expression) is syntax.Operation and (
        expression.operator in COMPARING or (expression.operator in CHOOSING and frame.source.separator != ".")
    ):
        return syntax.Type("bool")
    if type(expression) is syntax.Operation:
        kinds = [_static_type(walk, frame, item) for item in expression.operands]
        if frame.source.separator == ".":
            last = expression.operands[-1]
            exponent = last.value if type(last) is syntax.Number else None
            return python_numbers.operation(expression.operator, kinds, exponent)
        known = [kind for kind in kinds if kind is not None]
        for name in ("std::string", "double", "float"):
            if any(kind.name == name for kind in known):
                return syntax.Type(name)
        return known[0] if len(known) == len(kinds) and known else None
    cell = expressions.cell_of(walk, frame, expression)
    if cell is not None and cell.type is not None and cell.type.name not in ("", "auto"):
        return cell.type
    value = cell.value if cell is not None else expressions.evaluate(walk, frame, expression)
    return conversions.value_type(value)


#: Operators whose result is a truth value in both languages, and those that give an operand in Python.
COMPARING = frozenset(("==", "!=", "<", ">", "<=", ">=", "!"))
CHOOSING = frozenset(("&&", "||"))
LITERAL_TYPES: dict[type[Expression], Type] = {
    syntax.String: syntax.Type("std::string"),
    syntax.Boolean: syntax.Type("bool"),
    syntax.Format: syntax.Type("std::string"),
    syntax.ListLiteral: syntax.Type("list"),
    syntax.DictLiteral: syntax.Type("dict"),
}
