# SPDX-License-Identifier: Apache-2.0
"""Summaries of ``launch_ros``: nodes, containers, and what is set for those that follow."""

from __future__ import annotations

from haros_ci.launch.python.builtin_functions import Summary
from haros_ci.launch.python.conditions import tests_of
from haros_ci.launch.python.launch_actions import simple, timer
from haros_ci.launch.python.parameters import entry, of_values, remaps, source, sources
from haros_ci.launch.python.phrases import INTERPRETER, flag, phrases_of, words
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.substitutions import pairs
from haros_ci.launch.python.values import LaunchObject, LibraryCall, Unknown, Value, merged, phrase
from haros_ci.model.launch_actions import Action, ParameterSource, Phrase, Substitution, Test

NODE = "* executable package name namespace exec_name parameters remappings ros_arguments arguments"
COMMON = (
    ("package", "package"),
    ("executable", "executable"),
    ("name", "name"),
    ("namespace", "namespace"),
    ("exec_name", "exec_name"),
    ("prefix", "launch-prefix"),
)


def started(kind: str) -> Summary:
    """A node of *kind* (launch_ros/actions/node.py); without an executable it is not known what it is."""

    def summary(run: ScriptEvaluation, call: LibraryCall) -> Value:
        bound = renamed(run, call.bind(NODE), call)
        if call.args and isinstance(call.args[0], Unknown):
            return run.unknown(call.args[0].reason, call.location)
        if bound.get("executable") is None:
            return run.unknown(call.unknown or f"{call.name} is given no executable", call.location)
        if bound["executable"] == INTERPRETER:
            bound["executable"] = "python3"
        found = list(phrases_of(bound, COMMON, call))
        for name, called in (("arguments", "args"), ("ros_arguments", "ros_args")):
            if bound.get(name) is not None:
                found.append((called, words(run, bound[name], call)))
        if kind == "container":
            run.containers += 1
            found.append(("handle", (f"{call.location.path}:{run.containers}",)))
        if "respawn" in bound:
            found.append(("respawn", flag(bound["respawn"])))
        parameters = sources(run, bound.get("parameters"), call.location)
        if call.unknown and "parameters" not in bound:
            parameters = (ParameterSource(kind="?", location=call.location, reason=call.unknown),)
        action = Action(
            kind=kind,
            location=call.location,
            phrases=tuple(found),
            parameters=parameters,
            remaps=remaps(run, bound.get("remappings"), call),
            environment=tuple(pair for name in ("env", "additional_env") for pair in pairs(run, bound.get(name), call)),
            tests=tests_of(bound.get("condition"), call.location),
            deprecated=dropped(bound),
        )
        fields = {"on_exit": bound.get("on_exit")}
        if kind == "container":
            fields["components"] = bound.get("composable_node_descriptions")
        return LaunchObject(call.name, call.location, fields, action)

    return summary


def renamed(run: ScriptEvaluation, bound: dict[str, Value], call: LibraryCall) -> dict[str, Value]:
    """*bound* under today's names; with a name that launch_ros has dropped after Foxy the file may be refused."""
    for name in ("executable", "plugin", "name", "namespace"):
        old = f"node_{name}"
        if bound.get(old) is not None and bound.get(name) is None:
            bound[name] = bound[old]
            text = f"launch_ros takes {old}= (it does up to ROS 2 Foxy)"
            run.doubts.setdefault(text, Test(kind="?", text=text, location=call.location, reason=text))
    return bound


def dropped(bound: dict[str, Value]) -> tuple[tuple[str, str], ...]:
    """The names among *bound* that launch_ros has dropped, with today's."""
    names = ("executable", "plugin", "name", "namespace")
    return tuple((f"node_{name}=", f"{name}=") for name in names if bound.get(f"node_{name}") is not None)


