# SPDX-License-Identifier: Apache-2.0
"""Expressions: the value of each, the cell of those that have one, and their static types."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from haros_ci.link import (
    assignments,
    calls,
    construct,
    conversions,
    copies,
    iterators,
    lookup,
    members,
    operators,
    statements,
    static_types,
    text_methods,
    uncertain,
)
from haros_ci.link.run import Frame, Run
from haros_ci.link.types import is_smart_pointer, pointee
from haros_ci.link.values import (
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
from haros_ci.model.location import Location
from haros_ci.model.program import Expression


def evaluate(run: Run, frame: Frame, expression: Expression) -> Value:
    """The value of *expression*; never raises, whatever it is."""
    return EVALUATORS[expression[0]](run, frame, expression)


def cell_of(run: Run, frame: Frame, expression: Expression) -> Cell | None:
    """The cell that *expression* names (an lvalue); None if it names none."""
    tag = expression[0]
    if tag == "name":
        return lookup.named_cell(run, frame, expression[1])
    if tag == "field":
        return members.member(run, evaluate(run, frame, expression[1]), expression[2], frame)
    if tag == "index":
        return assignments.accessed(run, frame, expression)
    if tag == "call":
        return assignments.accessed(run, frame, expression)
    if tag == "*":
        value = evaluate(run, frame, expression[1])
        if isinstance(value, Pointer):
            return value.cell
        if isinstance(value, Object) and "[of]" in value.fields:
            return iterators.pointed(value)
        if isinstance(value, Object) and value.definition is not None:
            return Cell(value, (value.name, value.arguments, ""))
        return None if isinstance(value, Choice) else cell_of(run, frame, expression[1])
    if tag in ("&", "kw"):
        return cell_of(run, frame, expression[-1])
    if tag == "cast":
        return cell_of(run, frame, expression[2])
    return None


def _this(run: Run, frame: Frame, expression: Expression) -> Value:
    around: Frame | None = frame
    while around is not None:
        if around.this is not None:
            return around.this
        around = around.outer
    return run.opaque("the object is not known", frame)


def _conditional(run: Run, frame: Frame, expression: Expression) -> Value:
    holds = statements.truth(evaluate(run, frame, expression[1]))
    ways = [lambda side=side: evaluate(run, frame, side) for side in expression[2:4]]
    if holds is None:
        return run.either_way(ways, "it stands in one side of a conditional expression")
    mark = run.state.mark()
    with run.doubted("the other side of a conditional expression is taken as things are"):
        ways[1 if holds else 0]()
    run.state.undo(mark)
    return ways[0 if holds else 1]()


def _list(run: Run, frame: Frame, expression: Expression) -> Value:
    items: list[Cell] = []
    for item in expression[1]:
        if item[0] == "star":
            more = static_types.elements(run, frame, item[1])
            if more is None or len(items) + len(more) > LIST_LIMIT:
                return Sequence(Cell(run.opaque("a list with unpacked elements", frame)))
            items += [Cell(each.value) if isinstance(each, Cell) else Cell(each) for each in more]
            continue
        items.append(Cell(evaluate(run, frame, item)))
    return Sequence(Cell(tuple(items)))


def _dict(run: Run, frame: Frame, expression: Expression) -> Value:
    pairs: dict[Any, Cell] = {}
    for key, item in expression[1]:
        if key and key[0] == "starstar":
            more = evaluate(run, frame, key[1])
            cells = more.content.value if isinstance(more, Mapped) else None
            if not isinstance(cells, dict):
                return Mapped(Cell(run.opaque("a dictionary with unpacked entries", frame)))
            pairs.update({name: Cell(cell.value) for name, cell in cells.items()})
            continue
        found = evaluate(run, frame, key) if key else NONE
        if not isinstance(found, Known) or isinstance(found.value, (list, dict)):
            return Mapped(Cell(run.opaque("a dictionary with computed keys", frame)))
        pairs[found.value] = Cell(evaluate(run, frame, item))
    return Mapped(Cell(pairs))


def _lambda(run: Run, frame: Frame, expression: Expression) -> Value:
    function, captured = copies.captures(run, frame, expression[1])
    around = kept(frame)
    for name, init, line, column in captured:
        place = Location(frame.source.path, line, column)
        held = construct.initial(run, frame, ("auto", (), ""), init, place)
        around.scopes = [*around.scopes, {name: Cell(held, copies.static_copy(run, frame, init[1]))}]
    return Callable(frame.source, function, here(frame), frame=around)


def kept(frame: Frame) -> Frame:
    """*frame* as a function that is made in it finds it later: with the scopes that are open now, but for Python's."""
    if frame.source.program.language == "python":
        return frame
    return replace(frame, scopes=[*frame.scopes])


