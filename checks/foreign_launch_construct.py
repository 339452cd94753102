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
        more = f" and {len(texts) - 1} more" if len(texts) > 1 else ""
        other = 1 if _is_ros1(first) else 2
        instead = f"; write {first.instead}" if first.instead else ""
        yield Finding(
            at=first.location,
            message=f"{first.text}{more} is of ROS {other}, and launch of ROS {3 - other} refuses it{instead}",
            about=(path,),
            related=tuple((use.location, f"{use.text}, too") for use in uses[1:20]),
            flow=included_by(first),
            level=Level.NOTE if other == 1 and first.is_installed is False else None,
        )


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
    summary="Launch files are written for the ROS version of their package.",
    level=Level.WARNING,
    catalogue="L12",
    tags=("launch",),
    run=check,
)
