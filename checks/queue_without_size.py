# SPDX-License-Identifier: Apache-2.0
"""ROS 1: publishers without a queue size in Python, and queues without a limit."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, End, Finding, Level, System


def check(system: System) -> Iterator[Finding]:
    for end in system.ends:
        is_end = end.kind in ("publishers", "subscribers") and end.node.ros == 1
        if not is_end or not end.in_source or end.implicit or any(u.field == "queue_size" for u in end.raw.unknowns):
            continue
        problem = _problem(end)
        if problem is not None:
            yield Finding(at=end.location, message=problem[0], about=(end,), level=problem[1])


def _problem(end: End) -> tuple[str, Level] | None:
    is_python = end.location.path.endswith(".py")
    if end.raw.queue_size is None and end.kind == "publishers":
        return (
            (
                f"{end.node} publishes {end.name} without queue_size: publish() then blocks until each subscriber has the "
                "message, so one slow subscriber delays the node; pass queue_size"
            ),
            Level.NOTE,
        )
    if end.raw.queue_size != 0:
        return None
    if end.kind == "subscribers" and is_python:
        return (
            f"{end.node} subscribes to {end.name} with queue_size 0: rospy raises an exception; pass a positive size",
            Level.ERROR,
        )
    does = "publishes" if end.kind == "publishers" else "subscribes to"
    return (
        (
            f"{end.node} {does} {end.name} with queue size 0, which means no limit: the queue grows while messages "
            "arrive faster than they are processed; pass a positive size"
        ),
        Level.NOTE,
    )


CHECK = Check(
    id="queue-without-size",
    summary="Publisher or subscriber without a queue size, or with size 0.",
    level=Level.WARNING,
    catalogue="Q05",
    tags=("topics", "qos"),
    run=check,
)
