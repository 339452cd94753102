# SPDX-License-Identifier: Apache-2.0
"""Launch files that make a robot description of a xacro file that only defines macros."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project


def check(project: Project) -> Iterator[Finding]:
    for description in project.descriptions:
        robot = description.robot
        if not description.command or description.location is None or not robot.is_whole:
            continue
        if robot.root != "robot" or robot.size or any(fault.certain for fault in robot.faults):
            continue
        macros = f" only defines macros ({', '.join(robot.macros[:3])})" if robot.macros else " is empty"
        yield Finding(
            at=description.location,
            message=f"xacro expands {robot.path.rpartition('/')[2]} to a robot without links: the file{macros}; name a file "
            "that defines links or calls the macros",
            about=(description.package or robot.path, robot.path.rpartition("/")[2]),
            related=((Location(robot.path, 1), "this file is expanded"),),
        )


CHECK = Check(
    id="empty-robot-description",
    summary="Robot description that xacro expands to no links.",
    level=Level.ERROR,
    catalogue="X02",
    tags=("robot-description", "launch"),
    project=check,
)
