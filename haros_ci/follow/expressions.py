# SPDX-License-Identifier: Apache-2.0
"""Expressions: the value of each, the cell of those that have one, and their static types."""

from __future__ import annotations

from collections.abc import Callable as Function_
from dataclasses import replace
from typing import TypeVar, cast

from haros_ci import syntax
from haros_ci.follow import (
    assignments,
    bases,
    calls,
    construct,
    conversions,
    copies,
    indexing,
    lookup,
    members,
    narrowing,
    operators,
    properties,
    static_types,
    uncalled,
    uncertain,
)
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import text_methods, texts
from haros_ci.follow.walk import Walk
from haros_ci.index.index import EITHER
from haros_ci.index.types import is_smart_pointer, pointee
from haros_ci.model.location import Location
from haros_ci.regex import regex
from haros_ci.syntax import Expression
from haros_ci.values import iterators
from haros_ci.values.abstract import (
    LIST_LIMIT,
    NONE,
    Callable,
    Cell,
    Choice,
    Known,
    Library,
    Mapped,
    Object,
    Opaque,
    Pointer,
    Sequence,
    Value,
    concatenate,
    printed,
)

_Kind = TypeVar("_Kind", bound=Expression)
_Evaluate = Function_[[Walk, Frame, Expression], Value]


def evaluate(walk: Walk, frame: Frame, expression: Expression) -> Value:
    """The value of *expression*; never raises, whatever it is."""
    return EVALUATORS[type(expression)](walk, frame, expression)


#: The last word of the names that libraries give their pointers: ``ModelPtr``, ``model_ptr``, not ``Xref``.
POINTER = regex(r"(?:Ptr|PTR|Pointer|Ref|(?:^|[_:])(?:ptr|pointer|ref))\Z")


def holds(walk: Walk, frame: Frame, expression: Expression, value: Value) -> bool | None:
    """Whether *expression*, which has come to *value*, is true; None if that is not known.

    A library's object that is no pointer has its own say: what its ``operator bool`` tells is not known. A pointer under a name of
    the library (``urdf::ModelInterfaceSharedPtr``) is true as one.
    """
    result = conversions.truth(value)
    if not result or not isinstance(value, Object) or value.definition is not None or frame.source.separator != "::":
        return result
    if not POINTER.search(value.name):
        cell = cell_of(walk, frame, expression) if isinstance(expression, (syntax.Name, syntax.Member)) else None
        kind = cell.type if cell is not None else None
        if kind is not None and kind.name == value.name and "*" not in kind.marks:
            return None
    return result


def cell_of(walk: Walk, frame: Frame, expression: Expression) -> Cell | None:
    """The cell that *expression* names (an lvalue); None if it names none."""
    if type(expression) is syntax.Name:
        return lookup.named_cell(walk, frame, expression.name)
    if type(expression) is syntax.Member:
        return members.member(walk, evaluate(walk, frame, expression.object), expression.name, frame)
    if type(expression) is syntax.Subscript or type(expression) is syntax.Call:
        return assignments.accessed(walk, frame, expression)
    if type(expression) is syntax.Dereference:
        value = evaluate(walk, frame, expression.value)
        if isinstance(value, Pointer):
            return value.cell
        if isinstance(value, Object) and "[of]" in value.fields:
            return iterators.pointed(value)
        if isinstance(value, Object) and value.definition is not None:
            return Cell(value, syntax.Type(value.name, value.arguments))
        return None if isinstance(value, Choice) else cell_of(walk, frame, expression.value)
    if isinstance(expression, (syntax.Address, syntax.Keyword, syntax.Cast)):
        return cell_of(walk, frame, expression.value)
    if type(expression) is syntax.Assignment and frame.source.separator == "::":  # (a += b) += c
        evaluate(walk, frame, expression)
        return cell_of(walk, frame, expression.target)
    return None


def located(walk: Walk, frame: Frame, expression: Expression) -> tuple[Cell | None, Value]:
    """The cell of *expression* if it names one, and its value; what it is made of is evaluated once."""
    if type(expression) is syntax.Name:
        cell = lookup.named_cell(walk, frame, expression.name)
        return cell, cell.value if cell is not None else lookup.no_variable(walk, frame, expression.name)
    if type(expression) is syntax.Member:
        return members.located(walk, frame, expression)
    if type(expression) is syntax.Call and syntax.name_of(expression.callee) in texts.CHANGING:
        walk.references = None
        value = evaluate(walk, frame, expression)
        changed = walk.references
        return (changed[0] if changed is not None and len(changed) == 1 else None), value
    cell = (
        cell_of(walk, frame, expression)
        if (type(expression) is syntax.Subscript or type(expression) is syntax.Dereference)
        else None
    )
    return cell, cell.value if cell is not None else evaluate(walk, frame, expression)


