# SPDX-License-Identifier: Apache-2.0
"""Numbers that the fields which they are compared with cannot hold, and items that arrays cannot have."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.behaviour.clauses import COMPARISONS
from haros_ci.behaviour.folding import folded
from haros_ci.behaviour.messages import INTEGERS, Scene
from haros_ci.behaviour.text import expression_text
from haros_ci.behaviour.tree import Binary, Expression, Item, Range, SetOf, parts
from haros_ci.interfaces.definitions import FieldType


def outside(predicate: Expression | None, scene: Scene) -> Iterator[tuple[Expression, str]]:
    """Each number that is outside of what a field or an array has, with a sentence on it."""
    for part in parts(predicate):
        if isinstance(part, Item):
            yield from _index(part, scene)
        elif isinstance(part, Binary) and part.operator in (*COMPARISONS, "in"):
            yield from _compared(part, scene)


def _compared(comparison: Binary, scene: Scene) -> Iterator[tuple[Expression, str]]:
    pairs = [(comparison.left, value) for value in _members(comparison.right)]
    if comparison.operator != "in":
        pairs.append((comparison.right, comparison.left))
    for field, value in pairs:
        typed, number = scene.typed(field), folded(value, scene)
        if not isinstance(typed, FieldType) or typed.form or typed.base not in INTEGERS:
            continue
        low, high = INTEGERS[typed.base]
        if isinstance(number, (int, float)) and not low <= number <= high and abs(number) < 1e300:
            text = expression_text(value)
            yield (
                value,
                f"{expression_text(field)} is {typed.base}, {low} to {high}, and never {text}; correct the number",
            )


def _members(expression: Expression) -> tuple[Expression, ...]:
    if isinstance(expression, SetOf):
        return expression.values
    return (expression.low, expression.high) if isinstance(expression, Range) else (expression,)


def _index(item: Item, scene: Scene) -> Iterator[tuple[Expression, str]]:
    array, index = scene.typed(item.base), folded(item.index, scene)
    if isinstance(index, (bool, str)) or index is None:
        return
    if index < 0:
        yield item.index, f"An index counts from 0, so {expression_text(item)} is no item; correct the index"
    elif isinstance(array, FieldType) and array.form in ("array", "bounded") and index >= array.size:
        text = expression_text(item.base)
        yield (
            item.index,
            f"{text} has at most {array.size} items, so {expression_text(item)} is none of them; correct the index",
        )
