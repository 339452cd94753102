# SPDX-License-Identifier: Apache-2.0
"""What checks of robot descriptions have in common."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace

from haros_ci.checking.check import Finding
from haros_ci.checking.project import Project
from haros_ci.checking.wording import listed
from haros_ci.model.location import Location
from haros_ci.model.robot import Description, Thing, Way
from haros_ci.regex import regex
from haros_ci.results.rule import Level

#: Names that a message lists, and places that a finding relates.
_NAMED = 3
_SHOWN = 40
#: Languages of files whose text may name a description, and libraries that read one without urdfdom.
_NAMING = ("launch", "python", "cpp", "xml", "yaml", "shell", "cmake")
_READERS = regex(
    r"^[ \t]*(?:import|from)[ \t]+(ikpy|pybullet|pinocchio|kinpy|urdfpy|yourdfpy|pytorch_kinematics|urchin)\b",
    re.MULTILINE,
)
_TRIALS = ("test", "tests", "testdata", "test_data")


def descriptions(project: Project) -> Iterator[Description]:
    """The robots that are meant to be whole: those of test directories, broken on purpose, only where a launch file names them."""
    for description in project.descriptions:
        if description.command or not any(part in _TRIALS for part in description.robot.path.split("/")[:-1]):
            yield description


#: How the message begins of a file that holds a robot and is no XML.
_NO_XML = "not read as a description of a robot: not well-formed XML: "


def malformed(project: Project) -> Iterator[tuple[Location, str]]:
    """The descriptions of robots that are no XML: the place of the first fault of each, and what it is in expat's words."""
    _ = project.descriptions  # now all of them have been read
    for problem in project.problems:
        if problem.message.startswith(_NO_XML):
            yield Location(problem.path, problem.line or 1), problem.message.removeprefix(_NO_XML)


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


def other_reader(description: Description, project: Project) -> str:
    """The library, other than urdfdom, by which alone Python code reads the file of *description*; "" if anything else names the file, or nothing does.

    None of these asks a limit for its effort or velocity (ikpy's URDF_parser, PyBullet's loadURDF, pinocchio's and kinpy's own readers).
    """
    name = description.robot.path.rpartition("/")[2]
    if description.command or "/" in name or not name:
        return ""
    found = ""
    for file in project.workspace.files:
        if file.path == description.robot.path or file.language not in _NAMING:
            continue
        text = project.text(file.path)
        if name not in text:
            continue
        reader = _READERS.search(text) if file.language == "python" else None
        if reader is None:
            return ""
        found = found or reader[1]
    return found


def together(findings: Iterable[tuple[str, Finding]]) -> Iterator[Finding]:
    """The *findings*, each with its kind; those of one kind at one place, where a macro that is called several times makes each, are one.

    Each is identified by the first of its *apart* names. The calls of the others are related places.
    """
    found: dict[tuple[str, Location], list[Finding]] = {}
    for kind, finding in findings:
        found.setdefault((kind, finding.at), []).append(finding)
    for same in found.values():
        if len({finding.apart for finding in same}) < 2:
            yield from same
        else:
            yield _merged(same)


def _merged(same: list[Finding]) -> Finding:
    levels = {finding.level for finding in same}
    first = same[0]
    names = list(dict.fromkeys(name for finding in same for name in finding.apart))
    owners = {finding.about[0] for finding in same if finding.about}
    owner = next(iter(owners)) if len(owners) == 1 else first.at.path
    others = [name for name in names if name not in first.apart]
    shown = [*others[:_NAMED], f"{len(others) - _NAMED} more"] if len(others) > _NAMED + 1 else others
    end = "" if first.message.endswith(("?", ".")) else ";"
    the = "The" if first.message.endswith(("?", ".")) else "the"
    places = dict.fromkeys(first.related)
    for finding in same:
        call = next((at for at, _ in reversed(finding.flow) if at != first.at), None)
        if finding is not first and call is not None and finding.apart != first.apart:
            places.setdefault((call, f"{', '.join(finding.apart)}, too"))
    return replace(
        first,
        message=f"{first.message}{end} {the} same is true of {listed(shown)}, by other calls of this macro",
        about=(owner, *names),
        related=tuple(places)[:_SHOWN],
        apart=tuple(names),
        level=next((level for level in (Level.ERROR, None, Level.WARNING, Level.NOTE) if level in levels), None),
    )
