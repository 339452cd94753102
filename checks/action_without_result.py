# SPDX-License-Identifier: Apache-2.0
"""Ways through the execution of an action's goal that end without its outcome."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from haros_ci.api import Check, Decidability, Finding, Level, Location, Project, listed, regex, syntax
from haros_ci.api.code import (
    Codebase,
    Routine,
    attribute_values,
    callbacks,
    called,
    callers,
    calls_of,
    dotted,
    given_function,
    in_callbacks,
    is_local,
    last_part,
    nodes,
    owner_of,
    type_name,
    undone_ways,
)

#: What sets a goal's outcome: rclcpp_action and rclpy (methods of the goal handle), actionlib (methods of the server).
OUTCOMES = frozenset(
    "succeed abort canceled setSucceeded setAborted setPreempted setRejected setCanceled set_succeeded set_aborted "
    "set_preempted terminate terminate_all terminate_current succeeded_current".split()
)
#: Those of a goal handle.
_ENDS = frozenset(("succeed", "abort", "canceled"))
#: Comments by which a goal is left to be aborted, and so many lines of a function that are read.
_ABORTS = regex(
    r"\b(?:otherwise|automatically|implicitly)\b[^.;()=]{0,60}\babort|\babort(?:s|ed)?\b[^.;()=]{0,60}\b(?:automatically|implicitly|by itself)\b",
    re.IGNORECASE,
)
_READ = 200
HANDLES = ("rclcpp_action::ServerGoalHandle", "rclcpp_action::ServerGoalHandleBase")


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    seen = {
        id(reached.routine) for reached in in_callbacks(code) if reached.callback.kind == "timer"
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
        is_ended = bool(ways) and _is_ended_elsewhere(code, routine)
        if ways and not routine.is_python and (is_ended or _is_step(code, routine)):
            continue  # it is called again and again, or waits
        if ways:
            yield Finding(
                at=Location(routine.path, function.line, function.column),
                message=f"{routine.title} executes an action goal, but {_ends(ways, (function.line, function.column))} "
                f"the goal: {why}; set the final state on every path",
                about=(routine.title,),
                level=Level.NOTE if is_ended or _is_meant(project, routine, ways) else None,
                related=tuple(
                    (Location(routine.path, *way), "this path returns without a final state")
                    for way in ways
                    if way != (function.line, function.column)
                ),
            )


def _ends(ways: Iterable[tuple[int, int]], begin: tuple[int, int]) -> str:
    """What the paths leave undone, and where they end, by their lines; *begin* stands for the end of the function, whose line is not known."""
    lines = [str(line) for line in dict.fromkeys(way[0] for way in ways if way != begin)]
    if begin in ways:
        if not lines:
            return "the path that reaches the end of the function neither succeeds nor aborts nor cancels"
        in_lines = f"in line {lines[0]}" if len(lines) == 1 else f"in lines {listed(lines)}"
        return f"the paths that end {in_lines} and at the end of the function neither succeed nor abort nor cancel"
    if len(lines) == 1:
        return f"the path that ends in line {lines[0]} neither succeeds nor aborts nor cancels"
    return f"the paths that end in lines {listed(lines)} neither succeed nor abort nor cancel"


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
    return any(type_name(code, routine, syntax.Name(parameter.name)) in HANDLES for parameter in parameters)


def _does(
    code: Codebase, routine: Routine, expression: syntax.Expression, names: frozenset[str], depth: int = 2
) -> bool:
    """Whether *expression* sets the outcome, or may: it hands the goal on, or calls what sets it."""
    for node in nodes(expression):
        if isinstance(node, syntax.Lambda) or (isinstance(node, syntax.Assignment) and _is_handed(node.value, names)):
            return True
        if not isinstance(node, syntax.Call):
            continue
        if last_part(node.callee) in OUTCOMES or any(_is_handed(argument, names) for argument in node.arguments):
            return True
        for target in called(code, routine, node) if depth else ():
            if any(_does(code, target, call.whole, frozenset(), depth - 1) for call in code.body(target).calls):
                return True
    return False


def _is_ended_elsewhere(code: Codebase, routine: Routine) -> bool:
    """Whether the class keeps a goal handle in a member, and another of its functions ends the goal by that.

    One that puts a new handle there in the same breath does not count: it ends the goal before, for the sake of the new one.
    """
    owner = owner_of(code, routine)
    if owner is None:
        return False
    paths = code.mentioning(owner[1].name.rpartition(owner[0].separator)[2])
    for other in (other_routine for path in sorted(paths) for other_routine in code.routines(path)):
        if other.owner != routine.owner or other.method is routine.method or other.is_python != routine.is_python:
            continue
        for call in code.body(other).calls:
            member = _member(code, other, call.callee) if call.name in _ENDS else ""
            kept = attribute_values(code, owner, member) if member else ()
            is_new = any(other_routine.method is other.method for other_routine, _ in kept)
            if not is_new and any(isinstance(value, syntax.Name) for _, value in kept):
                return True
    return False


def _is_step(code: Codebase, routine: Routine) -> bool:
    """Whether every call of *routine* gives it the goal handle that a member keeps: the goal outlives what it returns."""
    calls = [(caller, call) for caller, call in callers(code, routine) if not caller.is_test]
    return bool(calls) and all(any(_is_kept(code, caller, value) for value in call.args) for caller, call in calls)


def _is_kept(code: Codebase, caller: Routine, value: syntax.Expression) -> bool:
    """Whether *value* is such a member, or a local variable that is set to nothing else."""
    if not isinstance(value, syntax.Name) or not is_local(code, caller, value.name):
        return bool(_held(code, caller, value))
    body = code.body(caller)
    starts = [part for variable in body.variables.get(value.name, ()) for part in variable.parts]
    sets = [source for target, _, source, _ in body.sets if target == value]
    return bool(starts or sets) and all(_held(code, caller, start) for start in (*starts, *sets))


def _is_meant(project: Project, routine: Routine, ways: Iterable[tuple[int, int]]) -> bool:
    """Whether a comment in the function says that the goal is aborted otherwise: lines up to the last way are read."""
    first = routine.function.line - 1
    last = max((line for line, _ in ways), default=first)
    lines = project.text(routine.path).splitlines()[first : min(max(last, first + 10), first + _READ)]
    return any(_ABORTS.search(line) for line in lines)


def _member(code: Codebase, routine: Routine, callee: syntax.Expression) -> str:
    """The member of ``this`` that a method is called on; of C++ one that holds a goal handle."""
    return _held(code, routine, callee.object) if isinstance(callee, syntax.Member) else ""


def _held(code: Codebase, routine: Routine, held: syntax.Expression) -> str:
    """The member of ``this`` that *held* is; of C++ one that holds a goal handle."""
    while isinstance(held, syntax.Dereference):
        held = held.value
    if not routine.is_python and type_name(code, routine, held) not in HANDLES:
        return ""
    if isinstance(held, syntax.Member) and isinstance(held.object, syntax.This):
        return held.name
    is_own = isinstance(held, syntax.Name) and not routine.is_python and not is_local(code, routine, held.name)
    return held.name if isinstance(held, syntax.Name) and is_own else ""


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