def _this(walk: Walk, frame: Frame, expression: syntax.This) -> Value:
    around: Frame | None = frame
    while around is not None:
        if around.this is not None:
            return properties.this(around.function, around.this)
        around = around.outer
    return walk.opaque("the object is not known", frame)


def _compiled(walk: Walk, frame: Frame, expression: syntax.Compiled) -> Value:
    verdicts = {walk.is_compiled(frame.source.path, line) for line, _, _ in expression.guards}
    return Known(False) if False in verdicts else walk.opaque(EITHER, frame) if None in verdicts else Known(True)


def _conditional(walk: Walk, frame: Frame, expression: syntax.Conditional) -> Value:
    decided = holds(walk, frame, expression.test, evaluate(walk, frame, expression.test))
    ways = [lambda side=side: evaluate(walk, frame, side) for side in (expression.then, expression.other)]
    if decided is None:
        return walk.either_way(ways, "it stands in one side of a conditional expression")
    mark = walk.state.mark()
    with walk.doubted("the other side of a conditional expression is taken as things are"):
        ways[1 if decided else 0]()
    walk.state.undo(mark)
    return ways[0 if decided else 1]()


def _list(walk: Walk, frame: Frame, expression: syntax.ListLiteral) -> Value:
    items: list[Cell] = []
    for item in expression.items:
        if type(item) is syntax.Star:
            more = static_types.elements(walk, frame, item.value)
            if more is None or len(items) + len(more) > LIST_LIMIT:
                return Sequence(Cell(walk.opaque("a list with unpacked elements", frame)))
            items += [Cell(cell.value) if isinstance(cell, Cell) else Cell(cell) for cell in more]
            continue
        items.append(Cell(evaluate(walk, frame, item)))
    return Sequence(Cell(tuple(items)))


def _dict(walk: Walk, frame: Frame, expression: syntax.DictLiteral) -> Value:
    pairs: dict[object, Cell] = {}
    for key, item in expression.pairs:
        if key and type(key) is syntax.DoubleStar:
            more = evaluate(walk, frame, key.value)
            cells = more.content.value if isinstance(more, Mapped) else None
            if not isinstance(cells, dict):
                return Mapped(Cell(walk.opaque("a dictionary with unpacked entries", frame)))
            pairs.update({name: Cell(cell.value) for name, cell in cells.items()})
            continue
        found = evaluate(walk, frame, key) if key else NONE
        if not isinstance(found, Known) or issubclass(found.kind, (list, dict)):
            return Mapped(Cell(walk.opaque("a dictionary with computed keys", frame)))
        pairs[found.value] = Cell(evaluate(walk, frame, item))
    return Mapped(Cell(pairs))


def _lambda(walk: Walk, frame: Frame, expression: syntax.Lambda) -> Value:
    function, captured = copies.captures(walk, frame, expression.function)
    around = with_defaults(walk, frame, function) if frame.source.separator == "." else kept(frame)
    for variable in captured:
        place = Location(frame.source.path, variable.line, variable.column)
        held = construct.initial(walk, frame, syntax.AUTO, variable.init, place)
        kind = copies.static_copy(walk, frame, variable.init.value) if type(variable.init) is syntax.Equals else None
        around.scopes = [*around.scopes, {variable.name: Cell(held, kind)}]
    if function.captures:
        around.scopes = [*around.scopes, copies.by_value(walk, frame, function.captures)]
    made = Callable(frame.source, function, here(frame), frame=around, templates=frame.templates)
    return uncalled.keep(walk, made) if frame.source.separator == "::" else made


def kept(frame: Frame) -> Frame:
    """*frame* as a function that is made in it finds it later: with the scopes that are open now, but for Python's."""
    if frame.source.program.language == "python":
        return frame
    return replace(frame, scopes=[*frame.scopes])


def with_defaults(walk: Walk, frame: Frame, function: syntax.Function) -> Frame:
    """*frame* as a Python function that is made in it finds it, with what its default arguments are now, under their names with a ``=``."""
    literals = (syntax.Boolean, syntax.Number, syntax.String, syntax.Null)
    defaults = {
        f"{parameter.name}=": Cell(evaluate(walk, frame, parameter.default))
        for parameter in function.parameters
        if parameter.default is not None and not isinstance(parameter.default, literals)
    }
    return replace(frame, scopes=[*frame.scopes, defaults]) if defaults else kept(frame)


def here(frame: Frame) -> Object | None:
    return frame.this if frame.this is not None or frame.outer is None else here(frame.outer)


