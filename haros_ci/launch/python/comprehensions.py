# SPDX-License-Identifier: Apache-2.0
"""Comprehensions: a value made by ``for`` and ``if``."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import Any

from haros_ci.launch.python.assignments import assign
from haros_ci.launch.python.heap import LOOP
from haros_ci.launch.python.run import ScriptEvaluation, condition
from haros_ci.launch.python.sequences import items_of
from haros_ci.launch.python.truth import truth
from haros_ci.launch.python.values import Maybe, Rest, ScriptScope, Unknown, Value


def comprehension(run: ScriptEvaluation, scope: ScriptScope, node: Any) -> Value:
    """A list, set, dictionary or generator made by ``for``; generators are made at once."""
    inner = ScriptScope({}, scope, scope.source)
    run.heap.born(inner.variables)
    place = scope.source.place(node)
    found: list[Value] = []
    for tests in passes(run, inner, node.generators, 0):
        if isinstance(node, ast.DictComp):
            item: Value = (run.evaluate(run, inner, node.key), run.evaluate(run, inner, node.value))
        else:
            item = run.evaluate(run, inner, node.elt)
        found.append(Maybe(item, tests) if tests else item)
        run.budget.take(1)
    if isinstance(node, ast.DictComp):
        result: dict[Any, Value] = {}
        for item in found:
            if isinstance(item, Maybe) or isinstance(item[0], Unknown):
                lost = item.tests[0] if isinstance(item, Maybe) else item[0]
                key = Rest(lost.reason or "depends on a condition", place)
                result[key] = key
            else:
                result[item[0]] = item[1]
        return run.made(result, place)
    return run.made(set(found) if isinstance(node, ast.SetComp) else found, place)


def passes(
    run: ScriptEvaluation, scope: ScriptScope, generators: list[ast.comprehension], depth: int
) -> Iterator[tuple[Any, ...]]:
    """Set the variables of each turn; the tests under which there is such a turn are given."""
    if depth == len(generators):
        yield ()
        return
    generator = generators[depth]
    value = run.evaluate(run, scope if depth else scope.parent or scope, generator.iter)
    items = items_of(run, value, scope.source.place(generator.iter))
    if isinstance(items, Unknown):
        items = [Rest(items.reason, items.location)]
    for item in items[:LOOP]:
        run.budget.step()
        tests: tuple[Any, ...] = ()
        if isinstance(item, Rest):
            tests = condition(scope, generator.iter, item, "for each of")[:1]
            item = Unknown(item.reason, item.location)
        elif isinstance(item, Maybe):
            item, tests = item.value, item.tests
        assign(run, scope, generator.target, item)
        for test in generator.ifs:
            known = truth(run, run.evaluate(run, scope, test))
            if isinstance(known, Unknown):
                tests = (*tests, condition(scope, test, known)[0])
            elif not known:
                break
        else:
            for more in passes(run, scope, generators, depth + 1):
                yield (*tests, *more)
