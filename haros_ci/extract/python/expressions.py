# SPDX-License-Identifier: Apache-2.0
"""Python expressions in the little language of ``haros_ci.syntax``."""

from __future__ import annotations

import ast
import math
from collections.abc import Callable
from typing import TypeVar, cast

from haros_ci import syntax
from haros_ci.extract.python import comprehensions
from haros_ci.extract.python.annotations import NO_TYPE, type_of
from haros_ci.extract.python.keywords import written_out
from haros_ci.extract.python.scope import DEEPEST, PythonScope, qualified, too_deep
from haros_ci.extract.python.source import place, unknown
from haros_ci.syntax import Block, Expression, Function, Parameter

_OPERATORS: dict[type[ast.AST], str] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.Div: "/",
    ast.FloorDiv: "//",
    ast.Mod: "%",
    ast.Pow: "**",
    ast.MatMult: "@",
    ast.LShift: "<<",
    ast.RShift: ">>",
    ast.BitOr: "|",
    ast.BitAnd: "&",
    ast.BitXor: "^",
    ast.Not: "!",
    ast.UAdd: "+",
    ast.USub: "-",
    ast.Invert: "~",
    ast.And: "&&",
    ast.Or: "||",
    ast.Eq: "==",
    ast.NotEq: "!=",
    ast.Lt: "<",
    ast.LtE: "<=",
    ast.Gt: ">",
    ast.GtE: ">=",
    ast.In: "in",
    ast.NotIn: "not in",
    ast.Is: "is",
    ast.IsNot: "is not",
}
_WIDEST_INTEGER = 64  # bits; a JSON reader need not take more
_STR_CONVERSION = ord("s")
_Kind = TypeVar("_Kind", bound=ast.expr)
_Lower = Callable[[ast.expr, PythonScope, int], Expression]


def operator_text(node: ast.AST) -> str:
    """An operator as the little language spells it."""
    return _OPERATORS[type(node)]


def expression(node: ast.expr, scope: PythonScope, depth: int) -> Expression:
    """Lower one expression; what has no words, or lies too deep, is unknown."""
    if depth > DEEPEST:
        too_deep(scope, node)
        return unknown(scope.file.source, node)
    lower = _LOWERED.get(type(node))
    return lower(node, scope, depth + 1) if lower else unknown(scope.file.source, node)


def parameters(arguments: ast.arguments, scope: PythonScope, depth: int) -> tuple[Parameter, ...]:
    """All parameters in order; a bare ``*`` is one named ``*``, so that what follows is by keyword only."""

    def parameter(mark: str, found: ast.arg, default: ast.expr | None) -> Parameter:
        type_ = type_of(found.annotation, lambda node: expression(node, scope, depth)) if found.annotation else NO_TYPE
        return Parameter(mark + found.arg, type_, None if default is None else expression(default, scope, depth))

    positional = [*arguments.posonlyargs, *arguments.args]
    missing = len(positional) - len(arguments.defaults)
    found = [
        parameter("", item, arguments.defaults[index - missing] if index >= missing else None)
        for index, item in enumerate(positional)
    ]
    if arguments.vararg:
        found.append(parameter("*", arguments.vararg, None))
    elif arguments.kwonlyargs:
        found.append(Parameter("*", NO_TYPE))
    found += [
        parameter("", item, default) for item, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True)
    ]
    if arguments.kwarg:
        found.append(parameter("**", arguments.kwarg, None))
    return tuple(found)


def this_within(scope: PythonScope, names: set[str]) -> str | None:
    """What a function inside *scope* sees of its method's first parameter, unless it rebinds the name."""
    return None if scope.this in names else scope.this


def anonymous(
    node: ast.expr, found: tuple[Parameter, ...], scope: PythonScope, body: Callable[[PythonScope], Block]
) -> Expression:
    """A function without a name that takes *found*, at the place of *node*; *body* lowers what it does."""
    file = scope.file
    index = len(file.functions)
    file.functions.append(None)
    name = qualified(scope, "<lambda>")
    names = {parameter.name.lstrip("*") for parameter in found}
    inner = PythonScope(file, "function", name, this_within(scope, names))
    line, column = place(file.source, node)
    file.functions[index] = Function(
        name, "", "lambda", found, NO_TYPE, line, column, body(inner), body_line=line, body_column=column
    )
    return syntax.Lambda(index)


def _plain_lambda(node: ast.Lambda, scope: PythonScope, depth: int) -> Expression:
    found = parameters(node.args, scope, depth)
    return anonymous(node, found, scope, lambda inner: (syntax.Return(expression(node.body, inner, depth)),))


def _comprehension(node: comprehensions.Comprehension, scope: PythonScope, depth: int) -> Expression:
    return comprehensions.comprehension(node, scope, depth)


