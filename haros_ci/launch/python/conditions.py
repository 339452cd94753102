# SPDX-License-Identifier: Apache-2.0
"""Summaries of ``launch.conditions``, and the tests that a condition stands for."""

from __future__ import annotations

from haros_ci.launch.python.builtin_functions import Summary
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import Choice, LaunchObject, LibraryCall, Unknown, Value, phrase, why
from haros_ci.model.launch_actions import Test
from haros_ci.model.location import Location


def boolean(kind: str) -> Summary:
    def summary(run: ScriptEvaluation, call: LibraryCall) -> Value:
        bound = call.bind("predicate_expression")
        if "predicate_expression" not in bound:
            return run.unknown("the condition has no expression", call.location)
        value = bound["predicate_expression"]
        if isinstance(value, Unknown):
            test = Test(kind="?", text=call.text, location=call.location, reason=value.reason)
        else:
            test = Test(kind=kind, phrases=(phrase(value),), text=call.text, location=call.location)
        return LaunchObject(call.name, call.location, {"test": test})

    return summary


def configuration(kind: str) -> Summary:
    def summary(run: ScriptEvaluation, call: LibraryCall) -> Value:
        bound = call.bind("launch_configuration_name expected_value")
        name, expected = bound.get("launch_configuration_name"), bound.get("expected_value")
        test = Test(kind=kind, phrases=(phrase(name), phrase(expected)), text=call.text, location=call.location)
        if expected is None or isinstance(name, Unknown):
            reason = "whether a launch configuration is not set is not followed" if expected is None else why(name)
            test = Test(kind="?", text=call.text, location=call.location, reason=reason)
        return LaunchObject(call.name, call.location, {"test": test})

    return summary


def predicate(run: ScriptEvaluation, call: LibraryCall) -> Value:
    test = Test(kind="?", text=call.text, location=call.location, reason="a condition in Python is not followed")
    return LaunchObject(call.name, call.location, {"test": test})


def tests_of(value: Value, place: Location) -> tuple[Test, ...]:
    """The tests of ``condition=value``; none for None."""
    if value is None:
        return ()
    if isinstance(value, LaunchObject) and isinstance(value.fields.get("test"), Test):
        return (value.fields["test"],)
    if isinstance(value, Choice) and all(item is None or isinstance(item, LaunchObject) for _, item in value.options):
        return (Test(kind="?", text="condition", location=place, reason=value.reason),)
    return (Test(kind="?", text="condition", location=place, reason=why(value)),)


SUMMARIES: dict[str, Summary] = {
    "launch.conditions.IfCondition": boolean("if"),
    "launch.conditions.UnlessCondition": boolean("unless"),
    "launch.conditions.LaunchConfigurationEquals": configuration("equals"),
    "launch.conditions.LaunchConfigurationNotEquals": configuration("not-equals"),
    "launch.Condition": predicate,
}
