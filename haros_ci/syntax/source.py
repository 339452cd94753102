# SPDX-License-Identifier: Apache-2.0
"""A program with the file that it is: what the index looks names up in, and what values that are functions or classes come from."""

from __future__ import annotations

from haros_ci.records import dataclass
from haros_ci.syntax.program import Program


@dataclass(frozen=True, slots=True, eq=False)
class Source:
    """A file as a program: *path* is relative to the root, *module* its dotted Python name."""

    path: str
    package: str | None
    program: Program
    module: str = ""

    @property
    def separator(self) -> str:
        return "." if self.program.language == "python" else "::"
