# SPDX-License-Identifier: Apache-2.0
"""Python statements in the little language of ``haros_ci.syntax``."""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import Any, TypeVar, cast

from haros_ci import syntax
from haros_ci.extract.python.annotations import NO_TYPE
from haros_ci.extract.python.blocks import (
    Tried,
    bound_again,
    done_before_leaving,
    left_by_finally,
    may_enter,
    of_manager,
    suppressed_by,
)
from haros_ci.extract.python.definitions import annotation, define_class, define_function
from haros_ci.extract.python.expressions import expression, operator_text
from haros_ci.extract.python.imports import imported
from haros_ci.extract.python.scope import DEEPEST, PythonScope, bind, conditionally, rebind, too_deep
from haros_ci.extract.python.source import column, condition, place, unknown
from haros_ci.regex import regex
from haros_ci.syntax import Alias, Block, Expression, Statement

_ELSE = regex(r"[ \t\f]*(else)\b")
_LEAVES = (syntax.Break, syntax.Continue, syntax.Return, syntax.Throw)
_Kind = TypeVar("_Kind", bound=ast.stmt)
_Lower = Callable[[ast.stmt, PythonScope, int], Block]


def block(nodes: list[ast.stmt], scope: PythonScope, depth: int) -> Block:
    """Lower statements one after the other; what lies too deep is unknown."""
    if depth > DEEPEST and nodes:
        too_deep(scope, nodes[0])
        return tuple([syntax.Do(unknown(scope.file.source, node)) for node in nodes])
    lowered: list[Statement] = []
    for node in nodes:
        lower = _LOWERED.get(type(node))
        if lower:
            lowered.extend(lower(node, scope, depth + 1))
        else:
            lowered.append(syntax.Do(unknown(scope.file.source, node)))
    return tuple(lowered)


def _nothing(node: ast.stmt, scope: PythonScope, depth: int) -> Block:
    return ()


def _globals(node: ast.Global, scope: PythonScope, depth: int) -> Block:
    scope.file.rebound.update(node.names)
    return (syntax.Global(tuple(node.names)),)


def _nonlocals(node: ast.Nonlocal, scope: PythonScope, depth: int) -> Block:
    return (syntax.Nonlocal(tuple(node.names)),)


def _plain(node: ast.Expr, scope: PythonScope, depth: int) -> Block:
    """Docstrings and other literals that stand alone say nothing."""
    return () if isinstance(node.value, ast.Constant) else (syntax.Do(expression(node.value, scope, depth)),)


def _bind(
    target: ast.expr, value: ast.expr | None, lowered: Expression | None, scope: PythonScope, node: ast.stmt
) -> None:
    """Note what an assignment, loop or import binds in a module or class; *lowered* None for an unknown value."""
    if scope.bindings is None:
        return
    known = unknown(scope.file.source, node) if lowered is None else lowered
    if isinstance(target, ast.Name):
        bind(scope, target.id, NO_TYPE, known, node, place(scope.file.source, target))
    elif isinstance(target, ast.Starred):
        _bind(target.value, None, None, scope, node)
    elif isinstance(target, (ast.Tuple, ast.List)):
        items: list[Expression | None] = [None] * len(target.elts)
        if isinstance(value, (ast.Tuple, ast.List)) and lowered is not None and len(value.elts) == len(items):
            stars = any(isinstance(item, ast.Starred) for item in (*value.elts, *target.elts))
            items = items if stars else list(lowered.items) if isinstance(lowered, syntax.ListLiteral) else items
        for inner, item in zip(target.elts, items, strict=True):
            _bind(inner, None, item, scope, node)


def _assign(node: ast.Assign, scope: PythonScope, depth: int) -> Block:
    if depth + len(node.targets) > DEEPEST:
        too_deep(scope, node)
        return (syntax.Do(unknown(scope.file.source, node)),)
    value = expression(node.value, scope, depth)
    for target in node.targets:
        _bind(target, node.value, value, scope, node)
    for target in reversed(node.targets):
        value = syntax.Assignment("=", expression(target, scope, depth), value)
    return (syntax.Do(value),)


