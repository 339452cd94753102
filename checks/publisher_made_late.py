# SPDX-License-Identifier: Apache-2.0
"""Publishers that a callback makes for itself, and publishes with at once."""

from __future__ import annotations

import builtins
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, regex, syntax
from haros_ci.api.code import Call, Codebase, Routine, call_place, callees, dotted, is_node, late, reached, type_name

#: What gives subscribers time to connect, or asks whether they have.
WAITS = regex(r"sleep|wait|spin|[gG]etNumSubscribers|get_num_connections|get_subscription_count|on_activate|latch")
#: Calls of MoveIt's commanders that return when the robot has moved.
MOVES = frozenset(("go", "execute", "pick", "place"))
#: How far functions are followed that are called before the first message.
DEPTH = 3


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    for routine, made, published in late(code):
        if not _is_publisher(code, routine, made) or _may_reach(code, routine, made):
            continue
        if _takes_time(code, routine, made, published):
            continue
        yield Finding(
            at=call_place(routine, made),
            message=(
                f"{routine.title}, which a callback runs, makes a publisher and publishes with it at once: no subscriber is "
                "connected yet, and what it publishes first is lost; make the publisher when the node starts, and keep it"
            ),
            about=(routine.title, "made late"),
            related=((call_place(routine, published), "published here"),),
        )


def _is_publisher(code: Codebase, routine: Routine, made: Call) -> bool:
    if routine.is_python:
        if made.name == "Publisher":
            return dotted(code, routine, made.callee) == "rospy.Publisher"
        return made.name == "create_publisher" and isinstance(made.receiver, syntax.This)
    if made.name == "advertise":
        return made.receiver is not None and type_name(code, routine, made.receiver) == "ros::NodeHandle"
    return made.name == "create_publisher" and is_node(code, routine, made.receiver)


def _may_reach(code: Codebase, routine: Routine, made: Call) -> bool:
    """Whether the message may arrive: something waits, the topic is latched, or its quality of service keeps messages."""
    if any(WAITS.search(call.name) for call in code.body(routine).calls):
        return True
    plain = [value for value in made.args if not isinstance(value, syntax.Keyword)]
    if routine.is_python:
        return any(
            isinstance(value, syntax.Keyword) and value.name not in ("queue_size", "topic") for value in made.args
        )
    if made.name == "advertise":
        return len(plain) > 2 or not made.templates
    return len(plain) < 2 or not isinstance(plain[1], syntax.Number)


def _takes_time(code: Codebase, routine: Routine, made: Call, published: Call) -> bool:
    """Whether something between the two waits: a movement, or a function that is called there, or one that it calls; or whether nothing is known of one."""
    between = [call for call in code.body(routine).calls if made.line < call.line < published.line]
    if any(call.name in MOVES for call in between):
        return True
    wholes = {id(call.whole) for call in between}
    called = [(call, target) for call, target in callees(code, routine) if id(call.whole) in wholes]
    found = {id(call.whole) for call, _ in called}
    if routine.is_python and any(_is_of_elsewhere(call) for call in between if id(call.whole) not in found):
        return True
    return any(
        call.name in MOVES or WAITS.search(call.name)
        for _, target in called
        for below, _ in reached(code, target, DEPTH)
        for call in code.body(below).calls
    )


def _is_of_elsewhere(call: Call) -> bool:
    """Whether a function of Python is called by its plain name that is no builtin one: another module has it."""
    return call.receiver is None and call.name[:1].islower() and not hasattr(builtins, call.name)


CHECK = Check(
    id="publisher-made-late",
    summary="Publisher that a callback makes and uses at once.",
    level=Level.WARNING,
    tags=("code",),
    project=check,
)
