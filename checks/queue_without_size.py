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
        said = _said(end)
        if said is not None:
            yield Finding(at=end.location, message=said[0], about=(end,), level=said[1])


def _said(end: End) -> tuple[str, Level] | None:
    is_python = end.location.path.endswith(".py")
    if end.raw.queue_size is None and end.kind == "publishers":
        return (
            f"{end.node} publishes {end.name} without queue_size: each message is sent to one subscriber after the other, "
            "a slow one holds up the node; pass queue_size",
            Level.NOTE,
        )
    if end.raw.queue_size != 0:
        return None
    if end.kind == "subscribers" and is_python:
        return f"{end.node} subscribes to {end.name} with queue_size 0: rospy refuses it with an exception", Level.ERROR
    does = "publishes" if end.kind == "publishers" else "subscribes to"
    return (
        f"{end.node} {does} {end.name} with a queue of size 0, which is a queue without a limit: it grows as long as messages "
        "come faster than they are taken; give it a size",
        Level.NOTE,
    )


CHECK = Check(
    id="queue-without-size",
    summary="Each publisher's and subscriber's queue has a size, which is not 0.",
    level=Level.WARNING,
    catalogue="Q05",
    tags=("topics", "qos"),
    run=check,
)
