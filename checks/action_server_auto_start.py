# SPDX-License-Identifier: Apache-2.0
"""Action servers of ROS 1 that start before they are ready."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, syntax
from haros_ci.api.code import Codebase, Routine, call_place, calls_of, dotted, owner_of, resolved

CPP = ("actionlib::SimpleActionServer", "actionlib::ActionServer")
PYTHON = ("actionlib.SimpleActionServer", "actionlib.ActionServer", "actionlib.simple_action_server.SimpleActionServer")
WHY = (
    "the action server starts in its constructor, of which actionlib warns: a goal that comes before the node has made what the callback uses, "
    "or registered it, is lost or fails; "
)


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    for routine, call in calls_of(code, "SimpleActionServer", "ActionServer"):
        if not routine.is_python or dotted(code, routine, call.callee) not in PYTHON:
            continue
        started = (
            call.argument(3, "auto_start") if call.name == "SimpleActionServer" else call.argument(4, "auto_start")
        )
        if any(isinstance(argument, (syntax.Star, syntax.DoubleStar)) for argument in call.args):
            continue
        if started is None:
            message = "auto_start defaults to True; pass auto_start=False, and call start() at the end of the set-up"
        elif isinstance(started, syntax.Boolean) and started.value:
            message = "pass auto_start=False, and call start() at the end of the set-up"
        else:
            continue
        yield Finding(at=call_place(routine, call), message=WHY + message, about=(routine.title, call.name))
    paths = code.mentioning("ActionServer")
    for source in code.sources:
        if source.separator == "::" and source.path in paths:
            for routine in code.routines(source.path):
                if routine.owner.startswith("actionlib::"):
                    continue
                yield from _cpp(code, routine)


def _cpp(code: Codebase, routine: Routine) -> Iterator[Finding]:
    for name, args, at in _made(code, routine):
        if _auto_starts(args):
            yield Finding(
                at=at,
                message=f"{WHY}pass false for auto_start, and call start() at the end of the set-up",
                about=(routine.title, name),
            )


def _auto_starts(args: tuple[syntax.Expression, ...]) -> bool:
    """Whether the last argument is true: one of (name, auto_start), (name, callback, auto_start), a node handle before them."""
    return len(args) >= 2 and args[-1] == syntax.Boolean(True)


def _made(code: Codebase, routine: Routine) -> Iterator[tuple[str, tuple[syntax.Expression, ...], Location]]:
    """The action servers that a routine makes: by member initialisers, variables and ``new``."""
    owner = owner_of(code, routine)
    if routine.function.kind == "constructor" and owner is not None:
        fields = {field.name: field for field in owner[1].fields}
        for init in routine.function.inits:
            if init.name in fields and _is_server(code, routine, fields[init.name].type):
                yield init.name, init.arguments, Location(routine.path, init.line, init.column)
    for name, every in code.body(routine).variables.items():
        for variable in every:
            is_made = isinstance(variable.init, (syntax.Parentheses, syntax.Braces))
            if is_made and _is_server(code, routine, variable.type):
                yield name, variable.parts, Location(routine.path, variable.line, variable.column)
    for kind, args, line, column in code.body(routine).news:
        if _is_server(code, routine, kind):
            yield kind.name, args, Location(routine.path, line, column)
    for call in code.body(routine).calls:
        if (
            call.name in ("make_shared", "make_unique")
            and call.templates
            and _is_server(code, routine, call.templates[0])
        ):
            yield call.name, call.args, call_place(routine, call)


def _is_server(code: Codebase, routine: Routine, kind: syntax.Argument) -> bool:
    if not isinstance(kind, syntax.Type):
        return False
    found = resolved(code, kind, routine.method.function.name.rpartition("::")[0], routine.source)
    if found.name in ("std::shared_ptr", "boost::shared_ptr", "std::unique_ptr", "boost::scoped_ptr"):
        return False
    return found.name in CPP


CHECK = Check(
    id="action-server-auto-start",
    summary="ROS 1 action server started in its constructor, before its callback is ready.",
    level=Level.WARNING,
    catalogue="C11",
    tags=("code", "actions"),
    project=check,
)
