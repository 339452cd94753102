# SPDX-License-Identifier: Apache-2.0
"""All code of a workspace, by language: its functions as routines, its classes, and which files mention a word.

Built once; everything that costs time is made when it is asked for.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

from haros_ci.code.body import Body, body_of
from haros_ci.index.build import build_index
from haros_ci.index.index import Index, Source, is_test
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.syntax import Class, Function

#: The header of rosserial's node handle, and that of roscpp's.
ROSSERIAL, ROSCPP = "ros.h", "ros/ros.h"


@dataclass(frozen=True, slots=True, eq=False)
class Routine:
    """A function with a body: *outer* is the routine that a lambda or nested function stands in."""

    source: Source
    function: Function
    outer: Routine | None = None

    @property
    def path(self) -> str:
        return self.source.path

    @property
    def is_python(self) -> bool:
        return self.source.program.language == "python"

    @property
    def location(self) -> Location:
        return Location(self.source.path, self.function.line, self.function.column)

    @property
    def method(self) -> Routine:
        """The routine that is no lambda around it, or it itself."""
        found = self
        while found.outer is not None:
            found = found.outer
        return found

    @property
    def is_test(self) -> bool:
        """Whether it stands in a folder or package for tests."""
        folders = self.source.path.split("/")[:-1]
        return is_test(self.source.path) or any(folder.endswith(("_test", "_tests")) for folder in folders)

    @property
    def owner(self) -> str:
        """The class whose ``this`` it sees; "" for a plain function."""
        return self.method.function.owner

    @property
    def title(self) -> str:
        """Its name for messages: ``Class::method``, ``the lambda in Class::method``."""
        name = self.function.name
        if self.function.kind == "lambda":
            return f"the lambda in {self.outer.title}" if self.outer is not None else "a lambda"
        parts = name.split(self.source.separator)
        return self.source.separator.join(parts[-2:] if self.function.owner else parts[-1:]) or "the module"


@dataclass(slots=True)
class Codebase:
    """*text* gives a file's text, *look* the same for looking up words quickly: nothing else of it is asked; *asked* are the words."""

    sources: tuple[Source, ...]
    text: Callable[[str], str]
    cpp: Index
    python: Index
    #: ROS version by package, where the manifest tells.
    ros: dict[str, int] = field(default_factory=dict)
    by_path: dict[str, Source] = field(default_factory=dict)
    _routines: dict[str, tuple[Routine, ...]] = field(default_factory=dict)
    _by_function: dict[int, Routine] = field(default_factory=dict)
    _bodies: dict[int, Body] = field(default_factory=dict)
    _mentions: dict[tuple[str, ...], frozenset[str]] = field(default_factory=dict)
    _texts: list[tuple[str, str]] | None = None
    _words: dict[str, list[str]] | None = None
    #: Sources that no target compiles: checks of the code pass them over, since they never run.
    unbuilt: frozenset[str] = frozenset()
    look: Callable[[str], str] | None = None
    asked: set[str] = field(default_factory=set)
    _firmware: frozenset[str] | None = None
    #: What other modules of this room remember about this code, by their own keys.
    kept: dict[object, Any] = field(default_factory=dict)

    def index(self, source: Source) -> Index:
        return self.python if source.program.language == "python" else self.cpp

    def body(self, routine: Routine) -> Body:
        """What a routine does."""
        found = self._bodies.get(id(routine.function))
        if found is None:
            found = self._bodies[id(routine.function)] = body_of(routine.function)
        return found

    def routines(self, path: str) -> tuple[Routine, ...]:
        """All functions of a file that have a body, lambdas after what they stand in."""
        found = self._routines.get(path)
        if found is None:
            source = self.by_path.get(path)
            found = self._routines[path] = tuple(self._made(source)) if source is not None else ()
        return found

    def _made(self, source: Source) -> Iterator[Routine]:
        functions = source.program.functions
        inner: set[int] = set()
        bodies: list[tuple[int, Function]] = []
        for number, function in enumerate(functions):
            if function.body is not None or function.inits:
                bodies.append((number, function))
                found = self._bodies[id(function)] = body_of(function)
                inner.update(other_number for other_number, _ in found.inner)
        waiting = [(function, None) for number, function in reversed(bodies) if number not in inner]
        pending: list[tuple[Function, Routine | None]] = list(waiting)
        while pending:
            function, outer = pending.pop()
            if id(function) in self._by_function:
                continue
            routine = self._by_function[id(function)] = Routine(source, function, outer)
            yield routine
            for index, _ in reversed(self.body(routine).inner):
                if 0 <= index < len(functions) and functions[index].body is not None:
                    pending.append((functions[index], routine))

    def routine(self, source: Source, function: Function) -> Routine | None:
        """The routine of a function; None for a declaration."""
        self.routines(source.path)
        found = self._by_function.get(id(function))
        if found is None and function.body is not None:  # a method that is defined through an alias of its class
            same = (one for one in self.routines(source.path) if one.function.body is function.body)
            found = self._by_function[id(function)] = next(same, None) or Routine(source, function)
        return found

    def inner(self, routine: Routine, index: int) -> Routine | None:
        """The lambda or nested function at *index* of the routine's file."""
        functions = routine.source.program.functions
        return self.routine(routine.source, functions[index]) if 0 <= index < len(functions) else None

    def routines_of(self, path: str, owner: str) -> Sequence[Routine]:
        """Those of ``routines`` that see the ``this`` of the class *owner*."""
        key = ("routines by class", path)
        if key not in self.kept:
            made: dict[str, list[Routine]] = {}
            for routine in self.routines(path):
                made.setdefault(routine.owner, []).append(routine)
            self.kept[key] = made
        found: Sequence[Routine] = self.kept[key].get(owner, ())
        return found

    def mentioning(self, *words: str) -> frozenset[str]:
        """The files of programs whose text contains one of *words*, without firmware and those that no target compiles."""
        if words not in self._mentions:
            if self._texts is None:
                look = self.look or self.text
                self._texts = [(source.path, look(source.path)) for source in self.sources]
            found: set[str] = set()
            self.asked.update(words)
            for word in words:
                found.update([path for path, text in self._texts if word in text])
            self._mentions[words] = frozenset(found - self.unbuilt - self.firmware)
        return self._mentions[words]

    def naming(self, word: str) -> frozenset[str]:
        """The same files as those of ``mentioning``, of those that have *word*, an identifier, as a whole word: for many words."""
        if self._words is None:
            self._words = {}
            outside, look = self.unbuilt | self.firmware, self.look or self.text
            for source in self.sources:
                if source.path not in outside:
                    for one in set(re.findall(r"\w+", look(source.path))):
                        self._words.setdefault(one, []).append(source.path)
        self.asked.add(word)
        return frozenset(self._words.get(word, ()))

    @property
    def firmware(self) -> frozenset[str]:
        """The C++ files of microcontrollers: they include rosserial's ``ros.h``, whose classes have the names of roscpp's.

        There ``subscribe`` and ``advertise`` are given objects that exist, and nothing is ever shut down.
        """
        if self._firmware is None:
            firmware = (
                source.path for source in self.sources if source.separator == "::" and self._is_firmware(source)
            )
            self._firmware = (
                frozenset(firmware) if any(ROSSERIAL in group for group in self._included()) else frozenset()
            )
        return self._firmware

    def _included(self) -> Iterator[tuple[str, ...]]:
        """What each file includes."""
        for source in self.sources:
            yield tuple(include.strip('<>" ') for include in source.program.includes)

    def _is_firmware(self, source: Source) -> bool:
        files = (source.path, *self.cpp.reach(source.path))
        included = {include.strip('<>" ') for path in files for include in self.by_path[path].program.includes}
        return ROSSERIAL in included and ROSCPP not in included

    def ros_of(self, source: Source) -> int | None:
        """1 or 2: what a Python file imports, for a package of one ROS may keep scripts for the other; else what the manifest of
        its package says, else what a C++ file includes.
        """
        program = source.program
        found = self.ros.get(source.package or "")
        if found is not None and program.language != "python":
            return found
        heads = {include.strip('<>"').partition("/")[0] for include in program.includes}
        heads |= {alias.type.name.partition(".")[0] for alias in program.aliases if program.language == "python"}
        either = {1: heads & {"ros", "rospy"}, 2: heads & {"rclcpp", "rclpy", "rclcpp_components"}}
        versions = [version for version, names in either.items() if names]
        return versions[0] if len(versions) == 1 else found

    def end_line(self, routine: Routine) -> int:
        """A line that the text of a routine surely ends before: the next one's first, or the file's end."""
        starts = (
            other_routine.function.line for other_routine in self.routines(routine.path) if other_routine.outer is None
        )
        later = [line for line in starts if line > routine.method.function.line]
        return min(later) if later else self.text(routine.path).count("\n") + 2

    def lines(self, routine: Routine, first: int) -> str:
        """The text of a routine's file from line *first* to where the routine ends at the latest."""
        return "\n".join(self.text(routine.path).split("\n")[first - 1 : self.end_line(routine) - 1])

    def classes(self, source: Source) -> tuple[tuple[Source, Class], ...]:
        """The classes of a file."""
        return tuple((source, class_) for class_ in source.program.classes)


def codebase(
    sources: Iterable[Source],
    text: Callable[[str], str],
    ros: dict[str, int] | None = None,
    look: Callable[[str], str] | None = None,
    asked: set[str] | None = None,
) -> Codebase:
    """The code of *sources*, the programs of a workspace sorted by path; *look* and *asked* are those of ``Codebase``."""
    every = tuple(sources)
    cpp = build_index(source for source in every if source.program.language != "python")
    python = build_index(source for source in every if source.program.language == "python")
    by_path = {source.path: source for source in every}
    asked = set() if asked is None else asked
    return Codebase(every, text, cpp, python, dict(ros or {}), by_path, look=look, asked=asked)
