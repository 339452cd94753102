# SPDX-License-Identifier: Apache-2.0
"""Calls: of the functions of a file, of methods, and of the libraries that have summaries."""

from __future__ import annotations

from haros_ci.launch.python.assignments import forget_items
from haros_ci.launch.python.builtin_functions import HARMLESS, Summary
from haros_ci.launch.python.builtin_functions import SUMMARIES as PYTHON
from haros_ci.launch.python.controller_launches import SUMMARIES as CONTROLLERS
from haros_ci.launch.python.definitions import bound, call_function, instantiate
from haros_ci.launch.python.gz_actions import SUMMARIES as GZ
from haros_ci.launch.python.imports import SUMMARISED
from haros_ci.launch.python.launch_actions import SUMMARIES as LAUNCH
from haros_ci.launch.python.launch_events import SUMMARIES as EVENTS
from haros_ci.launch.python.lineage import find
from haros_ci.launch.python.module_files import SUMMARIES as MODULES
from haros_ci.launch.python.moveit import SUMMARIES as MOVEIT
from haros_ci.launch.python.moveit_launches import SUMMARIES as MOVEIT_LAUNCHES
from haros_ci.launch.python.path_methods import SUMMARIES as PATHS
from haros_ci.launch.python.ros_actions import SUMMARIES as ROS
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.substitutions import SUMMARIES as SUBSTITUTIONS
from haros_ci.launch.python.values import (
    Bound,
    Configurations,
    Context,
    LaunchObject,
    Library,
    LibraryCall,
    Native,
    ScriptClass,
    ScriptFunction,
    ScriptInstance,
    Unknown,
    Value,
    describe,
)
from haros_ci.launch.python.webots_actions import SUMMARIES as WEBOTS
from haros_ci.launch.python.written_files import SUMMARIES as WRITTEN
from haros_ci.launch.python.written_files import WRITING, WrittenFile, lose
from haros_ci.launch.python.xacro_documents import SUMMARIES as XACRO

SUMMARIES: dict[str, Summary] = {
    **PYTHON,
    **WRITTEN,
    **PATHS,
    **SUBSTITUTIONS,
    **LAUNCH,
    **EVENTS,
    **ROS,
    **MOVEIT,
    **MOVEIT_LAUNCHES,
    **CONTROLLERS,
    **GZ,
    **MODULES,
    **WEBOTS,
    **XACRO,
}


def summary_of(dotted: str) -> Summary | None:
    """The summary of a name, wherever in its package it comes from (``launch.actions.group_action.GroupAction``)."""
    parts = dotted.split(".")
    for name in (dotted, ".".join([*parts[:2], parts[-1]]), f"{parts[0]}.{parts[-1]}"):
        if name in SUMMARIES:
            return SUMMARIES[name]
    return None


def call_value(run: ScriptEvaluation, function: Value, call: LibraryCall) -> Value:
    """The value of a call of *function*."""
    run.budget.step()
    if isinstance(function, Library):
        return call_library(run, function, call)
    if isinstance(function, ScriptFunction):
        return call_function(run, function, call)
    if isinstance(function, Bound):
        return bound(run, function.function, function.owner, call)
    if isinstance(function, ScriptClass):
        return instantiate(run, function, call)
    if isinstance(function, Native):
        try:
            return function.call(run, call)
        except (TypeError, ValueError, KeyError, IndexError, AttributeError, ArithmeticError) as error:
            return run.unknown(f"`{function.name}` raises {type(error).__name__}", call.location)
    if isinstance(function, ScriptInstance) and isinstance(method := find(function.type, "__call__"), ScriptFunction):
        return bound(run, method, function, call)
    if isinstance(function, Unknown):
        forget_reachable(run, call, function.reason)
        return Unknown(function.reason, function.location or call.location)
    return run.unknown(f"{describe(function)} cannot be called here", call.location)


def call_library(run: ScriptEvaluation, function: Library, call: LibraryCall) -> Value:
    dotted = function.dotted
    if run.written and dotted not in WRITING:
        lose(run, call, f"what {dotted} writes is not followed")
    summary = summary_of(dotted)
    if summary is not None:
        named = LibraryCall(
            name=dotted,
            location=call.location,
            args=call.args,
            keywords=call.keywords,
            unknown=call.unknown,
            text=call.text,
        )
        try:
            return summary(run, named)
        except (TypeError, ValueError, KeyError, IndexError, AttributeError, ArithmeticError) as error:
            return run.unknown(f"{dotted} raises {type(error).__name__}", call.location)
    if dotted.startswith(HARMLESS):
        return run.unknown(f"what {dotted} gives is not followed", call.location)
    reason = f"{dotted} is not known"
    if dotted.split(".")[0] not in SUMMARISED or dotted.startswith("random."):
        forget_reachable(run, call, reason)
    return run.unknown(reason, call.location)


def forget_reachable(run: ScriptEvaluation, call: LibraryCall, reason: str) -> None:
    """A function that is not known may change the lists and dictionaries that it is given, and those in them.

    One that is given the launch context may set any configuration; performing a substitution sets none.
    """
    is_asking = call.name.rpartition(".")[2] in ("perform", "evaluate", "perform_substitution")
    todo = [(value, 0) for value in (*call.args, *call.keywords.values())]
    while todo:
        value, depth = todo.pop()
        run.budget.step()
        if depth < 6 and isinstance(value, (list, tuple)):
            todo.extend((item, depth + 1) for item in value)
        elif depth < 6 and isinstance(value, dict):
            todo.extend((item, depth + 1) for item in value.values())
        if isinstance(value, Configurations):
            value = value.context
        if isinstance(value, Context) and not is_asking:
            value.launch.set_any_configuration()
        target = value.fields.get("entities") if isinstance(value, LaunchObject) else value
        target = target.parts if isinstance(target, WrittenFile) else target
        if isinstance(target, (list, dict, set)):
            run.heap.touch(target)
            if isinstance(target, list) and isinstance(value, LaunchObject):
                target.append(Unknown(reason, call.location))
            else:
                forget_items(target, reason, call.location)
        elif isinstance(value, ScriptInstance):
            run.heap.touch(value.variables)
            for name in value.variables:
                value.variables[name] = Unknown(reason, call.location)
