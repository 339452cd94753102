# SPDX-License-Identifier: Apache-2.0
"""The function, class or namespace that encloses each line of a file, found without a compiler."""

from __future__ import annotations

from bisect import bisect_right

from haros_ci.records import dataclass
from haros_ci.results.comments import lines_of


@dataclass(frozen=True, slots=True)
class LineScopes:
    """Qualified names by line: *names[i]* holds from line *starts[i]* up to the next start."""

    starts: tuple[int, ...] = ()
    names: tuple[str, ...] = ()

    def at(self, line: int) -> str:
        """The innermost scope on the 1-based *line* (``nav::Ctl::init``, ``Class.method``), "" outside any."""
        index = bisect_right(self.starts, line) - 1
        return self.names[index] if index >= 0 else ""


def scopes(text: str, language: str) -> LineScopes:
    """The scopes of a C, C++ or Python text, in linear time; none for other languages. Broken input never raises.

    A scope begins where its declaration does and ends with its last line of code. Lambdas and blocks are no scopes;
    anonymous namespaces and types add nothing to a name. A macro that stands for a definition is named with its
    arguments: ``TEST(Walker, turns)``.
    """
    if language == "cpp":
        from haros_ci.results.scope_cpp import cpp_marks as marks
    elif language == "python":
        from haros_ci.results.scope_python import python_marks as marks
    else:
        return LineScopes()
    found = marks("\n".join(lines_of(text)))
    return LineScopes(tuple(line for line, _ in found), tuple(name for _, name in found))


def mark(marks: list[tuple[int, str]], line: int, name: str) -> None:
    """Append "from *line* on, *name*" to marks in ascending order; what began at or after *line* gives way."""
    while marks and marks[-1][0] >= line:
        marks.pop()
    if (marks[-1][1] if marks else "") != name:
        marks.append((line, name))
