# SPDX-License-Identifier: Apache-2.0
"""Publishers that promise, by their QoS, to publish more often than their code does."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, End, Finding, Level, Project, System
from haros_ci.api.code import Codebase
from haros_ci.api.rates import published

#: Calls by which a node says that it lives without publishing (rclcpp/publisher_base.hpp, rclpy/publisher.py).
ASSERTS = "assert_liveliness"
#: A period counts as longer from this share of the limit on.
MARGIN = 1.001


def check(project: Project) -> Iterator[Finding]:
    seen: set[tuple[object, ...]] = set()
    for system in project.systems:
        for end, what, limit in _promises(system, project.code):
            rate = published(system, project.code, end)
            if rate is None or not rate.is_known or rate.high <= 0 or 1.0 / rate.high <= limit * MARGIN:
                continue
            key = (end.location, what, rate, limit)
            if key not in seen:
                seen.add(key)
                yield Finding(
                    at=end.location,
                    message=(
                        f"{end.node} publishes {end.name} every {1.0 / rate.high:.6g} s at the most often, and promises a {what} "
                        f"of {limit:.6g} s: it is missed each time; publish more often, or promise less"
                    ),
                    about=(end.node.type, end.original_name, what),
                )


def _promises(system: System, code: Codebase) -> Iterator[tuple[End, str, float]]:
    """The publishers of a system that promise something by their code, what that is, and its seconds."""
    for end in system.ends:
        if end.kind != "publishers" or end.raw.is_ruled_out or end.qos is None or not end.in_source:
            continue
        limits = [("deadline", end.qos.deadline)]
        if end.qos.liveliness == "manual_by_topic" and not code.mentioning(ASSERTS):
            limits.append(("liveliness lease", end.qos.lease))
        for what, limit in limits:
            if isinstance(limit, float | int) and limit > 0:
                yield end, what, limit


CHECK = Check(
    id="deadline-not-kept",
    summary="Publisher whose deadline or liveliness lease is shorter than its period.",
    level=Level.WARNING,
    tags=("topics", "qos", "rates"),
    project=check,
)
