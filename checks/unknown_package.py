# SPDX-License-Identifier: Apache-2.0
"""Packages that launch files name, and that do not exist."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, PackageUse, System, included_by, is_slip

#: How many packages of a workspace begin alike where that is their prefix.
COMMON = 4


def check(system: System) -> Iterator[Finding]:
    known = {dependency.name for package in system.packages.values() for dependency in package.dependencies}
    for use in system.facts(PackageUse):
        if use.is_here or use.package in known:
            continue
        meant = _meant(use.package, system)
        if meant is None:
            continue
        yield Finding(
            at=use.location,
            message=f"there is no package {use.package!r}; did you mean {meant!r}?",
            about=(use.package,),
            flow=included_by(use),
            apart=(use.package,),
            presence=use.presence,
        )


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
    summary="The packages that launch files name exist.",
    level=Level.ERROR,
    decidability=Decidability.HEURISTIC,
    catalogue="L02",
    tags=("launch",),
    run=check,
)
