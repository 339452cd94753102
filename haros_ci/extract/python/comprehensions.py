# SPDX-License-Identifier: Apache-2.0
"""Python comprehensions and generator expressions in the little language of ``haros_ci.syntax``."""

from __future__ import annotations

import ast
from dataclasses import replace
from typing import Any

from haros_ci import syntax
from haros_ci.extract.python import expressions
from haros_ci.extract.python.annotations import NO_TYPE
from haros_ci.extract.python.scope import DEEPEST, PythonScope, too_deep
from haros_ci.extract.python.source import condition, place, unknown
from haros_ci.syntax import Block, Expression, Parameter

Comprehension = ast.ListComp | ast.SetComp | ast.GeneratorExp | ast.DictComp


def comprehension(node: Comprehension, scope: PythonScope, depth: int) -> Expression:
    """``[f(x) for x in xs if x]`` is ``[for](xs, lambda x: f(x), lambda x: x, "x")``, the text that of the condition.

    ``for x in xs for y in ys`` is ``[for in](xs, lambda x: [for](ys, ...))``, its lists one after the other. A
    dictionary is ``[dict]`` of a list of pairs. A pattern is taken apart in the lambda's body.
    """
    if any(generator.is_async for generator in node.generators):
        return unknown(scope.file.source, node)
    made = _level(node, 0, scope, depth)
    if isinstance(node, ast.DictComp):
        return syntax.Call(syntax.Name("[dict]"), (made,), (), *place(scope.file.source, node))
    return made


def _level(node: Comprehension, number: int, scope: PythonScope, depth: int) -> Expression:
    """The for of that *number*, with all that stands behind it."""
    if depth > DEEPEST:
        too_deep(scope, node)
        return unknown(scope.file.source, node)
    source = scope.file.source
    entry = node.generators[number]
    is_last = number + 1 == len(node.generators)

    def element(inner: PythonScope) -> Expression:
        if not is_last:
            return _level(node, number + 1, inner, depth + 1)
        if isinstance(node, ast.DictComp):
            pair = (node.key, node.value)
            return syntax.ListLiteral(tuple([expressions.expression(item, inner, depth) for item in pair]))
        return expressions.expression(node.elt, inner, depth)

    parts = [expressions.expression(entry.iter, scope, depth), _function(node, entry.target, scope, depth, element)]
    if entry.ifs:
        test = (
            entry.ifs[0] if len(entry.ifs) == 1 else ast.copy_location(ast.BoolOp(ast.And(), entry.ifs), entry.ifs[0])
        )
        guard = _function(
            entry.ifs[0], entry.target, scope, depth, lambda inner: expressions.expression(test, inner, depth)
        )
        parts += [guard, syntax.String(condition(source, entry.ifs[0], entry.ifs[-1])[:200])]
    name = "[for]" if is_last else "[for in]"
    return syntax.Call(syntax.Name(name), tuple(parts), (), *place(source, node))


def _function(node: ast.expr, target: ast.expr, scope: PythonScope, depth: int, value: Any) -> Expression:
    """A lambda of one parameter, *target*, that returns what *value* lowers; ``:=`` in it sets variables outside."""
    name = target.id if isinstance(target, ast.Name) else ""
    bound = {part.id for part in ast.walk(target) if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store)}
    outside = sorted({part.target.id for part in ast.walk(node) if isinstance(part, ast.NamedExpr)})

    def body(inner: PythonScope) -> Block:
        inner = replace(inner, this=expressions.this_within(scope, bound))
        statements: list[Any] = [syntax.Nonlocal(tuple(outside))] if outside else []
        if not name:
            statements.append(
                syntax.Do(syntax.Assignment("=", expressions.expression(target, inner, depth), syntax.Name("")))
            )
        return (*statements, syntax.Return(value(inner)))

    return expressions.anonymous(node, (Parameter(name, NO_TYPE),), scope, body)
