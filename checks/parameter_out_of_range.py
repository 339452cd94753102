# SPDX-License-Identifier: Apache-2.0
"""Parameters with a value outside the range that the node declares for them."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import ALWAYS, Check, End, Finding, Given, Level, System


def check(system: System) -> Iterator[Finding]:
    for node in system.nodes:
        for key, ends in node.names.declared.items() if node.ros == 2 else ():
            if all(end.raw.range is None for end in ends):
                continue
            parameters = [parameter for parameter in node.given if parameter.key == key]
            for parameter in parameters:
                if not _differ(ends) and parameter.type == ends[0].type:
                    yield from _judged(ends[0], key, parameter.value, parameter)
            for end in ends if not parameters else ():
                yield from _judged(end, key, end.raw.value, None)


def _judged(end: End, key: str, value: object, parameter: Given | None) -> Iterator[Finding]:
    problem = _outside(end, value)
    if problem:
        yield Finding(
            at=parameter.at if parameter else end.location,
            message=(
                f"{end.node} {('is given' if parameter else 'declares by default')} {value} for the parameter {key}, {problem}: "
                "the node throws at the declaration; use a value within the range"
            ),
            about=(end.node, key),
            related=((end.location, "range declared here"),),
            presence=parameter.presence if parameter else ALWAYS,
        )


def _differ(ends: tuple[End, ...]) -> bool:
    return len({end.raw.range for end in ends}) > 1


def _outside(end: End, value: object) -> str:
    """What is wrong with *value*; "" if nothing is (rclcpp/src/rclcpp/node_interfaces/node_parameters.cpp)."""
    limits = end.raw.range
    if limits is None or isinstance(value, bool) or not isinstance(value, (int, float)):
        return ""
    low, high, step = limits
    if low is None or high is None or low > high:
        return ""
    slack = 1e-6 * max(abs(low), abs(high), 1.0)
    if value < low - slack:
        return f"which is less than {low:g}, the minimum of its range"
    if value > high + slack:
        return f"which is more than {high:g}, the maximum of its range"
    if end.type == "int" and step and step > 1 and value != high and (value - low) % step:
        return f"which does not fit the step {step:g} of its range from {low:g}"
    return ""


CHECK = Check(
    id="parameter-out-of-range",
    summary="Parameter value outside its declared range.",
    level=Level.ERROR,
    catalogue="P04",
    tags=("parameters",),
    run=check,
)
