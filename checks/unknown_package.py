# SPDX-License-Identifier: Apache-2.0
"""Packages that launch files name, and that do not exist."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, System, regex
from haros_ci.api.launch import PackageUse, included_by, is_optional
from haros_ci.api.packages import knowledge, meant_here, meant_released

#: What a package can be called (REP 127); anything else is to be replaced in a template.
_NAME = regex(r"[A-Za-z][\w-]*\Z")


def check(system: System) -> Iterator[Finding]:
    known = system.whole.dependencies
    alone: bool | None = None
    seen: set[tuple[str, str]] = set()
    for use in system.facts(PackageUse):
        if use.location.path.endswith(".py") and (use.location.path, use.package) in seen:
            continue  # one call may stand in a variable that is used many times
        seen.add((use.location.path, use.package))
        if use.is_here or use.package in known or not _NAME.match(use.package):
            continue
        meant = meant_here(use.package, system.packages, known)
        if meant is None and (use.package in system.whole.repositories or is_optional(use, system)):
            continue
        sure = meant is not None
        meant = meant or meant_released(use.package)
        if meant is None and alone is None:
            alone = _stands_alone(known, system)
        if meant is None and not (alone and knowledge().is_package(use.package) is False):
            continue
        hint = f"; did you mean {meant!r}?" if meant else ": it is neither in the workspace nor in a ROS distribution"
        yield Finding(
            at=use.location,
            message=f"package {use.package!r} does not exist{hint}",
            about=(use.package,),
            flow=included_by(use),
            apart=(use.package,),
            level=_level(meant, sure),
            presence=use.presence,
        )


def _level(meant: str | None, sure: bool) -> Level | None:
    """Many packages are built from a source that nobody names: an error where the workspace has the one that is meant."""
    if meant is None:
        return Level.NOTE
    return None if sure else Level.WARNING


def _stands_alone(declared: frozenset[str], system: System) -> bool:
    """Whether all that the workspace declares is known: where it is not, there are packages that nobody here knows."""
    return all(name in system.packages or knowledge().is_known(name) for name in declared)


CHECK = Check(
    id="unknown-package",
    summary="Package name in a launch file that does not exist.",
    level=Level.ERROR,
    decidability=Decidability.HEURISTIC,
    catalogue="L02",
    tags=("launch",),
    run=check,
)
