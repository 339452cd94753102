# SPDX-License-Identifier: Apache-2.0
"""Dependencies of a manifest that only the other ROS has (the distributions of rosdistro; the migration guide of ROS 2)."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, ProjectPackage, regex, spelled_out
from haros_ci.api.packages import COUNTERPARTS, Dependency, holds, is_nested, repositories_named

#: What builds a package; of another one wrong-build-type tells.
_TOOLS = ("buildtool_depend", "buildtool_export_depend", "doc_depend")

#: What makes code of interfaces, and what that code needs.
_GENERATORS = frozenset(
    ("message_generation", "message_runtime", "rosidl_default_generators", "rosidl_default_runtime")
)
#: The client libraries, by the language of the code that needs them.
_CLIENTS = {"rospy": "python", "rclpy": "python", "roscpp": "cpp", "rclcpp": "cpp"}
_INTERFACES = (".msg", ".srv", ".action")
_VERSION = regex(r"\$ROS_VERSION\s*==\s*['\"]?([12])")
#: Files that bring sources of other repositories into the workspace.
_SOURCES = regex(r"\.(?:repos|rosinstall)$|(?:^|/)\.gitmodules$|(?:^|/)[^/]*(?:dependencies|upstream)[^/]*\.ya?ml$")


def check(project: Project) -> Iterator[Finding]:
    brings_sources = any(_SOURCES.search(name) for name in project.workspace.names)
    for package in project.packages:
        if package.manifest is None or package.ros is None or is_nested(package):
            continue
        if _is_for_both(package):
            yield from _without_condition(package)
            continue
        found: dict[str, Dependency] = {}
        for need in package.raw.dependencies:
            if need.kind not in _TOOLS and _is_foreign(package, need):
                if need.name in COUNTERPARTS[package.ros] or not (brings_sources or _is_elsewhere(package, need.name)):
                    found.setdefault(need.name, need)
        if found:
            yield _finding(package, package.ros, list(found.values()))


def _is_elsewhere(package: ProjectPackage, name: str) -> bool:
    """Whether sources of the package *name* are at hand elsewhere: a file uses it, a page tells to clone it, or git fills a directory of its name."""
    project = package.project
    is_awaited = any(posixpath.basename(path) == name for path in project.absent)
    return is_awaited or _is_named(package, name) or _is_cloned(project, name)


def _is_for_both(package: ProjectPackage) -> bool:
    """Whether the package may be built for either ROS: by conditions, by both build tools, or by CMake for the other one."""
    tools = {need.name for need in package.raw.dependencies if need.kind in _TOOLS}
    if any(need.condition for need in package.raw.dependencies) or {"catkin", "ament_cmake"} <= tools:
        return True
    if package.ros == 2:
        return "catkin" in tools or bool(package.commands("catkin_package")) or "ros1" in package.name
    return bool(package.commands("ament_package")) or any(name.startswith("ament") for name in tools)


def _without_condition(package: ProjectPackage) -> Iterator[Finding]:
    """In a manifest with dependencies for either ROS: those on what one ROS alone has, for both."""
    conditions = " ".join(need.condition or "" for need in package.raw.dependencies)
    if {match[1] for match in _VERSION.finditer(conditions)} != {"1", "2"}:
        return
    for need in package.raw.dependencies:
        ros = next((ros for ros in (1, 2) if need.name in COUNTERPARTS[ros]), None)
        if ros is None or need.condition is not None or need.kind in _TOOLS:
            continue
        if package.project.package(need.name) is not None or package.project.knowledge.is_in(need.name, ros):
            continue
        yield Finding(
            at=_at(package, need),
            message=f"{package.name} is for ROS 1 and ROS 2 and depends on {need.name} in both, which no ROS {ros} distribution has: rosdep "
            f'stops there; add condition="$ROS_VERSION == {3 - ros}"',
            about=(package.name, need.name),
            apart=(need.kind, need.name),
        )


def _is_foreign(package: ProjectPackage, need: Dependency) -> bool:
    project, ros = package.project, package.ros
    if ros is None or project.package(need.name) is not None or holds(package, need.condition) is False:
        return False
    knowledge = project.knowledge
    if knowledge.is_key(need.name) or knowledge.is_package(need.name) is not True or knowledge.is_in(need.name, ros):
        return False
    return knowledge.is_in(need.name, 3 - ros)


def _finding(package: ProjectPackage, ros: int, found: list[Dependency]) -> Finding:
    found.sort(key=lambda need: (need.name not in COUNTERPARTS[ros], need.line or 0))
    names = [need.name for need in found]
    shown = {name: _instead(package, ros, name) for name in names}
    known = [name for name in shown if name in COUNTERPARTS[ros]]
    remove = [name for name in known if not shown[name]]
    write = [f"{shown[name]} for {name}" for name in known if shown[name]]
    remedy = [f"remove {spelled_out(remove)}"] if remove else []
    remedy += [f"write {spelled_out(write)}"] if write else []
    if not known:
        one = "it" if len(names) == 1 else "them"
        remedy = [f"nothing in the package names {one}: remove {one}, or add the sources to the workspace"]
    return Finding(
        at=_at(package, found[0]),
        message=f"{package.name} is a ROS {ros} package and depends on {spelled_out(names)}, which no ROS "
        f"{ros} distribution has: rosdep stops here; {', and '.join(remedy)}",
        about=(package.name,),
        related=tuple((_at(package, need), f"depends on {need.name}, too") for need in found[1:20]),
        level=None if names[0] in COUNTERPARTS[ros] else Level.WARNING,
    )


def _instead(package: ProjectPackage, ros: int, name: str) -> str:
    """What takes the place of *name*; "" where nothing does, the package declares it already, or has no need of it."""
    counterpart = COUNTERPARTS[ros].get(name, "")
    if name in _CLIENTS and not _has_language(package, name):
        return ""
    if name in _GENERATORS and not package.build.interfaces and not _has_interfaces(package):
        return ""
    if counterpart.startswith("rclcpp") and package.raw.build_type == "ament_python":
        counterpart = "rclpy"  # which has actions and components, too
    return "" if counterpart in package.declared else counterpart


def _has_language(package: ProjectPackage, client: str) -> bool:
    """Whether the package has code in the language of a client library, or none at all: there the library of the manifest says which is to come."""
    languages = {
        file.language
        for file in package.files
        if not file.path.endswith(("/setup.py", ".launch.py"))
        and file.path != "setup.py"
        and "/launch/" not in file.path
    }
    own = languages & set(_CLIENTS.values())
    return not own or _CLIENTS[client] in own


def _has_interfaces(package: ProjectPackage) -> bool:
    return any(name.endswith(_INTERFACES) for name in package.project.below(package.path))


def _is_cloned(project: Project, name: str) -> bool:
    """Whether a page, a script or a workflow of the workspace tells to clone the repository of that name."""
    return name in repositories_named(project.workspace)


def _is_named(package: ProjectPackage, name: str) -> bool:
    """Whether a file of the package beside its manifest has the name of a dependency: it is used, and its sources are at hand elsewhere."""
    word = re.compile(rf"(?<![\w-]){re.escape(name)}(?![\w-])")
    paths = (file.path for file in package.files if file.path != package.manifest_path)
    return any(word.search(text) for path in paths if name in (text := package.project.text(path)))


def _at(package: ProjectPackage, need: Dependency) -> Location:
    return Location(package.manifest_path, need.line or 1)


CHECK = Check(
    id="foreign-dependency",
    summary="Dependency on a package that only the other ROS version has.",
    level=Level.ERROR,
    tags=("packages",),
    project=check,
)
