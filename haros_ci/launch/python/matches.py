# SPDX-License-Identifier: Apache-2.0
"""``match``."""

from __future__ import annotations

import ast

from haros_ci.launch.python.assignments import set_name
from haros_ci.launch.python.flows import Flow, ways
from haros_ci.launch.python.run import ScriptEvaluation, condition
from haros_ci.launch.python.truth import equal, truth
from haros_ci.launch.python.values import ScriptScope, Unknown, Value


def match(run: ScriptEvaluation, scope: ScriptScope, node: ast.Match) -> Flow | None:
    """``match``: values and the wildcard are compared; any other pattern may fit."""
    subject = run.evaluate(run, scope, node.subject)
    return case(run, scope, node, subject, 0)


def case(run: ScriptEvaluation, scope: ScriptScope, node: ast.Match, subject: Value, index: int) -> Flow | None:
    if index >= len(node.cases):
        return None
    item = node.cases[index]
    known: Value = fits(run, scope, item.pattern, subject)
    if item.guard is not None and known is True:
        known = truth(run, run.evaluate(run, scope, item.guard))
    if known is True:
        flow: Flow | None = run.block(run, scope, item.body)
        return flow
    if known is False:
        return case(run, scope, node, subject, index + 1)
    tests = condition(scope, node.subject, known, f"case {index + 1} of match")
    return ways(
        run, scope, tests, lambda: run.block(run, scope, item.body), lambda: case(run, scope, node, subject, index + 1)
    )


def fits(run: ScriptEvaluation, scope: ScriptScope, pattern: ast.pattern, subject: Value) -> bool | Unknown:
    if isinstance(pattern, ast.MatchValue):
        return equal(run, subject, run.evaluate(run, scope, pattern.value))
    if isinstance(pattern, ast.MatchSingleton):
        return equal(run, subject, pattern.value)
    if isinstance(pattern, ast.MatchOr):
        found = [fits(run, scope, item, subject) for item in pattern.patterns[:100]]
        doubt = next((item for item in found if isinstance(item, Unknown)), False)
        return True if True in found else doubt
    if isinstance(pattern, ast.MatchAs) and pattern.pattern is None:
        if pattern.name:
            set_name(run, scope, pattern.name, subject)
        return True
    return run.unknown("this pattern is not followed", scope.source.place(pattern))
