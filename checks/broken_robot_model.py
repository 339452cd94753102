# SPDX-License-Identifier: Apache-2.0
"""Robot descriptions that urdfdom refuses, or takes otherwise than they are meant."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from posixpath import basename

from haros_ci.api import Check, Finding, Level, Location, Project, regex
from haros_ci.api.robots import (
    Description,
    Joint,
    RobotLink,
    descriptions,
    is_left_over,
    lead,
    other_reader,
    place_of,
    together,
)

#: Joints that urdfdom refuses without a <limit> (parseJoint).
_LIMITED = ("revolute", "prismatic")
#: The start tag of an element, and whether that is all of it.
_START = regex(r"\s*<([\w:.-]+)(?:\s[^<>]*?)?(/)?>")
#: Blanks around what they mean nothing around.
_AROUND = regex(r"(?<!\s)\s*(=|>)\s*")
#: Lines of an element that are compared.
MAX_LINES = 200


def check(project: Project) -> Iterator[Finding]:
    for found in together(_found(project)):
        path = found.at.path
        if found.level is not Level.NOTE and is_left_over(path, project):
            yield replace(found, level=Level.NOTE, message=f"{found.message} (nothing here loads {basename(path)})")
        else:
            yield found


def _found(project: Project) -> Iterator[tuple[str, Finding]]:
    """The findings, each with what makes those at one place one: limits of the joints that one macro makes."""
    count = 0
    for description in descriptions(project):
        robot = description.robot
        if robot.root != "robot" or any(fault.certain and fault.kind != "unprefixed" for fault in robot.faults):
            continue
        for joint in robot.joints:
            if joint.certain:
                yield from limits(description, joint, project)
        twice = list(doubles(description, project))
        for other_finding in twice:
            yield f"{(count := count + 1)}", other_finding
        is_part = not description.is_named and not robot.path.endswith(".urdf")
        if robot.is_whole and robot.links and not (twice or is_part) and all(link.name for link in robot.links):
            for other_finding in tree(description):
                yield f"{(count := count + 1)}", other_finding


def finding(
    description: Description,
    at: Location,
    message: str,
    about: str,
    thing: Joint | RobotLink | None = None,
    level: Level | None = None,
    related: tuple[tuple[Location, str], ...] = (),
) -> Finding:
    way = lead(description, thing.way if thing is not None else ())
    return Finding(
        at=at,
        message=message,
        about=(description.package or description.robot.path, about),
        related=related,
        flow=(*way, (thing.location, f"the {about}")) if thing is not None and way else (),
        level=level,
        apart=(about,),
    )


def limits(description: Description, joint: Joint, project: Project) -> Iterator[tuple[str, Finding]]:
    """A ``<limit>`` that is missing, that lacks what it has to say, or that is the wrong way round."""
    about = f"joint {joint.name or '?'}"
    limit = joint.limit
    if limit is None:
        if joint.type in _LIMITED and description.robot.is_whole:
            yield (
                "no limit",
                finding(
                    description,
                    joint.location,
                    (
                        f"the {joint.type} {about} has no <limit>: urdfdom rejects the whole robot; add <limit>, or make the "
                        "joint continuous or fixed"
                    ),
                    about,
                    joint,
                ),
            )
        return
    missing = [name for name in ("effort", "velocity") if getattr(limit, name) is None]
    if missing and description.robot.is_whole:
        reader = other_reader(description, project)
        only = f" (here {reader} alone reads the file, which does without)" if reader else ""
        yield (
            f"without {missing}",
            finding(
                description,
                limit.location,
                (
                    f"the <limit> of {about} has no {' and no '.join(missing)}: urdfdom rejects the whole robot; add the "
                    f"attribute{only}"
                ),
                about,
                joint,
                Level.NOTE if reader else None,
            ),
        )
    lower, upper = number(limit.lower), number(limit.upper)
    if joint.type in _LIMITED and lower is not None and upper is not None and lower > upper:
        yield (
            "inverted",
            finding(
                description,
                limit.location,
                (
                    f"the lower limit of {about} ({lower:g}) is greater than the upper limit ({upper:g}): no position is "
                    f"allowed; {_mended(joint, lower, upper, description)}"
                ),
                about,
                joint,
                Level.WARNING,
            ),
        )


def _mended(joint: Joint, lower: float, upper: float, description: Description) -> str:
    """What to write instead of *lower* and *upper*; for a joint that follows another one backwards that one's range, turned."""
    factor = 1.0 if joint.factor is None else number(joint.factor)
    if joint.mimic is None or (factor is not None and factor >= 0):
        return "swap the two values"
    if factor is None:
        return f"the joint mimics {joint.mimic}: write the range that this gives it, the smaller value first"
    names = [
        other_joint
        for other_joint in description.robot.joints
        if other_joint.name == joint.mimic and other_joint.limit is not None
    ]
    limit, offset = names[0].limit if len(names) == 1 else None, number(joint.offset)
    low, high = (number(limit.lower), number(limit.upper)) if limit is not None else (None, None)
    what = f"the joint mimics {joint.mimic} times {factor:g}"
    if low is None or high is None or offset is None or low > high:
        return f"{what}: write the range of {joint.mimic} times {factor:g}, the smaller value first"
    ends = sorted((low * factor + offset + 0.0, high * factor + offset + 0.0))
    return f'{what}: write lower="{ends[0]:g}" upper="{ends[1]:g}"'


