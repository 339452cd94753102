# SPDX-License-Identifier: Apache-2.0
"""Fold expressions over packs of arguments (en.cppreference.com/w/cpp/language/fold): ``(f(args), ...)``."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import expressions
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.syntax import Expression
from haros_ci.syntax.walk import everything
from haros_ci.values.abstract import NONE, Cell, Sequence, Value


def folded(walk: Walk, frame: Frame, expression: Expression) -> Value:
    """Evaluate *expression* for the elements of the packs that it names, in their order; once where these are not known."""
    packs = _packs(frame)
    named = {node.name for node in everything(expression) if type(node) is syntax.Name} & packs
    found = {name: cell.value for name in sorted(named) if (cell := frame.find(name)) is not None}
    contents = [value.content.value for value in found.values() if isinstance(value, Sequence)]
    known = [content for content in contents if isinstance(content, tuple)]
    if not found or len(known) < len(found) or len({len(content) for content in known}) != 1:
        with walk.doubted("how many elements a pack has is not known"):
            return expressions.evaluate(walk, frame, expression)
    for row in zip(*known, strict=True):
        frame.scopes.append({name: Cell(cell.value, cell.type) for name, cell in zip(found, row, strict=True)})
        try:
            expressions.evaluate(walk, frame, expression)
        finally:
            frame.scopes.pop()
    return NONE


def _packs(frame: Frame) -> set[str]:
    """The names of the packs of arguments of the functions around."""
    found: set[str] = set()
    around: Frame | None = frame
    while around is not None:
        if around.function is not None:
            found |= {parameter.name[1:] for parameter in around.function.parameters if parameter.name.startswith("*")}
        around = around.outer
    return found