def _annotated(node: ast.AnnAssign, scope: PythonScope, depth: int) -> Block:
    value = None if node.value is None else expression(node.value, scope, depth)
    if isinstance(node.target, ast.Name):
        where = place(scope.file.source, node.target)
        type_ = annotation(node.annotation, scope, depth)
        bind(scope, node.target.id, type_, value, node, where)
        return (syntax.Variable(node.target.id, type_, None if value is None else syntax.Equals(value), *where),)
    return () if value is None else (syntax.Do(syntax.Assignment("=", expression(node.target, scope, depth), value)),)


def _augmented(node: ast.AugAssign, scope: PythonScope, depth: int) -> Block:
    _bind(node.target, None, None, scope, node)
    if isinstance(node.target, ast.Name):
        rebind(scope, node.target.id)
    target, value = expression(node.target, scope, depth), expression(node.value, scope, depth)
    return (syntax.Do(syntax.Assignment(operator_text(node.op) + "=", target, value)),)


def _delete(node: ast.Delete, scope: PythonScope, depth: int) -> Block:
    rebind(scope, *(target.id for target in node.targets if isinstance(target, ast.Name)))
    return (syntax.Do(unknown(scope.file.source, node)),)


def _assert(node: ast.Assert, scope: PythonScope, depth: int) -> Block:
    return (syntax.Do(expression(node.test, scope, depth)),)


def _if(node: ast.If, scope: PythonScope, depth: int) -> Block:
    source = scope.file.source
    inner = conditionally(scope)
    test = expression(node.test, scope, depth)
    body, other = block(node.body, inner, depth), block(node.orelse, inner, depth)
    text = condition(source, node.test, node.test)
    where = _else(node.body, node.orelse, scope)
    return (syntax.If(*place(source, node), text, test, body, *where, other),)


def _else(body: list[ast.stmt], orelse: list[ast.stmt], scope: PythonScope) -> tuple[int, int]:
    """Where ``else`` or ``elif`` stands: ast places only an elif; between it and the body are no other statements."""
    if not orelse:
        return (0, 0)
    source, first = scope.file.source, orelse[0]
    for line in range((body[-1].end_lineno or 0) + 1, first.lineno + 1):
        if found := _ELSE.match(source.parsed[line - 1]):
            return line, column(source, line, len(source.parsed[line - 1][: found.start(1)].encode())) + 1
    return place(source, first)


def _while(node: ast.While, scope: PythonScope, depth: int) -> Block:
    source = scope.file.source
    test = expression(node.test, scope, depth)
    body = block(node.body, conditionally(scope), depth)
    text = condition(source, node.test, node.test)
    return (syntax.Loop("while", *place(source, node), text, (), test, body), *_after_loop(node, scope, depth))


def _for(node: ast.For | ast.AsyncFor, scope: PythonScope, depth: int) -> Block:
    """The first statement of the body assigns the parts of a pattern from the nameless item."""
    source = scope.file.source
    inner = conditionally(scope)
    items = expression(node.iter, scope, depth)
    _bind(node.target, None, None, inner, node)
    target = expression(node.target, scope, depth)
    body = block(node.body, inner, depth)
    name = target.name if isinstance(target, syntax.Name) else ""
    if not name:
        body = (syntax.Do(syntax.Assignment("=", target, syntax.Name(""))), *body)
    text = condition(source, node.target, node.iter)
    item = syntax.Each(*place(source, node), text, name, NO_TYPE, items, body)
    return (item, *_after_loop(node, scope, depth))


def _after_loop(node: ast.For | ast.AsyncFor | ast.While, scope: PythonScope, depth: int) -> Block:
    """A loop's else runs unless the loop was left by break: then it hangs on a condition nobody wrote."""
    if not node.orelse:
        return ()
    if not any(isinstance(part, ast.Break) for statement in node.body for part in ast.walk(statement)):
        return block(node.orelse, scope, depth)
    body = block(node.orelse, conditionally(scope), depth)
    return (syntax.If(*_else(node.body, node.orelse, scope), "else", syntax.Unknown("else"), body, 0, 0, ()),)


