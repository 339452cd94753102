# SPDX-License-Identifier: Apache-2.0
"""Large copies of other projects that name nothing of ROS: for the model they are libraries, as if they were installed.

Nothing in them can make an endpoint, and their headers are often the largest part of a workspace (Boost, Eigen, CppAD). Their files count
for what they include. Read in full are what own code includes by itself, for its enumerators and types, and a copy in which a class of the
workspace has its base.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.syntax import Class, Program, Type
from haros_ci.workspace.library_trees import library_trees
from haros_ci.workspace.third_party import NAMES, around

#: Lines of a copy below which it is read in full: that costs little.
LARGE = 10_000
#: Namespaces of the libraries that API rows describe, and of what loads plug-ins (``extract/apis``).
SPACES = (
    "ros roscpp rclcpp rclcpp_lifecycle rclcpp_action rclcpp_components rcl_interfaces nodelet nodelet_topic_tools jsk_topic_tools image_transport"
    " camera_info_manager point_cloud_transport pcl_ros topic_tools message_filters tf tf2 tf2_ros filters actionlib dynamic_reconfigure"
    " diagnostic_updater self_test realtime_tools interactive_markers bond robot_state_publisher controller_manager costmap_2d moveit"
    " planning_scene_monitor urdf pluginlib class_loader nav2 nav2_util ament_index_cpp autoware autoware_utils autoware_universe_utils"
    " tier4_autoware_utils autoware_utils_rclcpp autoware_utils_debug autoware_utils_logging autoware_utils_tf autoware_utils_diagnostics"
    " component_interface_utils gazebo gazebo_ros rviz rviz_common rviz_default_plugins BT controller_interface hardware_interface"
).split()
_ROS = regex(
    rf"\b(?:{'|'.join(SPACES)})::"
    r"|[<\"](?:ros|rcl\w{0,20}|rclcpp\w{0,20}|tf2?(?:_ros)?|nodelet|pluginlib|class_loader|gazebo\w{0,20}|\w{1,40}_msgs|message_filters)/"
    r"|\b(?:ros[12]?|rclcpp|rclc?)_\w|\b(?:ROS|RCLCPP|RCUTILS|PLUGINLIB|CLASS_LOADER)_[A-Z]"
)
#: Without any of these a file in the tree of a well-known library names nothing of ROS: these have millions of lines.
LIKELY = ("ros::", "ros/", "rclcpp", "nodelet", "pluginlib", "_msgs/")
#: An include as written, with its brackets or quotes.
_INCLUDE = regex(r"^[ \t]{0,80}#[ \t]{0,80}include[ \t]{0,80}(<[^<>\n]{1,400}>|\"[^\"\n]{1,400}\")", re.MULTILINE)
#: The name of a class that is defined.
_CLASS = regex(
    r"\b(?:class|struct)[ \t]{1,40}(?:[A-Z][A-Z0-9_]{1,60}[ \t]{1,40})?(\w{1,200})\s{0,80}(?:final\s{0,80})?[:{]"
)


def foreign(workspace: Workspace) -> dict[str, tuple[SourceFile, ...]]:
    """The files of each large copy that names nothing of ROS, without those that own code includes by itself."""
    copies: dict[str, list[SourceFile]] = {}
    for file in workspace.files:
        if file.language == "cpp" and file.third_party:
            copies.setdefault(_project(file), []).append(file)
    large = {name: files for name, files in copies.items() if sum(file.lines for file in files) >= LARGE}
    if not large:
        return {}
    trees = library_trees(workspace.names, {package.path: package.name for package in workspace.packages})
    large = {name: files for name, files in large.items() if not any(_names_ros(workspace, files, trees))}
    named = {last for file in workspace.files if _is_own(file) for last in _included(workspace, file)}
    found = {}
    for name, files in large.items():
        left = (file for file in files if around(file.path, trees) or not _is_named(file.path, named))
        found[name] = tuple(left)
    return found


def without_bases(
    workspace: Workspace, copies: Mapping[str, Iterable[SourceFile]], programs: Iterable[Program | None]
) -> frozenset[str]:
    """The paths of the files of *copies* in which no class of *programs*, the workspace's own, has its base; but for well-known libraries."""
    bases = {
        base.name.rpartition("::")[2]
        for program in programs
        if program is not None and program.language == "cpp"
        for definition in program.classes
        for base in _bases(definition)
    }
    trees = library_trees(workspace.names, {package.path: package.name for package in workspace.packages})
    found: set[str] = set()
    for files in map(tuple, copies.values()):
        unknown = [file for file in files if not around(file.path, trees)]
        if all(bases.isdisjoint(_CLASS.findall(workspace.text(file.path))) for file in unknown):
            found.update(file.path for file in files)
    return frozenset(found)


def head(text: str) -> Program:
    """What counts of such a file: what it includes."""
    return Program("cpp", includes=tuple(dict.fromkeys(_INCLUDE.findall(text))))


def _bases(definition: Class) -> Iterator[Type]:
    """The base classes of a class that may be in a copy: those of the standard library are not."""
    return (base for base in definition.bases if not base.name.startswith("std::"))


def _project(file: SourceFile) -> str:
    """The directory of the copy that a file belongs to: in ``third_party`` each directory is another one."""
    directory = file.third_party
    if directory.rpartition("/")[2].lower() not in NAMES:
        return directory
    return f"{directory}/{file.path[len(directory) + 1 :].partition('/')[0]}"


def _names_ros(workspace: Workspace, files: Iterable[SourceFile], trees: frozenset[str]) -> Iterator[bool]:
    for file in files:
        text = workspace.text(file.path)
        is_likely = not around(file.path, trees) or any(word in text for word in LIKELY)
        yield is_likely and _ROS.search(text) is not None


def _is_own(file: SourceFile) -> bool:
    return file.language == "cpp" and not file.third_party


def _included(workspace: Workspace, file: SourceFile) -> Iterator[str]:
    return (name[1:-1].lstrip("./") for name in _INCLUDE.findall(workspace.text(file.path)))


def _is_named(path: str, named: set[str]) -> bool:
    """Whether one of the includes *named* may be of the file at *path*: it is the end of it."""
    parts = path.split("/")
    return any("/".join(parts[number:]) in named for number in range(len(parts)))
