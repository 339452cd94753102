# SPDX-License-Identifier: Apache-2.0
"""Frame ids with a leading slash (tf2 migration: "tf2 does not accept frame ids starting with /")."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from haros_ci.api import Check, Decidability, End, Finding, Level, Location, Parameter, System, SystemNode

#: Parameters that hold the name of a frame.
_FRAME = re.compile(r"(?:^|[_./:])(?:frame|frame_id|frameid|[a-z0-9]+_frame|[a-z0-9_]+_frame_id)$")
_NODES = ("getters", "parameters")


def check(system: System) -> Iterator[Finding]:
    given: dict[str, list[Parameter]] = {}
    for parameter in system.parameters:
        if _FRAME.search(parameter.name) and not parameter.unknowns:
            given.setdefault(parameter.name, []).append(parameter)
    told: set[Location] = set()
    for node in system.nodes:
        if not _uses_tf2(node, system):
            continue
        for end in node.of(*_NODES):
            if end.known and _FRAME.search(end.name):
                for place, value in _values(end, given):
                    if place not in told:
                        told.add(place)
                        yield _finding(end, place, value)


def _uses_tf2(node: SystemNode, system: System) -> bool:
    """ROS 2 has tf2 alone; in ROS 1 the package has to depend on tf2_ros, and not on tf, which takes a slash for tf_prefix."""
    if node.package == "tf2_ros":  # who receives what a broadcaster sends takes the slash off
        return False
    if node.ros == 2:
        return True
    package = system.packages.get(node.package)
    needs = {each.name for each in package.dependencies} if package is not None else set()
    return "tf2_ros" in needs and "tf" not in needs


def _values(end: End, given: dict[str, list[Parameter]]) -> Iterator[tuple[Location, str]]:
    """What the parameter has: as it is set from outside, else as the code has it by default."""
    outside = given.get(end.name, ())
    for parameter in outside:
        place = parameter.origin or parameter.location
        if place is not None and _has_slash(parameter.value):
            yield place, parameter.value
    if not outside and end.in_source and _has_slash(end.raw.value):
        yield end.location, end.raw.value


def _has_slash(value: Any) -> bool:
    return isinstance(value, str) and re.fullmatch(r"/[A-Za-z][\w/]*", value) is not None


def _finding(end: End, place: Location, value: str) -> Finding:
    return Finding(
        at=place,
        message=(
            f"the frame {value} of the parameter {end.name} begins with a slash: tf2 has no such frame, and looking it up fails; "
            f"write {value.lstrip('/')}"
        ),
        about=(end,),
        related=((end.location, f"{end.node} reads it here"),),
    )


CHECK = Check(
    id="frame-leading-slash",
    summary="Frame ids have no leading slash.",
    level=Level.WARNING,
    decidability=Decidability.HEURISTIC,
    catalogue="N03",
    tags=("tf", "parameters"),
    run=check,
)