def number(text: str | None) -> float | None:
    """A limit as urdfdom reads it: 0 if it is not given; None if it is not known."""
    if text is None:
        return 0.0
    try:
        return float(text)
    except ValueError:
        return None


#: A thing, and the one that has its name already, with what it is.
Double = tuple[str, Joint | RobotLink, Joint | RobotLink]


def doubles(description: Description, project: Project) -> Iterator[Finding]:
    """Links, or joints, of one name; a macro called twice, or a block that is repeated, makes many, which are one finding."""
    found: dict[Location, list[Double]] = {}
    repeated: dict[tuple[str, str], list[Double]] = {}
    for kind, things in (("link", description.robot.links), ("joint", description.robot.joints)):
        first: dict[str, Joint | RobotLink] = {}
        for thing in things:
            if thing.certain and thing.name:
                before = first.setdefault(thing.name, thing)
                if before is thing:
                    continue
                double = (f"{kind} {thing.name!r}", thing, before)
                if is_repeated(thing.location, before.location, project):
                    repeated.setdefault((thing.location.path, before.location.path), []).append(double)
                else:
                    found.setdefault(place_of(thing, before), []).append(double)
    for several in repeated.values():
        several.sort(key=lambda double: double[1].location.line or 0)
        names = [about for about, _, _ in several]
        shown = [*names[:3], f"{len(names) - 3} more"] if len(names) > 3 else names
        listed = " and ".join(filter(None, (", ".join(shown[:-1]), shown[-1])))
        about, thing, before = several[0]
        are, them = ("are", "them") if len(names) > 1 else ("is", "it")
        yield finding(
            description,
            thing.location,
            f"{listed} {are} repeated word by word in one robot: urdfdom rejects the robot; delete {them} here",
            about.replace("'", ""),
            thing,
            related=tuple((one.location, f"the first {name}") for name, _, one in several[:3]),
        )
    for at, several in found.items():
        about, thing, before = several[0]
        more = f" (and {len(several) - 1} more duplicates)" if len(several) > 1 else ""
        yield finding(
            description,
            at,
            f"duplicate {about} in one robot{more}: urdfdom rejects the robot; rename one of the two",
            about.replace("'", ""),
            thing,
            related=((place_of(before, thing), f"the first {about}"),),
        )


