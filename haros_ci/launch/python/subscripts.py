# SPDX-License-Identifier: Apache-2.0
"""``value[key]``."""

from __future__ import annotations

from typing import Any

from haros_ci.launch.python.contexts import configuration
from haros_ci.launch.python.paths import parent_path
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import (
    Configurations,
    LaunchObject,
    Library,
    Native,
    Rest,
    Unknown,
    Value,
    holes,
    present,
    uncertain,
    why,
)
from haros_ci.model.location import Location


def subscript(run: ScriptEvaluation, value: Value, key: Value, place: Location) -> Value:
    """The item, or the slice; Unknown if there is none."""
    if isinstance(value, Unknown):
        return Unknown(value.reason, value.location)
    if isinstance(key, slice):
        return sliced(run, value, key, place)
    if uncertain(key):
        return Unknown(why(key), getattr(key, "location", None))
    if isinstance(value, Configurations):
        return configuration(run, value.context, key, place)
    if isinstance(value, dict):
        return item_of(run, value, key, place)
    if isinstance(value, (list, tuple)):
        return element(run, value, key, place)
    if isinstance(value, (str, bytes, range)) and isinstance(key, int):
        if -len(value) <= key < len(value):
            return value[key]
        return run.unknown("there is no such index", place)
    if isinstance(value, Library):
        if value.dotted == "os.environ":
            return (
                run.environment[key]
                if key in run.environment
                else run.unknown(f"the environment variable {key} is not known", place)
            )
        return Library(f"{value.dotted}[{key.dotted if isinstance(key, Library) else key}]")
    if isinstance(value, Native) and value.name == "parents" and isinstance(key, int) and 0 <= key < 50:
        path = value.call(run, None)
        for _ in range(key + 1):
            path = parent_path(path)
        return path
    if isinstance(value, LaunchObject) and isinstance(value.fields.get("items"), dict):
        return item_of(run, value.fields["items"], key, place)
    return run.unknown(why(value), place)


def item_of(run: ScriptEvaluation, value: dict[Any, Value], key: Value, place: Location) -> Value:
    """The item of a dictionary; a key that is there only on some way counts as there."""
    if key in value:
        return present(value[key])
    rest = next((item for item in value if isinstance(item, Rest)), None)
    if rest is not None:
        return Unknown(rest.reason, rest.location)
    return run.unknown(f"there is no item {key!r}"[:120], place)


def element(run: ScriptEvaluation, value: Any, key: Value, place: Location) -> Value:
    """The item of a list by its index, if what stands before it is certain."""
    if not isinstance(key, int):
        return run.unknown("the index is no number", place)
    before = value[: key + 1] if key >= 0 else value[key:]
    if (doubt := holes(before)) is not None:
        return Unknown(doubt.reason, doubt.location)
    if -len(value) <= key < len(value):
        return value[key]
    return run.unknown("there is no such index", place)


def sliced(run: ScriptEvaluation, value: Value, key: slice, place: Location) -> Value:
    parts = (key.start, key.stop, key.step)
    for part in parts:
        if uncertain(part):
            return Unknown(why(part), getattr(part, "location", None))
    if not all(part is None or isinstance(part, int) for part in parts) or key.step == 0:
        return run.unknown("the slice is not of numbers", place)
    if isinstance(value, (list, tuple)) and (doubt := holes(value)) is not None:
        return type(value)([Rest(doubt.reason, doubt.location)])
    if isinstance(value, (str, bytes, list, tuple)):
        return run.made(value[key], place)
    return run.unknown(why(value), place)
