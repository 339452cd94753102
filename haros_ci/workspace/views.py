# SPDX-License-Identifier: Apache-2.0
"""Packages of one name in a workspace: which of them count, and what one version of ROS sees of it.

colcon refuses two packages of one name, and so do catkin_make and catkin build (catkin_pkg.packages): which one a build would take is
decided by what they are kept from (COLCON_IGNORE, AMENT_IGNORE, CATKIN_IGNORE), and of that nothing is listed. A package for catkin and one
for ament are never built together, so both count, each with its version of ROS.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import replace

from haros_ci.model.package import Package, SourceFile
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.records import dataclass, field


@dataclass(frozen=True, slots=True)
class View:
    """A workspace in which no two packages have the same name.

    *ros* is the version of ROS that it is built with, None where one view shows all. *doubled* are the names of packages that another
    view has, too, *shared* the paths below them (``package/path``) that both have.
    """

    workspace: Workspace
    ros: int | None = None
    doubled: frozenset[str] = frozenset()
    shared: frozenset[str] = frozenset()
    _of_both: Mapping[str, int | None] = field(default_factory=dict)
    #: By name, the paths of packages that do not count here, as another one of the name does; without those that a change brings.
    _left_out: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    def has_version(self, ros: int | None) -> bool:
        """Whether what is of this version of ROS, None for either, belongs here."""
        return self.ros is None or ros in (None, self.ros)

    def versions(self) -> Callable[[str], bool]:
        """A function that says whether a package of this name belongs here; one that is not in the workspace does."""
        ros = {package.name: package.ros for package in self.workspace.packages}
        return lambda name: self.has_version(ros.get(name))

    def holds(self, path: str) -> bool:
        """Whether findings at the root-relative *path* are this view's: they are, unless its package is of the other version."""
        while path not in ("", "."):
            path = path.rpartition("/")[0] or "."
            if path in self._of_both:
                return self.has_version(self._of_both[path])
        return True

    def is_nearer_another(self, path: str, message: str) -> bool:
        """Whether *message*, on the file at *path*, names a package of which another one, that does not count here, is nearer to the file.

        Two workspaces of one repository (``robot/src``, ``server/src``) have a package of that name each, and that which is built with the file is its neighbour.
        """
        for name, others in self._left_out.items():
            if re.search(rf"(?<![\w-]){re.escape(name)}(?![\w-])", message):
                kept = max((_near(path, p.path) for p in self.workspace.packages if p.name == name), default=0)
                if max(_near(path, other) for other in others) > kept:
                    return True
        return False


def _near(path: str, other: str) -> int:
    """How many directories from the root on two paths share."""
    pairs = zip(path.split("/")[:-1], other.split("/"))
    return next(
        (i for i, (here, there) in enumerate(pairs) if here != there), min(path.count("/"), other.count("/") + 1)
    )


def views(workspace: Workspace) -> tuple[View, ...]:
    """The views of *workspace*: one, unless packages of one name are of both versions of ROS; that of ROS 1 is the first then.

    A workspace without packages of one name is its own view.
    """
    names = [package.name for package in workspace.packages]
    if len(names) == len(set(names)):
        return (View(workspace),)
    groups = _groups(workspace.packages)
    first = {file.path: file for file in workspace.files}
    chosen = {name: _chosen(group, first, workspace.hiding.later) for name, group in groups.items()}
    doubled = frozenset(name for name, found in chosen.items() if len(found) > 1)
    if not doubled:
        one = _without(workspace, {package.path for found in chosen.values() for package in found.values()})
        return (View(one, _left_out=_others(workspace, one, groups)),)
    of_both = {package.path: package.ros for package in workspace.packages}
    shared = _paths(workspace, doubled, chosen, 1) & _paths(workspace, doubled, chosen, 2)
    found = []
    for ros in (1, 2):
        kept = {(seen.get(ros) or next(iter(seen.values()))).path for seen in chosen.values()}
        one = _without(workspace, kept)
        found.append(View(one, ros, doubled, shared, of_both, _others(workspace, one, groups)))
    return tuple(found)


def _paths(
    workspace: Workspace, names: Iterable[str], chosen: Mapping[str, Mapping[int, Package]], ros: int
) -> frozenset[str]:
    """The files of those packages of a version of ROS, as ``package/path``."""
    starts = {name: f"{chosen[name][ros].path}/" for name in names}
    return frozenset(
        f"{name}/{file.path[len(start) :]}"
        for name, start in starts.items()
        for file in workspace.files
        if file.path.startswith(start)
    )


def doubles(packages: Iterable[Package], files: Iterable[SourceFile], later: Collection[str] = ()) -> Iterable[Problem]:
    """A problem for each package that does not count, because another one of its name does; *later* are the paths of those that a change brings."""
    by_path = {file.path: file for file in files}
    for name, group in _groups(packages).items():
        kept = _chosen(group, by_path, later)
        taken = {package.path for package in kept.values()}
        for package in group:
            if package.path not in taken:
                other = kept.get(package.ros or 0) or next(iter(kept.values()))
                yield Problem(
                    package.path,
                    f"the package name {name!r} is also that of {other.path}, which the model has (not {package.path}); to choose, "
                    f"put a COLCON_IGNORE (catkin: CATKIN_IGNORE) file into the other directory or name it under 'exclude' of the project file",
                )


def _groups(packages: Iterable[Package]) -> dict[str, list[Package]]:
    """The packages by name, by path, where there are several."""
    groups: dict[str, list[Package]] = {}
    for package in sorted(packages, key=lambda package: package.path):
        groups.setdefault(package.name, []).append(package)
    return {name: group for name, group in groups.items() if len(group) > 1}


def _chosen(group: list[Package], files: Mapping[str, SourceFile], later: Collection[str]) -> dict[int, Package]:
    """The packages of one name that count, by version of ROS.

    Of one version it is the first by path, those of the base revision before those that a change brings (*later*), one's own before copies
    of other projects; one whose manifest does not tell the version counts
    where no other does, as version 0.
    """

    def is_copy(package: Package) -> bool:
        file = files.get("package.xml" if package.path == "." else f"{package.path}/package.xml")
        return file is not None and bool(file.third_party)

    found: dict[int, Package] = {}
    for package in sorted(group, key=lambda package: (package.path in later, is_copy(package), package.path)):
        found.setdefault(package.ros or 0, package)
    known = {ros: package for ros, package in found.items() if ros}
    return known or found


def _others(
    workspace: Workspace, view: Workspace, groups: Mapping[str, Sequence[Package]]
) -> dict[str, tuple[str, ...]]:
    """By name, the paths of packages that the *view* leaves out for one that may be of the same version of ROS, but for those that a change brings."""
    kept = {package.name: package for package in view.packages if package.name in groups}
    found = {
        name: tuple(
            package.path
            for package in group
            if package.path != kept[name].path
            and package.path not in workspace.hiding.later
            and (package.ros is None or kept[name].ros in (None, package.ros))
        )
        for name, group in groups.items()
    }
    return {name: paths for name, paths in found.items() if paths}


def _without(workspace: Workspace, kept: set[str]) -> Workspace:
    """*workspace* with those packages alone, of several of one name, that lie at the paths *kept*."""
    names = [package.name for package in workspace.packages]
    left_out = {p.path for p in workspace.packages if names.count(p.name) > 1 and p.path not in kept}
    start = tuple(f"{path}/" for path in left_out)
    return replace(
        workspace,
        packages=tuple(package for package in workspace.packages if package.path not in left_out),
        files=tuple(file for file in workspace.files if not file.path.startswith(start)),
    )
