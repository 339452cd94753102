# SPDX-License-Identifier: Apache-2.0
"""Findings of pylint in one file that have one cause: the file cannot be compiled, or what it calls has changed, or a few lines were left behind."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable

from haros_ci.linters.dead_statements import OF_FILES
from haros_ci.results.result import Result
from haros_ci.results.same_cause import OF_A_NAME, put_together
from haros_ci.results.scope import scopes

TOOL = "pylint"
#: Errors of the compiler, which stops at the whole file: what else would happen when a line of it is run never does.
COMPILING = frozenset(
    f"{TOOL}:{rule}" for rule in OF_FILES if not rule.startswith(("bidirectional", "invalid-character"))
)
#: Rules that speak of a call that does not fit what is called.
CALLS = frozenset(
    f"{TOOL}:{rule}"
    for rule in (
        "missing-kwoa",
        "no-value-for-parameter",
        "redundant-keyword-arg",
        "too-many-function-args",
        "unexpected-keyword-arg",
    )
)
RUNNING = CALLS | {
    f"{TOOL}:{rule}" for rule in ("undefined-variable", "used-before-assignment", "possibly-used-before-assignment")
}
#: So many functions that a file calls in a former way, or so many constructors, were changed without it.
MANY_CALLS, MANY_CONSTRUCTORS = 3, 2
#: Undefined names of one function that lie within so many lines were left behind together.
NEAR = 5
#: A finding names no more other places than this.
MOST = 40


def one_file(results: Iterable[Result], text: Callable[[str], str]) -> tuple[Result, ...]:
    """*results* in their order, those of pylint in one file that have one cause as one: the first by place; *text* reads a path.

    Call it after :func:`haros_ci.linters.one_cause.one_cause`.
    """
    found = list(results)
    for cause in (_of_compiler, _of_calls, _of_names):
        groups: dict[str, list[Result]] = defaultdict(list)
        for result in found:
            if result.tool == TOOL:
                groups[result.location.path].append(result)
        merged: dict[int, Result] = {}
        dropped: set[int] = set()
        for here in groups.values():
            for first, *others in cause(here, text):
                merged[id(first)] = put_together(first, others[:MOST])
                dropped.update(map(id, others[:MOST]))
        found = [merged.get(id(result), result) for result in found if id(result) not in dropped]
    return tuple(found)


def _of_compiler(here: list[Result], text: Callable[[str], str]) -> Iterable[list[Result]]:
    """What stops the compiler comes first, then what would happen if it did not."""
    stops = sorted((result for result in here if result.full_id in COMPILING), key=lambda result: result.sort_key)
    others = [result for result in here if result.full_id in RUNNING]
    return [[stops[0], *sorted(others, key=lambda result: result.sort_key)]] if stops and others else []


def _of_calls(here: list[Result], text: Callable[[str], str]) -> Iterable[list[Result]]:
    calls = sorted((result for result in here if result.full_id in CALLS), key=lambda result: result.sort_key)
    made = [result for result in calls if "constructor call" in result.message]
    if len(calls) >= MANY_CALLS:
        return [calls]
    return [made] if len(made) >= MANY_CONSTRUCTORS else []


def _of_names(here: list[Result], text: Callable[[str], str]) -> Iterable[list[Result]]:
    named = [result for result in here if result.full_id in OF_A_NAME and result.location.line]
    if len(named) < 2:
        return []
    inside = scopes(text(here[0].location.path), "python")
    groups: list[list[Result]] = []
    for result in sorted(named, key=lambda result: result.sort_key):
        line = result.location.line or 0
        last = groups[-1][-1] if groups else None
        is_near = last is not None and line - (last.location.line or 0) <= NEAR and last.level is result.level
        if last is not None and is_near and inside.at(line) and inside.at(line) == inside.at(last.location.line or 0):
            groups[-1].append(result)
        else:
            groups.append([result])
    return [group for group in groups if len(group) > 1]
