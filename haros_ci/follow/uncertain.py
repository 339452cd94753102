# SPDX-License-Identifier: Apache-2.0
"""Assignments to what has no single cell: what may be meant holds what it held or the value, or is not known."""

from __future__ import annotations

import re

from haros_ci import syntax
from haros_ci.follow import conversions, copies, dispatch, expressions, members, unknown_calls
from haros_ci.follow.frames import Frame
from haros_ci.follow.ros import qos_calls
from haros_ci.follow.walk import Walk
from haros_ci.syntax import Expression
from haros_ci.values.abstract import (
    NONE,
    Callable,
    Cell,
    Choice,
    Known,
    Library,
    Mapped,
    Object,
    Pointer,
    Sequence,
    Value,
    data_of,
    join,
)

UNCERTAIN = "it is assigned to in a way that is not followed"


def lost(walk: Walk, frame: Frame, target: Expression, value: Value) -> None:  # noqa: C901 - one branch for each kind of target
    """What has no single cell is assigned to: all that may be meant is what it was or the value, or not known."""
    if type(target) is syntax.Member and isinstance(value, Callable) and _passed_to_library(walk, frame, target, value):
        return
    if type(target) is syntax.Cast:
        lost(walk, frame, target.value, value)
    elif type(target) is syntax.Conditional:
        holds = conversions.truth(expressions.evaluate(walk, frame, target.test))
        sides = (target.then, target.other)
        for side in sides if holds is None else (sides[0 if holds else 1],):
            cell = expressions.cell_of(walk, frame, side)
            if cell is None:
                lost(walk, frame, side, value)
            elif holds is not None:
                walk.state.write(cell, conversions.converted(value, cell.type))
            else:
                _maybe(walk, frame, cell, value)
    elif type(target) is syntax.Member:
        owners = _options(expressions.evaluate(walk, frame, target.object))
        if type(target.object) is syntax.Subscript and not any(isinstance(owner, Object) for owner in owners):
            owners = [
                other_value
                for held in _options(expressions.evaluate(walk, frame, target.object.object))
                for other_value in _held(held)
            ]
        for owner in owners:
            if isinstance(owner, Library):
                qos_calls.change(walk, owner)
            for option in _pointed(owner):
                cell = members.member(walk, option, target.name, frame)
                if cell is not None:
                    _maybe(walk, frame, cell, value)
    elif type(target) is syntax.Dereference:
        owner = expressions.evaluate(walk, frame, target.value)
        for other_value in owner.options if isinstance(owner, Choice) else (owner,):
            if isinstance(other_value, Pointer):
                _maybe(walk, frame, other_value.cell, value)
            elif isinstance(other_value, Object) and "[of]" in other_value.fields:
                _element(walk, frame, other_value.fields["[of]"].value, value)
    elif type(target) is syntax.Subscript:
        python = frame.source.program.language == "python"
        key = expressions.evaluate(walk, frame, target.index)
        for container in _options(expressions.evaluate(walk, frame, target.object)):
            if isinstance(container, (Sequence, Mapped)) and (isinstance(key, Known) or python):
                if python:
                    dispatch.kept(walk, container, value)
                walk.state.forget(container.content, walk.opaque(UNCERTAIN, frame))
            elif isinstance(container, (Sequence, Mapped)):
                _element(walk, frame, container, value)
            elif isinstance(container, Known):
                _inside(walk, frame, target, container, key, value)
    elif type(target) is syntax.Call and type(target.callee) is syntax.Member:
        cell = _root(walk, frame, target.callee.object)
        if cell is not None:
            _forget(walk, frame, cell)


def _passed_to_library(walk: Walk, frame: Frame, target: syntax.Member, value: Callable) -> bool:
    """A function is assigned to a member of a struct inside a library's object: the struct is made, as a part of it."""
    inside = expressions.evaluate(walk, frame, target.object)
    if not isinstance(inside, Library) or type(target.object) is not syntax.Member or frame.source.separator != "::":
        return False
    if not isinstance(inside.this, Object) or inside.this.definition is not None:
        return False
    struct = Object(inside.name, location=inside.this.location)
    struct.fields[target.name] = Cell(value)
    inside.this.fields[target.object.name] = Cell(struct)
    return True


