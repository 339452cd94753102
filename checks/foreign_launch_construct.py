# SPDX-License-Identifier: Apache-2.0
"""Launch files with constructs of the other ROS version."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System
from haros_ci.api.launch import ConstructUse, included_by


def check(system: System) -> Iterator[Finding]:
    found: dict[str, list[ConstructUse]] = {}
    for use in system.facts(ConstructUse):
        if use.kind == "foreign":
            found.setdefault(use.location.path, []).append(use)
    for path, uses in found.items():
        first = uses[0]
        texts = list(dict.fromkeys(use.text for use in uses))
        other = 1 if _is_ros1(first) else 2
        yield Finding(
            at=first.location,
            message=_leftover(texts, other) if _is_whole(uses, other) else _half_ported(first, texts, other),
            about=(path,),
            related=tuple((use.location, f"{use.text}, too") for use in uses[1:20]),
            flow=included_by(first),
            level=Level.NOTE if other == 1 and first.is_installed is False else None,
        )


#: What starts the launch files of each ROS version.
_LAUNCH = {1: "roslaunch", 2: "ros2 launch"}


def _is_whole(uses: list[ConstructUse], other: int) -> bool:
    """Whether the whole file is of the *other* ROS: it is read as such, or starts nodes as that does."""
    return uses[0].ros == other or any(use.text == "exec= of <node>" for use in uses)


def _leftover(texts: list[str], other: int) -> str:
    several = f"{len(texts)} construct{'s' if len(texts) > 1 else ''}"
    return (
        f"ROS {other} launch file in a ROS {3 - other} package ({several}, first {texts[0]}): "
        f"`{_LAUNCH[3 - other]}` rejects it; port it or delete it"
    )


def _half_ported(first: ConstructUse, texts: list[str], other: int) -> str:
    more = f" and {len(texts) - 1} more construct{'s' if len(texts) > 2 else ''}" if len(texts) > 1 else ""
    instead = f"; write {first.instead}" if first.instead else ""
    return f"{first.text}{more} of ROS {other}: `{_LAUNCH[3 - other]}` rejects the whole file{instead}"


def _is_ros1(use: ConstructUse) -> bool:
    """Whether *use* is a construct of ROS 1: one word of each tells."""
    words: tuple[str, ...] = (
        "type=",
        "ns=",
        "doc=",
        "rosparam",
        "find ",
        "arg ",
        "optenv",
        "machine",
        "clear_params",
        "pass_all",
        "<test",
    )
    words += ("required=", "textfile=", "binfile=", "command=", "<master")
    return any(word in use.text for word in words)


CHECK = Check(
    id="foreign-launch-construct",
    summary="Launch file written for the other ROS version.",
    level=Level.WARNING,
    catalogue="L12",
    tags=("launch",),
    run=check,
    of_refused=True,
)