def _constant(node: ast.Constant, scope: PythonScope, depth: int) -> Expression:
    value = node.value
    if value is None:
        return syntax.Null()
    if isinstance(value, bool):
        return syntax.Boolean(value)
    if isinstance(value, str) and (value.isascii() or not any("\ud800" <= c <= "\udfff" for c in value)):
        return syntax.String(value)
    if isinstance(value, int) and value.bit_length() <= _WIDEST_INTEGER:
        return syntax.Number(value)
    if isinstance(value, float) and math.isfinite(value):
        return syntax.Number(value)
    return unknown(scope.file.source, node)


def _name(node: ast.Name, scope: PythonScope, depth: int) -> Expression:
    return syntax.This() if node.id == scope.this else syntax.Name(node.id)


def _attribute(node: ast.Attribute, scope: PythonScope, depth: int) -> Expression:
    return syntax.Member(expression(node.value, scope, depth), node.attr)


def _subscript(node: ast.Subscript, scope: PythonScope, depth: int) -> Expression:
    return syntax.Subscript(expression(node.value, scope, depth), expression(node.slice, scope, depth))


def _slice(node: ast.Slice, scope: PythonScope, depth: int) -> Expression:
    """``a:b:c`` is ``[slice](a, b, c)``, None for what is not written."""
    parts = [
        syntax.Null() if part is None else expression(part, scope, depth)
        for part in (node.lower, node.upper, node.step)
    ]
    return syntax.Call(syntax.Name("[slice]"), tuple(parts), (), *place(scope.file.source, node))


def _set_by_name(node: ast.Call, scope: PythonScope, depth: int) -> Expression | None:
    """``setattr(a, "b", c)`` is ``a.b = c`` (docs.python.org, setattr); None for any other call."""
    if not (
        isinstance(node.func, ast.Name) and node.func.id == "setattr" and len(node.args) == 3 and not node.keywords
    ):
        return None
    name = node.args[1].value if isinstance(node.args[1], ast.Constant) else None
    if not isinstance(name, str) or not name.isidentifier():
        return None
    target = syntax.Member(expression(node.args[0], scope, depth), name)
    return syntax.Assignment("=", target, expression(node.args[2], scope, depth))


def _updated(node: ast.Call) -> ast.expr | None:
    """The object whose attributes ``x.__dict__.update(…)`` or ``vars(x).update(…)`` sets; None of any other call."""
    if not isinstance(node.func, ast.Attribute) or node.func.attr != "update":
        return None
    of = node.func.value
    if isinstance(of, ast.Attribute) and of.attr == "__dict__":
        return of.value
    is_vars = isinstance(of, ast.Call) and isinstance(of.func, ast.Name) and of.func.id == "vars"
    return of.args[0] if is_vars and isinstance(of, ast.Call) and len(of.args) == 1 and not of.keywords else None


def _call(node: ast.Call, scope: PythonScope, depth: int) -> Expression:
    written = _set_by_name(node, scope, depth)
    if written is not None:
        return written
    owner = _updated(node)
    callee = expression(node.func, scope, depth) if owner is None else syntax.Name("[update]")
    arguments = [expression(item, scope, depth) for item in (*([] if owner is None else [owner]), *node.args)]
    for keyword in written_out(node.keywords):
        value = expression(keyword.value, scope, depth)
        arguments.append(syntax.Keyword(keyword.arg, value) if keyword.arg else syntax.DoubleStar(value))
    return syntax.Call(callee, tuple(arguments), (), *place(scope.file.source, node))


def _unary(node: ast.UnaryOp, scope: PythonScope, depth: int) -> Expression:
    return syntax.Operation(_OPERATORS[type(node.op)], (expression(node.operand, scope, depth),))


def _binary(node: ast.BinOp, scope: PythonScope, depth: int) -> Expression:
    if isinstance(node.op, ast.Mod) and isinstance(node.right, (ast.List, ast.Set)):
        return unknown(scope.file.source, node)  # the whole list is formatted, where a tuple's elements are
    return syntax.Operation(
        _OPERATORS[type(node.op)],
        (expression(node.left, scope, depth), expression(node.right, scope, depth)),
    )


def _all_of(operator: str, parts: list[Expression], node: ast.expr, scope: PythonScope, depth: int) -> Expression:
    if depth + len(parts) > DEEPEST:
        too_deep(scope, node)
        return unknown(scope.file.source, node)
    joined = parts[0]
    for part in parts[1:]:
        joined = syntax.Operation(operator, (joined, part))
    return joined


def _boolean(node: ast.BoolOp, scope: PythonScope, depth: int) -> Expression:
    inner = depth + len(node.values)
    parts = [expression(value, scope, inner) for value in node.values]
    return _all_of(_OPERATORS[type(node.op)], parts, node, scope, depth)


