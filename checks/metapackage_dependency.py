# SPDX-License-Identifier: Apache-2.0
"""Dependencies on metapackages, of packages that are none."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, ProjectPackage
from haros_ci.api.packages import Dependency, needs, place

#: Dependencies for running alone.
_RUN = ("run_depend", "exec_depend", "test_depend", "doc_depend")


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        if package.raw.is_metapackage:
            continue
        found: dict[str, list[Dependency]] = {}
        for need in needs(package):
            if need.name != package.name and is_metapackage(project, package, need.name):
                found.setdefault(need.name, []).append(need)
        for name, needed in found.items():
            if not _is_customary(package, name, needed):
                yield _finding(project, package, name, needed)


def _is_customary(package: ProjectPackage, name: str, needed: list[Dependency]) -> bool:
    """Whether the package only wants all of the metapackage installed, which packages of ROS 1 do with ros_control and others."""
    return package.ros == 1 and _found_by(package, name) is None and all(need.kind in _RUN for need in needed)


def is_metapackage(project: Project, package: ProjectPackage, name: str) -> bool:
    """Whether a dependency of *package* is certainly a metapackage: here, or among the released packages of ROS 1."""
    target = project.package(name)
    if target is not None:
        return target.raw.is_metapackage
    return package.ros == 1 and project.knowledge.is_metapackage(name, 1) is True


def _finding(project: Project, package: ProjectPackage, name: str, needed: list[Dependency]) -> Finding:
    call = _found_by(package, name) if package.ros == 1 else None
    effect = (
        "find_package() fails, because a metapackage has no CMake configuration"
        if call is not None
        else "all packages of the metapackage are installed, whether used or not"
    )
    target = project.package(name)
    related = [] if call is None else [(call, f"{name} is searched for here")]
    if target is not None:
        related.append((Location(target.manifest_path, 1), f"{name} is a metapackage"))
    return Finding(
        at=place(package, needed[0]),
        message=f"{package} depends on the metapackage {name}: {effect}; depend on the packages of {name} that the code "
        "uses",
        about=(package.name, name),
        related=tuple(related),
        level=Level.ERROR if call is not None else None,
    )


def _found_by(package: ProjectPackage, name: str) -> Location | None:
    """Where its CMake looks for *name* and cannot do without it."""
    for call in package.commands("find_package"):
        if (
            name in call.arguments
            and not call.is_conditional
            and (name != call.arguments[0] or "REQUIRED" in call.arguments)
        ):
            return call.location
    return None


CHECK = Check(
    id="metapackage-dependency",
    summary="Dependency on a metapackage.",
    level=Level.NOTE,
    catalogue="M04",
    tags=("packages",),
    project=check,
)
