# SPDX-License-Identifier: Apache-2.0
"""Packages that a change takes out of the model while their code stays: what their nodes do is compared with nothing any more."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

from haros_ci.model.package import Package, SourceFile
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.regex import regex
from haros_ci.workspace.noted_files import named
from haros_ci.workspace.selection import parents
from haros_ci.workspace.views import doubles

_MANIFEST = "package.xml"
#: What code and launch files have that are of ROS, by their language.
_OF_ROS = {
    "cpp": regex(r"#[ \t]*include[ \t]*[<\"](?:ros/|rclcpp|nodelet/|rclc/)"),
    "python": regex(r"^[ \t]*(?:import|from)[ \t]+(?:rospy|rclpy|launch|roslaunch)\b", re.MULTILINE),
    "launch": regex(r"<launch\b|^launch[ \t]*:", re.MULTILINE),
}


def lost_packages(head: Workspace, base: Workspace, renames: Mapping[str, str]) -> Iterator[Problem]:
    """One for each package of *base* whose code of ROS is in no package of *head*, or in one that the model leaves out, and for each package around others.

    *renames* leads from paths of *base* to those that the files have in *head*. A package that is gone with its code is none of these.
    """
    before = {package.path for package in base.packages}
    swallowed = _swallowed(head, before)
    for outer, inner in swallowed.items():
        many = "a package" if len(inner) == 1 else f"{len(inner):,} packages"
        yield Problem(
            _manifest(outer),
            f"this file makes a package around {many} of the base revision ({named(inner)}): colcon and catkin do not look below a package, so nothing of "
            f"that is built or in the model; move this file, or remove it",
        )
    gone = sorted(
        before - {package.path for package in head.packages} - {path for paths in swallowed.values() for path in paths}
    )
    for path in gone:
        if left := [file.path for file in _inside(path, head.files) if file.package is None and _is_of_ros(file, head)]:
            what = "this file lies" if len(left) == 1 else f"this and {len(left) - 1:,} more files of ROS lie"
            yield Problem(
                left[0],
                f"{what} in no package, as {_manifest(path)} is gone: what is in there is not in the model; keep the manifest, or remove the files",
            )
    yield from _doubled(head, base, renames)


def _swallowed(head: Workspace, before: Iterable[str]) -> dict[str, list[str]]:
    """The packages of the base that have their manifests, and lie in another package of *head* now, by that one's path."""
    packages = {package.path for package in head.packages}
    found: dict[str, list[str]] = {}
    for path in sorted(before):
        if path not in packages and _manifest(path) in head.names:
            around = next((above for above in (*parents(_manifest(path)), ".") if above in packages), None)
            if around is not None:
                found.setdefault(around, []).append(path)
    return found


def _doubled(head: Workspace, base: Workspace, renames: Mapping[str, str]) -> Iterator[Problem]:
    """One for each package that the model leaves out for another one of its name, and did not."""
    known = {renames.get(_manifest(one.path), _manifest(one.path)) for one in doubles(base.packages, base.files)}
    packages: dict[str, Package] = {package.path: package for package in head.packages}
    for one in doubles(head.packages, head.files, head.hiding.later):
        manifest = _manifest(one.path)
        if manifest not in known and any(_is_of_ros(file, head) for file in _inside(one.path, head.files)):
            name = packages[one.path].name
            yield Problem(
                manifest,
                f"another package is called {name!r}, too, and the model has that one: nothing of this one is looked at; give it another name",
            )


def _inside(path: str, files: Iterable[SourceFile]) -> Iterator[SourceFile]:
    return (file for file in files if path == "." or file.path.startswith(f"{path}/"))


def _is_of_ros(file: SourceFile, workspace: Workspace) -> bool:
    pattern = _OF_ROS.get(file.language)
    return pattern is not None and not file.third_party and pattern.search(workspace.text(file.path)) is not None


def _manifest(directory: str) -> str:
    return _MANIFEST if directory == "." else f"{directory}/{_MANIFEST}"