def is_repeated(second: Location, first: Location, project: Project) -> bool:
    """Whether the elements at both places are the same, word by word, and nothing in them depends on where they are."""
    words = element(project, second) if second != first else []
    return bool(words) and not any("${" in word or "$(" in word for word in words) and words == element(project, first)


def element(project: Project, at: Location) -> list[str]:
    """The words of the element that begins at *at*; none where it is not found, or too long."""
    lines = project.workspace.text(at.path).split("\n")[max((at.line or 1) - 1, 0) :][:MAX_LINES]
    text = "\n".join(lines)[max((at.column or 1) - 1, 0) :]
    start = _START.match(text)
    if start is None:
        return []
    end = start.end() if start[2] else text.find(f"</{start[1]}>")
    return _AROUND.sub(r"\1", text[:end]).replace("/>", " />").split() if end > 0 else []


def tree(description: Description) -> Iterator[Finding]:
    """Links that joints name and that are not there, links with two parents, and what is no tree (initTree, initRoot)."""
    robot = description.robot
    links = {link.name: link for link in robot.links}
    if any(joint.parent is None or joint.child is None for joint in robot.joints):
        return
    parents: dict[str, Joint] = {}
    unknown: dict[str, list[tuple[str, Joint]]] = {}
    for joint in robot.joints:
        for role, name in (("parent", joint.parent or ""), ("child", joint.child or "")):
            if name not in links:
                unknown.setdefault(name, []).append((role, joint))
        before = parents.setdefault(joint.child or "", joint)
        if before is not joint and joint.child in links:
            yield finding(
                description,
                place_of(joint, before),
                (
                    f"link {joint.child!r} is the child of two joints, {before.name!r} and {joint.name!r}: urdfdom uses the "
                    "last joint only; give each link one parent joint"
                ),
                f"link {joint.child}",
                joint,
                Level.WARNING,
                related=((place_of(before, joint), f"the joint {before.name!r}"),),
            )
    roles = [role for uses in unknown.values() for role, _ in uses]
    is_part = not description.is_named and len(unknown) == 1 and all(unknown) and set(roles) == {"parent"}
    for name, uses in unknown.items():
        role, joint = uses[0]
        what = f"the {role} link {name!r}, which the robot does not have" if name else f"no {role} link"
        others = {id(use) for _, use in uses} - {id(joint)}
        more = (
            f" (and {len(others)} more joint{'s name' if len(others) > 1 else ' names'} it)" if others and name else ""
        )
        yield finding(
            description,
            joint.location,
            f"joint {joint.name or '?'} names {what}{more}: urdfdom rejects the robot; correct the link's name"
            f"{' (nothing here loads the file: it may be a part for another robot)' if is_part else ''}",
            f"link {name}" if name else f"joint {joint.name}",
            joint,
            Level.NOTE if is_part else None,
            related=tuple((use.location, f"joint {use.name}") for _, use in uses[1:4]),
        )
    roots = [link for link in robot.links if link.name not in parents]
    if unknown or len(roots) == 1:
        return
    if not roots:
        at = robot.joints[0]
        yield finding(
            description,
            at.location,
            (
                "the joints form a cycle, so no link is the root: urdfdom rejects the robot; remove one joint of the "
                "cycle"
            ),
            "root",
            at,
        )
        return
    names = ", ".join(repr(link.name) for link in roots[:4]) + (", …" if len(roots) > 4 else "")
    yield finding(
        description,
        place_of(roots[1], roots[0]),
        f"the robot has {len(roots)} root links, {names}: urdfdom rejects it; connect them by a joint",
        "root",
        roots[1],
        related=((place_of(roots[0], roots[1]), f"the root {roots[0].name!r}"),),
    )


CHECK = Check(
    id="broken-robot-model",
    summary="Robot model that urdfdom rejects: duplicate names, missing limits, or no single tree of links.",
    level=Level.ERROR,
    catalogue="X03",
    tags=("robot-description",),
    project=check,
)
