# SPDX-License-Identifier: Apache-2.0
"""option() of CMake for a variable that an option() before has set already (cmake-commands(7), option)."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, regex
from haros_ci.api.packages import CMakeCommand

_UNSET = regex(r"\bunset\s*\(|\bCACHE\b", re.IGNORECASE)
_TRUE = frozenset(("ON", "TRUE", "YES", "Y", "1"))


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        first: dict[str, CMakeCommand] = {}
        removed: set[str] = set()
        for command in package.commands("option"):
            words = command.arguments
            if len(words) < 2 or "$" in words[0]:
                continue
            before = first.get(words[0])
            if before is None:
                if not command.is_conditional:
                    first[words[0]] = command
                continue
            old, new = _default(before), _default(command)
            if words[0] in removed or old is None or new is None or old == new or command.location == before.location:
                continue
            removed.add(words[0])
            if _UNSET.search(project.text(command.location.path)):
                continue
            value = "ON" if new else "OFF"
            yield Finding(
                at=command.location,
                message=f"option({words[0]}) has no effect: line {before.location.line} of {before.location.path} has set the variable "
                f"already, and option() leaves a variable that is set alone; write set({words[0]} {value}) to change it",
                about=(package.name, words[0]),
                related=((before.location, "the first option()"),),
            )


def _default(command: CMakeCommand) -> bool | None:
    word = command.arguments[2] if len(command.arguments) > 2 else "OFF"
    return None if "$" in word else word.upper() in _TRUE


CHECK = Check(
    id="option-without-effect",
    summary="Second option() of the same variable, which has no effect.",
    level=Level.WARNING,
    tags=("build",),
    project=check,
)
