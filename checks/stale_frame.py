# SPDX-License-Identifier: Apache-2.0
"""Coordinate frames that a change gives another name, and that something still uses under the old one."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from difflib import SequenceMatcher

from haros_ci.api import Check, Finding, Level, Location, Project, dataclass, regex
from haros_ci.api.robots import broadcasts

#: Frames that nodes of other packages broadcast: localization, mapping, odometry.
COMMON = frozenset({"map", "odom", "world", "earth"})
#: Parameters that hold the name of a frame.
_PARAMETER = regex(r"(?:^|[_./:])(?:frame|frame_id|frameid|[a-z0-9_]+_frame|[a-z0-9_]+_frame_id)$")
_YAML = regex(r"^\s*(?:- )?[\"']?([\w./]*frame\w*)[\"']?:\s*[\"']?/?([\w/]+)[\"']?\s*(?:#.*)?$")
_RVIZ = regex(r"^\s*(?:Fixed|Target|Reference) Frame: [\"']?/?([\w/]+)[\"']?\s*$")
#: A statement of code that takes a frame by its name: a look-up, or a message's header.
_CODE = regex(r"frame|[tT]ransform")
_DEFAULT = regex(r"param|declare|default|argument|getenv", re.IGNORECASE)
_TEXT = regex(r"[\"']/?([A-Za-z]\w*(?:/\w+)*)[\"']")
_LINK = regex(r"<(?:link|frame)\s[^>]*?name\s*=\s*[\"']([^\"']+)[\"']|child_frame_id\b[^\n]*?[\"']/?(\w+)[\"']")
_TEST = regex(r"(^|/)tests?/|(^|/)(test_[^/]*|[^/]*_test)\.\w+$")
#: What no robot is made of.
_SOURCES = frozenset((".cpp", ".cc", ".cxx", ".hpp", ".h", ".msg", ".srv", ".action", ".md", ".txt"))
_MODELS = (".xacro", ".urdf", ".sdf", ".xml", ".cpp", ".py", ".hpp", ".h", ".cc")
#: How alike two names are at least, where several frames of one place have new ones.
ALIKE = 0.6
#: The largest file that is looked into, in characters.
MAX_TEXT = 500_000


@dataclass(frozen=True, slots=True)
class _Frame:
    name: str
    source: str
    at: Location


def check(project: Project) -> Iterator[Finding]:
    if project.base is None:
        return
    changed = _changed(project, project.base)
    renamed = dict(_renamed(project, project.base, changed)) if changed else {}
    if not renamed:
        return
    reported: set[Location] = set()
    for place, name, what, level in _users(project, renamed):
        if _line(place) not in reported and _was_there(project, project.base, place):
            reported.add(_line(place))
            new = renamed[name]
            yield Finding(
                at=place,
                message=(
                    f"{what} still uses the frame {name}, which this change renames to {new.name} ({new.at}): tf has no frame "
                    f"{name} any more, so look-ups fail; write {new.name} here, too"
                ),
                about=(name, place.path),
                related=((new.at, "the new name of the frame"),),
                level=level,
            )


def _changed(project: Project, base: Project) -> frozenset[str]:
    """The suffixes of the files that are not as they were at the base."""
    old, new = (
        {(file.path, file.digest) for file in other_project.workspace.files} for other_project in (base, project)
    )
    return frozenset("." + path.rpartition(".")[2] for path, _ in old ^ new)


def _renamed(project: Project, base: Project, changed: frozenset[str]) -> Iterator[tuple[str, _Frame]]:
    """Frames of the base that nothing provides now, each with the new one of the same source."""
    has_links = not changed <= _SOURCES
    before, after = tuple(_frames(base, project.renames, has_links)), tuple(_frames(project, {}, has_links))
    old, new = ({frame.name for frame in frames} for frames in (before, after))
    written = None
    for source in dict.fromkeys(frame.source for frame in before):
        removed = {frame.name: frame for frame in before if frame.source == source and frame.name not in new}
        come = {frame.name: frame for frame in after if frame.source == source and frame.name not in old}
        for name in removed:
            if name in COMMON or not come:
                continue
            similarity, best = max((SequenceMatcher(None, name, other).ratio(), other) for other in come)
            is_only = len(removed) == len(come) == 1
            if not is_only and similarity < ALIKE:
                continue
            written = _written(project) if written is None else written
            if not any(text == name or text.endswith(f"}}{name}") for text in written):
                yield name, come[best]


def _frames(project: Project, renames: Mapping[str, str], has_links: bool) -> Iterator[_Frame]:
    """The links of robots and the children of transforms, with a name for the source that is the same in both revisions."""
    for description in project.descriptions if has_links else ():
        for link in description.robot.links:
            if link.name:
                path = link.location.path
                yield _Frame(link.name, renames.get(path, path), link.location)
    for system in project.systems:
        for sent in broadcasts(project, system):
            path = renames.get(sent.at.path, sent.at.path)
            yield _Frame(sent.child, f"{path} {sent.node.type} {sent.parent}", sent.at)


def _written(project: Project) -> frozenset[str]:
    """What the workspace calls links and children of transforms, as it is written."""
    found: set[str] = set()
    for path in sorted(project.workspace.names):
        if path.endswith(_MODELS):
            text = project.text(path)[:MAX_TEXT]
            if "<link" in text or "<frame" in text or "child_frame_id" in text:
                found |= {match[1] or match[2] for match in _LINK.finditer(text)}
    return frozenset(found)


def _users(project: Project, renamed: Mapping[str, _Frame]) -> Iterator[tuple[Location, str, str, Level]]:  # noqa: C901 - one loop for each place that names a frame
    """Place, frame, what names it there, and how grave that is."""
    for system in project.systems:
        for parameter in system.parameters:
            place = parameter.origin or parameter.location
            name = _frame_of(parameter.value) if _PARAMETER.search(parameter.name) else ""
            if name in renamed and place is not None and not parameter.unknowns:
                yield place, name, f"the parameter {parameter.name}", Level.ERROR
        keys = {parameter.name for parameter in system.parameters}
        for node in system.nodes:
            for end in node.of("parameters", "getters"):
                name = _frame_of(end.raw.value)
                if name in renamed and end.in_source and end.name not in keys and _PARAMETER.search(end.name):
                    yield end.location, name, f"the default of the parameter {end.name}", Level.ERROR
        for sent in broadcasts(project, system):
            if sent.parent in renamed and sent.parent is not None and sent.node.is_launched:
                yield sent.at, sent.parent, f"the transform of {sent.child} that {sent.node} sends", Level.ERROR
    for file in project.workspace.files:
        if _TEST.search(file.path):
            continue
        if file.language in ("cpp", "python"):
            yield from _in_code(file.path, project.text(file.path), renamed)
        elif file.language == "yaml":
            for number, line in _lines(project.text(file.path)):
                match = _YAML.match(line)
                if match and match[2] in renamed and _PARAMETER.search(match[1]):
                    yield Location(file.path, number), match[2], f"the parameter {match[1]}", Level.ERROR
    for path in sorted(project.workspace.names):
        if path.endswith(".rviz"):
            for number, line in _lines(project.text(path)):
                match = _RVIZ.match(line)
                if match and match[1] in renamed:
                    yield Location(path, number), match[1], "rviz", Level.WARNING


def _frame_of(value: object) -> str:
    return value.lstrip("/") if isinstance(value, str) else ""


def _in_code(path: str, text: str, renamed: Mapping[str, _Frame]) -> Iterator[tuple[Location, str, str, Level]]:
    if not any(name in text for name in renamed):
        return
    lines = text[:MAX_TEXT].split("\n")
    for number, line in enumerate(lines, 1):
        for match in _TEXT.finditer(line):
            before = line[: match.start()]
            if match[1] not in renamed or "//" in before or "#" in before or before.lstrip().startswith("*"):
                continue
            around = " ".join(lines[max(number - 2, 0) : number]) if not _CODE.search(line) else line
            if _CODE.search(around) and not _DEFAULT.search(around) and not re.match(r"\s*[=!]=", line[match.end() :]):
                yield Location(path, number, match.start() + 1), match[1], "the code", Level.ERROR


def _lines(text: str) -> Iterator[tuple[int, str]]:
    return enumerate(text[:MAX_TEXT].splitlines(), 1)


def _line(place: Location) -> Location:
    return Location(place.path, place.line)


def _was_there(project: Project, base: Project, place: Location) -> bool:
    """Whether the line was there before the change: what the change itself writes is meant so."""
    old = next((old for old, new in project.renames.items() if new == place.path), place.path)
    lines = project.text(place.path).splitlines()
    line = lines[place.line - 1].strip() if place.line and place.line <= len(lines) else ""
    return bool(line) and line in base.text(old)


CHECK = Check(
    id="stale-frame",
    summary="Old name of a renamed coordinate frame.",
    level=Level.ERROR,
    tags=("tf", "change"),
    project=check,
)
