# SPDX-License-Identifier: Apache-2.0
"""What a change brings into build files that no reader here follows: findings, and notes where it is usual."""

from __future__ import annotations

from haros_ci.model.workspace import Problem, Workspace
from haros_ci.workspace.build_steps import BuildStep, steps_not_followed
from haros_ci.workspace.cmake_ends import early_end
from haros_ci.workspace.cmake_templates import as_cmake, cmake_templates
from haros_ci.workspace.cut import cut

#: Build types of packages whose build files are read; "" is catkin, or one that the manifest does not tell.
_READ = frozenset(("", "ament_cmake", "ament_cmake_auto", "ament_cmake_python", "ament_python", "catkin", "cmake"))
_LISTS = "CMakeLists.txt"
#: Findings for one file, and notes of one run.
MOST = 20


def brought_steps(head: Workspace, base: Workspace) -> tuple[tuple[Problem, ...], tuple[Problem, ...]]:
    """What changed CMake files of *head*, and templates of some, have, and no CMake file of *base* that is gone or has changed, in the same words: what is a finding, and what is a note."""
    texts = {path: head.text(path) for path in _changed(head, base)}
    templates = {path for path in cmake_templates(head) if head.reports_on(path) and _differs(path, head, base)}
    texts |= {path: as_cmake(head.text(path)) for path in sorted(templates)}
    if not texts:
        return (), ()
    before = _words_before(head, base, with_templates=bool(templates))
    names = {path.rpartition("/")[2] for path in head.names}
    found: list[Problem] = []
    notes: list[Problem] = []
    for path, text in texts.items():
        steps = [step for step in steps_not_followed(text, names.__contains__) if step.words not in before]
        found += cut((_problem(path, step) for step in steps if not step.is_usual), MOST)
        notes += (_problem(path, step) for step in steps if step.is_usual)
        if path.endswith(_LISTS) and (end := early_end(text)) is not None:
            was = early_end(base.text(path)) if path in base.names else None
            notes += [_problem(path, end)] if was is None else []
    return tuple(found), cut(notes, MOST)


def _changed(head: Workspace, base: Workspace) -> list[str]:
    """The CMake files of *head* that are reported on, and have a text that no file of *base* has."""
    known = {file.digest for file in base.files if file.language == "cmake"}
    new = (file for file in head.files if file.language == "cmake" and file.digest not in known)
    return [file.path for file in new if not file.third_party and head.reports_on(file.path)]


def _words_before(head: Workspace, base: Workspace, with_templates: bool) -> set[str]:
    """The steps, in words, of the CMake files of *base*, and its templates of some, that *head* has in no such way."""
    same = {(file.path, file.digest) for file in head.files if file.language == "cmake"}
    gone = (file for file in base.files if file.language == "cmake" and (file.path, file.digest) not in same)
    texts = [base.text(file.path) for file in gone]
    if with_templates:
        texts += [as_cmake(base.text(path)) for path in cmake_templates(base) if _differs(path, base, head)]
    return {step.words for text in texts for step in steps_not_followed(text)}


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
    return Problem(path, f"{step.words} {step.effect}", step.line)
