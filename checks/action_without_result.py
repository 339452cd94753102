# SPDX-License-Identifier: Apache-2.0
"""Ways through the execution of an action's goal that end without its outcome."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, Location, Project, syntax
from haros_ci.api.code import (
    Codebase,
    Routine,
    callbacks,
    called,
    calls_of,
    dotted,
    given_function,
    in_callbacks,
    last_part,
    nodes,
    type_name,
    undone_ways,
)

#: What sets a goal's outcome: rclcpp_action and rclpy (methods of the goal handle), actionlib (methods of the server).
OUTCOMES = frozenset(
    "succeed abort canceled setSucceeded setAborted setPreempted setRejected setCanceled set_succeeded set_aborted "
    "set_preempted terminate terminate_all terminate_current succeeded_current".split()
)
HANDLES = ("rclcpp_action::ServerGoalHandle", "rclcpp_action::ServerGoalHandleBase")


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    seen = {
        id(each.routine) for each in in_callbacks(code) if each.callback.kind == "timer"
    }  # it goes on at the next tick
    for routine, why in _executing(code):
        if id(routine) in seen or routine.is_test:
            continue
        seen.add(id(routine))
        names = frozenset(parameter.name for parameter in routine.function.parameters)
        if not any(last_part(call.callee) in OUTCOMES for call in code.body(routine).calls):
            continue

        def does(expression: syntax.Expression, routine: Routine = routine, names: frozenset[str] = names) -> bool:
            return _does(code, routine, expression, names)

        function = routine.function
        ways = undone_ways(function.body or (), does, (function.line, function.column), names)
        if ways:
            yield Finding(
                at=Location(routine.path, function.line, function.column),
                message=f"{routine.title} executes an action goal, but one of its paths neither succeeds nor aborts nor cancels "
                f"the goal: {why}; set the final state on every path",
                about=(routine.title,),
                related=tuple(
                    (Location(routine.path, *way), "this path returns without a final state") for way in ways
                ),
            )


def _executing(code: Codebase) -> Iterator[tuple[Routine, str]]:
    """The routines that execute goals, and what becomes of a goal without an outcome."""
    for callback in callbacks(code):
        if callback.kind == "action" and callback.maker.is_python and callback.role in ("3", "execute_callback"):
            yield callback.routine, "rclpy logs a warning and aborts the goal"
    for path in sorted(code.mentioning("GoalHandle")):
        for routine in code.routines(path):
            if not routine.is_python and routine.function.kind != "lambda" and _takes_handle(code, routine):
                yield routine, "the goal ends as canceled, with an empty result"
    for maker, call in calls_of(code, "SimpleActionServer"):
        if maker.is_python and dotted(code, maker, call.callee).startswith("actionlib."):
            value = call.argument(2, "execute_cb")
            for routine in given_function(code, maker, value) if value is not None else ():
                yield routine, "actionlib logs a warning and aborts the goal"


def _takes_handle(code: Codebase, routine: Routine) -> bool:
    """Whether it is given a goal handle of rclcpp_action, and is not the one that accepts or cancels goals."""
    if (
        routine.function.returns.name != "void"
    ):  # what is asked whether to accept or cancel, or is called again and again
        return False
    parameters = (parameter for parameter in routine.function.parameters if parameter.name)
    return any(type_name(code, routine, syntax.Name(each.name)) in HANDLES for each in parameters)


def _does(
    code: Codebase, routine: Routine, expression: syntax.Expression, names: frozenset[str], depth: int = 2
) -> bool:
    """Whether *expression* sets the outcome, or may: it hands the goal on, or calls what sets it."""
    for node in nodes(expression):
        if isinstance(node, syntax.Lambda) or (isinstance(node, syntax.Assignment) and _is_handed(node.value, names)):
            return True
        if not isinstance(node, syntax.Call):
            continue
        if last_part(node.callee) in OUTCOMES or any(_is_handed(each, names) for each in node.arguments):
            return True
        for target in called(code, routine, node) if depth else ():
            if any(_does(code, target, call.whole, frozenset(), depth - 1) for call in code.body(target).calls):
                return True
    return False


def _is_handed(value: syntax.Expression, names: frozenset[str]) -> bool:
    """Whether *value* is the goal or its handle itself: *names* are the function's parameters."""
    while isinstance(value, (syntax.Dereference, syntax.Address, syntax.Keyword, syntax.Cast, syntax.Star)):
        value = value.value
    return isinstance(value, syntax.Name) and value.name in names


CHECK = Check(
    id="action-without-result",
    summary="Execution path of an action goal without a final state.",
    level=Level.WARNING,
    decidability=Decidability.EXACT,
    tags=("code", "actions"),
    project=check,
)
