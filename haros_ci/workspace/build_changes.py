# SPDX-License-Identifier: Apache-2.0
"""What a change brings into build files that no reader here follows: findings, and notes where it is usual."""

from __future__ import annotations

from haros_ci.model.workspace import Problem, Workspace
from haros_ci.workspace.build_steps import BuildStep, steps_not_followed
from haros_ci.workspace.cut import cut

#: Build types of packages whose build files are read; "" is catkin, or one that the manifest does not tell.
_READ = frozenset(("", "ament_cmake", "ament_cmake_auto", "ament_cmake_python", "ament_python", "catkin", "cmake"))
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
        found += cut((_problem(file.path, step) for step in steps if not step.is_usual), MOST)
        notes += (_problem(file.path, step) for step in steps if step.is_usual)
    return tuple(found), cut(notes, MOST)


def brought_builders(head: Workspace, base: Workspace) -> tuple[Problem, ...]:
    """The packages of *head* that are built by what nothing here reads (Meson, Cargo, Gradle), and in *base* were not, or not there."""
    before = {(package.path, package.build_type) for package in base.packages}
    found = []
    for package in head.packages:
        path = "package.xml" if package.path == "." else f"{package.path}/package.xml"
        is_read = package.build_type in _READ
        if not is_read and (package.path, package.build_type) not in before and head.reports_on(path):
            message = f"{package.name} is built by {package.build_type}, whose files nothing here reads: what it compiles, makes or runs is not known"
            found.append(Problem(path, message))
    return cut(found, MOST)


def _problem(path: str, step: BuildStep) -> Problem:
    return Problem(path, f"{step.words} may compile, make or run what is not analysed", step.line)
