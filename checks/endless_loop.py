# SPDX-License-Identifier: Apache-2.0
"""Endless loops that go on after ROS has shut down."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, Location, Project, regex, syntax
from haros_ci.api.code import Codebase, Routine, alone, callees, is_dead

#: Text in a loop's body by which it may end, or by which more may happen than is seen.
ENDS = regex(
    r"\b(break|return|throw|goto|exit|_exit|quick_exit|abort|raise|terminate|longjmp|ok|is_shutdown|isShuttingDown|isRunning|"
    r"co_await|co_yield|co_return|yield|await|interruption_point|rethrow_exception|sys|os|pthread_exit|THROW\w*|RETURN\w*|\w*_RETURN\w*|"
    r"\w*ASSERT\w*|\w*CHECK\w*|BREAK\w*)\b"
)
#: Calls in Python that raise an exception once rospy or rclpy has shut down (rospy.sleep: ROSInterruptException).
RAISES = regex(
    r"\b(rospy|rclpy|rate|executor)\b|(?<!\btime)\.sleep\(|\binput\(|spin|\bnext\(|\.get\(|\.recv|\.accept\(|\.read|\bself\.\w*rate"
)
#: What a node includes; the clients of microcontrollers (rosserial) know no shutdown.
ROS = frozenset(("ros/ros.h", "nodelet/nodelet.h"))
#: The functions that tell whether ROS goes on.
_ASKED = ("ros::ok", "rclcpp::ok")

#: A request that the machine goes off, which the loop repeats until it does.
_POWER = regex(
    r"\bsystem\s*\([^;]{0,400}\b(?:shutdown|poweroff|reboot|halt)\b|\b\w{0,80}?(?:power_?off|reboot)\w{0,80}\s*\(",
    re.IGNORECASE,
)
#: What interrupts a boost::thread or a group of them; what the thread may be interrupted at, and waits that are no such place.
_INTERRUPT = regex(r"(?:\.|->)\s*interrupt(?:_all)?\s*\(")
_INTERRUPTION_POINT = regex(r"(?:wait|sleep|pop|join|take|receive|acquire)\w{0,80}\s*\(", re.IGNORECASE)
_NO_INTERRUPTION_POINT = regex(
    r"\b(?:std::this_thread::sleep_\w+|(?:ros|rclcpp)::\w+|usleep|nanosleep|(?<!:)sleep|\w*(?:r|[rR]ate)_?\.sleep)\s*\("
)


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    for path in sorted(code.mentioning("while", "for (;", "for(;")):
        for routine in code.routines(path):
            if routine.is_test or not code.body(routine).loops or not _is_of_a_node(code, routine):
                continue
            for statement, _ in code.body(routine).loops:
                if (
                    _is_endless(statement)
                    and not _may_end(code, routine, statement)
                    and (routine.is_python or not is_dead(code, routine))
                ):
                    yield _finding(code, routine, statement)


def _is_of_a_node(code: Codebase, routine: Routine) -> bool:
    program = routine.source.program
    if routine.is_python:
        # rclpy leaves KeyboardInterrupt to Python; rospy takes it (rospy/core.py: register_signals)
        heads = {alias.type.name.partition(".")[0] for alias in program.aliases}
        return "rospy" in heads and "rclpy" not in heads
    files = {routine.path, *code.cpp.reach(routine.path)}
    includes = (include.strip('<>"') for path in files for include in code.by_path[path].program.includes)
    return any(include in ROS or include.startswith("rclcpp") for include in includes)


def _is_endless(statement: syntax.Loop) -> bool:
    condition = statement.test
    if condition is None:
        return bool(statement.keyword == "for")
    return _is_uncalled(condition) or (isinstance(condition, (syntax.Boolean, syntax.Number)) and bool(condition.value))


def _is_uncalled(condition: syntax.Expression | None) -> bool:
    """Whether it names the function that tells of a shutdown, and does not call it: the address of a function always holds."""
    return condition is not None and isinstance(condition, syntax.Name) and condition.name.removeprefix("::") in _ASKED


def _may_end(code: Codebase, routine: Routine, statement: syntax.Loop) -> bool:
    """Whether there is a way out of the loop, or may be one in what is not seen."""
    text = _text(code, routine, statement)
    if text is None or ENDS.search(text) or _POWER.search(code.lines(routine, statement.line)):
        return True
    if not routine.is_python:
        if _is_interrupted(code, routine, text):
            return True
        return bool(re.search(r"\bdetach\s*\(", alone(code, routine.path)))  # such a thread ends with the process
    calls = {call.name for call in code.body(routine).calls if statement.line <= call.line}
    called = (code.lines(callee, callee.function.line) for call, callee in callees(code, routine) if call.name in calls)
    return any(RAISES.search(text) for text in (text, *called))


def _is_interrupted(code: Codebase, routine: Routine, text: str) -> bool:
    """Whether a boost::thread is interrupted in the file or its headers, and the loop may have a place where that ends it."""
    files = {routine.path, *code.cpp.reach(routine.path)}
    return bool(
        files & code.mentioning("boost::thread")
        and any(_INTERRUPT.search(alone(code, path)) for path in files & code.mentioning("interrupt"))
        and _INTERRUPTION_POINT.search(_NO_INTERRUPTION_POINT.sub(" ", text))
    )


def _text(code: Codebase, routine: Routine, statement: syntax.Loop) -> str | None:
    """The loop's text without comments and strings; None where its end is not found."""
    lines = code.text(routine.path).split("\n")[statement.line - 1 :]
    if routine.is_python:
        indent = statement.column - 1
        body = [lines[0]]
        for line in lines[1:]:
            if line.strip() and len(line) - len(line.lstrip()) <= indent:
                break
            body.append(re.sub(r"#.*|\"[^\"]*\"|'[^']*'", "", line))
        return "\n".join(body)
    text = "\n".join([lines[0][statement.column - 1 :], *lines[1:]])
    text = re.sub(r"//[^\n]*|/\*.*?(?:\*/|\Z)|\"(?:[^\"\\\n]|\\.)*\"|'(?:[^'\\\n]|\\.)*'", " ", text, flags=re.S)
    start = text.find("{")
    if start < 0 or ";" in text[:start].replace("(;;)", "").replace("( ; ; )", ""):
        return None
    depth = 0
    for at in range(start, len(text)):
        depth += {"{": 1, "}": -1}.get(text[at], 0)
        if depth == 0:
            return text[start:at]
    return None


def _finding(code: Codebase, routine: Routine, statement: syntax.Loop) -> Finding:
    ros = code.ros_of(routine.source)
    condition = "not rospy.is_shutdown()" if routine.is_python else "ros::ok()" if ros == 1 else "rclcpp::ok()"
    test, why = statement.test, ""
    if isinstance(test, syntax.Name) and _is_uncalled(test):
        why = f"names {test.name} and does not call it, so that the loop"
    reason = f": its condition {why} always holds" if why else ""
    return Finding(
        at=Location(routine.path, statement.line, statement.column),
        message=f"the loop in {routine.title} has no exit{reason}: it continues after a shutdown, and the process hangs or "
        f"is killed; test {condition} in its condition",
        about=(routine.title, "endless loop"),
    )


CHECK = Check(
    id="endless-loop",
    summary="Loop in a node that does not end at shutdown.",
    level=Level.WARNING,
    catalogue="C06",
    decidability=Decidability.EXACT,
    tags=("code",),
    profiles=("strict",),
    project=check,
)
