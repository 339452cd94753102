# SPDX-License-Identifier: Apache-2.0
"""Launch files that include others."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci.launch.facts import includes, ros2
from haros_ci.launch.ros2.context import Context
from haros_ci.launch.ros2.outside import include_known
from haros_ci.launch.ros2.places import BY_SETUP
from haros_ci.model.architecture import Condition
from haros_ci.model.launch_actions import Action, Description
from haros_ci.substitutions.names import MARK, quoted, unknown

if TYPE_CHECKING:
    from haros_ci.launch.ros2.run import LaunchEvaluation

#: What an include costs beside its actions; 300 of them are many for one launch.
STEPS = 100


def include(run: LaunchEvaluation, action: Action, conditions: tuple[Condition, ...]) -> None:
    """IncludeLaunchDescription: perform the file in the scope that it is included in."""
    context = run.context
    context.spend(STEPS + len(context.scope.configurations) // 4)
    phrase = action.get("file")
    file = context.text(phrase) if phrase is not None else unknown("no file is named")
    passed = [(context.text(name), value) for name, value in action.arguments]
    includes.named(context, action, file)
    if not file.known:
        shown = quoted(file.raw) if file.raw.strip(MARK) else "a launch file by a path that is not known"
        message = f"includes {shown}: {file.reasons[0]}; what it starts is unknown"
        includes.lost(context, action, file, message)
        return
    place = context.places.find(file.raw)
    if place.path is None and place.outside and include_known(run, action, file, passed, conditions):
        return
    if place.path is None:
        includes.lost(context, action, file, f"includes {quoted(file.raw)}: {place.reason}; what it starts is unknown")
        return
    if not context.places.files.has(place.path) and context.places.may_be_installed(place.path):
        message = f"includes {place.path}, which {BY_SETUP}; what it starts is unknown"
        includes.lost(context, action, file, message)
        return
    if not context.places.files.has(place.path):
        message = f"includes {place.path}, which is not in the workspace; correct the path"
        includes.lost(context, action, file, message, certain=True)
        return
    found = run.description(place.path)
    if found is None:
        message = f"includes {place.path}, which is no ROS 2 launch file; correct the path"
        includes.lost(context, action, file, message)
        return
    run.included.add(place.path)
    for name, value in passed:
        if name.known:
            made = context.scope.configurations[name.raw] = context.text(value)
            ros2.given(context, name.raw, made)
            ros2.named(context, made, action.location, "value", name.raw)
    link = (place.path, tuple(sorted(context.scope.configurations.items(), key=lambda item: item[0])))
    if link in run.chain:
        message = f"includes {place.path}, which includes this again, without end; break the cycle"
        context.problem(action.location, message)
        return
    missing = _missing(context, action, place.path, found, {name.raw for name, _ in passed})
    statics = includes.statics_of(run.load, context.places)
    includes.followed(context, action, statics, file, place.path, (name for name, _ in passed), missing)
    outer, context.included = context.included, context.facts.chain(context.included, action.location)
    run.inside(place.path, found.actions, conditions)
    context.included = outer


def _missing(context: Context, action: Action, path: str, found: Description, passed: set[str]) -> list[str]:
    """Launch refuses an include without an argument that has no default, even where it is set around it."""
    names: list[str] = []
    for child in found.actions:
        name = child.get("name")
        if child.kind != "arg" or child.tests or child.get("default") is not None or name is None:
            continue
        text = context.text(name)
        if text.known and text.raw not in passed and MARK not in "".join(passed):
            what = f"includes {path} without its argument {quoted(text.raw)}, which has no default; pass it"
            context.problem(action.location, what, certain=True)
            names.append(text.raw)
    return names
