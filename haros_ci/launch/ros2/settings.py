# SPDX-License-Identifier: Apache-2.0
"""Actions that set something in the launch context: configurations, environment, and what all nodes after them get."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from haros_ci.launch.ros2.context import NAMESPACE, Context, GlobalParameter, GlobalRemap, GroupScope
from haros_ci.launch.ros2.node import joined_namespace
from haros_ci.launch.ros2.parameters import performed_values
from haros_ci.launch.ros2.substitutions import truth_of
from haros_ci.model.architecture import Condition
from haros_ci.model.launch_actions import Action
from haros_ci.substitutions.names import Text, literal, quoted, unknown


def name_of(context: Context, action: Action) -> str | None:
    """The name that *action* sets; None, with a problem, if it is not known."""
    phrase = action.get("name")
    name = context.text(phrase) if phrase is not None else unknown("it has no name")
    if name.known:
        return name.raw
    context.problem(action.location, f"the name that is set here is not known: {name.reasons[0]}")
    if action.kind in ("let", "arg"):
        context.set_any_configuration()
    return None


def value_of(context: Context, action: Action) -> Text:
    """The value that *action* sets."""
    phrase = action.get("value")
    return literal("") if phrase is None else context.text(phrase)


def let(context: Context, action: Action) -> None:
    """SetLaunchConfiguration."""
    name = name_of(context, action)
    if name is not None:
        context.scope.configurations[name] = value_of(context, action)


def set_environment(context: Context, action: Action) -> None:
    """Set, append to or unset an environment variable, for ``$(env)`` and for what is started later."""
    name = name_of(context, action)
    environment = context.scope.environment
    if name is None:
        return
    if action.kind == "unset-env":
        environment.pop(name, None)
    elif action.kind == "set-env" or name not in environment:
        environment[name] = value_of(context, action)
    else:
        separator, prepend = action.get("separator"), action.get("prepend")
        between = literal(":") if separator is None else context.text(separator)
        parts = [environment[name], between, value_of(context, action)]
        if prepend is not None and truth_of(context.text(prepend)) is True:
            parts.reverse()
        raw = "".join(part.raw for part in parts)
        environment[name] = Text(raw, tuple(reason for part in parts for reason in part.reasons))


def reset_environment(context: Context, action: Action) -> None:
    """The environment as it was when launch began."""
    context.scope.environment = dict(context.initial)


def reset(context: Context, action: Action) -> None:
    """Clear the configurations, namespace, remaps and parameters of all nodes among them, but for those kept."""
    context.scope = GroupScope(kept(context, action), context.scope.environment)


def kept(context: Context, action: Action) -> dict[str, Text]:
    """The configurations that a group or reset sets itself."""
    pairs = [(context.text(name), context.text(value)) for name, value in action.arguments]
    return {name.raw: value for name, value in pairs if name.known}


def push_namespace(context: Context, action: Action) -> None:
    """Put a namespace below the present one; an absolute one replaces it."""
    phrase = action.get("namespace")
    configurations = context.scope.configurations
    own = context.text(phrase) if phrase is not None else None
    made = joined_namespace(context.get(NAMESPACE), own)
    if made is not None:
        configurations[NAMESPACE] = made


def set_remap(context: Context, action: Action) -> None:
    """Rules for all nodes that follow in this scope; as in launch, a list begun outside of it is changed for good."""
    scope = context.scope
    scope.remaps = [] if scope.remaps is None else scope.remaps
    for source, target, location in action.remaps:
        pair = (context.text(source), context.text(target))
        scope.remaps.append(GlobalRemap(*pair, location, presence=context.presence))


def set_parameter(context: Context, action: Action) -> None:
    """Parameters for all nodes that follow in this scope, with the same reservation as for remaps."""
    scope = context.scope
    scope.parameters = [] if scope.parameters is None else scope.parameters
    for source in action.parameters:
        single = replace(action, parameters=(source,))
        if source.kind == "file":
            made = GlobalParameter(single, (), context.text(source.path), presence=context.presence)
        else:
            made = GlobalParameter(single, performed_values(context, source), presence=context.presence)
        scope.parameters.append(made)


def doubt(context: Context, before: GroupScope, counts: tuple[int, int], conditions: tuple[Condition, ...]) -> None:
    """What has been set since *before* under *conditions* may be set, or not."""
    scope = context.scope
    reason = f"it depends on the condition {quoted(conditions[-1].condition)}, which is not decided"
    for one, other in (
        (before.configurations, scope.configurations),
        (before.environment, scope.environment),
    ):
        for name in dict.fromkeys((*one, *other)):
            if one.get(name) != other.get(name):
                other[name] = unknown(reason)
    remaps, parameters = scope.remaps or [], scope.parameters or []
    remaps[counts[0] :] = [replace(rule, conditions=(*conditions, *rule.conditions)) for rule in remaps[counts[0] :]]
    parameters[counts[1] :] = [
        replace(parameter, conditions=(*conditions, *parameter.conditions)) for parameter in parameters[counts[1] :]
    ]


SETTERS: Mapping[str, Callable[[Context, Action], None]] = {
    "let": let,
    "set-env": set_environment,
    "append-env": set_environment,
    "unset-env": set_environment,
    "reset": reset,
    "reset-env": reset_environment,
    "push-namespace": push_namespace,
    "set-remap": set_remap,
    "set-parameter": set_parameter,
    "set-parameters-from-file": set_parameter,
}
