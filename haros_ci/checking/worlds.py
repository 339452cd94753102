# SPDX-License-Identifier: Apache-2.0
"""Packages that build under ROS 1 and under ROS 2, from one directory, and what they say of either."""

from __future__ import annotations

from collections.abc import Callable, Container

from haros_ci.knowledge.knowledge import knowledge
from haros_ci.model.condition import evaluate
from haros_ci.model.package import Package
from haros_ci.regex import regex

_FINDS = regex(r"(?mi)^[^#\n]*?\bfind_package[ \t]*\([ \t]*(catkin|ament_cmake)\b")
_ENVIRONMENTS = ({"ROS_VERSION": "1"}, {"ROS_VERSION": "2"})


def serves_both(package: Package, text: Callable[[str], str]) -> bool:
    """Whether *package* is for both: the manifest has dependencies for each alone (REP 149), or its CMake finds catkin and ament_cmake.

    *text* reads a file of the workspace.
    """
    if {(True, False), (False, True)} <= _verdicts(package):
        return True
    cmake = text("CMakeLists.txt" if package.path == "." else f"{package.path}/CMakeLists.txt")
    return {name.lower() for name in _FINDS.findall(cmake)} == {"catkin", "ament_cmake"}


def condition_on(name: str, package: Package, workspace: Container[str]) -> str:
    """The condition that a dependency on *name* is to have: one on the ROS that alone has it, where *package* has such conditions; else "".

    *workspace* are the names of its packages, of which nothing is said.
    """
    if package.format < 3 or name in workspace or not _verdicts(package) & {(True, False), (False, True)}:
        return ""
    known = knowledge()
    if not known.is_package(name):
        return ""  # a key of rosdep, or known nowhere
    worlds = [ros for ros in (1, 2) if known.is_in(name, ros)]
    return f"$ROS_VERSION == {worlds[0]}" if len(worlds) == 1 else ""


def dependency_tag(tag: str, name: str, package: Package, workspace: Container[str] = ()) -> str:
    """``<tag>name</tag>`` as the manifest of *package* is to have it, with the condition that it needs there."""
    condition = condition_on(name, package, workspace)
    attribute = f' condition="{condition}"' if condition else ""
    return f"<{tag}{attribute}>{name}</{tag}>"


def _verdicts(package: Package) -> set[tuple[bool | None, ...]]:
    """For each condition of the dependencies of *package* whether it holds under ROS 1, and under ROS 2."""
    conditions = {dependency.condition for dependency in package.dependencies if dependency.condition is not None}
    return {tuple(evaluate(condition, environment) for environment in _ENVIRONMENTS) for condition in conditions}
