# SPDX-License-Identifier: Apache-2.0
"""OpaqueFunction and ForEach: a function of the launch file that is interpreted when its context is known."""

from __future__ import annotations

from collections.abc import Callable

from haros_ci.launch.python import written_files
from haros_ci.launch.python.conditions import tests_of
from haros_ci.launch.python.contexts import perform
from haros_ci.launch.python.entities import actions_of, call_opaque, doubted, unknown_action
from haros_ci.launch.python.files import yaml_data
from haros_ci.launch.python.heap import ScriptBudgetExhausted
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import Context, LaunchObject, LibraryCall, Value, phrase, why
from haros_ci.model.launch_actions import Action, LaunchContext


def opaque(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """OpaqueFunction: the actions that its function returns."""
    return later(run, call, lambda context: call_opaque(run, call, context))


def for_each(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """ForEach: its function is called for each part of a text between semicolons, with that map's keys."""
    bound = call.bind("input_values * function")

    def actions(context: Context) -> tuple[Action, ...]:
        text = perform(run, context, phrase(bound.get("input_values")), call.location)
        if not isinstance(text, str):
            return (unknown_action(why(text), call.location),)
        result: list[Action] = []
        for part in text.split(";")[:200]:
            data = yaml_data(run, part, call) if part.strip() else {}
            if not isinstance(data, dict) or not all(isinstance(key, str) for key in data):
                return (unknown_action("the parts of ForEach are no maps", call.location),)
            if data:
                value = run.call(
                    run, bound.get("function"), LibraryCall(name="ForEach", location=call.location, keywords=data)
                )
                result.extend(actions_of(run, value, call.location))
        return tuple(result)

    return later(run, call, actions)


def later(run: ScriptEvaluation, call: LibraryCall, actions: Callable[[Context], tuple[Action, ...]]) -> Value:
    """An action whose function has a budget of its own; what it changes counts within it alone."""

    def function(context: LaunchContext) -> tuple[Action, ...]:
        frames, places = run.frames, run.places
        run.frames, run.places = [], dict(places)
        modules, first, last = run.modules, run.first, run.last  # those that are imported here are undone with the rest
        run.modules, run.first, run.last = dict(modules), list(first), list(last)
        run.budget.restart()
        journal = run.heap.open()
        try:
            known = set(run.doubts)
            made = actions(Context(context, len(run.heap.journals)))
            made = (*written_files.actions(run), *made)
            return doubted(run, made, call.location) if set(run.doubts) != known else made
        except (ScriptBudgetExhausted, RecursionError) as error:
            reason = str(error) if isinstance(error, ScriptBudgetExhausted) else "it is nested too deep"
            return (unknown_action(f"{call.name.rpartition('.')[2]}: {reason}", call.location),)
        finally:
            run.heap.close(journal)
            run.frames, run.places = frames, places
            run.modules, run.first, run.last = modules, first, last

    tests = tests_of(call.keywords.get("condition"), call.location)
    return LaunchObject(
        call.name, call.location, {}, Action(kind="opaque", location=call.location, function=function, tests=tests)
    )
