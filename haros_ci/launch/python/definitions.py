# SPDX-License-Identifier: Apache-2.0
"""Functions and classes of a launch file, and calls of them."""

from __future__ import annotations

import ast
from typing import Any

from haros_ci.launch.python.assignments import set_name
from haros_ci.launch.python.forks import settle
from haros_ci.launch.python.heap import CALLS
from haros_ci.launch.python.lineage import find
from haros_ci.launch.python.run import ScriptEvaluation, ScriptFrame
from haros_ci.launch.python.values import (
    Bound,
    Choice,
    Library,
    LibraryCall,
    ScriptClass,
    ScriptFunction,
    ScriptInstance,
    ScriptScope,
    Unknown,
    Value,
    why,
)
from haros_ci.model.launch_actions import Test

PLAIN_DECORATORS = ("launch_testing.", "pytest.", "functools.", "unittest.", "typing.", "abc.")
DATACLASS = "dataclasses.dataclass"


def function_definition(run: ScriptEvaluation, scope: ScriptScope, node: Any) -> None:
    """``def``: with its defaults, and the decorators that are followed."""
    if isinstance(node, ast.AsyncFunctionDef):
        set_name(run, scope, node.name, run.unknown("async functions are not followed", scope.source.place(node)))
        return
    defaults = tuple(run.evaluate(run, scope, item) for item in node.args.defaults)
    named = tuple(None if item is None else run.evaluate(run, scope, item) for item in node.args.kw_defaults)
    kind = "function"
    decorators = []
    for item in reversed(node.decorator_list):
        value = run.evaluate(run, scope, item.func if isinstance(item, ast.Call) else item)
        dotted = value.dotted if isinstance(value, Library) else ""
        if dotted in ("builtins.staticmethod", "builtins.classmethod", "builtins.property"):
            kind = dotted.split(".")[1]
        elif not dotted.startswith(PLAIN_DECORATORS):
            decorators.append(item)
    made: Value = ScriptFunction(node.name, node, scope, defaults, named, kind)
    for item in decorators:
        made = run.apply(run.evaluate(run, scope, item), (made,), scope.source.place(node))
    set_name(run, scope, node.name, made)


def class_definition(run: ScriptEvaluation, scope: ScriptScope, node: ast.ClassDef) -> None:
    """``class``: its body is done at once; with an unknown decorator it is not followed."""
    bases = [run.evaluate(run, scope, base) for base in node.bases]
    place = scope.source.place(node)
    library = next((base.dotted for base in bases if isinstance(base, Library)), "")
    fields: tuple[str, ...] = ()
    known = all(isinstance(base, (ScriptClass, Library)) for base in bases)
    for item in node.decorator_list:
        value = run.evaluate(run, scope, item.func if isinstance(item, ast.Call) else item)
        if isinstance(value, Library) and value.dotted == DATACLASS:
            fields = tuple(
                part.target.id
                for part in node.body
                if isinstance(part, ast.AnnAssign) and isinstance(part.target, ast.Name)
            )
        else:
            known = False
    inner = ScriptScope({}, scope, scope.source, is_class=True)
    run.block(run, inner, node.body)
    if not known:
        set_name(run, scope, node.name, run.unknown(f"the class `{node.name}` is not followed", place))
        return
    made = ScriptClass(
        node.name, inner.variables, tuple(base for base in bases if isinstance(base, ScriptClass)), library, fields
    )
    for key, value in list(inner.variables.items()):
        if isinstance(value, ScriptFunction):
            inner.variables[key] = ScriptFunction(
                value.name, value.node, value.scope, value.defaults, value.keyword_defaults, value.kind, made
            )
    set_name(run, scope, node.name, made)


def call_function(run: ScriptEvaluation, function: ScriptFunction, call: LibraryCall) -> Value:
    """The value that *function* returns; what it returns on several ways is a Choice."""
    budget = run.budget
    if budget.calls >= CALLS:
        return run.unknown("the functions call one another too deep", call.location)
    scope = ScriptScope({}, function.scope, function.scope.source)
    run.heap.born(scope.variables)
    if function.owner is not None:
        scope.variables["__class__"] = function.owner
    problem = bind(run, function, call, scope.variables)
    if problem:
        return run.unknown(problem, call.location)
    if function.owner is not None:
        scope.variables["__class__"] = scope.variables.pop("__class__")
    if isinstance(function.node, ast.Lambda):
        budget.calls += 1
        try:
            return run.evaluate(run, scope, function.node.body)
        finally:
            budget.calls -= 1
    frame = ScriptFrame(yields=[] if generates(function.node) else None)
    if frame.yields is not None:
        run.heap.born(frame.yields)
    run.frames.append(frame)
    budget.calls += 1
    try:
        flow = run.block(run, scope, function.node.body)
        pending = tuple(test for _, test, _ in frame.pending)
        settle(run, frame, 0)
    finally:
        budget.calls -= 1
        run.frames.pop()
    if frame.yields is not None:
        return frame.yields
    if flow is not None and flow.kind == "raise":
        if not frame.returns:
            return run.unknown(f"`{function.name}` raises an exception", call.location)
        return together(frame.returns)
    value = flow.value if flow is not None else None
    return together([*frame.returns, (pending, value)]) if frame.returns else value


