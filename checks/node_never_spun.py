# SPDX-License-Identifier: Apache-2.0
"""Programs that make a node with callbacks and never spin it."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Call, Check, Codebase, Finding, Level, Project, Routine, call_place, calls_of, dotted

#: Whatever may call callbacks: a text that has one of these words is not looked at.
SPINS = re.compile(
    r"spin|[eE]xecutor|callAvailable|callOne|CallbackQueue|[wW]ait_?[sS]et|waitForShutdown|waitForMessage|wait_for_message|asyncio|"
    r"rqt|rviz|gazebo|container|BasicNavigator|_main\b|run_node|Application"
)
#: What main may hand its node to, besides.
STARTS = re.compile(r"\b(run|exec|start|loop|join|Run|Start|Loop|Exec)\w*\s*\(")
INITS = {"rclcpp::init": 2, "ros::init": 1, "rclpy.init": 2}
CALLBACKS = re.compile(
    r"\b(create_subscription|create_wall_timer|create_timer|create_service|advertiseService|subscribe|createTimer)\s*[<(]"
)


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    for routine, call in calls_of(code, "init"):
        if routine.is_test or _name(code, routine, call) not in INITS:
            continue
        if routine.function.name != "main" and not (
            routine.is_python and routine.function.kind in ("function", "module")
        ):
            continue
        if STARTS.search(code.text(routine.path)) or SPINS.search(code.text(routine.path)):
            continue
        texts = [code.text(path) for path in sorted(_program(code, routine))]
        if any(SPINS.search(text) for text in texts):
            continue
        made = next((CALLBACKS.search(text) for text in texts if CALLBACKS.search(text)), None)
        if made is None:
            continue
        yield Finding(
            at=call_place(routine, call),
            message=f"the program makes a node with callbacks ({made[1]}), and nothing in it spins: no callback is ever called; "
            "spin the node, or add it to an executor that does",
            about=(routine.source.package or routine.path, routine.path.rpartition("/")[2]),
        )


def _name(code: Codebase, routine: Routine, call: Call) -> str:
    if routine.is_python:
        return dotted(code, routine, call.callee)
    return str(call.callee[1]).removeprefix("::") if call.callee[0] == "name" else ""


def _program(code: Codebase, routine: Routine) -> set[str]:
    """The files that the program may be made of: for Python its package's, for C++ what it includes, and what goes with these headers."""
    package = routine.source.package
    around = {each.path for each in code.sources if package is not None and each.package == package}
    if routine.is_python:
        return around | {routine.path}
    headers = set(code.cpp.reach(routine.path))
    packages = {package, *(code.by_path[path].package for path in headers)}
    beside = {
        each.path
        for each in code.sources
        if each.package in packages and each.separator == "::" and not headers.isdisjoint(code.cpp.reach(each.path))
    }
    return headers | beside | {routine.path}


CHECK = Check(
    id="node-never-spun",
    summary="A program that makes a node with callbacks spins it.",
    level=Level.ERROR,
    catalogue="",
    tags=("code",),
    project=check,
)
