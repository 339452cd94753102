# SPDX-License-Identifier: Apache-2.0
"""Parameters with a value outside the range that the node declares for them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from haros_ci.api import Check, End, Finding, Level, Location, System


def check(system: System) -> Iterator[Finding]:
    for node in system.nodes:
        given = {each.key: each for each in node.given}
        for key, ends in node.names.declared.items() if node.ros == 2 else ():
            for end in ends:
                value = given[key].value if key in given else end.raw.value
                at = given[key].at if key in given else end.location
                said = _outside(end, value)
                if said and not (key in given and _differ(ends)):
                    yield _finding(end, key, value, said, at, key in given)


def _finding(end: End, key: str, value: Any, said: str, at: Location, is_given: bool) -> Finding:
    whose = "is given" if is_given else "declares by default"
    return Finding(
        at=at,
        message=(f"{end.node} {whose} {value} for the parameter {key}, {said}: the node throws when it declares it"),
        about=(end.node, key),
        related=((end.location, "declared with a range"),),
    )


def _differ(ends: tuple[End, ...]) -> bool:
    return len({end.raw.range for end in ends}) > 1


def _outside(end: End, value: Any) -> str:
    """What is wrong with *value*; "" if nothing is (rclcpp/src/rclcpp/node_interfaces/node_parameters.cpp)."""
    limits = end.raw.range
    if limits is None or isinstance(value, bool) or not isinstance(value, (int, float)):
        return ""
    low, high, step = limits
    if low is None or high is None or low > high:
        return ""
    slack = 1e-6 * max(abs(low), abs(high), 1.0)
    if value < low - slack:
        return f"which is less than {low:g}, the least that its range allows"
    if value > high + slack:
        return f"which is more than {high:g}, the most that its range allows"
    if end.type == "int" and step and step > 1 and value != high and (value - low) % step:
        return f"which is no multiple of the step {step:g} of its range above {low:g}"
    return ""


CHECK = Check(
    id="parameter-out-of-range",
    summary="The value of a parameter is within the range that the node declares for it.",
    level=Level.ERROR,
    catalogue="P04",
    tags=("parameters",),
    run=check,
)
