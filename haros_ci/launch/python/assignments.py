# SPDX-License-Identifier: Apache-2.0
"""Giving values to names, tuples of names, attributes and items."""

from __future__ import annotations

import ast
from typing import Any

from haros_ci.launch.python.contexts import set_configuration
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.sequences import items_of
from haros_ci.launch.python.values import (
    Choice,
    Configurations,
    LaunchObject,
    Library,
    Module,
    Rest,
    ScriptClass,
    ScriptInstance,
    ScriptScope,
    Unknown,
    Value,
    holes,
    uncertain,
    why,
)


def assign(run: ScriptEvaluation, scope: ScriptScope, target: ast.expr, value: Value) -> None:
    """``target = value``; what is assigned to something that is not known is lost."""
    run.budget.step()
    if isinstance(target, ast.Name):
        set_name(run, scope, target.id, value)
    elif isinstance(target, (ast.Tuple, ast.List)):
        unpack(run, scope, target, value)
    elif isinstance(target, ast.Attribute):
        owner = run.evaluate(run, scope, target.value)
        if isinstance(owner, (ScriptInstance, ScriptClass, Module)):
            run.heap.touch(owner.variables)
            owner.variables[target.attr] = value
        elif isinstance(owner, LaunchObject):
            run.heap.touch(owner.fields)
            owner.fields[target.attr] = value
    elif isinstance(target, ast.Subscript):
        owner = run.evaluate(run, scope, target.value)
        key = (
            run.unknown("a slice is assigned", scope.source.place(target))
            if isinstance(target.slice, ast.Slice)
            else (run.evaluate(run, scope, target.slice))
        )
        set_item(run, owner, key, value)


def set_name(run: ScriptEvaluation, scope: ScriptScope, name: str, value: Value) -> None:
    home = scope.outer_names.get(name, scope)
    run.heap.touch(home.variables)
    home.variables[name] = value


def unpack(run: ScriptEvaluation, scope: ScriptScope, target: ast.Tuple | ast.List, value: Value) -> None:
    """``a, *b = value``."""
    place = scope.source.place(target)
    items = items_of(run, value, place)
    names = target.elts
    star = next((i for i, item in enumerate(names) if isinstance(item, ast.Starred)), None)
    fits = not isinstance(items, Unknown) and (
        len(items) == len(names) if star is None else len(items) >= len(names) - 1
    )
    if isinstance(items, Unknown) or not fits or holes(items) is not None:
        lost = items if isinstance(items, Unknown) else run.unknown("the number of values is not known to fit", place)
        for item in names:
            assign(
                run, scope, item.value if isinstance(item, ast.Starred) else item, Unknown(lost.reason, lost.location)
            )
        return
    if star is not None:
        after = len(names) - star - 1
        middle: Any = list(items[star : len(items) - after])
        items = [*items[:star], middle, *items[len(items) - after :]]
    for item, part in zip(names, items, strict=True):
        assign(run, scope, item.value if isinstance(item, ast.Starred) else item, part)


def set_item(run: ScriptEvaluation, owner: Value, key: Value, value: Value) -> None:
    """``owner[key] = value``; with a key that is not known, any item may have been replaced."""
    if isinstance(owner, Configurations):
        set_configuration(run, owner.context, key, value)
        return
    if isinstance(owner, Choice):
        for _, option in owner.options:
            if isinstance(option, (dict, list)):
                run.heap.touch(option)
                forget_items(option, owner.reason, owner.location)
    elif isinstance(owner, Library) and owner.dotted == "os.environ" and isinstance(key, str):
        run.heap.touch(run.environment)
        run.environment[key] = value
    elif isinstance(owner, dict):
        run.heap.touch(owner)
        if uncertain(key) or not hashable(key):
            forget_items(owner, why(key), None)
        else:
            owner[key] = value
    elif isinstance(owner, list):
        run.heap.touch(owner)
        known = isinstance(key, int) and -len(owner) <= key < len(owner) and holes(owner) is None
        if known:
            owner[key] = value
        else:
            forget_items(owner, why(key) if uncertain(key) else "an index is not in the list", None)


def hashable(key: Value) -> bool:
    try:
        hash(key)
    except TypeError:
        return False
    return True


def forget_items(owner: Any, reason: str, location: Any) -> None:
    """Any item of *owner* (touched already) may be another by now, and there may be more."""
    lost = Rest(reason, location)
    if isinstance(owner, dict):
        for key in owner:
            owner[key] = Unknown(reason, location)
        owner[lost] = lost
    elif isinstance(owner, list):
        owner[:] = [lost]
    elif isinstance(owner, set):
        owner.clear()
        owner.add(lost)


def delete(run: ScriptEvaluation, scope: ScriptScope, target: ast.expr) -> None:
    """``del target``."""
    if isinstance(target, ast.Name):
        run.heap.touch(scope.variables)
        scope.variables.pop(target.id, None)
    elif isinstance(target, ast.Subscript):
        owner = run.evaluate(run, scope, target.value)
        if not isinstance(owner, (dict, list)):
            return
        run.heap.touch(owner)
        key = (
            run.unknown("a slice is deleted", None)
            if isinstance(target.slice, ast.Slice)
            else run.evaluate(run, scope, target.slice)
        )
        if isinstance(owner, dict) and not uncertain(key) and hashable(key):
            owner.pop(key, None)
        elif (
            isinstance(owner, list)
            and isinstance(key, int)
            and -len(owner) <= key < len(owner)
            and holes(owner) is None
        ):
            del owner[key]
        else:
            forget_items(owner, "an item is deleted that is not known", None)
