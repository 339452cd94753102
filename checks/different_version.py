# SPDX-License-Identifier: Apache-2.0
"""A package whose version is unlike that of all others of its repository (catkin_pkg.package_version.verify_equal_package_versions)."""

from __future__ import annotations

import posixpath
from collections import Counter
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Fix, Level, Location, Project, ProjectPackage
from haros_ci.api.packages import Element, set_text, word

#: So many packages that are released say that the repository is, and so many others have to agree.
_RELEASED = 3
_AGREEING = 3
#: So many packages may be unlike the others.
_FEW = 2


def check(project: Project) -> Iterator[Finding]:
    found: dict[str, tuple[ProjectPackage, Element, str]] = {}
    for package in project.packages:
        element = next(package.manifest.all("version"), None) if package.manifest is not None else None
        if element is not None and element.line is not None:
            found[package.name] = (package, element, word(element))
    counts = Counter(version for _, _, version in found.values())
    if len(counts) < 2 or sum(package.has("CHANGELOG.rst") for package, _, _ in found.values()) < _RELEASED:
        return
    usual, number = counts.most_common(1)[0]
    others = [item for item in found.values() if item[2] != usual]
    if number < _AGREEING or len(others) > min(_FEW, number // 3):
        return
    places = {posixpath.dirname(package.path) for package, _, version in found.values() if version == usual}
    for package, element, version in others:
        if posixpath.dirname(package.path) in places and package.path != ".":
            fix = set_text(package, element, usual, f"write {usual}")
            yield _finding(package, element, version, usual, number, fix)


def _finding(
    package: ProjectPackage, element: Element, version: str, usual: str, number: int, fix: Fix | None
) -> Finding:
    return Finding(
        at=Location(package.manifest_path, element.line),
        message=f"{package} has version {version}, the {number} other packages of the repository have {usual}: catkin_prepare_release and bloom "
        f"stop at different versions; write {usual}",
        about=(package.name, "version"),
        fixes=() if fix is None else (fix,),
    )


CHECK = Check(
    id="different-version",
    summary="Package with another version than the rest of its repository.",
    level=Level.NOTE,
    tags=("packages",),
    project=check,
)
