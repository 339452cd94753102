# SPDX-License-Identifier: Apache-2.0
"""What an OpaqueFunction asks of its launch context."""

from __future__ import annotations

from typing import Any

from haros_ci.launch.python import container_methods
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import (
    Configurations,
    Context,
    Library,
    LibraryCall,
    Maybe,
    Native,
    PartialText,
    Sub,
    Unknown,
    Value,
    merged,
    mystery,
    phrase,
    text_of,
    why,
)
from haros_ci.model.launch_actions import PREFIX, SHARE, Action, Performed, Phrase, Substitution, Test
from haros_ci.model.location import Location


def perform(run: ScriptEvaluation, context: Value, text: Phrase, place: Location) -> Value:
    """*text* in *context* as a str value; the parts that are not known are so in it."""
    if not isinstance(context, Context):
        reason = why(context) if isinstance(context, Unknown) else "the launch context is not known"
        return run.unknown(reason, place)
    parts: list[Any] = []
    for part in text:
        run.budget.step()
        if isinstance(part, str):
            parts.append(part)
            continue
        if part.kind == "?":
            parts.append(part)
            continue
        done = context.launch.perform((part,))
        parts.append(done.text if done.known else mystery(done.reason, done.location or place))
    return run.made(text_of(merged(parts)), place)


def configuration(run: ScriptEvaluation, context: Context, name: Value, place: Location) -> Value:
    """``context.launch_configurations[name]``."""
    if not isinstance(name, str):
        return run.unknown(why(name), place)
    found = context.launch.configuration(name)
    if found is None:
        return run.unknown(f"the launch configuration {name} is not set", place)
    return found.text if found.known else PartialText((mystery(found.reason, found.location or place),))


def set_configuration(run: ScriptEvaluation, context: Context, name: Value, value: Value) -> None:
    """``context.launch_configurations[name] = value``; under a condition that is not known the value is not known."""
    if not isinstance(name, str):
        context.launch.set_any_configuration()
        return
    text = phrase(value)
    if len(run.heap.journals) > context.depth:
        done = Performed("?", "depends on a condition")
    elif not text:
        done = Performed("")
    elif len(text) == 1 and isinstance(text[0], str):
        done = Performed(text[0])
    else:
        done = context.launch.perform(text)
    context.launch.set_configuration(name, done)


def holds(run: ScriptEvaluation, context: Value, tests: tuple[Test, ...], place: Location) -> Value:
    """``condition.evaluate(context)``."""
    if not isinstance(context, Context):
        return run.unknown("the launch context is not known", place)
    for test in tests:
        known = None if test.kind == "?" else context.launch.test(test)
        if known is None:
            return run.unknown(test.reason or f"whether {test.text} holds is not known", test.location or place)
        if not known:
            return False
    return True


def context_attribute(run: ScriptEvaluation, context: Context, name: str, place: Location) -> Value:
    """An attribute or a method of the context."""
    if name == "launch_configurations":
        return Configurations(context)
    if name == "perform_substitution":
        return Native(
            name, lambda run, call: perform(run, context, phrase(call.args[0] if call.args else ""), call.location)
        )
    if name == "environment":
        return Library("os.environ")
    return run.unknown(f"context.{name} is not followed", place)


def configurations_attribute(run: ScriptEvaluation, value: Configurations, name: str, place: Location) -> Value:
    """A method of the launch configurations; where these may be others than those that are known, what has them all is not followed."""
    if name == "get":
        return Native(name, lambda run, call: get(run, value.context, call))
    if name in ("update", "setdefault"):
        return Native(name, lambda run, call: set_several(run, value.context, name, call))
    names = value.context.launch.names_of_configurations() if name in ("items", "keys", "values", "copy") else None
    if names is not None and len(run.heap.journals) <= value.context.depth:
        run.budget.take(len(names))
        every = {key: configuration(run, value.context, key, place) for key in names}
        return Native(name, lambda run, call: container_methods.ASKING[dict][name](run, every, call))
    return run.unknown(f"launch_configurations.{name} is not followed", place)


def get(run: ScriptEvaluation, context: Context, call: LibraryCall) -> Value:
    bound = call.bind("key default")
    name = bound.get("key")
    if isinstance(name, str) and context.launch.configuration(name) is None:
        return bound.get("default")
    return configuration(run, context, name, call.location)


def set_several(run: ScriptEvaluation, context: Context, name: str, call: LibraryCall) -> Value:
    """``update`` and ``setdefault`` of the launch configurations."""
    provided = call.args[0] if call.args else {}
    if name == "setdefault":
        if not isinstance(provided, str) or context.launch.configuration(provided) is None:
            set_configuration(run, context, provided, call.args[1] if len(call.args) > 1 else None)
        return run.unknown("what setdefault gives is not followed", call.location)
    if not isinstance(provided, dict) or call.unknown:
        context.launch.set_any_configuration()
        return None
    for key, value in (*provided.items(), *call.keywords.items()):
        run.budget.step()
        set_configuration(run, context, key, value)
    return None


def executed(run: ScriptEvaluation, action: Action, call: LibraryCall) -> Value:
    """``action.execute(context)`` or ``visit``: what is set counts; what else is done there is not followed."""
    context = call.args[0] if call.args else call.keywords.get("context")
    if isinstance(context, Context) and action.kind in ("let", "arg"):
        name = perform(run, context, action.get("name") or (), call.location)
        value = perform(run, context, action.get("value") or (), call.location) if action.kind == "let" else None
        if action.tests or action.kind == "arg":
            value = run.unknown("whether this is done is not known", call.location)
        if action.kind == "let" or not isinstance(name, str) or context.launch.configuration(name) is None:
            set_configuration(run, context, name, value)
        return None
    if isinstance(context, Context):
        context.launch.set_any_configuration()
    return run.unknown(f"what an action '{action.kind}' does when it is executed is not followed", call.location)


def perform_substitutions(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``launch.utilities.perform_substitutions(context, subs)``."""
    bound = call.bind("context subs")
    return perform(run, bound.get("context"), phrase(bound.get("subs")), call.location)


def normalized(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``normalize_to_list_of_substitutions``."""
    value = call.args[0] if call.args else None
    if isinstance(value, (Unknown, Maybe)):
        return run.unknown(why(value), call.location)
    return [Sub((part,), "TextSubstitution" if isinstance(part, str) else "Substitution") for part in phrase(value)]


def sub_attribute(run: ScriptEvaluation, value: Sub, name: str, place: Location) -> Value:
    """An attribute or a method of a substitution."""
    if name == "perform":
        return Native(
            name, lambda run, call: perform(run, call.bind("context").get("context"), value.phrase, call.location)
        )
    if name == "find" and value.name.startswith("FindPackage"):
        return Native(name, lambda run, call: found_package(run, value, call))
    if name == "text" and all(isinstance(part, str) for part in value.phrase):
        return text_of(value.phrase)
    if name == "variable_name" and len(value.phrase) == 1 and isinstance(value.phrase[0], Substitution):
        return [Sub(value.phrase[0].arguments[0], "TextSubstitution")] if value.phrase[0].arguments else []
    return run.unknown(f"{value.name}.{name} is not followed", place)


def found_package(run: ScriptEvaluation, value: Sub, call: LibraryCall) -> Value:
    """``FindPackageShare(…).find(package)``: the directory of the package that is asked for."""
    package = call.bind("package_name").get("package_name")
    marker = SHARE if value.name == "FindPackageShare" else PREFIX
    return marker.format(package) if isinstance(package, str) else run.unknown(why(package), call.location)
