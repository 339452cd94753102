# SPDX-License-Identifier: Apache-2.0
"""Packages that a launch file needs, and that its own package does not depend on."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

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


#: Tools that people start while they make or watch a robot.
_TOOLS = frozenset(
    ("moveit_setup_assistant", "moveit_ros_benchmarks", "plotjuggler", "plotjuggler_ros", "rosbag", "ros2bag")
)
#: So many packages with a launch file of one name have it from a generator.
_MANY = 3
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
#: Places that a script fills in when it copies the file: ``$NAME$``, ``@NAME@``, ``{{ name }}``.
_BLANK = re.compile(r"[\"'/>= ](?:\$[A-Z][A-Z0-9_]+\$|@[A-Z][A-Z0-9_]+@|\{\{ ?\w+ ?\}\})")


def check(system: System) -> Iterator[Finding]:
    provided: dict[str, tuple[frozenset[str], bool]] = {}
    uses = _uses(system)
    for use in system.facts(PackageUse):
        package = owner(system, use.location)
        if package is None or package.name == use.package:
            continue
        if package.name not in provided:
            provided[package.name] = _provided(package, system)
        found, is_whole = provided[package.name]
        if use.package in found or not _exists(use.package, package.ros, system):
            continue
        if _is_left_out(package, use, system) or _closes_a_cycle(package.name, use.package, system, uses):
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
            level=None if is_whole and not _is_aside(use, system) else Level.NOTE,
        )


def _uses(system: System) -> Mapping[str, frozenset[str]]:
    """By package of the workspace what its launch files use of other packages."""
    found: dict[str, set[str]] = {}
    for use in system.facts(PackageUse):
        package = owner(system, use.location)
        if package is not None:
            found.setdefault(package.name, set()).add(use.package)
    return {name: frozenset(names) for name, names in found.items()}


def _closes_a_cycle(name: str, used: str, system: System, uses: Mapping[str, frozenset[str]]) -> bool:
    """Whether the package *used* needs the package *name* itself, or its launch files do.

    With the dependency declared in both packages colcon and catkin stop, because they can order neither first.
    """
    todo, seen = [used], {used}
    while todo:
        inner = system.packages.get(todo.pop())
        if inner is None:
            continue
        further = {dependency.name for dependency in inner.dependencies} | uses.get(inner.name, frozenset())
        if name in further:
            return True
        todo += further - seen
        seen |= further
    return False


def _is_left_out(package: Package, use: PackageUse, system: System) -> bool:
    """Whether the manifest has the dependency in a comment, or the launch file is a template that is yet to be filled in."""
    if system.workspace is None:
        return False
    comments = _COMMENT.findall(system.workspace.text(_manifest(package).path))
    if any(re.search(rf">\s*{re.escape(use.package)}\s*<", comment) for comment in comments):
        return True
    return _BLANK.search(system.workspace.text(use.location.path)) is not None


def _is_aside(use: PackageUse, system: System) -> bool:
    """Whether it is a tool for developers, or of a launch file that a user chooses by an argument or that several packages have.

    None of these may declare it. What is chosen is installed by who chooses it.

    Files of one name in several packages come from a generator (MoveIt's setup assistant), and packages ship without what few of their users want.
    """
    if use.package in _TOOLS or use.package.startswith("rqt"):
        return True
    file = use.location.path.rpartition("/")[2]
    if any(each.fullmatch(file) for each, _ in system.whole.chosen_files):
        return True
    alike = system.whole.files_by_name.get(file, ())
    owners = {each.name: each for path in alike if (each := owner(system, Location(path, 1))) is not None}
    declared = {dependency.name for each in owners.values() for dependency in each.dependencies}
    return len(owners) >= _MANY and use.package not in declared


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
            found.update(_closure(outside or (), package.ros))
        for dependency in inner.dependencies if inner is not None else ():
            if dependency.kind in _RUN and dependency.name not in found:
                found.add(dependency.name)
                todo.append(dependency.name)
    return frozenset(found), is_whole


def _closure(names: Iterable[str], ros: int | None) -> set[str]:
    """*names* and all that comes with them, as far as it is known."""
    found, todo = set(names), list(names)
    while todo:
        further = (knowledge().depends(todo.pop(), ros) or frozenset()) - found
        found |= further
        todo += further
    return found


CHECK = Check(
    id="undeclared-launch-dependency",
    summary="Package used by a launch file that package.xml does not declare.",
    level=Level.WARNING,
    catalogue="L04",
    tags=("launch", "packages"),
    run=check,
)