def _compare(node: ast.Compare, scope: PythonScope, depth: int) -> Expression:
    """``a < b < c`` is ``a < b && b < c``."""
    inner = depth + len(node.ops)
    sides = [expression(side, scope, inner) for side in (node.left, *node.comparators)]
    parts: list[Expression] = [
        syntax.Operation(_OPERATORS[type(operator)], (left, right))
        for operator, left, right in zip(node.ops, sides, sides[1:], strict=False)
    ]
    return _all_of("&&", parts, node, scope, depth)


def _conditional(node: ast.IfExp, scope: PythonScope, depth: int) -> Expression:
    parts = [expression(part, scope, depth) for part in (node.test, node.body, node.orelse)]
    return syntax.Conditional(*parts)


def _list(node: ast.List | ast.Tuple | ast.Set, scope: PythonScope, depth: int) -> Expression:
    return syntax.ListLiteral(tuple([expression(item, scope, depth) for item in node.elts]))


def _dict(node: ast.Dict, scope: PythonScope, depth: int) -> Expression:
    """``**other`` in it is a starstar as key, with an unknown value."""
    pairs: list[tuple[Expression, Expression]] = []
    for key, value in zip(node.keys, node.values, strict=True):
        lowered = expression(value, scope, depth)
        pairs.append(
            (syntax.DoubleStar(lowered), unknown(scope.file.source, value))
            if key is None
            else (expression(key, scope, depth), lowered)
        )
    return syntax.DictLiteral(tuple(pairs))


def _format(node: ast.JoinedStr, scope: PythonScope, depth: int) -> Expression:
    """A part with a conversion or a format is ``"{!r:>3}".format(x)``; unknown where the format is computed."""
    parts: list[Expression] = []
    for part in node.values:
        if not isinstance(part, ast.FormattedValue):
            parts.append(expression(part, scope, depth))
            continue
        spec = _format_text(part.format_spec)
        if spec is None:
            parts.append(unknown(scope.file.source, node))
            continue
        value = expression(part.value, scope, depth)
        mark = "" if part.conversion in (-1, _STR_CONVERSION) else f"!{chr(part.conversion)}"
        if mark or spec:
            text = syntax.String(f"{{{mark}:{spec}}}")
            value = syntax.Call(syntax.Member(text, "format"), (value,), (), *place(scope.file.source, node))
        parts.append(value)
    return syntax.Format(tuple(parts))


def _format_text(node: ast.expr | None) -> str | None:
    """The format of a part of an f-string, "" without one; None if it is computed."""
    if node is None:
        return ""
    parts = node.values if isinstance(node, ast.JoinedStr) else [node]
    texts = [part.value for part in parts if isinstance(part, ast.Constant) and isinstance(part.value, str)]
    text = "".join(texts)
    return text if len(texts) == len(parts) and text.isascii() and not set("{}") & set(text) else None


def _walrus(node: ast.NamedExpr, scope: PythonScope, depth: int) -> Expression:
    scope.file.rebound.add(node.target.id)
    return syntax.Assignment("=", expression(node.target, scope, depth), expression(node.value, scope, depth))


def _starred(node: ast.Starred, scope: PythonScope, depth: int) -> Expression:
    return syntax.Star(expression(node.value, scope, depth))


def _inner(node: ast.Await | ast.Yield | ast.YieldFrom, scope: PythonScope, depth: int) -> Expression:
    return syntax.Null() if node.value is None else expression(node.value, scope, depth)


def _on(kind: type[_Kind], lower: Callable[[_Kind, PythonScope, int], Expression]) -> tuple[type[ast.AST], _Lower]:
    """*lower* for expressions of *kind*, and for no others."""
    return kind, cast("_Lower", lower)


_LOWERED: dict[type[ast.AST], _Lower] = dict(
    (
        _on(ast.Constant, _constant),
        _on(ast.Name, _name),
        _on(ast.Attribute, _attribute),
        _on(ast.Subscript, _subscript),
        _on(ast.Call, _call),
        _on(ast.UnaryOp, _unary),
        _on(ast.BinOp, _binary),
        _on(ast.BoolOp, _boolean),
        _on(ast.Compare, _compare),
        _on(ast.IfExp, _conditional),
        _on(ast.List, _list),
        _on(ast.Tuple, _list),
        _on(ast.Set, _list),
        _on(ast.Dict, _dict),
        _on(ast.JoinedStr, _format),
        _on(ast.NamedExpr, _walrus),
        _on(ast.Starred, _starred),
        _on(ast.Lambda, _plain_lambda),
        _on(ast.ListComp, _comprehension),
        _on(ast.SetComp, _comprehension),
        _on(ast.GeneratorExp, _comprehension),
        _on(ast.DictComp, _comprehension),
        _on(ast.Slice, _slice),
        _on(ast.Await, _inner),
        _on(ast.Yield, _inner),
        _on(ast.YieldFrom, _inner),
    )
)
