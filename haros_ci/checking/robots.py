# SPDX-License-Identifier: Apache-2.0
"""What checks of robot descriptions have in common."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.checking.project import Project
from haros_ci.model.location import Location
from haros_ci.model.robot import Description, Thing, Way

_TRIALS = ("test", "tests", "testdata", "test_data")


def descriptions(project: Project) -> Iterator[Description]:
    """The robots that are meant to be whole: those of test directories, broken on purpose, only where a launch file names them."""
    for each in project.descriptions:
        if each.command or not any(part in _TRIALS for part in each.robot.path.split("/")[:-1]):
            yield each


def place_of(second: Thing, first: Thing | None = None) -> Location:
    """Where to mend *second*: the call that makes it, if a macro makes both it and *first*."""
    if first is not None and second.location == first.location:
        mine, theirs = second.way, first.way
        for (here, _), (there, _) in zip(mine, theirs):
            if here != there:
                return here
    return second.location


def lead(description: Description, way: Way) -> Way:
    """The steps from where the description begins to the place that *way* leads to."""
    if description.location is None:
        return way
    return ((description.location, f"xacro makes it of {description.robot.path}"), *way)


def is_by_itself(description: Description) -> bool:
    """Whether it is meant to be a whole robot: somebody names it, or its joints and links are one tree, of more than one link."""
    robot = description.robot
    if description.is_named:
        return True
    links = {link.name for link in robot.links}
    children = {joint.child for joint in robot.joints}
    ends = {end for joint in robot.joints for end in (joint.parent, joint.child)}
    return bool(robot.joints) and None not in links | ends and ends <= links and len(links - children) == 1