def here(frame: Frame) -> Object | None:
    return frame.this if frame.this is not None or frame.outer is None else here(frame.outer)


def _address(run: Run, frame: Frame, expression: Expression) -> Value:
    cell = cell_of(run, frame, expression[1])
    if cell is None or isinstance(cell.value, (Object, Callable)):
        return evaluate(run, frame, expression[1])
    return Pointer(cell)


def _dereference(run: Run, frame: Frame, expression: Expression) -> Value:
    value = evaluate(run, frame, expression[1])
    if isinstance(value, Pointer):
        return value.cell.value
    if isinstance(value, Object) and value.name == iterators.ITERATOR:
        cell = iterators.pointed(value)
        if cell is not None:
            return cell.value
        if not isinstance(value.fields["[of]"].value, Pointer):  # of a text
            return run.opaque("an element that is not known", frame, None, iterators.kind(value))
    if isinstance(value, Opaque) and value.type is not None and is_smart_pointer(value.type):
        return Opaque(value.reason, value.location, pointee(value.type))
    end = text_methods.end_of(expression[1], value) if isinstance(value, Object) and value.definition is None else None
    return value if end is None else end


def _cast(run: Run, frame: Frame, expression: Expression) -> Value:
    value = evaluate(run, frame, expression[2])
    kind = run.type_in(expression[1], frame)
    if isinstance(value, Object) and value.definition is not None and "*" in kind[2]:
        owner = run.class_of(kind[0], frame.source)
        own = value.definition[1]
        if owner is not None and owner[1] is not own and copies.derives(run, owner, own):
            return run.opaque("whether it is cast to its own class", frame, None, (kind[0], kind[1], ""))
    return conversions.converted(value, kind)


def _format(run: Run, frame: Frame, expression: Expression) -> Value:
    show = printed if frame.source.program.language == "python" else None
    return concatenate(tuple(evaluate(run, frame, part) for part in expression[1]), show)


def _unknown(run: Run, frame: Frame, expression: Expression) -> Value:
    text = expression[1] if len(expression) > 1 and isinstance(expression[1], str) else expression[0]
    if text.startswith("del ") and frame.source.program.language == "python":
        uncertain.deleted(run, frame, text)
    return run.opaque(f"it is computed: {text}", frame)


EVALUATORS = {
    "str": lambda run, frame, e: Known(e[1]),
    "num": lambda run, frame, e: Known(e[1]),
    "bool": lambda run, frame, e: Known(e[1]),
    "none": lambda run, frame, e: NONE,
    "name": lambda run, frame, e: lookup.name(run, frame, e),
    "this": _this,
    "field": lambda run, frame, e: members.field(run, frame, e),
    "index": lambda run, frame, e: assignments.indexed(run, frame, e),
    "call": lambda run, frame, e: calls.call(run, frame, e),
    "new": lambda run, frame, e: calls.new(run, frame, e),
    "op": lambda run, frame, e: operators.operation(run, frame, e),
    "set": lambda run, frame, e: assignments.assignment(run, frame, e),
    "if": _conditional,
    "lambda": _lambda,
    "list": _list,
    "dict": _dict,
    "format": _format,
    "&": _address,
    "*": _dereference,
    "cast": _cast,
    "type": lambda run, frame, e: Library(run.type_in(e[1], frame)[0]),
    "kw": lambda run, frame, e: evaluate(run, frame, e[2]),
    "star": _unknown,
    "starstar": _unknown,
    "?": _unknown,
}
