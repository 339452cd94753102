# SPDX-License-Identifier: Apache-2.0
"""Statements of a launch file, one after the other."""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import Any

from haros_ci.launch.python.assignments import assign, delete, set_name
from haros_ci.launch.python.definitions import class_definition, function_definition
from haros_ci.launch.python.expressions import augmented, evaluate
from haros_ci.launch.python.expressions import name as variable
from haros_ci.launch.python.flows import Flow, ways
from haros_ci.launch.python.forks import settle
from haros_ci.launch.python.heap import DEPTH, LOOP
from haros_ci.launch.python.imports import import_from, import_names
from haros_ci.launch.python.matches import match
from haros_ci.launch.python.module_files import is_search_path, search_also
from haros_ci.launch.python.run import ScriptEvaluation, condition
from haros_ci.launch.python.sequences import items_of
from haros_ci.launch.python.truth import truth
from haros_ci.launch.python.values import Maybe, Rest, ScriptScope, Unknown, Value, why
from haros_ci.model.launch_actions import Test


def block(run: ScriptEvaluation, scope: ScriptScope, nodes: list[ast.stmt]) -> Flow | None:
    """Do the statements *nodes*; None if the last of them came to its end."""
    for node in nodes:
        flow = statement(run, scope, node)
        if flow is not None:
            return flow
    return None


def statement(run: ScriptEvaluation, scope: ScriptScope, node: ast.stmt) -> Flow | None:
    budget = run.budget
    budget.step()
    handler = HANDLERS.get(type(node))
    if handler is None:
        return None
    if budget.depth >= DEPTH:
        run.unknown("it is nested too deep", scope.source.place(node))
        return None
    budget.depth += 1
    try:
        done: Flow | None = handler(run, scope, node)
        return done
    finally:
        budget.depth -= 1


def expression(run: ScriptEvaluation, scope: ScriptScope, node: ast.Expr) -> None:
    evaluate(run, scope, node.value)


def assignment(run: ScriptEvaluation, scope: ScriptScope, node: ast.Assign) -> None:
    value = evaluate(run, scope, node.value)
    for target in node.targets:
        assign(run, scope, target, value)


def annotated(run: ScriptEvaluation, scope: ScriptScope, node: ast.AnnAssign) -> None:
    if node.value is not None:
        assign(run, scope, node.target, evaluate(run, scope, node.value))


def changed(run: ScriptEvaluation, scope: ScriptScope, node: ast.AugAssign) -> None:
    old = variable(run, scope, node.target) if isinstance(node.target, ast.Name) else evaluate(run, scope, node.target)
    if is_search_path(old) and isinstance(node.op, ast.Add):
        search_also(run, evaluate(run, scope, node.value), scope.source.place(node))
        return
    assign(run, scope, node.target, augmented(run, scope, node, old))


def returned(run: ScriptEvaluation, scope: ScriptScope, node: ast.Return) -> Flow:
    return Flow("return", None if node.value is None else evaluate(run, scope, node.value))


def deletion(run: ScriptEvaluation, scope: ScriptScope, node: ast.Delete) -> None:
    for target in node.targets:
        delete(run, scope, target)


def outer(run: ScriptEvaluation, scope: ScriptScope, node: ast.Global | ast.Nonlocal) -> None:
    for word in node.names:
        home = scope.module
        if isinstance(node, ast.Nonlocal):
            here = scope.parent
            while here is not None and word not in here.variables:
                here = here.parent
            home = here or scope
        scope.outer_names[word] = home


def branch(run: ScriptEvaluation, scope: ScriptScope, node: ast.If) -> Flow | None:
    value = evaluate(run, scope, node.test)
    known = truth(run, value)
    if not isinstance(known, Unknown):
        return block(run, scope, node.body if known else node.orelse)
    tests = condition(scope, node.test, known)
    return ways(run, scope, tests, lambda: block(run, scope, node.body), lambda: block(run, scope, node.orelse))


def loop(run: ScriptEvaluation, scope: ScriptScope, node: ast.For) -> Flow | None:
    """``for``: a turn for each item; items that are not known are one turn under a test."""
    items = items_of(run, evaluate(run, scope, node.iter), scope.source.place(node.iter))
    if isinstance(items, Unknown):
        items = [Rest(items.reason, items.location)]
    if len(items) > LOOP:
        items = [Rest("the loop is too long", scope.source.place(node))]
    mark = (len(run.frames[-1].pending), len(run.frames[-1].returns))
    flow: Flow | None = None
    for item in items:
        run.budget.step()
        flow = turn(run, scope, node, item)
        if flow is not None and flow.kind != "continue":
            break
    finish(run, mark, flow)
    if flow is None or flow.kind == "continue":
        return block(run, scope, node.orelse)
    return None if flow.kind == "break" else flow


