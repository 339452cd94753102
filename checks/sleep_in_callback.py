# SPDX-License-Identifier: Apache-2.0
"""Callbacks that sleep."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, Project, regex, syntax
from haros_ci.api.code import (
    Call,
    Callback,
    Codebase,
    Place,
    Reached,
    Routine,
    Variable,
    call_place,
    called,
    calls_of,
    dotted,
    in_callbacks,
    names_in,
    nodes,
    type_name,
)

#: What registers callbacks that lose something while they wait: messages, and the beat of a timer. Services and actions keep their requests.
LOSING = (
    *(
        "create_subscription",
        "create_generic_subscription",
        "create_wall_timer",
        "create_timer",
        "subscribe",
        "Subscriber",
    ),
    *("createTimer", "createWallTimer", "createSteadyTimer", "Timer", "registerCallback", "TransformListener"),
)
#: Words of failures, and of calls that begin again after one.
FAILURE = regex(r"fail|err(?:or|no)?(?:$|[_A-Z])|invalid|timed?_?out", re.IGNORECASE)
AGAIN = regex(
    r"^(?:re_?)?(?:init\w*|connect\w*|open\w*|start\w*|set_?up\w*|reset\w*)$|^re(?:connect|open|start|try|boot)",
    re.IGNORECASE,
)
#: Names of services that bring hardware up, and of flags that say whether it has been.
INITIAL = regex(r"(?:^|[_/]|(?<=[a-z]))[iI]nit(?:iali[sz](?:e|ation))?(?:$|[_/A-Z])")
INITIALISED = regex(r"initiali[sz]ed|is_?init(?:ed)?(?:$|_)", re.IGNORECASE)
#: Sleeps shorter than this many seconds hold nobody up.
SHORT = 0.02
#: Sleeps shorter than this are a note: of a pause of a few cycles messages are seldom lost.
BRIEF = 0.1
#: Programs that nobody runs on a robot that moves: what brings it up or down, sets it up, and works offline.
TOOLS = regex(
    r"(?:^|[_/])(?:bring_?up|lifecycle_manager|calibrat\w*|offline|map_saver|merge\w*|replay\w*|record\w*|convert\w*|tools?|demos?|examples?|tutorials?"
    r"|mocks?|fakes?|dummy|simulat\w*|benchmarks?)(?=[_/.]|$)"
)
#: Calls of a routine that ends the node: nobody waits any more.
ENDS = frozenset(("exit", "_exit", "quick_exit", "shutdown", "destroy_node", "signal_shutdown", "requestShutdown"))
RATES = frozenset(("ros::Rate", "ros::WallRate", "rclcpp::Rate", "rclcpp::WallRate", "rclcpp::GenericRate"))
DURATIONS = frozenset(("ros::Duration", "ros::WallDuration"))
PYTHON_RATES = frozenset(("rclpy.timer.Rate",))
#: Seconds of one unit, by C++ literal suffix and by type.
UNITS = {"h": 3600.0, "min": 60.0, "s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
TYPES = {
    "hours": 3600.0,
    "minutes": 60.0,
    "seconds": 1.0,
    "milliseconds": 1e-3,
    "microseconds": 1e-6,
    "nanoseconds": 1e-9,
}


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    seen: set[int] = set()
    found: dict[int, list[tuple[Reached, Call, float]]] = {}
    for reached in in_callbacks(code):
        if reached.routine.is_test or reached.callback.maker.is_test or not _holds_up(code, reached.callback):
            continue
        calls = code.body(reached.routine).calls
        if ENDS.intersection(call.name for call in calls) or any(map(_depends, reached.path[1:])):
            continue
        for call in calls:
            if id(call) in seen or "sleep" not in call.name or (reached.path and _depends((reached.routine, call))):
                continue
            seconds = sleeps(code, reached.routine, call)
            if seconds is not None and not 0 <= seconds < SHORT:
                seen.add(id(call))
                found.setdefault(id(reached.callback.routine), []).append((reached, call, seconds))
    for every in found.values():
        yield _finding(code, every)


def _finding(code: Codebase, every: list[tuple[Reached, Call, float]]) -> Finding:
    """One finding for a callback, however often it sleeps."""
    reached, call, seconds = every[0]
    kind, title = reached.callback.kind, reached.callback.routine.title
    long = f" for {seconds:g} s" if seconds >= 0 else " for a time that is not known"
    where = f"{title}, the callback of a {kind}"
    if reached.routine is not reached.callback.routine:
        where = f"{reached.routine.title}, which {title}, the callback of a {kind}, runs"
    ros2 = reached.callback.ros == 2
    others = "no other callback of the node's default group runs" if ros2 else "the spinner runs no other callback"
    threads = (
        "put the callback into a separate callback group, with a multi-threaded executor"
        if ros2
        else "spin with several threads (ros::AsyncSpinner)"
    )
    #: who has called a service waits for its answer: a timer would come too late
    advice = threads if kind == "service" else f"use a timer, or {threads}"
    effect = f"{others}, and messages are delayed or lost; {advice}"
    return Finding(
        at=call_place(reached.routine, call),
        message=f"the thread sleeps{long} in {where}: during the sleep {effect}",
        about=(title, "sleep"),
        related=tuple((call_place(other.routine, sleep), "also sleeps here") for other, sleep, _ in every[1:]),
        flow=reached.flow(call, "sleeps here"),
        level=Level.NOTE
        if _loses_nothing(code, reached.callback) or all(_is_minor(code, *one) for one in every)
        else None,
    )


def _loses_nothing(code: Codebase, callback: Callback) -> bool:
    """Whether it is a service of a class, or of a file without one, that has no subscription and no timer: requests wait, and are not lost."""
    if callback.kind not in ("service", "action"):
        return False
    maker = callback.maker
    package = maker.source.package
    return not any(
        routine.path == maker.path or (routine.source.package == package and "" != routine.owner == maker.owner)
        for routine, _ in calls_of(code, *LOSING)
    )


def _is_after_failure(code: Codebase, routine: Routine, call: Call) -> bool:
    """Whether it stands where something has failed, and the routine begins again or returns: nothing is done for others then."""
    body = code.body(routine)
    for place in call.around:
        if place.kind == "handler" or (place.kind == "then" and place.test is not None and _is_failure(place.test)):
            if any(place in around for _, around in body.returns):
                return True
            if any(place in other.around and AGAIN.search(other.name) for other in body.calls):
                return True
    return False


def _is_failure(test: syntax.Expression) -> bool:
    """Whether a condition is the negation of something, or names a failure."""
    words = (syntax.name_of(node) for node in nodes(test) if isinstance(node, (syntax.Name, syntax.Member)))
    return (isinstance(test, syntax.Operation) and test.operator == "!") or any(map(FAILURE.search, words))


def _is_minor(code: Codebase, reached: Reached, call: Call, seconds: float) -> bool:
    """Whether it holds others up briefly, a known number of times, after a failure, at the start, or where nobody waits."""
    if _is_after_failure(code, reached.routine, call) or _is_initialising(reached, call):
        return True
    if 0 <= seconds < BRIEF or any(place.kind == "loop" and _is_bounded(place) for place in call.around):
        return True
    return any(TOOLS.search(routine.path.lower()) for routine in (reached.callback.maker, reached.routine))


def _is_initialising(reached: Reached, call: Call) -> bool:
    """Whether it is done once, when hardware is brought up: in a service for that, or while a flag says that it is not initialized yet."""
    callback = reached.callback
    if callback.kind == "service":
        texts = (argument.value for argument in callback.call.args if isinstance(argument, syntax.String))
        named = (callback.routine.function.name, *texts)
        if any(INITIAL.search(name.rpartition(":")[2].rpartition(".")[2]) for name in named):
            return True
    around = (place for _, step in (*reached.path, (reached.routine, call)) for place in step.around)
    tests = (place.test for place in around)
    return any(test is not None and _asks_for_flag(test) for test in tests)


def _asks_for_flag(test: syntax.Expression) -> bool:
    named = (node for node in nodes(test) if isinstance(node, (syntax.Name, syntax.Member)))
    return any(INITIALISED.search(syntax.name_of(node)) for node in named)


def _is_bounded(place: Place) -> bool:
    """Whether it is a loop over things or numbers, as of retries, that ends by itself."""
    loop = place.statement
    if isinstance(loop, syntax.Loop):
        return loop.keyword == "for" and loop.test not in (None, syntax.Null())
    return isinstance(loop, syntax.Each)


def _depends(step: tuple[Routine, Call]) -> bool:
    """Whether a condition on a parameter of the routine stands around the call: a timeout that may be zero."""
    routine, call = step
    parameters = {parameter.name for parameter in routine.function.parameters}
    conditions = (place.test or _condition(place) for place in call.around)
    return any(parameters & names_in(condition) for condition in conditions if condition is not None)


def _condition(place: Place) -> syntax.Expression | None:
    return place.statement.test if isinstance(place.statement, syntax.Loop) else None


def _holds_up(code: Codebase, callback: Callback) -> bool:
    """Whether other callbacks wait for this one, as far as is known."""
    if callback.kind not in ("subscription", "timer", "service"):
        return False
    if callback.ros == 2:
        return callback.group == ""
    if callback.maker.is_python:  # rospy calls the callbacks of each topic in a thread of their own
        return False
    package = callback.maker.source.package
    several = code.mentioning("AsyncSpinner", "MultiThreadedSpinner", "MTNodeHandle")
    return not any(code.by_path[path].package == package for path in several)


def sleeps(code: Codebase, routine: Routine, call: Call) -> float | None:
    """The seconds that a call sleeps, -1 for an unknown time; None if it is no sleep."""
    if called(code, routine, call.whole):
        return None
    if routine.is_python:
        if dotted(code, routine, call.callee) in ("time.sleep", "rospy.sleep"):
            return _number(call.args[0]) if call.args else -1
        if call.name != "sleep" or call.receiver is None:
            return None
        return -1 if type_name(code, routine, call.receiver) in PYTHON_RATES else None
    if isinstance(call.callee, syntax.Name):
        name = call.callee.name.removeprefix("::")
        if name in ("sleep", "usleep", "nanosleep"):
            seconds = _number(call.args[0]) if call.args else -1
            return (
                seconds * {"sleep": 1.0, "usleep": 1e-6}.get(name, 0.0) if seconds > 0 and name != "nanosleep" else -1
            )
        if name.endswith(("this_thread::sleep_for", "rclcpp::sleep_for", "this_thread::sleep")):
            return _pause(code, routine, call.args[0]) if call.args else -1
        return -1 if name.endswith("this_thread::sleep_until") else None
    if call.receiver is None or call.name != "sleep":
        return None
    kind = type_name(code, routine, call.receiver)
    if kind in DURATIONS:
        made = call.receiver
        return _number(made.arguments[0]) if isinstance(made, syntax.Call) and len(made.arguments) == 1 else -1
    return -1 if kind in RATES else None


def _number(expression: syntax.Expression) -> float:
    return float(expression.value) if isinstance(expression, syntax.Number) else -1


def _pause(code: Codebase, routine: Routine, expression: syntax.Expression) -> float:
    """The seconds of a duration, through local variables (``std::chrono::milliseconds pause(5)``); of several the longest."""
    made = code.body(routine).variables.get(expression.name) if isinstance(expression, syntax.Name) else None
    if made is None:
        return _chrono(expression)
    pauses = [_chrono(_value(variable)) for variable in made]
    return -1 if any(pause < 0 for pause in pauses) else max(pauses)


def _value(variable: Variable) -> syntax.Expression:
    """What a variable is made of, as the call that it amounts to."""
    if isinstance(variable.init, (syntax.Parentheses, syntax.Braces)):
        return syntax.Call(syntax.Name(variable.type.name), variable.init.arguments, (), 0, 0)
    return variable.assigned or syntax.Null()


def _chrono(expression: syntax.Expression) -> float:
    """The seconds of ``100ms`` or ``std::chrono::milliseconds(100)``."""
    if not isinstance(expression, syntax.Call) or not isinstance(expression.callee, syntax.Name):
        return -1
    if len(expression.arguments) != 1:
        return -1
    name, number = expression.callee.name, _number(expression.arguments[0])
    unit = (
        UNITS.get(name.removeprefix('operator""'))
        if name.startswith("operator")
        else TYPES.get(name.rpartition("::")[2])
    )
    return number * unit if unit is not None and number >= 0 else -1


CHECK = Check(
    id="sleep-in-callback",
    summary="Sleep in a callback of a subscription, timer or service.",
    level=Level.WARNING,
    catalogue="C02",
    decidability=Decidability.EXACT,
    tags=("code",),
    profiles=("strict",),
    project=check,
)
