# SPDX-License-Identifier: Apache-2.0
"""ROS 2 launch descriptions performed as launch and launch_ros do: which nodes start, and with what."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from haros_ci.launch.facts import includes
from haros_ci.launch.facts.includes import statics_of
from haros_ci.launch.facts.memory import Memo, steps_for, take
from haros_ci.launch.ros2.assuming import assumed_problems
from haros_ci.launch.ros2.context import Context, LaunchBudgetExhausted
from haros_ci.launch.ros2.places import Places
from haros_ci.launch.ros2.run import LaunchEvaluation
from haros_ci.model.environment import key_of, lost_of
from haros_ci.model.launch import LaunchedSystem
from haros_ci.model.launch_actions import Description
from haros_ci.model.location import Location
from haros_ci.model.workspace import Workspace
from haros_ci.substitutions.names import literal, quoted, unknown
from haros_ci.substitutions.presence import LaunchArguments


def launch_system(
    paths: Sequence[str],
    workspace: Workspace,
    load: Callable[[str], Description | None],
    arguments: Mapping[str, str],
    environment: Mapping[str, str],
    shares: Places,
    memo: Memo | None = None,
    alternatives: bool = False,
) -> LaunchedSystem:
    """What the launch files at *paths*, root-relative, start together, in order.

    *load* gives the description of a launch file in any dialect, None where there is none; *arguments* are set as on
    the command line, *environment* is all that ``$(env)`` sees, *shares* finds files by the places they are installed
    in. What launch refuses is left out with a problem; what stays undecided is kept with its condition. With a *memo*
    what has been launched before is not launched again. With *alternatives* all has its presence, and what is started
    with other launch arguments is in the result, too.
    """
    key = (tuple(paths), tuple(sorted(arguments.items())), key_of(environment), alternatives)
    if memo is not None and key in memo:
        before: LaunchedSystem = memo[key]
        return before
    seen = {name: literal(value) for name, value in sorted(environment.items())}
    context = Context(shares, seen | {name: unknown(reason) for name, reason in sorted(lost_of(environment).items())})
    steps, spare = steps_for(memo, context.steps), steps_for(memo, context.spare)
    context.steps, context.spare = steps, spare
    provided = {name: literal(value) for name, value in sorted(arguments.items())}
    run = LaunchEvaluation(context, load, frozenset(provided))
    if alternatives:
        context.arguments = LaunchArguments()
    try:
        for path in paths:
            run.file(path, provided)
            run.events()
    except LaunchBudgetExhausted:
        message = "the launch files start and include more than can be evaluated; what is left is unknown"
        context.problem(Location(paths[0]) if paths else None, message)
        context.facts.is_open = True
    for name in provided:
        if name not in run.declared and paths:
            context.problem(Location(paths[0]), f"argument {quoted(name)} is set, but not declared; correct its name")
    system = LaunchedSystem(
        nodes=tuple(run.nodes),
        arguments=tuple((name, text.shown) for name, text in run.arguments.items()),
        files=tuple(sorted(context.files)),
        includes=tuple(sorted(run.included)),
        problems=(*context.problems, *assumed_problems(run)),
        alternatives=tuple(run.alternatives),
        facts=includes.finished(context, statics_of(load, shares)),
    )
    take(memo, steps - max(context.steps, 0) + spare - max(context.spare, 0))
    if memo is not None:
        memo[key] = system
    return system