def together(returns: list[tuple[tuple[Test, ...], Value]]) -> Value:
    """One value of several that are each returned under tests."""
    first = returns[0][1]
    if all(value is first for _, value in returns):
        return first
    test = returns[0][0][0]
    options: list[tuple[tuple[Test, ...], Value]] = []
    for tests, value in returns:
        if isinstance(value, Choice):
            options.extend(((*tests, *more), item) for more, item in value.options)
        else:
            options.append((tests, value))
    reason = test.reason or f"depends on `{test.text}`"
    return Choice(reason, test.location, tuple(options)) if len(options) <= 32 else Unknown(reason, test.location)


def generates(node: ast.FunctionDef) -> bool:
    """Whether it is a generator; functions within it are not looked into."""
    todo: list[ast.AST] = list(node.body)
    while todo:
        item = todo.pop()
        if isinstance(item, (ast.Yield, ast.YieldFrom)):
            return True
        if not isinstance(item, (ast.FunctionDef, ast.Lambda, ast.ClassDef, ast.AsyncFunctionDef)):
            todo.extend(ast.iter_child_nodes(item))
    return False


def bind(run: ScriptEvaluation, function: ScriptFunction, call: LibraryCall, variables: dict[str, Value]) -> str:
    """Give the parameters of *function* their values; what is wrong is returned."""
    arguments = function.node.args
    names = [item.arg for item in (*arguments.posonlyargs, *arguments.args)]
    keywords = dict(call.keywords)
    provided = list(call.args)
    lost = next((item for item in provided if isinstance(item, Unknown) and type(item).__name__ == "Rest"), None)
    if lost is not None or call.unknown:
        for name in (*names, *(item.arg for item in arguments.kwonlyargs)):
            variables[name] = keywords.get(name, Unknown(call.unknown or why(lost), call.location))
        for index, value in enumerate(provided[: provided.index(lost)] if lost is not None else provided):
            if index < len(names):
                variables[names[index]] = value
        return ""
    for name, value in zip(names, provided, strict=False):
        variables[name] = value
    if arguments.vararg is not None:
        variables[arguments.vararg.arg] = tuple(provided[len(names) :])
    elif len(provided) > len(names):
        return f"`{function.name}` is given too many arguments"
    first_default = len(names) - len(function.defaults)
    for index, name in enumerate(names):
        if name in keywords:
            variables[name] = keywords.pop(name)
        elif index >= len(provided):
            if index < first_default:
                return f"`{function.name}` is not given `{name}`"
            variables[name] = function.defaults[index - first_default]
    for item, default in zip(arguments.kwonlyargs, function.keyword_defaults, strict=False):
        variables[item.arg] = keywords.pop(item.arg, default)
    if arguments.kwarg is not None:
        variables[arguments.kwarg.arg] = keywords
    elif keywords:
        return f"`{function.name}` is given `{sorted(keywords)[0]}`, which it has not"
    return ""


def instantiate(run: ScriptEvaluation, made: ScriptClass, call: LibraryCall) -> Value:
    """A new object of a class of the file; what a library's class adds is not known."""
    instance = ScriptInstance(made)
    run.heap.born(instance.variables)
    start = find(made, "__init__")
    if isinstance(start, ScriptFunction):
        done = call_function(
            run,
            start,
            LibraryCall(
                name=made.name,
                location=call.location,
                args=(instance, *call.args),
                keywords=call.keywords,
                unknown=call.unknown,
            ),
        )
        return (
            Unknown(done.reason, done.location)
            if isinstance(done, Unknown) and not isinstance(done, Choice)
            else instance
        )
    for name in made.fields:
        if name in made.variables:
            instance.variables[name] = made.variables[name]
    instance.variables.update(dict(zip(made.fields, call.args, strict=False)))
    instance.variables.update(call.keywords if made.fields else {})
    return instance


def bound(run: ScriptEvaluation, function: Value, owner: Value, call: LibraryCall) -> Value:
    """Call a method of *owner*."""
    return run.call(
        run,
        function,
        LibraryCall(
            name=call.name,
            location=call.location,
            args=(owner, *call.args),
            keywords=call.keywords,
            unknown=call.unknown,
        ),
    )


def method_of(run: ScriptEvaluation, function: ScriptFunction, owner: Value, made: ScriptClass, place: Any) -> Value:
    """A function of a class as an attribute of *owner*, which is an object or the class."""
    if function.kind == "staticmethod":
        return function
    if function.kind == "classmethod":
        return Bound(function, made)
    if isinstance(owner, ScriptClass):
        return function
    if function.kind == "property":
        return call_function(run, function, LibraryCall(name=function.name, location=place, args=(owner,), keywords={}))
    return Bound(function, owner)
