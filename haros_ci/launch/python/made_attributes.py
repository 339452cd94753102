# SPDX-License-Identifier: Apache-2.0
"""Methods and attributes of the objects that launch's classes make."""

from __future__ import annotations

from haros_ci.launch.python.contexts import executed, holds
from haros_ci.launch.python.lineage import find
from haros_ci.launch.python.moveit import made_by_moveit, moveit_attribute
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import Bound, LaunchObject, LibraryCall, Native, ScriptFunction, Unknown, Value
from haros_ci.launch.python.webots_actions import LAUNCHER
from haros_ci.launch.python.xacro_documents import DOCUMENT, document_attribute
from haros_ci.model.launch_actions import Test
from haros_ci.model.location import Location

SOURCES = "launch.LaunchDescriptionSource"


def made_attribute(run: ScriptEvaluation, made: LaunchObject, name: str, place: Location) -> Value:
    """An attribute of *made*; what launch keeps for itself is not known."""
    if made_by_moveit(made):
        return moveit_attribute(run, made, name, place)
    if made.name == LAUNCHER and name in made.fields:
        return made.fields[name]
    if made.name == DOCUMENT:
        return document_attribute(run, made, name, place)
    if "entities" in made.fields:
        if name in ("add_action", "add_entity"):
            return Native(name, lambda run, call: add(run, made, call))
        if name == "entities":
            return made.fields["entities"]
    if made.name == "builtins.super":
        return of_bases(run, made, name, place)
    test = made.fields.get("test")
    if name == "evaluate" and isinstance(test, Test):
        return Native(name, lambda run, call: holds(run, call.bind("context").get("context"), (test,), call.location))
    action = made.action
    if name in ("execute", "visit") and action is not None:
        return Native(name, lambda run, call: executed(run, action, call))
    if name in made.fields and isinstance(made.fields[name], str):
        return made.fields[name]
    return run.unknown(f"{made.name.rpartition('.')[2]}.{name} is not followed", place)


def of_bases(run: ScriptEvaluation, made: LaunchObject, name: str, place: Location) -> Value:
    """A method of the class that is a base; a library's ``__init__`` leaves nothing that is followed."""
    for base in made.fields["bases"]:
        found = find(base, name)
        if isinstance(found, ScriptFunction):
            return Bound(found, made.fields["owner"])
        if found is not None:
            return found
    if name == "__init__":
        return Native(name, lambda run, call: None)
    return run.unknown(f"`{name}` of a base is not known", place)


def add(run: ScriptEvaluation, made: LaunchObject, call: LibraryCall) -> Value:
    """``add_action(x)``, ``add_entity(x)``."""
    entities = made.fields["entities"]
    run.heap.touch(entities)
    value = (
        call.args[0] if call.args else next(iter(call.keywords.values()), Unknown("nothing is added", call.location))
    )
    run.budget.take(1)
    entities.append(value)
    return None
