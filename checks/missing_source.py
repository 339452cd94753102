# SPDX-License-Identifier: Apache-2.0
"""Source files of CMake's targets that do not exist."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, ProjectPackage, alternatives, regex
from haros_ci.api.launch import similar_files
from haros_ci.api.packages import OF_TARGETS, CMakeCommand, brings_files, is_told_of, may_appear

#: What add_executable() and add_library() take as files; what has another ending may be a keyword, a target or a library.
_SOURCE = regex(r"[^$<>;*?]{1,300}\.(?:c|cc|cpp|cxx|c\+\+|cu|h|hh|hpp|hxx)\Z")
_MAKING = frozenset(
    "add_executable add_library add_rostest_gmock add_rostest_gtest ament_add_gmock ament_add_gtest ament_add_gtest_executable ament_auto_add_executable "
    "ament_auto_add_gtest ament_auto_add_library catkin_add_executable catkin_add_gmock catkin_add_gtest cuda_add_executable cuda_add_library".split()
)
#: Commands that name files and targets, and make no file.
_QUIET = (
    _MAKING
    | OF_TARGETS
    | frozenset(
        "add_dependencies ament_auto_package ament_export_dependencies ament_export_include_directories ament_export_interfaces ament_export_libraries "
        "ament_export_targets ament_package catkin_install_python catkin_package find_package include_directories install list message project "
        "rclcpp_components_register_node rclcpp_components_register_nodes set set_source_files_properties source_group target_sources".split()
    )
)
#: Commands that make code, and which of them is not known; and those of ROS, which make it in the build space, and no sources of targets.
_GENERATING = regex(r".*generat")
_OF_ROS = frozenset(
    (
        "generate_dynamic_reconfigure_options",
        "generate_messages",
        "generate_parameter_library",
        "rosidl_generate_interfaces",
    )
)
#: Files of one package for which one that is meant is looked for: each is compared with all that are there.
MOST_COMPARED = 100


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        if package.raw.build_type == "ament_python" or not package.cmake.is_whole:
            continue
        if brings_files(package) or any(
            _GENERATING.match(c.name) and c.name not in _OF_ROS for c in package.build.commands
        ):
            continue
        reported: set[str] = set()
        for command in package.build.commands:
            if command.name not in _MAKING or command.is_conditional or "IMPORTED" in command.arguments[:3]:
                continue
            for word in command.arguments[1:]:
                path = command.place(word) if _SOURCE.match(word) else None
                if (
                    path is None
                    or path in reported
                    or project.exists(path)
                    or may_appear(package, path, _QUIET)
                    or is_told_of(package, path)
                ):
                    continue
                reported.add(path)
                yield _finding(package, command, path, len(reported) <= MOST_COMPARED)


def _finding(package: ProjectPackage, command: CMakeCommand, path: str, is_compared: bool) -> Finding:
    top = "" if package.path == "." else f"{package.path}/"
    shown = path.removeprefix(top)
    beside = [name for name in package.project.workspace.names if is_compared and name.startswith(top)]
    near = alternatives([name.removeprefix(top) for name in similar_files(path, beside, package.name)])
    instead = f"did you mean {near}?" if near else "correct the name, or add the file"
    return Finding(
        at=command.location,
        message=f"{command.arguments[0]} is built from {shown}, which does not exist: CMake stops, as it cannot find this source file"
        f"{', where tests are built' if command.is_test else ''}; {instead}",
        about=(package.name, shown),
        apart=(shown,),
        level=Level.WARNING if command.is_test else None,
    )


CHECK = Check(
    id="missing-source",
    summary="Source file of a CMake target that does not exist.",
    level=Level.ERROR,
    tags=("build",),
    project=check,
)
