# SPDX-License-Identifier: Apache-2.0
"""Conflict markers that a merge has left in a file (git-merge(1), HOW CONFLICTS ARE PRESENTED)."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, listed
from haros_ci.api.packages import CONFLICT_BEGINS, CONFLICT_ENDS, conflicts

_LANGUAGES = frozenset(("cpp", "python", "launch", "package", "cmake", "yaml", "interface", "xml", "setup", "shell"))
#: How comments of more than one line begin and end.
_COMMENTS = {"cpp": ("/*", "*/"), "xml": ("<!--", "-->"), "launch": ("<!--", "-->"), "package": ("<!--", "-->")}
_EFFECTS = {
    "cpp": "it does not compile",
    "python": "Python cannot read it",
    "launch": "launch cannot read it",
    "package": "the package is not found",
    "cmake": "CMake stops there",
    "interface": "its code cannot be generated",
}


def check(project: Project) -> Iterator[Finding]:
    """One finding for the files that one merge has left: those whose conflicts end with the same name."""
    merges: dict[tuple[str, str], list[tuple[str, list[int], str]]] = {}
    for file in project.workspace.files:
        if file.language not in _LANGUAGES or file.third_party:
            continue
        text = project.text(file.path)
        if CONFLICT_BEGINS not in text or CONFLICT_ENDS not in text or not _is_code(project, file.path):
            continue
        lines = conflicts(text, *_COMMENTS.get(file.language, ("", "")))
        if not lines:
            continue
        effect = _EFFECTS.get(file.language, "what reads it stops there")
        merges.setdefault((_merged(text), effect), []).append((file.path, lines, effect))
    for files in merges.values():
        yield _finding(files)


def _merged(text: str) -> str:
    """The name behind the first closing marker: the branch or commit that was merged."""
    closing = re.search(rf"^{CONFLICT_ENDS}(.{{1,200}})$", text, re.MULTILINE)
    return closing[1].strip() if closing is not None else ""


def _finding(files: list[tuple[str, list[int], str]]) -> Finding:
    path, lines, effect = files[0]
    more = f" (and {len(lines) - 1} more)" if len(lines) > 1 else ""
    also = (
        f"; so {'does' if len(files) == 2 else 'do'} {listed([other for other, _, _ in files[1:]])}"
        if len(files) > 1
        else ""
    )
    return Finding(
        at=Location(path, lines[0]),
        message=f"{path} holds the markers of a merge conflict from line {lines[0]} on{more}: {effect}; choose one side "
        f"and remove the markers{also}",
        about=tuple(file for file, _, _ in files),
        related=tuple((Location(file, first[0]), "the markers of the same merge") for file, first, _ in files[1:]),
    )


def _is_code(project: Project, path: str) -> bool:
    """Whether the markers are not in a text of a Python file: with one in its code no Python can be read."""
    program = project.programs.get(path)
    return program is None or program.language != "python" or bool(program.problems)


CHECK = Check(
    id="merge-conflict",
    summary="Markers of a merge conflict.",
    level=Level.ERROR,
    tags=("files",),
    project=check,
)
