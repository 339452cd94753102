# SPDX-License-Identifier: Apache-2.0
"""Packages that a launch file needs, and that its own package does not depend on."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System
from haros_ci.api.launch import PackageUse, included_by, owner
from haros_ci.api.packages import (
    closes_a_cycle,
    dependency_place,
    is_aside,
    is_left_out,
    is_to_be_had,
    provided,
    used_by_launch_files,
)


def check(system: System) -> Iterator[Finding]:
    got: dict[str, tuple[frozenset[str], bool]] = {}
    uses = used_by_launch_files(system)
    for use in system.facts(PackageUse):
        package = owner(system, use.location)
        if package is None or package.name == use.package:
            continue
        if package.name not in got:
            got[package.name] = provided(package, system)
        found, is_whole = got[package.name]
        if use.package in found or not is_to_be_had(use.package, package.ros, system):
            continue
        if is_left_out(package, use, system) or closes_a_cycle(package.name, use.package, system, uses):
            continue
        tag = "exec_depend" if package.format > 1 else "run_depend"
        yield Finding(
            at=dependency_place(package),
            message=f"a launch file of {package.name} uses {use.package}, but package.xml does not declare it: the launch "
            f"fails on a machine without {use.package}; add <{tag}>{use.package}</{tag}>",
            about=(package.name, use.package),
            related=((use.location, f"needs {use.package}"),),
            flow=included_by(use),
            apart=(use.package,),
            level=None if is_whole and not is_aside(use, system) else Level.NOTE,
        )


CHECK = Check(
    id="undeclared-launch-dependency",
    summary="Package used by a launch file that package.xml does not declare.",
    level=Level.WARNING,
    catalogue="L04",
    tags=("launch", "packages"),
    run=check,
)
