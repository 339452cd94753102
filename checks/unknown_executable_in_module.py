# SPDX-License-Identifier: Apache-2.0
"""Programs that Python modules start with Node() of launch_ros, and that their packages do not have."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, ProjectPackage, regex, syntax
from haros_ci.api.code import calls_of, dotted
from haros_ci.api.launch import ProgramUse, may_make_program, meant, similar_names

#: What makes a node in a launch file, wherever the call stands.
_NODES = regex(r"launch_ros\.actions\.(?:node\.|lifecycle_node\.)?(?:Lifecycle)?Node")


def check(project: Project) -> Iterator[Finding]:
    """Node(package=..., executable=...) in Python modules that launch files import, with both names written out."""
    code = project.code
    uses = [use for system in project.systems for use in system.facts(ProgramUse)]
    seen = {use.location.path for use in uses}
    reported = {(use.package, use.program) for use in uses if use.is_found is False}  # by unknown-executable
    for routine, call in calls_of(code, "Node", "LifecycleNode"):
        if not routine.is_python or routine.path in seen or routine.is_test:
            continue
        if _NODES.fullmatch(dotted(code, routine, call.callee)) is None:
            continue
        keywords = (argument for argument in call.args if isinstance(argument, syntax.Keyword))
        arguments = {
            keyword.name: keyword.value.value for keyword in keywords if isinstance(keyword.value, syntax.String)
        }
        package, program = project.package(arguments.get("package", "")), arguments.get("executable", "")
        if package is None or not program or not _lacks(package, program):
            continue
        similar = similar_names(program, package.build.programs(), package.name)
        yield Finding(
            at=Location(routine.path, call.line, call.column),
            message=f"package {package} builds or installs no program {program!r}: this node cannot start{meant(similar)}",
            about=(f"{package}/{program}",),
            apart=(routine.path, program),
            level=Level.NOTE if (package.name, program) in reported else None,
        )


def _lacks(package: ProjectPackage, program: str) -> bool:
    """Whether all programs of the package are known, this is none of them, and nothing in its build has the name."""
    if package.ros != 2 or program in package.build.programs() or not package.build.commands:
        return False
    if not package.cmake.is_whole or package.cmake.installs_unknown:
        return False
    if any(posixpath.basename(file.path) == program for file in package.files):
        return False
    paths = {command.location.path for command in package.build.commands} | {package.inside("setup.py")}
    return not any(may_make_program(package.project.text(path), program) for path in paths)


CHECK = Check(
    id="unknown-executable-in-module",
    summary="Node() in a Python module with a program that its package does not provide.",
    level=Level.ERROR,
    tags=("launch", "python"),
    project=check,
)
