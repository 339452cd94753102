# SPDX-License-Identifier: Apache-2.0
"""install() of CMake into the sources or the build space, which are no part of what is installed."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, ProjectPackage
from haros_ci.api.packages import Install

_SHOWN = 3


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        groups: dict[str, list[Install]] = {}
        for install in package.cmake.installs:
            if install.command.is_conditional or install.command.is_test or package.raw.build_type == "cmake":
                continue
            for place in dict.fromkeys(install.destinations.values()):
                where = _where(place)
                if where:
                    groups.setdefault(where, []).append(install)
        for where, found in groups.items():
            yield _finding(package, where, found)


def _where(place: str) -> str:
    if place == "${ROOT}" or place.startswith("${ROOT}/"):
        return "the sources"
    is_built = place == "${BUILD}" or place.startswith("${BUILD}/")
    return "the build space" if is_built and not place.startswith("${BUILD}/devel") else ""


def _finding(package: ProjectPackage, where: str, found: list[Install]) -> Finding:
    things = [thing.replace("${ROOT}/", "") for install in found for thing in install.things]
    shown = ", ".join(things[:_SHOWN]) + (" and more" if len(things) > _SHOWN else "")
    verb = "is" if len(things) == 1 else "are"
    return Finding(
        at=found[0].command.location,
        message=f"{shown or 'something'} of {package.name} {verb} installed into {where}: the install space and the Debian package lack it; write a "
        "DESTINATION relative to the install prefix",
        about=(package.name, where),
        related=tuple((install.command.location, "so is what this installs") for install in found[1:5]),
    )


CHECK = Check(
    id="install-outside-prefix",
    summary="install() into the sources or the build space.",
    level=Level.WARNING,
    tags=("build",),
    project=check,
)
