# SPDX-License-Identifier: Apache-2.0
"""Look-ups of transforms whose exception nobody catches."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project
from haros_ci.api.code import ASKED, Call, Codebase, Routine, call_place, callees, in_callbacks, is_caught, is_lookup

FILTERS = ("tf2_ros::MessageFilter", "tf::MessageFilter", "tf2_ros/message_filter")


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    seen: set[int] = set()
    paths = code.mentioning("lookupTransform", "lookup_transform", "tf_buffer", "tf2_ros")
    filtered = code.mentioning(*FILTERS)
    for reached in in_callbacks(code):
        made = reached.callback
        if (
            reached.routine.path not in paths
            or made.maker.is_test
            or (made.ros == 1 and (made.maker.is_python or made.kind == "service"))
        ):
            continue
        if made.call.name == "registerCallback" and made.maker.path in filtered:
            continue
        if any(is_caught(call.around) for _, call in reached.path):
            continue
        calls = code.body(reached.routine).calls
        on_the_way = (call.name for routine, _ in reached.path for call in code.body(routine).calls)
        if ASKED.intersection(call.name for call in calls) or ASKED.intersection(on_the_way):
            continue
        if any(_asks_before(code, routine, call) for routine, call in reached.path):
            continue
        for call in calls:
            if id(call) in seen or is_caught(call.around) or not is_lookup(code, reached.routine, call):
                continue
            if _asks_before(code, reached.routine, call):
                continue
            seen.add(id(call))
            title = made.routine.title
            yield Finding(
                at=call_place(reached.routine, call),
                message=f"{call.name} throws if the transform is not available, but neither {title}, the callback of a "
                f"{made.kind}, nor a caller below it catches the exception: the node terminates; catch "
                "tf2::TransformException"
                if not reached.routine.is_python
                else (
                    f"{call.name} raises if the transform is not available, but neither {title}, the callback of a "
                    f"{made.kind}, nor a caller below it catches the exception: it ends spin(); catch "
                    "tf2_ros.TransformException"
                ),
                about=(title, reached.routine.title, call.name),
                flow=reached.flow(call, "looks up a transform here"),
            )


def _asks_before(code: Codebase, routine: Routine, way: Call) -> bool:
    """Whether *routine*, before it goes on by the call *way*, calls a function that asks for transforms: it waits there until one is available."""
    before = {id(call.whole) for call in code.body(routine).calls if call.line < way.line}
    called = (target for call, target in callees(code, routine) if id(call.whole) in before)
    return any(ASKED.intersection(call.name for call in code.body(target).calls) for target in called)


CHECK = Check(
    id="transform-not-caught",
    summary="Transform look-up in a callback without exception handling.",
    level=Level.WARNING,
    catalogue="C04",
    tags=("code", "tf"),
    project=check,
)
