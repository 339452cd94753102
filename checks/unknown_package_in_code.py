# SPDX-License-Identifier: Apache-2.0
"""Packages whose directories programs ask for, and that do not exist."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, Project, ProjectPackage
from haros_ci.api.launch import PackageUse
from haros_ci.api.packages import Lookup, launch_lookups, lookups, meant_here, meant_released, repositories_named


def check(project: Project) -> Iterator[Finding]:
    names = [package.name for package in project.packages]
    declared = {dependency.name for package in project.workspace.packages for dependency in package.dependencies}
    is_alone = all(name in names or project.knowledge.is_known(name) for name in declared)
    used = {(fact.location.path, fact.package) for system in project.systems for fact in system.facts(PackageUse)}
    for package in project.packages:
        for use in lookups(package):
            if use.name in declared or use.name in names or project.knowledge.is_package(use.name) is not False:
                continue
            here = meant_here(use.name, names, declared)
            if here is None and use.name in repositories_named(project.workspace):
                continue
            meant = here or meant_released(use.name)
            if meant is not None or is_alone:
                yield _finding(use, meant, is_here=here is not None)
        yield from _in_launch_files(package, names, declared, used)


def _in_launch_files(
    package: ProjectPackage, names: list[str], declared: set[str], used: set[tuple[str, str]]
) -> Iterator[Finding]:
    """Slips in what launch files ask for and do not use; unknown-package has what is *used*, by file and name."""
    for use in launch_lookups(package):
        if use.name in declared or use.name in names or (use.location.path, use.name) in used:
            continue
        meant = meant_here(use.name, names, declared)
        if meant is not None:
            yield _finding(use, meant, is_here=True)


def _finding(use: Lookup, meant: str | None, *, is_here: bool) -> Finding:
    hint = f"; did you mean {meant!r}?" if meant else ": it is neither in the workspace nor in a ROS distribution"
    return Finding(
        at=use.location,
        message=f"package {use.name!r} does not exist, so that {use.function}() finds nothing{hint}",
        about=(use.name,),
        apart=(use.name,),
        level=Level.NOTE if meant is None else None if is_here else Level.WARNING,
    )


CHECK = Check(
    id="unknown-package-in-code",
    summary="Program that asks for the directory of a package that does not exist.",
    level=Level.ERROR,
    decidability=Decidability.HEURISTIC,
    tags=("packages", "code"),
    project=check,
)
