# SPDX-License-Identifier: Apache-2.0
"""The value of an expression of a launch file."""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import Any

from haros_ci.launch.python.comprehensions import comprehension
from haros_ci.launch.python.forks import fork
from haros_ci.launch.python.formats import formatted_value
from haros_ci.launch.python.heap import DEPTH, either
from haros_ci.launch.python.operators import binary, compare, unary
from haros_ci.launch.python.run import ScriptEvaluation, condition
from haros_ci.launch.python.sequences import items_of
from haros_ci.launch.python.subscripts import subscript
from haros_ci.launch.python.truth import truth
from haros_ci.launch.python.values import (
    Library,
    LibraryCall,
    Rest,
    ScriptFunction,
    ScriptScope,
    Unknown,
    Value,
    merged,
    phrase,
    present,
    text_of,
)


def evaluate(run: ScriptEvaluation, scope: ScriptScope, node: ast.expr) -> Value:
    """The value of *node*; an expression that is not supported, or too deep, is Unknown."""
    budget = run.budget
    budget.step()
    handler = HANDLERS.get(type(node))
    place = scope.source.place
    if handler is None:
        return run.unknown(f"{type(node).__name__} is not supported here", place(node))
    if budget.depth >= DEPTH:
        return run.unknown("it is nested too deep", place(node))
    budget.depth += 1
    try:
        return handler(run, scope, node)
    except (TypeError, ValueError, KeyError, IndexError, AttributeError, ArithmeticError) as error:
        return run.unknown(f"it raises {type(error).__name__}", place(node))
    finally:
        budget.depth -= 1


def constant(run: ScriptEvaluation, scope: ScriptScope, node: ast.Constant) -> Value:
    return run.made(node.value, scope.source.place(node))


def name(run: ScriptEvaluation, scope: ScriptScope, node: ast.Name) -> Value:
    return look_up(run, scope, node.id, node)


def look_up(run: ScriptEvaluation, scope: ScriptScope, word: str, node: ast.AST) -> Value:
    """The value of a variable, of a star import or of a builtin."""
    here: ScriptScope | None = scope.outer_names.get(word, scope)
    while here is not None:
        if word in here.variables and (here is scope or not here.is_class):
            return present(here.variables[word])
        here = here.parent
    for library in scope.module.variables.get("*", ()):
        if run.known(f"{library}.{word}"):
            return Library(f"{library}.{word}")
    if word in BUILTIN_NAMES:
        return Library(f"builtins.{word}")
    return run.unknown(f"`{word}` has no value here", scope.source.place(node))


BUILTIN_NAMES = frozenset(
    """__import__ abs all any bool bytes callable chr classmethod dict dir divmod enumerate eval exec filter float format frozenset
    getattr globals hasattr hash id input int isinstance issubclass iter len list locals map max min next object open
    ord pow print property range repr reversed round set setattr sorted staticmethod str sum super tuple type vars zip
    Exception ValueError KeyError TypeError RuntimeError FileNotFoundError OSError EnvironmentError IndexError
    AttributeError NotImplementedError ImportError IOError AssertionError StopIteration SystemExit""".split()
)


def attribute(run: ScriptEvaluation, scope: ScriptScope, node: ast.Attribute) -> Value:
    return run.attribute(run, evaluate(run, scope, node.value), node.attr, scope.source.place(node))


def call(run: ScriptEvaluation, scope: ScriptScope, node: ast.Call) -> Value:
    """A call; ``super()`` is that of the class around the function."""
    place = scope.source.place(node)
    if isinstance(node.func, ast.Name) and node.func.id == "super" and not node.args:
        return run.call(
            run,
            Library("builtins.super"),
            LibraryCall(
                name="super",
                location=place,
                keywords={},
                args=(scope.variables.get("__class__"), next(iter(scope.variables.values()), None)),
            ),
        )
    function = evaluate(run, scope, node.func)
    args, unknown = spread(run, scope, node.args)
    keywords: dict[str, Value] = {}
    for keyword in node.keywords:
        value = evaluate(run, scope, keyword.value)
        if keyword.arg is not None:
            keywords[keyword.arg] = value
        elif isinstance(value, dict) and not any(isinstance(key, Rest) for key in value):
            keywords.update({key: item for key, item in value.items() if isinstance(key, str)})
        else:
            unknown = "arguments given by ** are not known"
    text = (
        scope.source.segment(node) if isinstance(function, Library) and "condition" in function.dotted.lower() else ""
    )
    return run.call(
        run,
        function,
        LibraryCall(
            name=scope.source.segment(node.func)[:80] if not isinstance(function, Library) else function.dotted,
            location=place,
            args=tuple(args),
            keywords=keywords,
            unknown=unknown,
            text=text,
        ),
    )


