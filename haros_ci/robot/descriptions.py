# SPDX-License-Identifier: Apache-2.0
"""The robot descriptions of a workspace: which files are whole ones, and with which arguments xacro makes them."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import replace

from haros_ci.launch.facts.files import Finder
from haros_ci.model.build import Build
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.model.robot import Description, Robot
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.robot.commands import xacro_command
from haros_ci.robot.places import by_builds, found
from haros_ci.robot.sources import DescriptionSources
from haros_ci.robot.unknown import UNKNOWN, UnknownValue
from haros_ci.robot.urdf import read_robot

#: Files that may say with which arguments xacro is run.
_CALLERS = ("launch", "python", "cmake", "yaml")
_PASSED = regex(r"(?<![\w.])([A-Za-z_]\w*)\s*:=|[\"']([A-Za-z_]\w*)[\"']\s*:")
#: A name behind ``:=``, as it stands or in Python: ``" control:=", part``, ``f"control:={part}"``.
_VALUE = regex(r":=[\"' \t,+{]{0,20}(?:f[\"'][\"' \t,+{]{0,20})?(\w+)")
_HOLE = regex(r"\$\{[^}]*\}|\$\([^)]*\)|\*|\?|\[[^]]*\]")
#: Descriptions that are expanded on their own, at most.
MAX_FILES = 2_000
#: Names of arguments that launch files may give; with more of them any argument may be given.
MAX_PASSED = 5_000
#: Includes with something computed in their names, and the longest name of one.
MAX_PATTERNS = 2_000
MAX_NAME = 1_000
#: Characters of files that say how descriptions are made.
MAX_CALLERS = 5_000_000


@dataclass(slots=True)
class IncludedFiles:
    """Names of files as includes have them; what is computed in one may be anything."""

    names: set[str] = field(default_factory=set)
    parts: set[tuple[str, ...]] = field(default_factory=set)

    def add(self, name: str) -> None:
        base = _HOLE.sub("\x00", name[:MAX_NAME]).rpartition("/")[2]
        if "\x00" not in base:
            self.names.add(base)
        elif base.strip("\x00") and len(self.parts) < MAX_PATTERNS:
            self.parts.add(tuple(base.split("\x00")))

    def has(self, base: str) -> bool:
        """Whether a file of this name may be included."""
        return base in self.names or any(_fits(parts, base) for parts in self.parts)


def _is_named(name: str, text: str) -> bool:
    """Whether *name* stands in *text*, and is not the end of a longer name."""
    at = text.find(name)
    while at > 0 and (text[at - 1].isalnum() or text[at - 1] in "_.-"):
        at = text.find(name, at + 1)
    return at >= 0


def _names_passed(callers: str) -> set[str]:
    """The names of the arguments that launch files pass to xacro."""
    return {name for pair in _PASSED.findall(callers) for name in pair if name}


def _is_passed(name: str, text: str) -> bool:
    """Whether launch files give *name* to xacro as the value of an argument: then another description includes the file.

    The path may stand behind ``:=`` itself, or in a variable of Python that does.
    """
    end = rf"{re.escape(name)}(?![\w.-])"
    if re.search(rf":=[ \t]*[^\s,;]{{0,300}}?{end}", text):
        return True
    variables = re.findall(rf"^[ \t]*(\w+)[ \t]*=[^\n=]{{0,300}}?(?<![\w.-]){end}", text, re.MULTILINE)
    return bool(variables) and not set(_VALUE.findall(text)).isdisjoint(variables)


def _fits(parts: tuple[str, ...], name: str) -> bool:
    """Whether *name* is *parts* with anything in between."""
    first, *inner, last = parts
    if len(name) < len(first) + len(last) or not (name.startswith(first) and name.endswith(last)):
        return False
    at = len(first)
    for part in inner:
        at = name.find(part, at, len(name) - len(last))
        if at < 0:
            return False
        at += len(part)
    return True


@dataclass(slots=True)
class Descriptions:
    """Reads the descriptions of *workspace*, each file once; *builds* say where installed files come from."""

    workspace: Workspace
    builds: Mapping[str, Build]
    finder: Finder = field(init=False)
    sources: DescriptionSources = field(init=False)
    _owners: dict[str, Package | None] = field(default_factory=dict, init=False)
    _read: dict[tuple[object, ...], Robot | None] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        self.finder = Finder(self.workspace, self.builds)
        self.sources = DescriptionSources(self.workspace, by_builds(self.finder), self.finder.written)

    def of_files(self) -> Iterator[Description]:
        """Each file that is a description by itself: no other includes it, and it names its robot or a launch file names it."""
        included = self._included()
        callers = "\n".join(self._callers())
        passed = _names_passed(callers)
        tops = [path for path in self._candidates() if not included.has(path.rpartition("/")[2])]
        names = Counter(path.rpartition("/")[2] for path in tops)
        for path in tops[:MAX_FILES]:
            base = path.rpartition("/")[2]
            title = base if names[base] == 1 else self._inside(path)
            is_named = _is_named(title, callers) and not _is_passed(title, callers)
            is_known = is_named and len(passed) <= MAX_PASSED
            arguments = dict.fromkeys(passed, UNKNOWN) if is_known else {}
            robot = self._robot(path, arguments, is_open=not is_known)
            if robot is not None and (is_named or (robot.name != "" and robot.links)):
                yield replace(self._description(robot), is_named=is_named)

    @property
    def problems(self) -> tuple[Problem, ...]:
        """The descriptions that were not expanded to their ends."""
        return tuple(self.sources.problems.values())

    def of_command(self, command: str, location: Location | None = None) -> Description | None:
        """What xacro makes for a launch file's *command*; None if it is another command, or its file is not here."""
        call = xacro_command(command)
        if call is None:
            return None
        path = found(self.finder, call.file).path
        robot = None if path is None else self._robot(path, call.arguments)
        return None if robot is None else self._description(robot, command, location)

    def _description(self, robot: Robot, command: str = "", location: Location | None = None) -> Description:
        owner = self._owner(robot.path)
        return Description(
            robot=robot,
            package=owner.name if owner is not None else "",
            ros=owner.ros if owner is not None else None,
            command=command,
            location=location,
        )

    def _robot(self, path: str, arguments: Mapping[str, str | UnknownValue], *, is_open: bool = False) -> Robot | None:
        key = (path, is_open, tuple(sorted((name, str(value)) for name, value in arguments.items())))
        if key not in self._read:
            owner = self._owner(path)
            is_old = owner is not None and owner.ros == 1
            self._read[key] = read_robot(self.sources, path, arguments, legacy=is_old, is_open=is_open)
        return self._read[key]

    def _owner(self, path: str) -> Package | None:
        folder = path.rpartition("/")[0]
        if folder not in self._owners:
            around = (p for p in self.workspace.packages if p.path == "." or f"{folder}/".startswith(f"{p.path}/"))
            self._owners[folder] = max(around, key=lambda package: len(package.path), default=None)
        return self._owners[folder]

    def _inside(self, path: str) -> str:
        """The path inside its package."""
        owner = self._owner(path)
        return path if owner is None or owner.path == "." else path[len(owner.path) + 1 :]

    def _candidates(self) -> Iterator[str]:
        """The XML files whose root is a robot, but those for SRDF."""
        for file in self.workspace.files:
            if (
                file.language != "xml"
                or file.path.endswith((".srdf", ".sdf"))
                or "<robot" not in self.workspace.text(file.path)
            ):
                continue
            root = self.sources.read(file.path)
            if root is not None and root.tag == "robot":
                yield file.path

    def _callers(self) -> Iterator[str]:
        left = MAX_CALLERS
        for file in self.workspace.files:
            if file.language in _CALLERS:
                text = self.workspace.text(file.path)
                if "xacro" in text or "urdf" in text or "robot_description" in text:
                    left -= len(text)
                    if left < 0:
                        return
                    yield text

    def _included(self) -> IncludedFiles:
        """The names of files that some xacro may include."""
        found = IncludedFiles()
        files = (file.path for file in self.workspace.files if file.language == "xml")
        for path in dict.fromkeys((*files, *self.finder.written)):
            if "include" not in self.sources.text(path):
                continue
            root = self.sources.read(path)
            for node in () if root is None else root.walk():
                name = node.attributes.get("filename")
                if node.tag.endswith("include") and isinstance(name, str):
                    found.add(name)
        return found
