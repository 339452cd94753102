# SPDX-License-Identifier: Apache-2.0
"""What a manifest lacks of what launch files and parameters need: what a package gets, who is to declare it, how grave it is."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from types import MappingProxyType

from haros_ci.checking.launching import owner, said_by
from haros_ci.checking.package_names import meant_here
from haros_ci.checking.system import System
from haros_ci.knowledge.knowledge import knowledge
from haros_ci.model.launch_facts import PackageUse
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.regex import regex

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


#: That nothing is used but what manifests declare.
NOTHING: Mapping[str, frozenset[str]] = MappingProxyType({})
#: Tools that people start while they make or watch a robot.
_TOOLS = frozenset(
    ("moveit_setup_assistant", "moveit_ros_benchmarks", "plotjuggler", "plotjuggler_ros", "rosbag", "ros2bag")
)
#: So many packages with a launch file of one name have it from a generator.
_MANY = 3
#: What a launch file in Python asks for packages that need not be there.
_ASKS = regex(r"get_packages_with_prefixes|PackageNotFoundError|has_resource|get_resource\b")
#: The directories of launch files for tests, and how those of rostest are called.
_TEST = regex(r"(?:^|/)(?:(?:ros|unit|integration_|system_)?tests?|testing|test_(?:utils|launch|data))/|\.test$")
_COMMENT = regex(r"<!--.*?-->", re.DOTALL)
#: Places that a script fills in when it copies the file: ``$NAME$``, ``@NAME@``, ``{{ name }}``.
_BLANK = regex(r"[\"'/>= ](?:\$[A-Z][A-Z0-9_]+\$|@[A-Z][A-Z0-9_]+@|\{\{ ?\w+ ?\}\})")


def provided(package: Package, system: System) -> tuple[frozenset[str], bool]:
    """What *package* names in any way, and what packages of the workspace need that it needs; whether that is all it gets."""
    declared = {dependency.name for dependency in package.dependencies}
    found, is_whole = brought_by(
        (dependency.name for dependency in package.dependencies if dependency.kind in _RUN), package.ros, system
    )
    return found | declared, is_whole


def brought_by(names: Iterable[str], ros: int | None, system: System) -> tuple[frozenset[str], bool]:
    """*names* and what comes with them, by the workspace's manifests and what is known of released packages; whether that is all."""
    todo = list(names)
    found = set(todo)
    is_whole = True
    while todo:
        name = todo.pop()
        inner = system.packages.get(name)
        if inner is None:
            outside = knowledge().depends(name, ros) if knowledge().is_whole(name) else None
            is_known = outside is not None or name.startswith(_PLAIN) or name.endswith("_msgs")
            is_whole = is_whole and is_known
            found.update(_closure(outside or (), ros))
        for dependency in inner.dependencies if inner is not None else ():
            if dependency.kind in _RUN and dependency.name not in found:
                found.add(dependency.name)
                todo.append(dependency.name)
    return frozenset(found), is_whole


def used_by_launch_files(system: System) -> Mapping[str, frozenset[str]]:
    """By package of the workspace what its launch files use of other packages."""
    found: dict[str, set[str]] = {}
    for use in (said_by(fact, system) for fact in system.facts(PackageUse)):
        package = owner(system, use.location)
        if package is not None:
            found.setdefault(package.name, set()).add(use.package)
    return {name: frozenset(names) for name, names in found.items()}


def closes_a_cycle(
    name: str, used: str, packages: Mapping[str, Package], uses: Mapping[str, frozenset[str]] = NOTHING
) -> bool:
    """Whether the package *used* of the *packages* of a workspace needs the package *name* itself, or *uses* say so, by the names of packages.

    With the dependency declared in both packages colcon and catkin stop, because they can order neither first.
    """
    todo, seen = [used], {used}
    while todo:
        inner = packages.get(todo.pop())
        if inner is None:
            continue
        further = {dependency.name for dependency in inner.dependencies} | uses.get(inner.name, frozenset())
        if name in further:
            return True
        todo += further - seen
        seen |= further
    return False


def is_to_be_had(name: str, ros: int | None, system: System) -> bool:
    """Whether the workspace or a distribution has a package *name*, so that declaring it helps; unknown-package tells of slips."""
    known = knowledge()
    if name in system.packages:
        return True
    return (not known.is_there or known.is_current(name, ros)) and not _is_slip_of_one(name, system)


def _is_slip_of_one(name: str, system: System) -> bool:
    """Whether unknown-package takes *name* for a package of the workspace: no manifest there has it, and one is called nearly so."""
    if any(dependency.name == name for package in system.packages.values() for dependency in package.dependencies):
        return False
    return meant_here(name, system.packages) is not None


def is_left_out(package: Package, use: PackageUse, system: System) -> bool:
    """Whether the manifest has the dependency in a comment, or the launch file is a template that is yet to be filled in."""
    if system.workspace is None:
        return False
    comments = _COMMENT.findall(system.workspace.text(dependency_place(package).path))
    if any(re.search(rf">\s*{re.escape(use.package)}\s*<", comment) for comment in comments):
        return True
    return _BLANK.search(system.workspace.text(use.location.path)) is not None


def is_aside(use: PackageUse, system: System) -> bool:
    """Whether it is a tool for developers, or of a launch file that a user chooses by an argument or that several packages have.

    None of these may declare it. What is chosen is installed by who chooses it.

    Files of one name in several packages come from a generator (MoveIt's setup assistant), and packages ship without what few of their users want.
    """
    if use.package in _TOOLS or use.package.startswith("rqt"):
        return True
    file = use.location.path.rpartition("/")[2]
    if any(pattern.fullmatch(use.location.path) for pattern, _ in system.whole.chosen_files):
        return True
    alike = system.whole.files_by_name.get(file, ())
    owners = {package.name: package for one in alike if (package := owner(system, Location(one, 1))) is not None}
    declared = {dependency.name for package in owners.values() for dependency in package.dependencies}
    return len(owners) >= _MANY and use.package not in declared


def is_of_tests(use: PackageUse, package: Package, system: System) -> bool:
    """Whether only tests of *package* start the launch file, by its directory, or as one of rostest: no page or script names it."""
    path = use.location.path
    inner = path if package.path == "." else path[len(package.path) + 1 :]
    return _TEST.search(inner) is not None and not system.whole.is_named(path)


def asks_what_is_installed(path: str, system: System) -> bool:
    """Whether the file at *path* is a launch file in Python that asks for packages that need not be there."""
    return path.endswith(".py") and system.workspace is not None and bool(_ASKS.search(system.workspace.text(path)))


def dependency_place(package: Package) -> Location:
    """Where another dependency goes: behind those of its kind, else behind all that there are."""
    path = "package.xml" if package.path == "." else f"{package.path}/package.xml"
    there = [(dependency.line, dependency.kind) for dependency in package.dependencies if dependency.line is not None]
    lines = [line for line, kind in there if kind in _RUN] or [line for line, _ in there]
    return Location(path, max(lines, default=1))


def _closure(names: Iterable[str], ros: int | None) -> set[str]:
    """*names* and all that comes with them, as far as it is known."""
    found, todo = set(names), list(names)
    while todo:
        further = (knowledge().depends(todo.pop(), ros) or frozenset()) - found
        found |= further
        todo += further
    return found