def turn(run: ScriptEvaluation, scope: ScriptScope, node: ast.For, item: Value) -> Flow | None:
    if not isinstance(item, (Maybe, Rest)):
        assign(run, scope, node.target, item)
        return block(run, scope, node.body)

    def body() -> Flow | None:
        if isinstance(item, Rest):
            forget(run, scope, node, why(item))
        assign(run, scope, node.target, item.value if isinstance(item, Maybe) else Unknown(item.reason, item.location))
        return block(run, scope, node.body)

    if isinstance(item, Maybe) and len(item.tests) == 1:
        test = item.tests[0]
        away = Test(kind="?", text=f"not ({test.text})", location=test.location, reason=test.reason)
        tests = (test, away)
    else:
        tests = condition(scope, node.iter, Unknown(why(item), getattr(item, "location", None)), "for each of")
    return ways(run, scope, tests, body, lambda: None)


def forget(run: ScriptEvaluation, scope: ScriptScope, node: ast.For | ast.While, reason: str) -> None:
    """The variables that the loop sets may have any value of an earlier turn."""
    for item in node.body:
        for part in ast.walk(item):
            run.budget.step()
            if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store) and part.id in scope.variables:
                set_name(run, scope, part.id, Unknown(reason, scope.source.place(node)))


def repeat(run: ScriptEvaluation, scope: ScriptScope, node: ast.While) -> Flow | None:
    """``while``: as long as the condition is known; then one turn under a test."""
    mark = (len(run.frames[-1].pending), len(run.frames[-1].returns))
    for _ in range(LOOP):
        run.budget.step()
        known = truth(run, evaluate(run, scope, node.test))
        if isinstance(known, Unknown):
            break
        if not known:
            return finish(run, mark, block(run, scope, node.orelse))
        flow = block(run, scope, node.body)
        if flow is not None and flow.kind == "break":
            return finish(run, mark, None)
        if flow is not None and flow.kind != "continue":
            return flow
    else:
        known = Unknown("the loop is too long", scope.source.place(node))
    tests = condition(scope, node.test, known, "while")

    def body() -> Flow | None:
        forget(run, scope, node, why(known))
        return block(run, scope, node.body)

    return finish(run, mark, ways(run, scope, tests, body, lambda: None))


def finish(run: ScriptEvaluation, mark: tuple[int, int], flow: Flow | None) -> Flow | None:
    """The end of a loop: what was under the test of a ``break`` is so no more; after a ``return`` it stays."""
    frame = run.frames[-1]
    if len(frame.returns) == mark[1] and (flow is None or flow.kind != "return"):
        settle(run, frame, mark[0])
    return None if flow is not None and flow.kind in ("break", "continue") else flow


def attempt(run: ScriptEvaluation, scope: ScriptScope, node: Any) -> Flow | None:
    """``try``: its body; a handler is another way if something in the body is not known, and follows a ``raise``."""
    before = run.budget.failures
    place = scope.source.place(node)
    test = Test(kind="?", text="try", location=place, reason="whether the body of `try` fails is not known")
    away = Test(kind="?", text="except", location=place, reason=test.reason)
    caught: list[Flow | None] = []

    def body() -> Flow | None:
        flow = block(run, scope, node.body)
        caught.append(flow)
        return flow

    def handler() -> Flow | None:
        flow = caught[0] if caught else None
        failed = flow is not None and flow.kind == "raise"
        if not node.handlers or not (failed or run.budget.failures > before):
            return Flow("raise")
        first = node.handlers[0]
        if first.name:
            set_name(run, scope, first.name, run.unknown("an exception", place))
        return block(run, scope, first.body)

    flow = ways(run, scope, (test, away), body, handler)
    if flow is None:
        flow = block(run, scope, node.orelse)
    return block(run, scope, node.finalbody) or flow


def with_(run: ScriptEvaluation, scope: ScriptScope, node: ast.With) -> Flow | None:
    for item in node.items:
        value = evaluate(run, scope, item.context_expr)
        if item.optional_vars is not None:
            assign(run, scope, item.optional_vars, value)
    return block(run, scope, node.body)


HANDLERS: dict[type, Callable[[ScriptEvaluation, ScriptScope, Any], Any]] = {
    ast.Expr: expression,
    ast.Assign: assignment,
    ast.AnnAssign: annotated,
    ast.AugAssign: changed,
    ast.Return: returned,
    ast.Delete: deletion,
    ast.Global: outer,
    ast.Nonlocal: outer,
    ast.If: branch,
    ast.For: loop,
    ast.While: repeat,
    ast.Try: attempt,
    ast.With: with_,
    ast.Match: match,
    ast.Import: import_names,
    ast.ImportFrom: import_from,
    ast.FunctionDef: function_definition,
    ast.AsyncFunctionDef: function_definition,
    ast.ClassDef: class_definition,
    ast.Raise: lambda run, scope, node: Flow("raise"),
    ast.Break: lambda run, scope, node: Flow("break"),
    ast.Continue: lambda run, scope, node: Flow("continue"),
}
if hasattr(ast, "TryStar"):
    HANDLERS[ast.TryStar] = attempt