def spread(run: ScriptEvaluation, scope: ScriptScope, nodes: list[ast.expr]) -> tuple[list[Value], str]:
    """The values of *nodes*, with starred ones in their place; and why there may be others."""
    result: list[Value] = []
    unknown = ""
    for node in nodes:
        if isinstance(node, ast.Starred):
            items = items_of(run, evaluate(run, scope, node.value), scope.source.place(node))
            if isinstance(items, Unknown):
                result.append(Rest(items.reason, items.location))
                unknown = items.reason
            else:
                result.extend(items)
        else:
            result.append(evaluate(run, scope, node))
    return result, unknown


def sequence(run: ScriptEvaluation, scope: ScriptScope, node: ast.List | ast.Tuple | ast.Set) -> Value:
    place = scope.source.place(node)
    items, _ = spread(run, scope, node.elts)
    if isinstance(node, ast.Set):
        return run.made(set(items), place)
    value = run.made(items if isinstance(node, ast.List) else tuple(items), place)
    if len(items) == 2:
        run.places[id(value)] = (value, place)
    return value


def dictionary(run: ScriptEvaluation, scope: ScriptScope, node: ast.Dict) -> Value:
    result: dict[Any, Value] = {}
    place = scope.source.place(node)
    for key, item in zip(node.keys, node.values, strict=True):
        value = evaluate(run, scope, item)
        if key is None:
            if isinstance(value, dict):
                result.update(value)
            else:
                lost = Rest(value.reason if isinstance(value, Unknown) else "not a dictionary", place)
                result[lost] = lost
            continue
        made = evaluate(run, scope, key)
        if isinstance(made, Unknown):
            lost = Rest(made.reason, made.location)
            result = {known: Unknown(made.reason, made.location) for known in result}
            result[lost] = lost
        else:
            result[made] = value
    run.places[id(result)] = (result, place)
    return run.made(result, place)


def operation(run: ScriptEvaluation, scope: ScriptScope, node: ast.BinOp) -> Value:
    """``a + b + c …``: chains are followed without depth."""
    chain: list[ast.BinOp] = []
    first: ast.expr = node
    while isinstance(first, ast.BinOp):
        chain.append(first)
        first = first.left
    value = evaluate(run, scope, first)
    for step in reversed(chain):
        run.budget.step()
        value = binary(run, step.op, value, evaluate(run, scope, step.right), scope.source.place(step))
    return value


def augmented(run: ScriptEvaluation, scope: ScriptScope, node: ast.AugAssign, old: Value) -> Value:
    """The new value of ``x += y``; a list is extended in place."""
    value = evaluate(run, scope, node.value)
    if isinstance(node.op, ast.Add) and isinstance(old, list):
        items = items_of(run, value, scope.source.place(node))
        run.heap.touch(old)
        old.extend([Rest(items.reason, items.location)] if isinstance(items, Unknown) else items)
        return run.made(old, scope.source.place(node))
    return binary(run, node.op, old, value, scope.source.place(node))


def negation(run: ScriptEvaluation, scope: ScriptScope, node: ast.UnaryOp) -> Value:
    return unary(run, node.op, evaluate(run, scope, node.operand), scope.source.place(node))


def logic(run: ScriptEvaluation, scope: ScriptScope, node: ast.BoolOp) -> Value:
    """``and``/``or``: what decides it, if what stands before is known."""
    stop = isinstance(node.op, ast.Or)
    value: Value = None
    doubt: Unknown | None = None
    for item in node.values:
        value = evaluate(run, scope, item)
        known = truth(run, value)
        if isinstance(known, Unknown):
            doubt = doubt or known
        elif known is stop:
            return value if doubt is None else (stop if isinstance(value, bool) else doubt)
    return value if doubt is None else doubt