def _with(node: ast.With | ast.AsyncWith, scope: PythonScope, depth: int) -> Block:
    """The body follows in the same block: Python has no scope there."""
    entered: list[Statement] = []
    left: list[Statement] = []
    for item in node.items:
        call = expression(item.context_expr, scope, depth)
        at, name = place(scope.file.source, item.context_expr), item.optional_vars
        enters = may_enter(item.context_expr)
        if name is None:
            entered.append(syntax.Do(of_manager(call, "__enter__", at) if enters else call))
        else:
            _bind(name, None, None, scope, node)
            target = expression(name, scope, depth)
            entered.append(syntax.Do(syntax.Assignment("=", target, call)))
            if enters and isinstance(name, ast.Name):
                entered.append(syntax.Do(syntax.Assignment("=", target, of_manager(target, "__enter__", at))))
        manager = item.context_expr if name is None else name
        if enters and isinstance(manager, (ast.Name, ast.Attribute)):
            left.append(syntax.Do(of_manager(expression(manager, scope, depth), "__exit__", at)))
    suppressed = next((made for item in node.items if (made := suppressed_by(item.context_expr)) is not None), None)
    if suppressed is None:
        return (*entered, *block(node.body, scope, depth), *left)
    text = " ".join(ast.unparse(argument) for argument in suppressed.args)
    handler = syntax.Handler(*place(scope.file.source, node), text, "", NO_TYPE, ())
    return (*entered, syntax.Try(block(node.body, conditionally(scope), depth), (handler,)))


def _try(node: Tried, scope: PythonScope, depth: int) -> Block:
    """What else says belongs to the tried block, what finally says comes after all of it."""
    left = left_by_finally(node)
    if left is not None:
        anything = syntax.Handler(*place(scope.file.source, node.finalbody[0]), "", "", NO_TYPE, ())
        return (syntax.Try(_try(left, scope, depth), (anything,)), *block(node.finalbody, scope, depth))
    node = done_before_leaving(node) or node
    inner = conditionally(scope)
    tried = bound_again(node, scope) + block(node.body, inner, depth) + block(node.orelse, inner, depth)
    handlers = tuple([_handler(handler, inner, depth) for handler in node.handlers])
    return (syntax.Try(tried, handlers), *block(node.finalbody, scope, depth))


def _handler(node: ast.ExceptHandler, scope: PythonScope, depth: int) -> syntax.Handler:
    text = condition(scope.file.source, node.type, node.type) if node.type else ""
    if node.name:
        text = f"{text} as {node.name}"
        rebind(scope, node.name)
    type_ = annotation(node.type, scope, depth)
    return syntax.Handler(*place(scope.file.source, node), text, node.name or "", type_, block(node.body, scope, depth))


def _match(node: ast.Match, scope: PythonScope, depth: int) -> Block:
    """Alternatives are cases that fall through; a pattern that is no value, or has a guard, is unknown text."""
    source = scope.file.source
    inner = conditionally(scope)
    cases: list[syntax.Case] = []
    for case in node.cases:
        body = _captured(case.pattern, scope) + block(case.body, inner, depth)
        if not body or not isinstance(body[-1], _LEAVES):
            body = (*body, syntax.Break())
        patterns = case.pattern.patterns if isinstance(case.pattern, ast.MatchOr) else [case.pattern]
        values = [_pattern(pattern, scope, depth) for pattern in patterns]
        if case.guard is not None:
            values = [syntax.Unknown(condition(source, case.pattern, case.guard)[:200])]
        cases += [syntax.Case(value, ()) for value in values[:-1]]
        cases.append(syntax.Case(values[-1], body))
    text = condition(source, node.subject, node.subject)
    return (syntax.Switch(*place(source, node), text, expression(node.subject, scope, depth), tuple(cases)),)