def _address(walk: Walk, frame: Frame, expression: syntax.Address) -> Value:
    cell = cell_of(walk, frame, expression.value)
    if cell is None or isinstance(cell.value, (Object, Callable)):
        return evaluate(walk, frame, expression.value)
    return Pointer(cell)


def _dereference(walk: Walk, frame: Frame, expression: syntax.Dereference) -> Value:
    value = evaluate(walk, frame, expression.value)
    if isinstance(value, Pointer):
        return value.cell.value
    if isinstance(value, Object) and value.name == iterators.ITERATOR:
        cell = iterators.pointed(value)
        if cell is not None:
            return cell.value
        if not isinstance(value.fields["[of]"].value, Pointer):  # of a text
            return walk.opaque("an element that is not known", frame, None, iterators.kind(value))
    if isinstance(value, Opaque) and value.type is not None and is_smart_pointer(value.type):
        return Opaque(value.reason, value.location, pointee(value.type))
    end = (
        text_methods.end_of(expression.value, value) if isinstance(value, Object) and value.definition is None else None
    )
    return value if end is None else end


def _cast(walk: Walk, frame: Frame, expression: syntax.Cast) -> Value:
    value = evaluate(walk, frame, expression.value)
    kind = walk.type_in(expression.type, frame)
    if isinstance(value, Object) and value.definition is not None and "*" in kind.marks:
        owner = walk.class_of(kind.name, frame.source)
        own = value.definition[1]
        if owner is not None and owner[1] is not own and bases.derives(walk, owner, own):
            return walk.opaque("whether it is cast to its own class", frame, None, kind.bare())
    return conversions.converted(value, kind)


def _format(walk: Walk, frame: Frame, expression: syntax.Format) -> Value:
    show = printed if frame.source.program.language == "python" else None
    return concatenate(tuple(evaluate(walk, frame, part) for part in expression.parts), show)


def _unknown(walk: Walk, frame: Frame, expression: syntax.Unknown) -> Value:
    text = expression.text
    if text.startswith("del ") and frame.source.program.language == "python":
        uncertain.deleted(walk, frame, text)
    return walk.opaque(f"it is computed: {text}", frame)


def _unpacked(walk: Walk, frame: Frame, expression: syntax.Star | syntax.DoubleStar) -> Value:
    return walk.opaque(f"it is computed: {'star' if type(expression) is syntax.Star else 'starstar'}", frame)


def _on(kind: type[_Kind], value: Function_[[Walk, Frame, _Kind], Value]) -> tuple[type[Expression], _Evaluate]:
    """*value* for expressions of *kind*, and for no others."""
    return cast("type[Expression]", kind), cast("_Evaluate", value)


EVALUATORS: dict[type[Expression], _Evaluate] = dict(
    (
        _on(syntax.String, lambda walk, frame, e: Known(e.value)),
        _on(syntax.Number, lambda walk, frame, e: Known(e.value)),
        _on(syntax.Boolean, lambda walk, frame, e: Known(e.value)),
        _on(syntax.Null, lambda walk, frame, e: NONE),
        _on(syntax.Name, lambda walk, frame, e: lookup.name(walk, frame, e)),
        _on(syntax.This, _this),
        _on(syntax.Member, lambda walk, frame, e: members.field(walk, frame, e)),
        _on(syntax.Subscript, lambda walk, frame, e: indexing.indexed(walk, frame, e)),
        _on(syntax.Call, lambda walk, frame, e: (narrowing.called if frame.beliefs else calls.call)(walk, frame, e)),
        _on(syntax.New, lambda walk, frame, e: calls.new(walk, frame, e)),
        _on(syntax.Operation, lambda walk, frame, e: operators.operation(walk, frame, e)),
        _on(syntax.Assignment, lambda walk, frame, e: assignments.assignment(walk, frame, e)),
        _on(syntax.Compiled, _compiled),
        _on(syntax.Conditional, _conditional),
        _on(syntax.Lambda, _lambda),
        _on(syntax.ListLiteral, _list),
        _on(syntax.DictLiteral, _dict),
        _on(syntax.Format, _format),
        _on(syntax.Address, _address),
        _on(syntax.Dereference, _dereference),
        _on(syntax.Cast, _cast),
        _on(syntax.TypeName, lambda walk, frame, e: Library(walk.type_in(e.type, frame).name)),
        _on(syntax.Keyword, lambda walk, frame, e: evaluate(walk, frame, e.value)),
        _on(syntax.Star, _unpacked),
        _on(syntax.DoubleStar, _unpacked),
        _on(syntax.Unknown, _unknown),
    )
)
