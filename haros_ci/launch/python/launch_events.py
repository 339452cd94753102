# SPDX-License-Identifier: Apache-2.0
"""Summaries of ``launch.event_handlers``, ``launch.events`` and RegisterEventHandler."""

from __future__ import annotations

from haros_ci.launch.python.builtin_functions import Summary
from haros_ci.launch.python.conditions import tests_of
from haros_ci.launch.python.entities import actions_of, deferred_actions
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import LaunchObject, LibraryCall, Unknown, Value
from haros_ci.model.launch_actions import Action


def handler(names: str, *reactions: str) -> Summary:
    """An event handler with the parameters *names*, of which *reactions* say what is done."""

    def summary(run: ScriptEvaluation, call: LibraryCall) -> Value:
        bound = call.bind(names)
        done = [bound[name] for name in reactions if bound.get(name) is not None]
        return LaunchObject(call.name, call.location, {"reactions": done})

    return summary


def registered(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """RegisterEventHandler: the handler's actions, which are conditional."""
    bound = call.bind("event_handler")
    provided = bound.get("event_handler")
    tests = tests_of(bound.get("condition"), call.location)
    if not isinstance(provided, LaunchObject) or "reactions" not in provided.fields:
        reason = provided.reason if isinstance(provided, Unknown) else "the event handler is not known"
        children = actions_of(run, Unknown(reason, call.location), call.location)
        return LaunchObject(
            call.name,
            call.location,
            {},
            Action(kind="event", location=call.location, children=children, deferred="event", tests=tests),
        )
    children = tuple(
        action for item in provided.fields["reactions"] for action in deferred_actions(run, item, provided.location, 0)
    )
    return LaunchObject(
        call.name,
        call.location,
        {},
        Action(
            kind="event",
            location=call.location,
            children=children,
            deferred=provided.name.rpartition(".")[2],
            tests=tests,
        ),
    )


def event(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return LaunchObject(call.name, call.location)


H = "launch.event_handlers."
SUMMARIES: dict[str, Summary] = {
    "launch.actions.RegisterEventHandler": registered,
    "launch.EventHandler": handler("* matcher entities handle_once", "entities"),
    f"{H}OnProcessExit": handler("* target_action on_exit", "on_exit"),
    f"{H}OnProcessStart": handler("* target_action on_start", "on_start"),
    f"{H}OnProcessIO": handler("* target_action on_stdin on_stdout on_stderr", "on_stdin", "on_stdout", "on_stderr"),
    f"{H}OnExecutionComplete": handler("* target_action on_completion", "on_completion"),
    f"{H}OnShutdown": handler("* on_shutdown", "on_shutdown"),
    f"{H}OnIncludeLaunchDescription": handler("*"),
    "launch_ros.event_handlers.OnStateTransition": handler("* entities target_lifecycle_node transition", "entities"),
    "launch.events.Shutdown": event,
    "launch.events.matches_action": event,
    "launch.events.process.ShutdownProcess": event,
    "launch.events.process.SignalProcess": event,
    "launch.events.process.ProcessStarted": event,
    "launch.events.process.ProcessExited": event,
    "launch.events.TimerEvent": event,
    "launch_ros.events.lifecycle.ChangeState": event,
    "launch_ros.events.lifecycle.StateTransition": event,
    "launch_ros.events.matchers.matches_node_name": event,
}
