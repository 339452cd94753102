# SPDX-License-Identifier: Apache-2.0
"""Subscriptions whose callback sleeps longer than it takes the next message to come: the queue overflows."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project
from haros_ci.api.code import Callback, callbacks
from haros_ci.api.rates import rates_in, slept

#: From this share of what the callback can handle on, messages come too fast.
MARGIN = 1.01


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    for callback in callbacks(code):
        if callback.kind != "subscription" or callback.routine.is_test or not _is_one_by_one(callback):
            continue
        time = slept(code, callback)
        if time > 0:
            yield from _found(project, callback, time)


def _is_one_by_one(callback: Callback) -> bool:
    """Whether the callback does not run twice at the same time: rospy has a thread for each connection, groups may be reentrant."""
    return callback.group == "" if callback.ros == 2 else callback.ros == 1 and not callback.maker.is_python


def _found(project: Project, callback: Callback, time: float) -> Iterator[Finding]:
    seen: set[float] = set()
    for system in project.systems:
        for end in system.ends:
            if end.kind != "subscribers" or end.raw.location != callback.location or end.raw.is_ruled_out:
                continue
            if not end.known or (end.qos is not None and end.qos.history == "keep_all"):
                continue
            # what publishes in the same node may wait for the callback
            others = [
                one.rate.low
                for one in rates_in(system, project.code).published
                if one.topic == end.name and one.node != end.node.name
            ]
            least = sum(others)
            if least * time > MARGIN and least not in seen:
                seen.add(least)
                yield Finding(
                    at=end.location,
                    message=(
                        f"messages on {end.name} come {least:.6g} times a second in {system.name}, and {callback.routine.title}, their callback, "
                        f"sleeps {time:.6g} s each time: it handles {1.0 / time:.6g} a second at the most, the queue overflows, and the "
                        "others are lost; do not sleep in the callback"
                    ),
                    about=(end.node.type, end.original_name, "slower than its topic"),
                    related=((callback.routine.location, "the callback"),),
                )


CHECK = Check(
    id="callback-slower-than-topic",
    summary="Subscription whose callback sleeps longer than the next message takes.",
    level=Level.WARNING,
    tags=("topics", "rates"),
    project=check,
)
