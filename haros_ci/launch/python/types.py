# SPDX-License-Identifier: Apache-2.0
"""``isinstance``, and copies of values."""

from __future__ import annotations

from typing import Any

from haros_ci.launch.python.lineage import lineage
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import (
    LaunchObject,
    Library,
    LibraryCall,
    Maybe,
    PartialText,
    PathValue,
    ScriptClass,
    ScriptInstance,
    Sub,
    Unknown,
    Value,
    why,
)

TYPES: dict[str, Any] = {
    "str": (str, PartialText),
    "int": int,
    "float": float,
    "bool": bool,
    "list": list,
    "tuple": tuple,
    "dict": dict,
    "set": set,
    "bytes": bytes,
}


def is_instance(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``isinstance(x, types)``."""
    if len(call.args) != 2:
        return run.unknown("isinstance is given no type", call.location)
    value, types = call.args
    if isinstance(value, (Unknown, Maybe)):
        return run.unknown(why(value), call.location)
    answers = [fits(value, item) for item in (types if isinstance(types, (list, tuple)) else (types,))]
    if True in answers:
        return True
    return run.unknown("the type is not known", call.location) if None in answers else False


def fits(value: Value, expected: Value) -> bool | None:
    """Whether *value* is of the type *expected*; None if that is not known."""
    if isinstance(expected, ScriptClass):
        if not isinstance(value, ScriptInstance):
            return None if isinstance(value, Library) else False
        return expected in lineage(value.type)
    if not isinstance(expected, Library) or isinstance(value, (Library, ScriptInstance)):
        return None
    last = expected.dotted.rpartition(".")[2]
    if expected.dotted.startswith("builtins.") and last in TYPES:
        return isinstance(value, TYPES[last])
    if last in ("Path", "PurePath"):
        return isinstance(value, PathValue)
    if isinstance(value, LaunchObject):
        return True if value.name.rpartition(".")[2] == last else None
    if isinstance(value, Sub):
        return True if last in (value.name, "Substitution") else None
    return False if value is None or isinstance(value, (str, bool, int, float, list, tuple, dict, PathValue)) else None


def deep_copy(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return deep(run, call.args[0] if call.args else None, 0)


def deep(run: ScriptEvaluation, value: Value, depth: int) -> Value:
    run.budget.take(1)
    if depth > 30:
        return run.unknown("it is nested too deep", None)
    if isinstance(value, (list, tuple)):
        return type(value)(deep(run, item, depth + 1) for item in value)
    if isinstance(value, dict):
        return {key: deep(run, item, depth + 1) for key, item in value.items()}
    if isinstance(value, set):
        return set(value)
    if isinstance(value, ScriptInstance):
        return ScriptInstance(value.type, {key: deep(run, item, depth + 1) for key, item in value.variables.items()})
    return value


def shallow(run: ScriptEvaluation, call: LibraryCall) -> Value:
    value = call.args[0] if call.args else None
    return value.copy() if isinstance(value, (list, dict, set)) else value


def parent_class(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``super()``: the bases of the class, and the object."""
    made, owner = call.args if len(call.args) == 2 else (None, None)
    if not isinstance(made, ScriptClass) or not isinstance(owner, (ScriptInstance, ScriptClass)):
        return run.unknown("super() is not followed here", call.location)
    return LaunchObject("builtins.super", call.location, {"bases": made.bases, "owner": owner})
