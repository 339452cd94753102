# SPDX-License-Identifier: Apache-2.0
"""Packages that launch files name, and that do not exist."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, System, is_slip
from haros_ci.api.launch import PackageUse, included_by, is_optional
from haros_ci.api.packages import knowledge

#: What a package can be called (REP 127); anything else is to be replaced in a template.
_NAME = re.compile(r"[A-Za-z][\w-]*\Z")
#: How many packages of a workspace begin alike where that is their prefix.
COMMON = 4
#: Shorter names are too much alike.
LONG = 7


def check(system: System) -> Iterator[Finding]:
    known = {dependency.name for package in system.packages.values() for dependency in package.dependencies}
    alone: bool | None = None
    for use in system.facts(PackageUse):
        if use.is_here or use.package in known or not _NAME.match(use.package):
            continue
        meant = _meant(use.package, system)
        if meant is None and (use.package in system.whole.repositories or is_optional(use, system)):
            continue
        sure = meant is not None
        meant = meant or _misspelt(use.package)
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


def _misspelt(name: str) -> str | None:
    """The package of a distribution that is meant by a name that no package has."""
    if len(name) < LONG or knowledge().is_package(name) is not False:
        return None
    return next(
        (other for other in knowledge().packages() if abs(len(other) - len(name)) < 3 and is_slip(name, other)), None
    )


def _stands_alone(declared: set[str], system: System) -> bool:
    """Whether all that the workspace declares is known: where it is not, there are packages that nobody here knows."""
    return all(name in system.packages or knowledge().is_known(name) for name in declared)


def _meant(name: str, system: System) -> str | None:
    """A package of the workspace that is meant: misspelt, or with the prefix that many packages there have."""
    if len(name) < 5:
        return None
    for other in system.packages:
        prefix = other.removesuffix(name)
        if is_slip(name, other) or (prefix != other and prefix.endswith("_") and _is_common(prefix, system)):
            return other
    return None


def _is_common(prefix: str, system: System) -> bool:
    return sum(other.startswith(prefix) for other in system.packages) >= COMMON


CHECK = Check(
    id="unknown-package",
    summary="Package name in a launch file that does not exist.",
    level=Level.ERROR,
    decidability=Decidability.HEURISTIC,
    catalogue="L02",
    tags=("launch",),
    run=check,
)
