# SPDX-License-Identifier: Apache-2.0
"""CMake files that nothing runs: of a package that is built with ament_python, by its setup.py (colcon-ros, colcon_ros/task/ament_python)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from haros_ci.checking.check import Finding
from haros_ci.checking.project import Project

_ENDINGS = ("CMakeLists.txt", ".cmake")
#: The tags of checks of what is built.
_OF_BUILDS = frozenset(("packages", "build"))


def of_what_is_run(project: Project) -> Callable[[Iterable[str], Iterable[Finding]], Iterator[Finding]]:
    """A function that leaves out what checks of builds, known by their tags, find in CMake of such packages; wrong-build-type tells of what is lost by that."""
    alone = {p.name for p in project.packages if p.raw.build_type == "ament_python" and p.has("setup.py")}
    package_of = project.workspace.package_finder()

    def is_unrun(path: str) -> bool:
        return path.endswith(_ENDINGS) and package_of(path) in alone

    def left(tags: Iterable[str], findings: Iterable[Finding]) -> Iterator[Finding]:
        is_of_builds = bool(alone) and not _OF_BUILDS.isdisjoint(tags)
        return (finding for finding in findings if not is_of_builds or not is_unrun(finding.at.path))

    return left