def component(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """ComposableNode (launch_ros/descriptions/composable_node.py)."""
    names = "* package plugin name namespace parameters remappings extra_arguments condition"
    bound = renamed(run, call.bind(names), call)
    if bound.get("plugin") is None or (bound.get("package") is None and not call.unknown):
        return run.unknown(call.unknown or "a ComposableNode is given no package or no plugin", call.location)
    shown = (("package", "package"), ("plugin", "plugin"), ("name", "name"), ("namespace", "namespace"))
    return LaunchObject(
        call.name,
        call.location,
        {},
        Action(
            kind="component",
            location=call.location,
            phrases=phrases_of(bound, shown, call),
            parameters=sources(run, bound.get("parameters"), call.location),
            remaps=remaps(run, bound.get("remappings"), call),
            tests=tests_of(bound.get("condition"), call.location),
            deprecated=dropped(bound),
        ),
    )


def load(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """LoadComposableNodes: into a container by its name, or by the action that starts it."""
    bound = call.bind("* composable_node_descriptions target_container")
    target = bound.get("target_container")
    handle = target.action.get("handle") if isinstance(target, LaunchObject) and target.action is not None else None
    return LaunchObject(
        call.name,
        call.location,
        {"components": bound.get("composable_node_descriptions")},
        Action(
            kind="load",
            location=call.location,
            phrases=(("target", target_name(target)), *((("handle", handle),) if handle else ())),
            tests=tests_of(bound.get("condition"), call.location),
        ),
    )


def target_name(target: Value) -> Phrase:
    """The name of a container; that of an action is in its namespace, and so in the one that is pushed."""
    if not isinstance(target, LaunchObject) or target.action is None:
        return phrase(target)
    name, space = target.action.get("name") or (), target.action.get("namespace") or ()
    own = merged((*space, "/", *name)) if space else name
    if own and isinstance(own[0], str) and own[0].startswith("/"):
        return own
    if space and not isinstance(space[0], str):
        return own
    pushed = Substitution("var", (("ros_namespace",), ()), target.location)
    return merged((pushed, "/", *own))


def set_remap(run: ScriptEvaluation, call: LibraryCall) -> Value:
    bound = call.bind("src dst")
    pair = (phrase(bound.get("src")), phrase(bound.get("dst")), call.location)
    return LaunchObject(
        call.name,
        call.location,
        {},
        Action(
            kind="set-remap",
            location=call.location,
            remaps=(pair,),
            tests=tests_of(bound.get("condition"), call.location),
        ),
    )


def set_parameter(run: ScriptEvaluation, call: LibraryCall) -> Value:
    bound = call.bind("name value")
    made = of_values((entry(run, phrase(bound.get("name")), bound.get("value"), call.location),), call.location)
    return LaunchObject(
        call.name,
        call.location,
        {},
        Action(
            kind="set-parameter",
            location=call.location,
            parameters=(made,),
            tests=tests_of(bound.get("condition"), call.location),
        ),
    )


def set_parameters_from_file(run: ScriptEvaluation, call: LibraryCall) -> Value:
    bound = call.bind("filename")
    return LaunchObject(
        call.name,
        call.location,
        {},
        Action(
            kind="set-parameters-from-file",
            location=call.location,
            parameters=(source(run, bound.get("filename"), call.location),),
            tests=tests_of(bound.get("condition"), call.location),
        ),
    )


def set_use_sim_time(run: ScriptEvaluation, call: LibraryCall) -> Value:
    bound = call.bind("value")
    return LaunchObject(
        call.name,
        call.location,
        {},
        Action(
            kind="set-use-sim-time",
            location=call.location,
            phrases=(("value", flag(bound.get("value"))),),
            tests=tests_of(bound.get("condition"), call.location),
        ),
    )


def parameter_file(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return LaunchObject(call.name, call.location, call.bind("param_file * allow_substs"))


def parameter_value(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return LaunchObject(call.name, call.location, call.bind("value * value_type"))


def parameter(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return LaunchObject(call.name, call.location, call.bind("name value * value_type"))


A = "launch_ros.actions."
SUMMARIES: dict[str, Summary] = {
    f"{A}Node": started("node"),
    f"{A}LifecycleNode": started("lifecycle-node"),
    f"{A}ComposableNodeContainer": started("container"),
    f"{A}LoadComposableNodes": load,
    f"{A}PushRosNamespace": simple("push-namespace", "namespace"),
    f"{A}PushROSNamespace": simple("push-namespace", "namespace"),
    f"{A}SetRemap": set_remap,
    f"{A}SetParameter": set_parameter,
    f"{A}SetParametersFromFile": set_parameters_from_file,
    f"{A}SetUseSimTime": set_use_sim_time,
    f"{A}SetROSLogDir": simple("log", ""),
    f"{A}RosTimer": timer,
    f"{A}ROSTimer": timer,
    f"{A}LifecycleTransition": simple("log", ""),
    "launch_ros.descriptions.ComposableNode": component,
    "launch_ros.descriptions.ParameterFile": parameter_file,
    "launch_ros.parameter_descriptions.ParameterFile": parameter_file,
    "launch_ros.descriptions.ParameterValue": parameter_value,
    "launch_ros.parameter_descriptions.ParameterValue": parameter_value,
    "launch_ros.descriptions.Parameter": parameter,
    "launch_ros.parameter_descriptions.Parameter": parameter,
}
