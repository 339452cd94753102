# SPDX-License-Identifier: Apache-2.0
"""Objects of messages of ROS 2 that Python makes with values without names: the generated classes take ``**kwargs`` alone (rosidl_generator_py, _msg.py.em)."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci import syntax
from haros_ci.checking.message_fields import expressions, typed_routines
from haros_ci.checking.project import Project
from haros_ci.code.body import nodes
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.model.location import Location
from haros_ci.records import dataclass

#: Values with which the class is called otherwise than by one list of values.
_NAMED = (syntax.Keyword, syntax.Star, syntax.DoubleStar)


@dataclass(frozen=True, slots=True)
class UnnamedValues:
    """*maker* (``Int32``), the class with *fields*, is given *count* values without names in *routine*."""

    maker: str
    fields: tuple[str, ...]
    count: int
    routine: Routine
    location: Location


def unnamed_values(project: Project) -> Iterator[UnnamedValues]:
    """The first such call of each class in each function; what stands in a ``try`` is left out, for the code may be ready for it."""
    code = project.code
    for typed in typed_routines(project):
        if typed.structs.known.ros != 2:
            continue
        found: set[str] = set()
        for expression in expressions(typed.routine.function.body or ()):
            for call in nodes(expression):
                struct = typed.struct_of(code, call) if isinstance(call, syntax.Call) and call.arguments else None
                if not isinstance(call, syntax.Call) or struct is None or struct.name in found:
                    continue
                if not any(isinstance(argument, _NAMED) for argument in call.arguments):
                    found.add(struct.name)
                    maker = struct.name.rpartition(".")[2]
                    at = _location(code, typed.routine, maker)
                    yield UnnamedValues(maker, tuple(struct.fields), len(call.arguments), typed.routine, at)


def _location(code: Codebase, routine: Routine, maker: str) -> Location:
    """Where the class is first called with a value that has no name, else the head of the function."""
    start = routine.function.line
    pattern = re.compile(rf"(?<!\w){re.escape(maker)}\s*\((?!\s*(?:\)|\*|\w+\s*=(?!=)))")
    text = code.text(routine.path) if routine.function.kind == "module" else code.lines(routine, start)
    for number, line in enumerate(text.split("\n"), start or 1):
        match = pattern.search(line.partition("#")[0])
        if match is not None:
            return Location(routine.path, number, match.start() + 1, number, match.start() + 1 + len(maker))
    return Location(routine.path, start or 1)
