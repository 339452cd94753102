# SPDX-License-Identifier: Apache-2.0
"""Programs that make a node with callbacks and never spin it."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, regex, syntax
from haros_ci.api.code import Call, Callback, Codebase, Routine, alone, call_place, callbacks, calls_of, dotted

#: Whatever may call callbacks: a text that has one of these words is not looked at.
SPINS = regex(
    r"spin|[eE]xecutor|callAvailable|callOne|CallbackQueue|[wW]ait_?[sS]et|waitForShutdown|waitForMessage|wait_for_message|asyncio|"
    r"rqt|rviz|gazebo|container|BasicNavigator|_main\b|run_node|Application"
)
#: What main may hand its node to, besides.
STARTS = regex(r"\b(run|exec|start|loop|join|Run|Start|Loop|Exec)\w*\s*\(")
INITS = {"rclcpp::init": 2, "ros::init": 1, "rclpy.init": 2}
SPINNING = ("spin", "spin_once", "spin_until_future_complete")
KINDS = frozenset(("subscription", "timer", "service"))


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    yield from _classes_spun(code)
    for routine, call in calls_of(code, "init"):
        if routine.is_test or _name(code, routine, call) not in INITS:
            continue
        if routine.function.name != "main" and not (
            routine.is_python and routine.function.kind in ("function", "module")
        ):
            continue
        if STARTS.search(alone(code, routine.path)) or SPINS.search(alone(code, routine.path)):
            continue
        paths = _program(code, routine)
        text = code.text(routine.path)
        made = next(
            (e for e in callbacks(code) if e.maker.path in paths and e.kind in KINDS and _is_used(e, routine, text)),
            None,
        )
        if made is None or any(SPINS.search(alone(code, path)) for path in paths):
            continue
        yield Finding(
            at=call_place(routine, call),
            message=f"the program creates a {made.kind} with a callback, but never spins the node: the callback is never "
            "called; spin the node, or add it to an executor",
            about=(routine.source.package or routine.path, routine.path.rpartition("/")[2]),
            related=((made.location, f"{made.routine.title} is its callback"),),
        )


def _classes_spun(code: Codebase) -> Iterator[Finding]:
    """Calls of rclpy that spin a class in the place of a node that is made of it."""
    known = {f"{source.module}.{class_.name}" for source in code.sources for _, class_ in code.classes(source)}
    for routine, call in (found for name in SPINNING for found in calls_of(code, name)):
        if not routine.is_python or routine.is_test or not call.args or not isinstance(call.args[0], syntax.Name):
            continue
        name = str(call.args[0].name)
        whole = dotted(code, routine, call.args[0])
        if not whole or dotted(code, routine, call.callee) not in {f"rclpy.{spinning}" for spinning in SPINNING}:
            continue
        if re.search(rf"^[ \t]*{name}[ \t]*(?::[^=\n]*)?=(?!=)", alone(code, routine.path), re.MULTILINE) is not None:
            continue  # the name is given to something else
        if f"{routine.source.module}.{name}" in known if whole == name else whole in known:
            yield Finding(
                at=call_place(routine, call),
                message=f"rclpy.{call.name}() is given the class {name}, not a node that is made of it: the line raises an exception; "
                f"give it the object ({name}())",
                about=(routine.source.package or routine.path, routine.path.rpartition("/")[2], name),
            )


def _is_used(callback: Callback, routine: Routine, text: str) -> bool:
    """Whether the program makes the callback itself, or names the class that does."""
    owner = callback.maker.owner
    last = re.split(r"::|\.", owner)[-1]
    return callback.maker.path == routine.path if not owner else re.search(rf"\b{re.escape(last)}\b", text) is not None


def _name(code: Codebase, routine: Routine, call: Call) -> str:
    if routine.is_python:
        return dotted(code, routine, call.callee)
    return call.callee.name.removeprefix("::") if isinstance(call.callee, syntax.Name) else ""


def _program(code: Codebase, routine: Routine) -> set[str]:
    """The files that the program may be made of: for Python its package's, for C++ what it includes, and what goes with these headers."""
    package = routine.source.package
    around = {source.path for source in code.sources if package is not None and source.package == package}
    if routine.is_python:
        return around | {routine.path}
    headers = set(code.cpp.reach(routine.path))
    packages = {package, *(code.by_path[path].package for path in headers)}
    beside = {
        source.path
        for source in code.sources
        if source.package in packages
        and source.separator == "::"
        and not headers.isdisjoint(code.cpp.reach(source.path))
    }
    return headers | beside | {routine.path}


CHECK = Check(
    id="node-never-spun",
    summary="Node with callbacks that is never spun.",
    level=Level.ERROR,
    catalogue="",
    tags=("code",),
    project=check,
)
