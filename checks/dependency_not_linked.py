# SPDX-License-Identifier: Apache-2.0
"""Packages that CMake finds, and that a target which includes their headers is not compiled or linked with."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Fix, Level, Location, Project, ProjectPackage, regex
from haros_ci.api.packages import Target, Using, insert_line

#: Variables of libraries that bring neither headers nor libraries of ROS.
_PLAIN = regex(
    r"\$\{(?:EIGEN\w*|Eigen\w*|Boost|BOOST|OpenCV|OPENCV|PCL|GTEST|PYTHON|Python\w*|YAML_?CPP|yaml-cpp|SDL\w*|OPENGL\w*|Qt\w*|QT\w*"
    r"|TinyXML\w*|CURL|ZLIB|OGRE|BULLET|Bullet|CMAKE_DL|CMAKE_THREAD)_\w*\}"
)
_GENERATED = regex(r"(\w+)/(?:msg|srv|action)/\w+\.hp?p?")
_ROSCPP = regex(r"\bros::(?:init|NodeHandle|spin)\b|\bROS_(?:INFO|WARN|ERROR|DEBUG)\w*\b")


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        if not package.cmake.is_whole:
            continue
        if package.ros == 1:
            yield from _catkin(package)
        elif package.ros == 2:
            yield from _ament(package)


def _ament(package: ProjectPackage) -> Iterator[Finding]:
    found = {command.arguments[0] for command in package.commands("find_package") if command.arguments}
    found |= package.declared if package.commands("ament_auto_find_build_dependencies", "autoware_package") else set()
    using = Using(package)
    for target in _targets(package):
        needed: dict[str, tuple[str, Location]] = {}
        for header, place in package.included.of(target).items():
            name = header.partition("/")[0]
            if (
                name in found
                and name != package.name
                and name in package.declared
                and _is_its_own(package, name, header)
            ):
                needed.setdefault(name, (header, place))
        if not needed or any(_leads_out(word) for word in package.cmake.include_words(target)):
            continue
        used = using.of(target)
        for name, (header, place) in needed.items() if used is not None else ():
            if used is not None and name not in used:
                yield Finding(
                    at=target.location,
                    message=f"target {target.name} includes {header}, but is not linked with {name}: the compiler does not find the "
                    f"header; add {name} to target_link_libraries({target.name} ...)",
                    about=(package.name, target.name, name),
                    apart=(target.name, name),
                    related=((place, f"includes {header}"),),
                )


def _leads_out(word: str) -> bool:
    """Whether an include directory may be one outside the package, which has headers that no package has brought."""
    rest = re.sub(r"^\$<(?:BUILD|INSTALL)(?:_LOCAL)?_INTERFACE:(.*)>$", r"\1", word)
    return "/../" in f"/{rest}/" or rest.startswith(("/", "$ENV{"))


def _is_its_own(package: ProjectPackage, name: str, header: str) -> bool:
    """Whether *header* of *name* is in a directory of its own, which no other package brings by chance."""
    match = _GENERATED.fullmatch(header)
    if match is not None:
        return package.project.knowledge.is_package(name) is not False
    other = package.project.package(name)
    if other is None or other.ros != 2:
        return False
    path = other.inside(f"include/{header}")
    if path not in package.project.workspace.names:
        return False
    places = [row for row in other.build.installed if row.kind == "directory" and f"{path}/".startswith(f"{row.path}/")]
    return (
        bool(places)
        and all(row.destination.startswith(f"include/{name}") for row in places)
        and not any(row.path.endswith(f"include/{name}") for row in places)
    )


def _targets(package: ProjectPackage) -> Iterator[Target]:
    for target in package.cmake.targets.values():
        is_code = target.kind in ("executable", "library", "object") and target.sources
        if is_code and not (target.is_conditional or target.is_test or target.component):
            if not package.cmake.may_change(target.name):
                yield target


def _catkin(package: ProjectPackage) -> Iterator[Finding]:
    """ROS 1: what catkin found is there by ${catkin_INCLUDE_DIRS} and ${catkin_LIBRARIES}."""
    components = {
        word
        for command in package.commands("find_package")
        if command.arguments[:1] == ("catkin",)
        for word in command.after("COMPONENTS", "OPTIONAL_COMPONENTS", "REQUIRED")
    }
    if not components or package.commands("link_libraries"):
        return
    unseen: list[tuple[Target, str, Location]] = []
    for target in _targets(package):
        included = package.included.of(target)
        header = next((name for name in included if name.partition("/")[0] in components or name == "ros/ros.h"), None)
        if header is None:
            continue
        if not any(_may_bring(word) for word in package.cmake.include_words(target)):
            unseen.append((target, header, included[header]))
        elif target.kind == "executable" and "roscpp" in components and not _is_linked(package, target):
            source = next((path for path in target.sources if _ROSCPP.search(package.project.text(path))), None)
            if source is not None and "ros/ros.h" in included:
                fix = _before(
                    package, target, f"target_link_libraries({target.name} ${{catkin_LIBRARIES}})", after=True
                )
                yield Finding(
                    at=target.location,
                    message=f"target {target.name} uses roscpp, but is not linked with it: the linker stops with undefined "
                    f"references; add target_link_libraries({target.name} ${{catkin_LIBRARIES}})",
                    about=(package.name, target.name),
                    apart=(target.name,),
                    related=((Location(source, 1), "uses roscpp"),),
                    fixes=(fix,) if fix is not None else (),
                )
    if unseen:
        target, header, place = unseen[0]
        others = f" ({len(unseen) - 1} more targets have the same defect)" if len(unseen) > 1 else ""
        fix = _before(package, target, "include_directories(${catkin_INCLUDE_DIRS})")
        yield Finding(
            at=target.location,
            message=f"target {target.name} includes {header}, but has no include directory for catkin packages{others}: the "
            f"compiler does not find the header; add include_directories(${{catkin_INCLUDE_DIRS}})",
            about=(package.name, "catkin_INCLUDE_DIRS"),
            related=((place, f"includes {header}"),),
            fixes=(fix,) if fix is not None else (),
        )


def _before(package: ProjectPackage, target: Target, command: str, *, after: bool = False) -> Fix | None:
    """*command* on a line beside the one that makes *target*, where that is one line of its own in the package's file."""
    text = package.project.text(target.location.path)
    number = target.location.line or 0
    lines = text.splitlines()
    if target.location.path != package.cmake_path or not 0 < number <= len(lines) or "\r\n" in text:
        return None
    if not re.fullmatch(r"(?:add_executable|add_library)\([^()#]*\)[ \t]*", lines[number - 1]):
        return None
    edit = insert_line(package.cmake_path, text, number + after, command)
    return Fix(command.partition("(")[0].replace("_", " "), (edit,))


def _may_bring(word: str) -> bool:
    """Whether an include directory may be one of what catkin finds."""
    rest = word.replace("${ROOT}", "").replace("${BUILD}", "")
    return ("$" in rest and not _PLAIN.fullmatch(rest)) or rest.startswith(("/opt", "/usr/local", "/home"))


def _is_linked(package: ProjectPackage, target: Target) -> bool:
    """Whether the target may be linked with roscpp, by whatever it is linked with."""
    cmake = package.cmake
    for name in (target.name, *(other_target.name for other_target in cmake.linked(target.name))):
        if name in cmake.mentioned:
            return True
        for link in cmake.links.get(name, ()):
            if "$" in link.word and not _PLAIN.fullmatch(link.word):
                return True
            if link.word in ("roscpp", "ros") or "::" in link.word or link.word.startswith("/"):
                return True
    return False


CHECK = Check(
    id="dependency-not-linked",
    summary="Target that includes a package's headers but is not linked with the package.",
    level=Level.ERROR,
    catalogue="B03",
    tags=("build",),
    project=check,
)
