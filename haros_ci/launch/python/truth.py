# SPDX-License-Identifier: Apache-2.0
"""Whether a value counts as true, and whether two are equal."""

from __future__ import annotations

from typing import Any

from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import (
    Absent,
    Choice,
    LaunchObject,
    Library,
    Maybe,
    PartialText,
    PathValue,
    Rest,
    ScriptClass,
    ScriptFunction,
    ScriptInstance,
    Sub,
    Unknown,
    Value,
    holes,
    uncertain,
    why,
)


def truth(run: ScriptEvaluation, value: Value) -> bool | Unknown:
    """What ``if value`` asks; Unknown if it is not known."""
    if isinstance(value, Choice):
        answers = [truth(run, item) for _, item in value.options]
        if all(isinstance(item, bool) and item == answers[0] for item in answers):
            return answers[0]
        return Unknown(value.reason, value.location)
    if isinstance(value, Unknown):
        return value
    if isinstance(value, PartialText):
        if any(isinstance(part, str) for part in value.phrase):
            return True
        return Unknown(why(value), None)
    if isinstance(value, (list, tuple, set, dict)):
        if any(not isinstance(item, (Maybe, Rest)) for item in value):
            return True
        return Unknown(found.reason, found.location) if (found := holes(value)) is not None else False
    if isinstance(value, (ScriptInstance, Library)):
        return Unknown(why(value), None)
    if isinstance(value, (LaunchObject, Sub, PathValue, ScriptFunction, ScriptClass)):
        return True
    if value is None or isinstance(value, (bool, int, float, str, bytes, range)):
        return bool(value)
    return Unknown(why(value), None)


def equal(run: ScriptEvaluation, one: Value, other: Value, depth: int = 0) -> bool | Unknown:
    """What ``one == other`` asks."""
    run.budget.step()
    if isinstance(one, Choice) != isinstance(other, Choice):
        choice, plain = (one, other) if isinstance(one, Choice) else (other, one)
        answers = [equal(run, item, plain, depth + 1) for _, item in choice.options] if depth < 4 else []
        if answers and all(isinstance(item, bool) and item == answers[0] for item in answers):
            return answers[0]
        return Unknown(choice.reason, choice.location)
    for value in (one, other):
        if uncertain(value):
            return Unknown(why(value), getattr(value, "location", None))
    if one is other:
        return True
    simple = (bool, int, float, str, bytes, type(None), range)
    if isinstance(one, simple) and isinstance(other, simple):
        return bool(one == other)
    if isinstance(one, (list, tuple, set, dict)) and isinstance(other, (list, tuple, set, dict)):
        return equal_containers(run, one, other, depth)
    if isinstance(one, PathValue) and isinstance(other, PathValue):
        return equal(run, one.text, other.text, depth + 1)
    if isinstance(one, Library) or isinstance(other, Library):
        if isinstance(one, Library) and isinstance(other, Library) and one.dotted == other.dotted:
            return True
        return Unknown(why(one if isinstance(one, Library) else other), None)
    if isinstance(one, ScriptInstance) or isinstance(other, ScriptInstance):
        return Unknown("how objects compare is not followed", None)
    return False


def equal_containers(run: ScriptEvaluation, one: Any, other: Any, depth: int) -> bool | Unknown:
    if type(one) is not type(other):
        return False
    doubt = holes(one) or holes(other)
    if doubt is not None:
        return Unknown(doubt.reason, doubt.location)
    if depth > 20:
        return Unknown("it is nested too deep", None)
    if len(one) != len(other):
        return False
    run.budget.step(len(one))
    if isinstance(one, set):
        return bool(one == other)
    if isinstance(one, dict):
        if one.keys() != other.keys():
            return False
        pairs = [(one[key], other[key]) for key in one]
    else:
        pairs = list(zip(one, other, strict=True))
    for a, b in pairs:
        found = equal(run, a, b, depth + 1)
        if isinstance(found, Unknown):
            doubt = doubt or found
        elif not found:
            return False
    return True if doubt is None else Unknown(doubt.reason, doubt.location)


def contains(run: ScriptEvaluation, items: Any, expected: Value) -> bool | Unknown:
    """The result of ``expected in items``, for a list, tuple, set, dictionary or its keys."""
    doubt: Unknown | None = None
    value = items.get(expected) if isinstance(items, dict) and isinstance(expected, str) else None
    if isinstance(value, Choice) and any(isinstance(item, Absent) for _, item in value.options):
        return Unknown(value.reason, value.location)
    for item in items:
        found = equal(run, item, expected)
        if found is True:
            return True
        if isinstance(found, Unknown):
            doubt = doubt or found
    return False if doubt is None else Unknown(doubt.reason, doubt.location)
