# SPDX-License-Identifier: Apache-2.0
"""The items of a value that a loop goes through, and its items by index."""

from __future__ import annotations

from typing import Any

from haros_ci.launch.python.heap import LARGEST
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import Choice, Maybe, Rest, Unknown, Value, holes, why
from haros_ci.model.location import Location


def items_of(run: ScriptEvaluation, value: Value, place: Location) -> list[Value] | Unknown:
    """The items that ``for`` gets from *value*; Maybe and Rest among them say what is not known."""
    if isinstance(value, Choice):
        return items_of_choice(run, value, place)
    if isinstance(value, Unknown):
        return value
    if isinstance(value, (str, bytes, list, tuple, dict, range)):
        if len(value) > LARGEST:
            return run.unknown("it is too large", place)
        run.budget.take(len(value))
        return list(value)
    if isinstance(value, set):
        return (
            sorted(value, key=order)
            if len(value) == 1 or all(isinstance(item, str) for item in value)
            else [Rest("the order of a set is not known", place)]
        )
    return run.unknown(f"its items are not known: {why(value)}", place)


def order(item: Any) -> str:
    return str(item)


def items_of_choice(run: ScriptEvaluation, value: Choice, place: Location) -> list[Value] | Unknown:
    """The items of each sequence that it may be, each under the tests of its own."""
    result: list[Value] = []
    for tests, option in value.options:
        items = items_of(run, option, place)
        if isinstance(items, Unknown):
            return Unknown(value.reason, value.location)
        for item in items:
            if isinstance(item, Rest):
                result.append(item)
            elif isinstance(item, Maybe):
                result.append(Maybe(item.value, (*tests, *item.tests)))
            else:
                result.append(Maybe(item, tests))
    return result


def certain(run: ScriptEvaluation, value: Value, place: Location) -> list[Value] | Unknown:
    """The items of *value* where none is in doubt."""
    items = items_of(run, value, place)
    if not isinstance(items, Unknown) and (doubt := holes(items)) is not None:
        return Unknown(doubt.reason, doubt.location)
    return items