def _captured(pattern: ast.pattern, scope: PythonScope) -> Block:
    """Names that a pattern binds have unknown values."""
    names = [getattr(part, "name", None) or getattr(part, "rest", None) for part in ast.walk(pattern)]
    found = sorted({name for name in names if name})
    rebind(scope, *found)
    value = unknown(scope.file.source, pattern)
    return tuple([syntax.Do(syntax.Assignment("=", syntax.Name(name), value)) for name in found])


def _pattern(pattern: ast.pattern, scope: PythonScope, depth: int) -> Expression | None:
    if isinstance(pattern, ast.MatchValue):
        return expression(pattern.value, scope, depth)
    if isinstance(pattern, ast.MatchSingleton):
        return syntax.Null() if pattern.value is None else syntax.Boolean(pattern.value)
    if isinstance(pattern, ast.MatchAs) and pattern.pattern is None and pattern.name is None:
        return None
    return unknown(scope.file.source, pattern)


def _return(node: ast.Return, scope: PythonScope, depth: int) -> Block:
    return (syntax.Return(None if node.value is None else expression(node.value, scope, depth)),)


def _raise(node: ast.Raise, scope: PythonScope, depth: int) -> Block:
    return (syntax.Throw(None if node.exc is None else expression(node.exc, scope, depth)),)


def _function(node: ast.FunctionDef | ast.AsyncFunctionDef, scope: PythonScope, depth: int) -> Block:
    rebind(scope, node.name)
    index = define_function(node, scope, depth, block)
    return (syntax.NestedFunction(node.name, index),) if scope.kind == "function" else ()


def _class(node: ast.ClassDef, scope: PythonScope, depth: int) -> Block:
    rebind(scope, node.name)
    name, calls = define_class(node, scope, depth, block)
    return (syntax.NestedClass(name), *calls) if scope.kind != "class" else ()


def _import(node: ast.Import | ast.ImportFrom, scope: PythonScope, depth: int) -> Block:
    found = imported(node)
    rebind(scope, *(name for name, _ in found))
    if scope.kind == "module":
        scope.file.aliases.update({Alias(name, syntax.Type(target)): None for name, target in found})
        return ()
    return tuple([syntax.Import(name, target) for name, target in found])


def _type_alias(node: Any, scope: PythonScope, depth: int) -> Block:
    if scope.kind == "module":
        scope.file.aliases[Alias(node.name.id, annotation(node.value, scope, depth))] = None
    return ()


def _on(kind: type[_Kind], lower: Callable[[_Kind, PythonScope, int], Block]) -> tuple[type[ast.AST], _Lower]:
    """*lower* for statements of *kind*, and for no others."""
    return kind, cast("_Lower", lower)


_LOWERED: dict[type[ast.AST], _Lower] = dict(
    (
        _on(ast.Expr, _plain),
        _on(ast.Assign, _assign),
        _on(ast.AnnAssign, _annotated),
        _on(ast.AugAssign, _augmented),
        _on(ast.Delete, _delete),
        _on(ast.Assert, _assert),
        _on(ast.If, _if),
        _on(ast.While, _while),
        _on(ast.For, _for),
        _on(ast.AsyncFor, _for),
        _on(ast.With, _with),
        _on(ast.AsyncWith, _with),
        _on(ast.Try, _try),
        _on(ast.Match, _match),
        _on(ast.Return, _return),
        _on(ast.Raise, _raise),
        _on(ast.Break, lambda node, scope, depth: (syntax.Break(),)),
        _on(ast.Continue, lambda node, scope, depth: (syntax.Continue(),)),
        _on(ast.Pass, _nothing),
        _on(ast.Global, _globals),
        _on(ast.Nonlocal, _nonlocals),
        _on(ast.FunctionDef, _function),
        _on(ast.AsyncFunctionDef, _function),
        _on(ast.ClassDef, _class),
        _on(ast.Import, _import),
        _on(ast.ImportFrom, _import),
    )
)
if hasattr(ast, "TryStar"):  # from Python 3.11
    _LOWERED.update((_on(ast.TryStar, _try),))
if hasattr(ast, "TypeAlias"):  # from Python 3.12
    _LOWERED.update((_on(ast.TypeAlias, _type_alias),))
