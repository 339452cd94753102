# SPDX-License-Identifier: Apache-2.0
"""Summaries of ``launch.LaunchDescription``, ``launch.actions`` and ``launch.launch_description_sources``."""

from __future__ import annotations

from typing import Any

from haros_ci.launch.python.builtin_functions import Summary, nothing
from haros_ci.launch.python.conditions import SUMMARIES as CONDITIONS
from haros_ci.launch.python.conditions import tests_of
from haros_ci.launch.python.contexts import normalized, perform_substitutions
from haros_ci.launch.python.entities import DESCRIPTION, description
from haros_ci.launch.python.opaque import for_each, opaque
from haros_ci.launch.python.phrases import flag, pair_of, phrases_of, words
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.sequences import items_of
from haros_ci.launch.python.substitutions import pairs
from haros_ci.launch.python.values import LaunchObject, LibraryCall, Unknown, Value, merged, mystery, phrase, why
from haros_ci.model.launch_actions import Action, Phrase
from haros_ci.regex import regex


def launch_description(run: ScriptEvaluation, call: LibraryCall) -> Value:
    bound = call.bind("initial_entities")
    provided = bound.get("initial_entities")
    items: list[Value] | Unknown = [] if provided is None else items_of(run, provided, call.location)
    return description(call.location, [items] if isinstance(items, Unknown) else items)


def simple(kind: str, names: str, attributes: str = "") -> Summary:
    """An action of *kind* whose phrases are the parameters *names*, called *attributes* there."""
    requested = names.replace("*", " ").split()
    called = attributes.split() or requested

    def summary(run: ScriptEvaluation, call: LibraryCall) -> Value:
        bound = call.bind(names)
        found = phrases_of(bound, tuple(zip(requested, called, strict=True)), call)
        return LaunchObject(
            call.name,
            call.location,
            {},
            Action(
                kind=kind, location=call.location, phrases=found, tests=tests_of(bound.get("condition"), call.location)
            ),
        )

    return summary


