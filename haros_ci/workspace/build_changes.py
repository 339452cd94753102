# SPDX-License-Identifier: Apache-2.0
"""What a change brings into build files that no reader here follows: findings, and notes where it is usual."""

from __future__ import annotations

from haros_ci.model.workspace import Problem, Workspace
from haros_ci.workspace.build_steps import BuildStep, steps_not_followed
from haros_ci.workspace.cmake_templates import as_cmake, cmake_templates
from haros_ci.workspace.cut import cut

#: Build types of packages whose build files are read; "" is catkin, or one that the manifest does not tell.
_READ = frozenset(("", "ament_cmake", "ament_cmake_auto", "ament_cmake_python", "ament_python", "catkin", "cmake"))
#: Findings for one file, and notes of one run.
MOST = 20


def brought_steps(head: Workspace, base: Workspace) -> tuple[tuple[Problem, ...], tuple[Problem, ...]]:
    """What changed CMake files of *head*, and templates of some, have, and no CMake file of *base* that is gone or has changed, in the same words: what is a finding, and what is a note."""
    known = {file.digest for file in base.files if file.language == "cmake"}
    same = {(file.path, file.digest) for file in head.files if file.language == "cmake"}
    changed = [
        file.path
        for file in head.files
        if file.language == "cmake" and file.digest not in known and not file.third_party and head.reports_on(file.path)
    ]
    templates = [path for path in cmake_templates(head) if head.reports_on(path) and _differs(path, head, base)]
    if not changed and not templates:
        return (), ()
    before = {
        step.words
        for file in base.files
        if file.language == "cmake" and (file.path, file.digest) not in same
        for step in steps_not_followed(base.text(file.path))
    }
    if templates:
        texts = (base.text(path) for path in cmake_templates(base) if _differs(path, base, head))
        before |= {step.words for text in texts for step in steps_not_followed(as_cmake(text))}
    names = {path.rpartition("/")[2] for path in head.names}
    found: list[Problem] = []
    notes: list[Problem] = []
    for path in (*changed, *templates):
        text = as_cmake(head.text(path)) if path in templates else head.text(path)
        steps = [step for step in steps_not_followed(text, names.__contains__) if step.words not in before]
        found += cut((_problem(path, step) for step in steps if not step.is_usual), MOST)
        notes += (_problem(path, step) for step in steps if step.is_usual)
    return tuple(found), cut(notes, MOST)


def _differs(path: str, here: Workspace, there: Workspace) -> bool:
    return path not in there.names or here.text(path) != there.text(path)


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
