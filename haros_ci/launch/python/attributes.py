# SPDX-License-Identifier: Apache-2.0
"""``value.name`` for every kind of value."""

from __future__ import annotations

import math
from functools import partial

from haros_ci.launch.python.container_methods import container_method
from haros_ci.launch.python.contexts import configurations_attribute, context_attribute, sub_attribute
from haros_ci.launch.python.definitions import method_of
from haros_ci.launch.python.forks import fork
from haros_ci.launch.python.imports import module
from haros_ci.launch.python.lineage import find, lineage
from haros_ci.launch.python.made_attributes import made_attribute
from haros_ci.launch.python.path_methods import path_attribute, read_opened
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.text_methods import text_method
from haros_ci.launch.python.values import (
    Absent,
    Choice,
    Configurations,
    Context,
    LaunchObject,
    Library,
    LibraryCall,
    Module,
    Native,
    Opened,
    PartialText,
    PathValue,
    ScriptClass,
    ScriptFunction,
    ScriptInstance,
    Sub,
    Unknown,
    Value,
    present,
    why,
)
from haros_ci.launch.python.written_files import WrittenFile, attribute_of
from haros_ci.model.launch_actions import Test
from haros_ci.model.location import Location

CONSTANTS: dict[str, Value] = {
    "os.sep": "/",
    "os.path.sep": "/",
    "os.pathsep": ":",
    "os.curdir": ".",
    "os.pardir": "..",
    "os.linesep": "\n",
    "os.name": "posix",
    "math.pi": math.pi,
    "math.e": math.e,
    "math.inf": math.inf,
    "math.tau": math.tau,
    "typing.TYPE_CHECKING": False,
    "string.ascii_lowercase": "abcdefghijklmnopqrstuvwxyz",
    "string.digits": "0123456789",
}


def attribute(run: ScriptEvaluation, value: Value, name: str, place: Location) -> Value:  # noqa: C901 - one branch for each kind of value
    """The attribute *name*; methods of data are bound to it."""
    if isinstance(value, Library):
        dotted = f"{value.dotted}.{name}"
        return CONSTANTS[dotted] if dotted in CONSTANTS else Library(dotted)
    if isinstance(value, Choice):
        return Native(name, lambda run, call: on_each(run, value, name, call))
    if isinstance(value, Unknown):
        return Unknown(value.reason, value.location)
    if isinstance(value, (str, PartialText)):
        return Native(name, lambda run, call: text_method(run, value, name, call))
    if isinstance(value, (list, tuple, dict, set)):
        return Native(name, lambda run, call: container_method(run, value, name, call))
    if isinstance(value, (ScriptInstance, ScriptClass)):
        return member(run, value, name, place)
    if isinstance(value, Module):
        if name in value.variables:
            return value.variables[name]
        inner = module(run, f"{value.name}.{name}")
        return inner if isinstance(inner, Module) else run.unknown(f"`{name}` is not in {value.name}", place)
    if isinstance(value, PathValue):
        return path_attribute(run, value, name, place)
    if isinstance(value, Sub):
        return sub_attribute(run, value, name, place)
    if isinstance(value, Context):
        return context_attribute(run, value, name, place)
    if isinstance(value, Configurations):
        return configurations_attribute(run, value, name, place)
    if isinstance(value, Opened):
        return opened(run, value, name, place)
    if isinstance(value, WrittenFile):
        return attribute_of(run, value, name, place)
    if isinstance(value, LaunchObject):
        return made_attribute(run, value, name, place)
    if isinstance(value, ScriptFunction) and name == "__name__":
        return value.name
    return run.unknown(why(value), place)


def on_each(run: ScriptEvaluation, value: Choice, name: str, call: LibraryCall) -> Value:
    """A method of one of several objects: what it does counts for each under its test, what it gives is not known."""
    for tests, option in value.options:
        if isinstance(option, Unknown) or not tests:
            continue
        away = Test(kind="?", text=f"not ({tests[0].text})", location=tests[0].location, reason=tests[0].reason)
        fork(run, (tests[0], away), partial(call_on, run, option, name, call), lambda: None)
    return Unknown(value.reason, value.location)


def call_on(run: ScriptEvaluation, option: Value, name: str, call: LibraryCall) -> None:
    run.call(run, attribute(run, option, name, call.location), call)


def member(run: ScriptEvaluation, value: ScriptInstance | ScriptClass, name: str, place: Location) -> Value:
    """An attribute of an object or a class of the file."""
    if name in value.variables and isinstance(value, ScriptInstance):
        kept = value.variables[name]
        inherited = find(value.type, name)
        if inherited is None or not isinstance(kept, Choice):
            return present(kept)
        options = tuple((tests, inherited if isinstance(item, Absent) else item) for tests, item in kept.options)
        return Choice(kept.reason, kept.location, options)
    made = value.type if isinstance(value, ScriptInstance) else value
    if name == "__class__" and isinstance(value, ScriptInstance):
        return made
    if name == "__name__":
        return made.name
    found = find(made, name)
    if isinstance(found, ScriptFunction):
        return method_of(run, found, value, made, place)
    if found is not None or any(name in item.variables for item in lineage(made)):
        return found
    return run.unknown(f"`{made.name}` has no `{name}` that is known", place)


def opened(run: ScriptEvaluation, value: Opened, name: str, place: Location) -> Value:
    if name == "read":
        return Native(name, lambda run, call: read_opened(run, value, call.location))
    if name == "readlines":
        return Native(name, lambda run, call: lines(run, value, call.location))
    if name == "close":
        return Native(name, lambda run, call: None)
    return run.unknown(f"file.{name} is not followed", place)


def lines(run: ScriptEvaluation, value: Opened, place: Location) -> Value:
    text = read_opened(run, value, place)
    return text.splitlines(keepends=True) if isinstance(text, str) else text
