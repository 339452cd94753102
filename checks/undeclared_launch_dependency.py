# SPDX-License-Identifier: Apache-2.0
"""Packages that a launch file needs, and that its own package does not depend on."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, System
from haros_ci.api.launch import PackageUse, included_by, owner
from haros_ci.api.packages import Package, knowledge

#: Dependencies that are there when the package runs.
_RUN = ("depend", "exec_depend", "run_depend", "build_export_depend")


#: Packages that bring no others with nodes, configuration or models, by their beginnings and ends.
_PLAIN: tuple[str, ...] = (
    "rclcpp",
    "rclpy",
    "rcl",
    "launch",
    "ament_",
    "python3-",
    "python-",
    "tf2",
    "roscpp",
    "rospy",
    "roslaunch",
    "xacro",
)
_PLAIN += ("message_runtime", "rosidl_", "std_srvs", "pluginlib", "eigen", "class_loader", "rviz2", "rviz", "nodelet")


def check(system: System) -> Iterator[Finding]:
    provided: dict[str, tuple[frozenset[str], bool]] = {}
    for use in system.facts(PackageUse):
        package = owner(system, use.location)
        if package is None or package.name == use.package:
            continue
        if package.name not in provided:
            provided[package.name] = _provided(package, system)
        found, is_whole = provided[package.name]
        if use.package in found or not _exists(use.package, package.ros, system):
            continue
        tag = "exec_depend" if package.format > 1 else "run_depend"
        yield Finding(
            at=_manifest(package),
            message=f"a launch file of {package.name} uses {use.package}, but package.xml does not declare it: the launch "
            f"fails on a machine without {use.package}; add <{tag}>{use.package}</{tag}>",
            about=(package.name, use.package),
            related=((use.location, f"needs {use.package}"),),
            flow=included_by(use),
            apart=(use.package,),
            level=None if is_whole else Level.NOTE,
        )


def _exists(name: str, ros: int | None, system: System) -> bool:
    """Whether the workspace or a distribution has a package *name*, so that declaring it helps; unknown-package tells of slips."""
    known = knowledge()
    return name in system.packages or not known.is_there or known.is_in(name, ros)


def _manifest(package: Package) -> Location:
    """Where another dependency goes: behind those that there are."""
    path = "package.xml" if package.path == "." else f"{package.path}/package.xml"
    lines = [each.line for each in package.dependencies if each.line is not None and each.kind in _RUN]
    return Location(path, max(lines, default=1))


def _provided(package: Package, system: System) -> tuple[frozenset[str], bool]:
    """What *package* names in any way, and what packages of the workspace need that it needs; whether that is all it gets."""
    found = {dependency.name for dependency in package.dependencies}
    todo = [dependency.name for dependency in package.dependencies if dependency.kind in _RUN]
    is_whole = True
    while todo:
        name = todo.pop()
        inner = system.packages.get(name)
        if inner is None:
            outside = knowledge().depends(name, package.ros) if knowledge().is_whole(name) else None
            is_known = outside is not None or name.startswith(_PLAIN) or name.endswith("_msgs")
            is_whole = is_whole and is_known
            found.update(outside or ())
        for dependency in inner.dependencies if inner is not None else ():
            if dependency.kind in _RUN and dependency.name not in found:
                found.add(dependency.name)
                todo.append(dependency.name)
    return frozenset(found), is_whole


CHECK = Check(
    id="undeclared-launch-dependency",
    summary="Package used by a launch file that package.xml does not declare.",
    level=Level.WARNING,
    catalogue="L04",
    tags=("launch", "packages"),
    run=check,
)