def unsupported(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return run.unknown(f"{call.name.rpartition('.')[2]} is not followed", call.location)


def declared(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """DeclareLaunchArgument; each of its choices is a phrase."""
    bound = call.bind("name * default_value description choices")
    found = phrases_of(bound, (("name", "name"), ("default_value", "default")), call)
    choices = bound.get("choices")
    if isinstance(choices, (list, tuple)):
        found = (*found, *(("choices", phrase(item)) for item in choices))
    return LaunchObject(
        call.name,
        call.location,
        {"name": bound.get("name")},
        Action(
            kind="arg", location=call.location, phrases=found, tests=tests_of(bound.get("condition"), call.location)
        ),
    )


def declared_boolean(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """moveit_configs_utils' DeclareBooleanLaunchArg: its default is the text of a bool."""
    bound = call.bind("name * default_value description")
    keywords = {**bound, "default_value": text_default(bound.get("default_value", False))}
    keywords["choices"] = ["true", "false", "True", "False"]
    return declared(run, LibraryCall(name=call.name, location=call.location, keywords=keywords))


def text_default(value: Value) -> Value:
    return str(value) if isinstance(value, (bool, int, str)) else value


def group(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """GroupAction: its children are those that the list has in the end."""
    bound = call.bind("actions * scoped forwarding launch_configurations")
    provided = bound.get("launch_configurations")
    action = Action(
        kind="group",
        location=call.location,
        tests=tests_of(bound.get("condition"), call.location),
        phrases=tuple((name, flag(bound[name])) for name in ("scoped", "forwarding") if name in bound),
        arguments=pairs(run, provided, call) if provided is not None else (),
    )
    return LaunchObject(call.name, call.location, {"children": bound.get("actions")}, action)


def source(run: ScriptEvaluation, call: LibraryCall) -> Value:
    bound = call.bind("launch_file_path")
    return LaunchObject("launch.LaunchDescriptionSource", call.location, {"path": bound.get("launch_file_path")})


def given_source(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return LaunchObject(
        "launch.LaunchDescriptionSource",
        call.location,
        {"description": call.bind("launch_description").get("launch_description")},
    )


def include(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """IncludeLaunchDescription of a file, or of a launch description that is made here."""
    bound = call.bind("launch_description_source * launch_arguments")
    provided = bound.get("launch_description_source")
    tests = tests_of(bound.get("condition"), call.location)
    arguments = include_arguments(run, bound.get("launch_arguments"), call)
    if isinstance(provided, LaunchObject) and "description" in provided.fields:
        provided = provided.fields["description"]
    if isinstance(provided, LaunchObject) and provided.name == DESCRIPTION:
        lets = [
            LaunchObject(
                "let",
                call.location,
                {},
                Action(kind="let", location=call.location, phrases=(("name", name), ("value", value))),
            )
            for name, value in arguments
        ]
        return LaunchObject(
            call.name,
            call.location,
            {"children": [*lets, provided]},
            Action(kind="list", location=call.location, tests=tests),
        )
    path = provided.fields.get("path") if isinstance(provided, LaunchObject) else provided
    if path is None:
        path = Unknown(why(provided) if provided is not None else "it includes nothing", call.location)
    return LaunchObject(
        call.name,
        call.location,
        {},
        Action(
            kind="include", location=call.location, phrases=(("file", phrase(path)),), arguments=arguments, tests=tests
        ),
    )


def include_arguments(run: ScriptEvaluation, value: Value, call: LibraryCall) -> tuple[tuple[Phrase, Phrase], ...]:
    if value is None:
        return ()
    lost = (mystery(why(value), call.location),)
    if isinstance(value, dict):
        return ((lost, lost),)
    items = items_of(run, value, call.location)
    return ((lost, lost),) if isinstance(items, Unknown) else tuple(pair_of(item, call) for item in items)


#: What is more than one command, or more than its words.
_SHELL = regex(r"[;&|<>`\n]|\$\((?!find-pkg|workspace)")


def process(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """ExecuteProcess: its command's words with a blank between them."""
    bound = call.bind("* cmd prefix name cwd env additional_env")
    cmd = bound.get("cmd")
    line = words(run, cmd, call)
    if bound.get("shell") is True and isinstance(cmd, (list, tuple)):  # it is joined, and parted by the shell
        joined = merged(part for item in cmd for part in (*phrase(item), " "))
        line = line if any(isinstance(part, str) and _SHELL.search(part) for part in joined) else joined
    found: list[tuple[str, Phrase]] = [("cmd", line)]
    found += [
        (called, phrase(bound[name]))
        for name, called in (("name", "name"), ("prefix", "launch-prefix"))
        if bound.get(name)
    ]
    environment = tuple(pair for name in ("env", "additional_env") for pair in pairs(run, bound.get(name), call))
    return LaunchObject(
        call.name,
        call.location,
        {"on_exit": bound.get("on_exit")},
        Action(
            kind="executable",
            location=call.location,
            phrases=tuple(found),
            environment=environment,
            tests=tests_of(bound.get("condition"), call.location),
        ),
    )


def reset(run: ScriptEvaluation, call: LibraryCall) -> Value:
    bound = call.bind("launch_configurations")
    return LaunchObject(
        call.name,
        call.location,
        {},
        Action(
            kind="reset",
            location=call.location,
            arguments=pairs(run, bound.get("launch_configurations"), call),
            tests=tests_of(bound.get("condition"), call.location),
        ),
    )


def timer(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """TimerAction and RosTimer: what they do later."""
    bound = call.bind("* period actions")
    period = phrase(bound.get("period"))
    shown = "".join(part if isinstance(part, str) else "?" for part in period)
    return LaunchObject(
        call.name,
        call.location,
        {"children": bound.get("actions")},
        Action(
            kind="event",
            location=call.location,
            deferred=f"after {shown} s",
            tests=tests_of(bound.get("condition"), call.location),
        ),
    )


def emitted(run: ScriptEvaluation, call: LibraryCall) -> Value:
    bound: dict[str, Any] = call.bind("* event")
    event = bound.get("event")
    shutdown = isinstance(event, LaunchObject) and event.name.endswith("Shutdown")
    return LaunchObject(
        call.name,
        call.location,
        {},
        Action(
            kind="shutdown" if shutdown else "log",
            location=call.location,
            tests=tests_of(bound.get("condition"), call.location),
        ),
    )


A = "launch.actions."
S = "launch.launch_description_sources."
SUMMARIES: dict[str, Summary] = {
    **CONDITIONS,
    DESCRIPTION: launch_description,
    f"{A}DeclareLaunchArgument": declared,
    "moveit_configs_utils.launch_utils.DeclareBooleanLaunchArg": declared_boolean,
    f"{A}SetLaunchConfiguration": simple("let", "name value"),
    f"{A}UnsetLaunchConfiguration": unsupported,
    f"{A}SetEnvironmentVariable": simple("set-env", "name value"),
    f"{A}AppendEnvironmentVariable": simple("append-env", "name value"),
    f"{A}UnsetEnvironmentVariable": simple("unset-env", "name"),
    f"{A}ResetEnvironment": simple("reset-env", ""),
    f"{A}ResetLaunchConfigurations": reset,
    f"{A}PushLaunchConfigurations": unsupported,
    f"{A}PopLaunchConfigurations": unsupported,
    f"{A}PushEnvironment": unsupported,
    f"{A}PopEnvironment": unsupported,
    f"{A}GroupAction": group,
    f"{A}IncludeLaunchDescription": include,
    f"{A}ExecuteProcess": process,
    f"{A}ExecuteLocal": unsupported,
    f"{A}LogInfo": simple("log", ""),
    f"{A}Shutdown": simple("shutdown", ""),
    f"{A}EmitEvent": emitted,
    f"{A}UnregisterEventHandler": simple("log", ""),
    f"{A}OpaqueCoroutine": unsupported,
    f"{A}OpaqueFunction": opaque,
    f"{A}ForEach": for_each,
    f"{A}TimerAction": timer,
    f"{S}PythonLaunchDescriptionSource": source,
    f"{S}XMLLaunchDescriptionSource": source,
    f"{S}YAMLLaunchDescriptionSource": source,
    f"{S}AnyLaunchDescriptionSource": source,
    f"{S}FrontendLaunchDescriptionSource": source,
    "launch_xml.launch_description_sources.XMLLaunchDescriptionSource": source,
    "launch_yaml.launch_description_sources.YAMLLaunchDescriptionSource": source,
    "launch.LaunchDescriptionSource": given_source,
    "launch.utilities.perform_substitutions": perform_substitutions,
    "launch.utilities.normalize_to_list_of_substitutions": normalized,
    "launch.logging.get_logger": nothing,
    "launch_testing.actions.ReadyToTest": simple("log", ""),
    "launch_testing.util.KeepAliveProc": simple("log", ""),
    "launch_testing.actions.GTest": simple("log", ""),
    "launch_testing.actions.PyTest": simple("log", ""),
}
