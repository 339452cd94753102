# SPDX-License-Identifier: Apache-2.0
"""What a launch description does where some launch arguments are assumed to be otherwise."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from haros_ci.launch.ros2 import presences
from haros_ci.launch.ros2.context import LaunchBudgetExhausted
from haros_ci.model.presence import Presence
from haros_ci.model.workspace import Problem
from haros_ci.substitutions.presence import Assumed

if TYPE_CHECKING:
    from haros_ci.launch.ros2.run import LaunchEvaluation

#: How many steps the outermost assumption may take.
MAX_ASSUMED = 150_000


def assume(run: LaunchEvaluation, assumed: Assumed, presence: Presence, work: Callable[[], None]) -> None:
    """Do *work* where launch arguments are as *assumed*; what it starts are alternatives, and all else is as before."""
    context, is_outermost = run.context, not run.assumptions
    here = (context.scope, context.assumed, context.presence, context.path, context.files, context.included)
    is_open = context.facts.is_open
    tables = (context.rewritten, context.rewritten_trees)
    ours = (run.nodes, run.arguments, run.declared, run.included, run.containers, run.chain, run.depth)
    context.scope, context.assumed, context.presence = context.scope.isolated(), assumed, presence
    context.files = set(context.files)
    context.rewritten, context.rewritten_trees = dict(context.rewritten), dict(context.rewritten_trees)
    run.nodes, run.arguments, run.declared = run.alternatives, dict(run.arguments), set(run.declared)
    run.included, run.containers, run.chain = set(run.included), dict(run.containers), list(run.chain)
    run.assumptions += 1
    try:
        with presences.spare(context, MAX_ASSUMED):
            work()
    except LaunchBudgetExhausted:
        if not is_outermost:
            raise
    finally:
        run.assumptions -= 1
        context.scope, context.assumed, context.presence, context.path, context.files, context.included = here
        context.facts.is_open = is_open
        context.rewritten, context.rewritten_trees = tables
        run.nodes, run.arguments, run.declared, run.included, run.containers, run.chain, run.depth = ours


def assumed_problems(run: LaunchEvaluation) -> list[Problem]:
    """What is wrong under assumptions alone, each with the first of them."""
    return [
        Problem(problem.path, f"{problem.message} (with {words})", problem.line)
        for problem, words in run.context.assumed_problems.items()
        if problem not in run.context.problems
    ]
