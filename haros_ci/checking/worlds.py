# SPDX-License-Identifier: Apache-2.0
"""Packages that build under ROS 1 and under ROS 2, from one directory."""

from __future__ import annotations

import re
from collections.abc import Callable

from haros_ci.model.condition import evaluate
from haros_ci.model.package import Package

_FINDS = re.compile(r"(?mi)^[^#\n]*?\bfind_package[ \t]*\([ \t]*(catkin|ament_cmake)\b")
_ENVIRONMENTS = ({"ROS_VERSION": "1"}, {"ROS_VERSION": "2"})


def serves_both(package: Package, text: Callable[[str], str]) -> bool:
    """Whether *package* is for both: the manifest has dependencies for each alone (REP 149), or its CMake finds catkin and ament_cmake.

    *text* reads a file of the workspace.
    """
    conditions = {each.condition for each in package.dependencies if each.condition is not None}
    verdicts = {tuple(evaluate(each, environment) for environment in _ENVIRONMENTS) for each in conditions}
    if {(True, False), (False, True)} <= verdicts:
        return True
    cmake = text("CMakeLists.txt" if package.path == "." else f"{package.path}/CMakeLists.txt")
    return {name.lower() for name in _FINDS.findall(cmake)} == {"catkin", "ament_cmake"}
