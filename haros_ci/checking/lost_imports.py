# SPDX-License-Identifier: Apache-2.0
"""Findings on programs of Python that cannot start, as they import what their own package does not have (own_modules)."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.checking.check import Finding
from haros_ci.checking.own_modules import LostImport, OwnModules
from haros_ci.checking.project import ProjectPackage
from haros_ci.checking.started import started_programs
from haros_ci.checking.unlisted_modules import unlisted_modules
from haros_ci.model.location import Location


def lost_imports(package: ProjectPackage) -> Iterator[Finding]:
    """Modules and names that programs of *package* import of it, and that Python does not find, or not once it is installed.

    Programs are the ``console_scripts`` of a package of ament_python, and of others the scripts that CMake installs, or that a launch file starts.
    """
    own = OwnModules(package, package.project.sources)
    if package.raw.build_type == "ament_python":
        for entry_point in package.build.entry_points if package.ros == 2 else ():
            for lost in own.lost(entry_point) if entry_point.path else ():
                yield _finding(lost, entry_point.name, entry_point.location, package)
        yield from unlisted_modules(package)
        return
    installed = {one.path: one.location for one in package.build.installed if one.kind == "program"}
    started = started_programs(package)
    for path in package.build.scripts:
        name = path.rpartition("/")[2]
        if path in installed or name in started:
            for lost in own.lost_by_script(path):
                yield _finding(lost, name, installed.get(path, Location(path, 1)), package)


def _finding(lost: LostImport, program: str, place: Location, package: ProjectPackage) -> Finding:
    return Finding(
        at=lost.location,
        message=f"program {program} of package {package.name} cannot start: {lost.sentence()}",
        about=(package.name, *lost.names),
        related=((place, f"the program {program}"),),
        apart=(lost.location.path, *lost.names),
    )
