# SPDX-License-Identifier: Apache-2.0
"""ROS libraries whose source lies in the workspace: for the nodes that use them they are libraries, as if they were installed.

API rows (docs/adding-an-api.md) describe all that a call of these libraries makes. Their source ends in sockets, middleware and plug-ins,
where an endpoint cannot be seen any more.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from haros_ci.follow.ros import api_rows
from haros_ci.index.index import Source
from haros_ci.model.api import Row
from haros_ci.model.build import Build

#: Packages that are libraries as a whole (ros/ros_comm, ros/roscpp_core, ros/nodelet_core, ros2/rclcpp, ros2/rclpy).
WHOLE = frozenset(
    [
        "roscpp",
        "rospy",
        "xmlrpcpp",
        "rosgraph",
        "rosconsole",
        "rostime",
        "cpp_common",
        "roscpp_serialization",
        "roscpp_traits",
        "nodelet",
        "rclcpp",
        "rclcpp_action",
        "rclcpp_lifecycle",
        "rclpy",
    ]
)
#: Packages of which the files that define what the rows describe are a library; they have nodes and plug-ins of their own, too.
DESCRIBED = frozenset(
    [
        "actionlib",
        "bondcpp",
        "bondpy",
        "camera_info_manager",
        "camera_info_manager_py",
        "diagnostic_updater",
        "dynamic_reconfigure",
        "image_transport",
        "interactive_markers",
        "message_filters",
        "nodelet_topic_tools",
        "point_cloud_transport",
        "self_test",
        "tf",
        "tf2_ros",
        "tf2_ros_py",
    ]
)


def library_files(
    sources: Iterable[Source], builds: Mapping[str, Build], rows: Mapping[tuple[str, int], Iterable[Row]]
) -> frozenset[str]:
    """The paths of *sources* that are of libraries which *rows* describe, but not what their packages build or install as programs."""
    every = [source for source in sources if source.package in WHOLE or source.package in DESCRIBED]
    if not every:
        return frozenset()
    programs = _programs(builds)
    described = frozenset(
        name for found in rows.values() for row in found for name in (*api_rows.names_of(row), row.call)
    )
    modules = {
        _top(source)
        for source in every
        if source.package in DESCRIBED and source.module and _defines(source, described)
    }
    return frozenset(source.path for source in every if _is_library(source, described, modules)) - programs


def _is_library(source: Source, described: frozenset[str], modules: set[tuple[str | None, str]]) -> bool:
    if source.package not in DESCRIBED:
        return source.package in WHOLE
    return _top(source) in modules if source.module else _defines(source, described)


def _top(source: Source) -> tuple[str | None, str]:
    """The Python package that a module is in, which may import what the module defines."""
    return source.package, source.module.partition(".")[0]


def _defines(source: Source, described: frozenset[str]) -> bool:
    """Whether a file has a class or function that rows describe; in Python under the name of its package."""
    program = source.program
    names = [class_.name for class_ in program.classes if class_.fields or class_.bases]
    names += [name for function in program.functions for name in (function.name, function.owner) if name]
    if program.language == "python":
        names = [f"{_top(source)[1]}.{name.rpartition('.')[2]}" for name in names]
    return not described.isdisjoint(names)


def _programs(builds: Mapping[str, Build]) -> frozenset[str]:
    own = [build for name, build in builds.items() if name in WHOLE or name in DESCRIBED]
    return frozenset(path for build in own for path in _started(build))


def _started(build: Build) -> Iterator[str]:
    for target in build.targets:
        if target.kind == "executable":
            yield from (*target.sources, *target.conditional_sources)
    yield from build.scripts
    yield from (installed.path for installed in build.installed if installed.kind == "program")
    yield from (point.path for point in build.entry_points)