def comparison(run: ScriptEvaluation, scope: ScriptScope, node: ast.Compare) -> Value:
    left = evaluate(run, scope, node.left)
    result: Value = True
    for op, right_node in zip(node.ops, node.comparators, strict=True):
        right = evaluate(run, scope, right_node)
        result = compare(run, op, left, right, scope.source.place(node))
        if isinstance(result, Unknown) or result is False:
            return result
        left = right
    return result


def ternary(run: ScriptEvaluation, scope: ScriptScope, node: ast.IfExp) -> Value:
    test = evaluate(run, scope, node.test)
    known = truth(run, test)
    if not isinstance(known, Unknown):
        return evaluate(run, scope, node.body if known else node.orelse)
    tests = condition(scope, node.test, known)
    one, other = fork(run, tests, lambda: evaluate(run, scope, node.body), lambda: evaluate(run, scope, node.orelse))
    return either(one, other, tests)


def interpolated(run: ScriptEvaluation, scope: ScriptScope, node: ast.JoinedStr) -> Value:
    parts: list[Any] = []
    for item in node.values:
        if isinstance(item, ast.FormattedValue):
            spec = "" if item.format_spec is None else evaluate(run, scope, item.format_spec)
            value = evaluate(run, scope, item.value)
            done = formatted_value(
                run, value, chr(item.conversion) if item.conversion > 0 else "", spec, scope.source.place(item)
            )
            parts.extend(phrase(done))
        else:
            parts.extend(phrase(evaluate(run, scope, item)))
    return run.made(text_of(merged(parts)), scope.source.place(node))


def indexed(run: ScriptEvaluation, scope: ScriptScope, node: ast.Subscript) -> Value:
    value = evaluate(run, scope, node.value)
    if isinstance(node.slice, ast.Slice):
        parts = [
            None if part is None else evaluate(run, scope, part)
            for part in (node.slice.lower, node.slice.upper, node.slice.step)
        ]
        key: Value = next((part for part in parts if isinstance(part, Unknown)), None) or slice(*parts)
    else:
        key = evaluate(run, scope, node.slice)
    return subscript(run, value, key, scope.source.place(node))


def lambda_(run: ScriptEvaluation, scope: ScriptScope, node: ast.Lambda) -> Value:
    defaults = tuple(evaluate(run, scope, item) for item in node.args.defaults)
    named = tuple(None if item is None else evaluate(run, scope, item) for item in node.args.kw_defaults)
    return ScriptFunction("lambda", node, scope, defaults, named)


def walrus(run: ScriptEvaluation, scope: ScriptScope, node: ast.NamedExpr) -> Value:
    value = evaluate(run, scope, node.value)
    run.heap.touch(scope.variables)
    scope.variables[node.target.id] = value
    return value


def yielded(run: ScriptEvaluation, scope: ScriptScope, node: ast.Yield | ast.YieldFrom) -> Value:
    frame = run.frames[-1] if run.frames else None
    value = None if node.value is None else evaluate(run, scope, node.value)
    if frame is None or frame.yields is None:
        return run.unknown("`yield` outside a function", scope.source.place(node))
    run.heap.touch(frame.yields)
    if isinstance(node, ast.YieldFrom):
        items = items_of(run, value, scope.source.place(node))
        frame.yields.extend([Rest(items.reason, items.location)] if isinstance(items, Unknown) else items)
    else:
        frame.yields.append(value)
    return run.unknown("what a generator is sent is not known", scope.source.place(node))


HANDLERS: dict[type, Callable[[ScriptEvaluation, ScriptScope, Any], Value]] = {
    ast.Constant: constant,
    ast.Name: name,
    ast.Attribute: attribute,
    ast.Call: call,
    ast.List: sequence,
    ast.Tuple: sequence,
    ast.Set: sequence,
    ast.Dict: dictionary,
    ast.BinOp: operation,
    ast.UnaryOp: negation,
    ast.BoolOp: logic,
    ast.Compare: comparison,
    ast.IfExp: ternary,
    ast.JoinedStr: interpolated,
    ast.Subscript: indexed,
    ast.Lambda: lambda_,
    ast.NamedExpr: walrus,
    ast.ListComp: comprehension,
    ast.SetComp: comprehension,
    ast.GeneratorExp: comprehension,
    ast.DictComp: comprehension,
    ast.Yield: yielded,
    ast.YieldFrom: yielded,
}
