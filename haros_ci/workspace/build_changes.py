# SPDX-License-Identifier: Apache-2.0
"""What a change brings into build files that no reader here follows: findings, and notes where it is usual."""

from __future__ import annotations

from haros_ci.model.workspace import Problem, Workspace
from haros_ci.workspace.build_steps import BuildStep, steps_not_followed

#: Findings for one file, and notes of one run.
MOST = 20


def brought_steps(head: Workspace, base: Workspace) -> tuple[tuple[Problem, ...], tuple[Problem, ...]]:
    """What changed CMake files of *head* have, and no CMake file of *base* that is gone or has changed, in the same words: what is a finding, and what is a note."""
    known = {file.digest for file in base.files if file.language == "cmake"}
    same = {(file.path, file.digest) for file in head.files if file.language == "cmake"}
    changed = [
        file
        for file in head.files
        if file.language == "cmake" and file.digest not in known and not file.third_party and head.reports_on(file.path)
    ]
    if not changed:
        return (), ()
    before = {
        step.words
        for file in base.files
        if file.language == "cmake" and (file.path, file.digest) not in same
        for step in steps_not_followed(base.text(file.path))
    }
    names = {path.rpartition("/")[2] for path in head.names}
    found: list[Problem] = []
    notes: list[Problem] = []
    for file in changed:
        steps = [
            step for step in steps_not_followed(head.text(file.path), names.__contains__) if step.words not in before
        ]
        found += (_problem(file.path, step) for step in [step for step in steps if not step.is_usual][:MOST])
        notes += (_problem(file.path, step) for step in steps if step.is_usual)
    return tuple(found), tuple(notes[:MOST])


def _problem(path: str, step: BuildStep) -> Problem:
    return Problem(path, f"{step.words} may compile, make or run what is not analysed", step.line)
