# SPDX-License-Identifier: Apache-2.0
"""Publishers that a callback makes for itself, and publishes with at once."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, syntax
from haros_ci.api.code import Call, Codebase, Routine, call_place, dotted, is_node, late, type_name

#: What gives subscribers time to connect, or asks whether they have.
WAITS = re.compile(r"sleep|wait|spin|[gG]etNumSubscribers|get_num_connections|get_subscription_count|on_activate|latch")


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    for routine, made, published in late(code):
        if not _is_publisher(code, routine, made) or _may_reach(code, routine, made):
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


CHECK = Check(
    id="publisher-made-late",
    summary="Publisher that a callback makes and uses at once.",
    level=Level.WARNING,
    tags=("code",),
    project=check,
)
