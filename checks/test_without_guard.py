# SPDX-License-Identifier: Apache-2.0
"""Commands for tests that run in builds without tests, where they are not there (catkin's tests.cmake; ament's packages for tests)."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, ProjectPackage
from haros_ci.api.packages import CMakeCommand

#: Commands that stop with an error if CATKIN_ENABLE_TESTING is off (gtest.cmake, nosetests.cmake, download_test_data.cmake, rostest-extras.cmake).
_OF_CATKIN = frozenset(
    (
        *(
            "catkin_add_gtest",
            "catkin_add_gmock",
            "catkin_add_executable_with_gtest",
            "catkin_add_executable_with_gmock",
        ),
        *("catkin_add_nosetests", "catkin_download_test_data", "add_rostest", "add_rostest_gtest", "add_rostest_gmock"),
    )
)
#: The package that brings each command for tests of ament.
_OF_AMENT = {
    "ament_add_gtest": "ament_cmake_gtest",
    "ament_add_gtest_executable": "ament_cmake_gtest",
    "ament_add_gtest_test": "ament_cmake_gtest",
    "ament_add_gmock": "ament_cmake_gmock",
    "ament_add_pytest_test": "ament_cmake_pytest",
    "ament_add_google_benchmark": "ament_cmake_google_benchmark",
    "ament_add_nose_test": "ament_cmake_nose",
    "add_launch_test": "launch_testing_ament_cmake",
    "add_ros_test": "ros_testing",
}
#: What finds packages for tests besides find_package().
_AUTO = ("ament_lint_auto_find_test_dependencies", "ament_auto_find_test_dependencies")
#: What asks the other way round, or decides by itself whether there are tests.
_OTHERWISE = r"\bnot\s+(?:\(\s*)?(?:defined\s+)?{0}\b|\bset\s*\(\s*{0}\b"
_SHOWN = 4


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        if package.ros is None or not package.cmake.is_whole:
            continue
        switch = "CATKIN_ENABLE_TESTING" if package.ros == 1 else "BUILD_TESTING"
        otherwise = re.compile(_OTHERWISE.format(switch), re.IGNORECASE)
        found = list(_catkin(package) if package.ros == 1 else _ament(package))
        if found and not any(
            otherwise.search(project.text(path)) for path in {c.location.path for c in package.build.commands}
        ):
            yield _finding(package, switch, found)


def _catkin(package: ProjectPackage) -> Iterator[CMakeCommand]:
    if any("catkin" in command.arguments[:1] for command in package.commands("find_package")):
        yield from (command for command in package.commands(*sorted(_OF_CATKIN)) if _is_always_run(command))


def _ament(package: ProjectPackage) -> Iterator[CMakeCommand]:
    """Those whose packages are found for tests alone: whoever has found them always has the commands, too."""
    always = {
        command.arguments[0]
        for command in package.commands("find_package")
        if command.arguments and not command.is_test
    }
    for_tests = {
        command.arguments[0] for command in package.commands("find_package") if command.arguments and command.is_test
    }
    if any(command.is_test for command in package.commands(*_AUTO)):
        for_tests |= {dependency.name for dependency in package.raw.dependencies}
    for command in package.commands(*_OF_AMENT):
        if _is_always_run(command) and _OF_AMENT[command.name] in for_tests - always:
            yield command


def _is_always_run(command: CMakeCommand) -> bool:
    return not command.is_test and not command.is_conditional


def _finding(package: ProjectPackage, switch: str, found: list[CMakeCommand]) -> Finding:
    first = found[0]
    places = tuple((command.location, "here, too") for command in found[1:] if command.location != first.location)
    if package.ros == 1:
        why = "catkin stops with an error where tests are switched off (-DCATKIN_ENABLE_TESTING=OFF)"
    else:
        name = _OF_AMENT[first.name]
        why = f"{name} is found for tests alone, so that CMake stops at an unknown command with -DBUILD_TESTING=OFF"
    return Finding(
        at=first.location,
        message=f"{first.name}() of {package.name} is called outside of if({switch}): {why}; move it into that block",
        about=(package.name, first.name),
        related=places[:_SHOWN],
        apart=(package.name,),
    )


CHECK = Check(
    id="test-without-guard",
    summary="Command for tests that also runs where tests are switched off, and fails there.",
    level=Level.WARNING,
    tags=("build",),
    project=check,
)