def _inside(walk: Walk, frame: Frame, target: syntax.Subscript, container: Known, key: Value, value: Value) -> None:
    """An element of known data or a character of a text is set: the variable holds other data."""
    cell = expressions.cell_of(walk, frame, target.object)
    data = container.value
    known, item = data_of(value)
    if cell is not None and cell.value is container and known and isinstance(key, Known):
        if isinstance(data, dict) and isinstance(key.value, (str, int)):
            walk.state.write(cell, Known({**data, key.value: item}))
            return
        if isinstance(data, list) and type(key.value) is int and -len(data) <= key.value < len(data):
            changed = [*data]
            changed[key.value] = item
            walk.state.write(cell, Known(changed))
            return
    cell = cell if cell is not None else _root(walk, frame, target.object)
    if cell is not None:
        _forget(walk, frame, cell)


def _element(walk: Walk, frame: Frame, container: Value, value: Value) -> None:
    """Some element of a container is set."""
    if isinstance(container, Sequence) and isinstance(container.content.value, tuple):
        for cell in container.content.value:
            _maybe(walk, frame, cell, value)
    elif isinstance(container, (Sequence, Mapped)):
        walk.state.forget(container.content, walk.opaque(UNCERTAIN, frame))


def _maybe(walk: Walk, frame: Frame, cell: Cell, value: Value) -> None:
    """*cell* holds what it held, or *value*."""
    if isinstance(value, Object) and isinstance(cell.value, Object) and copies.is_by_value(cell.type):
        _forget(walk, frame, cell)
    else:
        walk.state.write(cell, join(cell.value, conversions.converted(value, cell.type)))


def _forget(walk: Walk, frame: Frame, cell: Cell) -> None:
    if cell.value == NONE:
        walk.state.write(cell, walk.opaque(UNCERTAIN, frame, None, cell.type))
    else:
        unknown_calls.forget(walk, frame, cell, UNCERTAIN)


def _root(walk: Walk, frame: Frame, expression: Expression) -> Cell | None:
    """The nearest cell that an element, member or character is inside of."""
    while True:
        cell = expressions.cell_of(walk, frame, expression)
        if cell is not None:
            return cell
        if isinstance(expression, (syntax.Subscript, syntax.Member)):
            expression = expression.object
        elif isinstance(expression, (syntax.Dereference, syntax.Cast)):
            expression = expression.value
        elif type(expression) is syntax.Call and type(expression.callee) is syntax.Member:
            expression = expression.callee.object
        else:
            return None


def _options(value: Value) -> list[Value]:
    """What a value may be, addresses looked through."""
    options = value.options if isinstance(value, Choice) else (value,)
    return [option.cell.value if isinstance(option, Pointer) else option for option in options]


def _held(container: Value) -> list[Value]:
    """The elements of a container."""
    held = container.content.value if isinstance(container, (Sequence, Mapped)) else ()
    cells = held.values() if isinstance(held, dict) else held if isinstance(held, tuple) else ()
    return [cell.value for cell in cells]


def _pointed(value: Value) -> list[Value]:
    """An object, or what an iterator may lead to."""
    if isinstance(value, Object) and "[of]" in value.fields:
        container = value.fields["[of]"].value
        cells = container.content.value if isinstance(container, Sequence) else ()
        return [cell.value for cell in cells] if isinstance(cells, tuple) else []
    return [value]


def exposed(walk: Walk, frame: Frame, expression: Expression) -> None:
    """A reference to one of several is made: what they hold may be changed through it from here on."""
    for side in (expression.then, expression.other) if type(expression) is syntax.Conditional else ():
        cell = expressions.cell_of(walk, frame, side)
        if cell is None:
            exposed(walk, frame, side)
        elif not isinstance(cell.value, Object):
            _forget(walk, frame, cell)


def deleted(walk: Walk, frame: Frame, text: str) -> None:
    """Python's ``del``: variables have no value, lists and maps that lose an element are not known."""
    for target in text.removeprefix("del ").split(","):
        found = re.match(r"\s*(?:\(\s*)?([A-Za-z_]\w*(?:\s*\.\s*\w+)*)\s*([\[(.]?)", target)
        if found is None:
            continue
        first, *rest = re.split(r"\s*\.\s*", found[1])
        expression: Expression = syntax.This() if first == "self" and frame.find("self") is None else syntax.Name(first)
        for part in rest:
            expression = syntax.Member(expression, part)
        cell = expressions.cell_of(walk, frame, expression)
        if cell is None:
            continue
        if not found[2]:
            walk.state.write(cell, walk.opaque("it is deleted", frame))
        elif isinstance(cell.value, (Sequence, Mapped)):
            walk.state.forget(cell.value.content, walk.opaque("something is deleted from it", frame))
        else:
            _forget(walk, frame, cell)
