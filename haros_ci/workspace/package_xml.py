# SPDX-License-Identifier: Apache-2.0
"""Package manifests of formats 1, 2 and 3 (REP 127, 140, 149) as packages.

Whether a package is one of ROS 1 or of ROS 2 is decided by the first of these that speaks for one of them alone: the
build types that its exports name, its build tools, all that it depends on. What a condition rules out does not count.
Where none does and its dependencies speak for both, the package builds under both: ``supports_both``. Such a package
counts as one of ROS 2, with the build type that it has there, unless all others of the workspace that tell are of
ROS 1; then it stays undecided (``ros`` None), and both sides of its conditions are looked at. The environment that
the program runs in is not asked, so that the result is the same everywhere. All dependencies are kept, those with a
condition on ``$ROS_VERSION`` included.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from types import MappingProxyType

from haros_ci.model.condition import evaluate
from haros_ci.model.element import Element
from haros_ci.model.package import Dependency, Package
from haros_ci.model.workspace import Problem
from haros_ci.regex import regex
from haros_ci.workspace.xml import XmlError, parse_xml

#: Tags that name another package which this one needs. ``conflict``, ``replace`` and groups do not.
DEPENDENCY_TAGS = (
    "build_depend",
    "buildtool_depend",
    "test_depend",
    "run_depend",  # format 1
    "depend",  # formats 2 and 3, as the rest
    "build_export_depend",
    "buildtool_export_depend",
    "exec_depend",
    "doc_depend",
)

#: All tags that <package> may hold (REP 127, 140 and 149).
_TAGS = frozenset(DEPENDENCY_TAGS) | frozenset(
    (
        *("name", "version", "description", "maintainer", "license", "url", "author", "conflict", "replace", "export"),
        *("group_depend", "member_of_group"),
    )
)
_NAME = regex(r"[A-Za-z][\w-]{0,100}")

#: Packages that exist in one ROS only, and are needed by most that are written for it.
_ROS_OF = {"catkin": 1, "roscpp": 1, "rospy": 1, "message_generation": 1, "rclcpp": 2, "rclpy": 2}
_ROS_OF["rosidl_default_generators"] = 2

_NOTHING: Mapping[str, str] = MappingProxyType({})


def parse_package(path: str, data: bytes, *, environment: Mapping[str, str] | None = None) -> Package | Problem:
    """The package that the manifest at *path* (relative to the root) describes, or the fault in it.

    *environment* are the variables that conditions may refer to. What a condition rules out is left out, what it cannot
    decide is kept, with the condition.
    """
    environment = _NOTHING if environment is None else environment
    try:
        root = parse_xml(data)
    except XmlError as err:
        return Problem(path, err.message, err.line)
    if root.tag != "package":
        return Problem(path, f"the outermost element is <{root.tag}>, not <package>", root.line)
    name = _text(next(root.all("name"), None))
    if not name:
        return _nameless(path, root)
    manifest_format = root.attributes.get("format", "1").strip()
    if manifest_format not in ("1", "2", "3"):
        return Problem(path, f"package format {manifest_format!r} is not known; use 3", root.line)
    dependencies = tuple(
        Dependency(_text(tag), tag.tag, None if verdict else tag.attributes["condition"], tag.line)
        for tag, verdict in _holding(root, environment, *DEPENDENCY_TAGS)
        if _text(tag)
    )
    exports = [child for export in root.all("export") for child in export.children]
    export = Element("export", {}, root.line, children=exports)
    build_types = {_text(tag) for tag, _ in _holding(export, environment, "build_type")} - {""}
    ros = _ros(build_types, dependencies)
    if len(build_types) > 1 and ros is not None:
        build_types = {one for one in build_types if _worlds({one}) == {ros}}
    return Package(
        name=name,
        path=path.rpartition("/")[0] or ".",
        format=int(manifest_format),
        version=_text(next(root.all("version"), None)),
        build_type=min(build_types) if len(build_types) == 1 else "",
        ros=ros,
        dependencies=dependencies,
        is_metapackage=any(export.all("metapackage")),
    )


def _nameless(path: str, root: Element) -> Problem:
    """What is wrong with a manifest without a name: a tag that no format has, with a text that can be one, is meant to hold it."""
    meant = next((child for child in root.children if child.tag not in _TAGS and _NAME.fullmatch(_text(child))), None)
    if meant is None:
        return Problem(path, "no package name; add <name>", root.line)
    return Problem(
        path,
        f"no package name: <{meant.tag}> is no tag of package.xml, and colcon and catkin do not take its text for the name; "
        f"write <name>{_text(meant)}</name>",
        meant.line,
    )


def supports_both(package: Package) -> bool:
    """Whether what *package* depends on is of ROS 1 and of ROS 2 at once."""
    if package.ros is not None:
        return False
    return {1, 2} <= _worlds({d.name for d in package.dependencies})


def settled(package: Package, path: str, data: bytes, others: Iterable[Package]) -> Package:
    """*package*, of the manifest at *path*: of ROS 2 if it supports both and *others* do not speak against it."""
    if not supports_both(package) or {other.ros for other in others} - {None} == {1}:
        return package
    chosen = parse_package(path, data, environment={"ROS_VERSION": "2"})
    build_type = chosen.build_type if isinstance(chosen, Package) else ""
    return replace(package, ros=2, build_type=package.build_type or build_type)


def _holding(parent: Element, environment: Mapping[str, str], *tags: str) -> list[tuple[Element, bool | None]]:
    """The children with *tags* whose condition holds, with True, or cannot be decided, with None."""
    found: list[tuple[Element, bool | None]] = []
    for child in parent.all(*tags):
        condition = child.attributes.get("condition")
        verdict = True if condition is None else evaluate(condition, environment)
        if verdict is not False:
            found.append((child, verdict))
    return found


def _ros(build_types: set[str], dependencies: tuple[Dependency, ...]) -> int | None:
    """1 or 2 by the build type, else the build tool, else the client libraries: the first that speaks for one alone; None where all speak for both."""
    build_tools = {d.name for d in dependencies if d.kind == "buildtool_depend"}
    for names in (build_types, build_tools, {d.name for d in dependencies}):
        worlds = _worlds(names)
        if len(worlds) == 1:
            return worlds.pop()
    return None


def _worlds(names: Iterable[str]) -> set[int]:
    """The ROS that packages of these names exist in, of those that exist in one only."""
    found = {2 if name.startswith("ament_") else _ROS_OF.get(name, 0) for name in names}
    return found - {0}


def _text(element: Element | None) -> str:
    return "" if element is None else " ".join(element.text.split())
