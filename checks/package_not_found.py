# SPDX-License-Identifier: Apache-2.0
"""Packages that CMake uses, and that no find_package() finds before (ament_target_dependencies.cmake, genmsg's generate_messages)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from haros_ci.api import Check, Finding, Fix, Level, Location, Project, ProjectPackage, regex
from haros_ci.api.packages import EXPORTED, CMakeCommand, brings, dependency_tags, insert_line, needs

#: Commands that may find packages besides find_package(), and those of such names that do not.
_FINDING = regex(r"find|depend|package|auto|catkin_simple|import|require|setup|common")
_TAME = frozenset(
    (
        *("find_package", "find_library", "find_path", "find_program", "find_file", "add_dependencies", "project"),
        *("ament_target_dependencies", "ament_export_dependencies", "ament_package", "ament_auto_package", "catkin_package"),
        *("ament_python_install_package", "ament_auto_add_executable", "ament_auto_add_library", "ament_find_gtest"),
        *("pluginlib_export_plugin_description_file", "ament_lint_auto_find_test_dependencies", "configure_package_config_file"),
        *("write_basic_package_version_file", "nav2_package", "cmake_minimum_required", "set_package_properties"),
    )
)  # fmt: skip
#: Commands that find all that the manifest declares for the build.
_AUTO = ("ament_auto_find_build_dependencies", "ament_auto_find_test_dependencies", "autoware_package")
#: Macros of ROS 1 and the packages that define them (genmsg-extras.cmake, actionlib_msgs-extras.cmake).
_MACROS = {
    "add_message_files": ("message_generation", "genmsg"),
    "add_service_files": ("message_generation", "genmsg"),
    "generate_messages": ("message_generation", "genmsg"),
    "add_action_files": ("actionlib_msgs",),
    "generate_dynamic_reconfigure_options": ("dynamic_reconfigure",),
}
#: Macros of ROS 2 and the package that defines them; one of a name that begins with *family* may bring it.
_MACROS_OF_AMENT = {
    **dict.fromkeys(
        ("ament_package", "ament_target_dependencies", "ament_export_dependencies", "ament_export_targets"),
        ("ament_cmake", "ament_"),
    ),
    "ament_python_install_package": ("ament_cmake_python", "ament_"),
    # Where others find its macro, it makes nothing of the files without the adapter: https://github.com/ros2/rosidl/issues/885.
    "rosidl_generate_interfaces": ("rosidl_default_generators", "rosidl_"),
    "rclcpp_components_register_node": ("rclcpp_components", "rclcpp_components"),
    "rclcpp_components_register_nodes": ("rclcpp_components", "rclcpp_components"),
    "pluginlib_export_plugin_description_file": ("pluginlib", "pluginlib"),
}
#: Build tools that find no others but those of ament.
_OF_TOOLS = frozenset(("ament_cmake", "ament_cmake_ros", "eigen3_cmake_module", "python_cmake_module"))
#: Those of catkin itself.
_OF_CATKIN = frozenset(("catkin_package", "catkin_python_setup", "catkin_install_python"))
#: What manifests name for the run of code, and whose own CMake finds no generator.
_RUNTIME = frozenset(("message_runtime", "genpy", "rosbuild"))
_SCOPES = frozenset(("PUBLIC", "PRIVATE", "INTERFACE", "SYSTEM"))
_TARGET = regex(r"([a-z]\w*)::\w+")
_GENERATED = regex(r"(\w+)/(?:msg|srv|action)/\w+\.hp?p?")
#: Such a header that lies in the workspace as a file: some include path may lead to it.
_CHECKED_IN = regex(rf"(?:.*/)?({_GENERATED.pattern})")
#: Packages whose headers have a directory of their own since Humble: include/rclcpp/rclcpp/rclcpp.hpp.
_CLIENTS = frozenset(("rclcpp", "rclcpp_action", "rclcpp_components", "rclcpp_lifecycle", "tf2", "tf2_ros"))


def check(project: Project) -> Iterator[Finding]:
    there = frozenset(found[1] for path in project.workspace.names if (found := _CHECKED_IN.fullmatch(path)))
    for package in project.packages:
        if not package.cmake.is_whole or package.ros is None or _may_find_more(package):
            continue
        reported: set[str] = set()
        for name, finding in _ament(package, there) if package.ros == 2 else _catkin(package):
            if name not in reported:
                reported.add(name)
                yield finding


def _may_find_more(package: ProjectPackage) -> bool:
    """Whether something else may find packages, or what is found is not known."""
    commands = package.build.commands
    if any(command.name not in (*_TAME, *_AUTO) and _FINDING.search(command.name) for command in commands):
        return True
    return any("$" in word for command in package.commands("find_package") for word in command.arguments[:1])


def _ament(package: ProjectPackage, there: frozenset[str]) -> Iterator[tuple[str, Finding]]:
    found: dict[str, CMakeCommand] = {}
    uses: list[tuple[str, CMakeCommand]] = []
    called: set[str] = set()
    for command in package.build.commands:
        provider, family = _MACROS_OF_AMENT.get(command.name, ("", ""))
        is_first = bool(provider) and not command.is_conditional and provider not in called
        if is_first:
            called.add(provider)
        if is_first and _is_unknown_macro(package, found, provider, family):
            why = "" if family == "rosidl_" else " at an unknown command"
            message = f"{command.name}() is called without a find_package({provider}) before: CMake stops{why}"
            yield (
                provider,
                _made(package, command.location, provider, f"{message}; {_remedy(package, provider)}", found),
            )
        if command.name == "find_package" and command.arguments:
            found.setdefault(command.arguments[0], command)
        elif command.name in _AUTO:
            found |= {name: command for name in package.declared if name not in found}
        elif command.name == "ament_target_dependencies" and not command.is_conditional:
            for name in command.arguments[1:]:
                if name not in _SCOPES and _is_lacking(package, found, name):
                    yield name, _unfound(package, command, name, found)
        elif command.name == "target_link_libraries" and not command.is_conditional:
            matches = (_TARGET.fullmatch(word) for word in command.arguments[1:])
            uses += [(match[1], command) for match in matches if match is not None]
    for name, command in uses:
        if _is_lacking(package, found, name):
            yield name, _linked(package, command, name, found)
    for name, header, place in _headers(package):
        if header not in there and _is_lacking(package, found, name):
            yield name, _included(package, name, header, place, found)


def _is_lacking(package: ProjectPackage, found: Iterable[str], name: str) -> bool:
    """Whether *name* is a package of ROS or of the workspace, and none of those *found* is it, or may find it in its turn."""
    project = package.project
    is_here = project.package(name) is not None
    if name in found or name == package.name or not (is_here or project.knowledge.is_in(name, package.ros)):
        return False
    if project.knowledge.is_key(name) and not is_here:
        return False  # a library of the system that is called like a package
    others = {item for item in found if not item.startswith("ament_")}
    ros = {other for other in others if not _is_of_the_system(package, other)}
    return brings(package, ros, name) is False


def _is_unknown_macro(package: ProjectPackage, found: Iterable[str], provider: str, family: str) -> bool:
    """Whether none of the packages *found* defines what *provider* does, or may find one that does: those of build tools find others."""
    if package.raw.build_type != "ament_cmake" or any(
        name.startswith(family) or (name.endswith(("_cmake", "_common", "_tools", "_utils")) and name not in _OF_TOOLS)
        for name in found
    ):
        return False
    return all(package.project.package(name) is None for name in found) and _is_lacking(package, found, provider)


def _is_undefined(package: ProjectPackage, found: set[str], providers: tuple[str, ...]) -> bool:
    """Whether none of the packages found is one of *providers*, or finds one."""
    waiting = [text for text in found if text == text.lower() and not _is_of_the_system(package, text)]
    if not waiting or package.name in providers:
        return False
    project, seen = package.project, set(_RUNTIME)
    while waiting:
        name = waiting.pop()
        if name in providers:
            return False
        if name in seen:
            continue
        seen.add(name)
        other = project.package(name)
        brought = project.knowledge.depends(name, 1)
        if other is not None:
            waiting += [need.name for need in needs(other, *EXPORTED)]
        elif brought is None or not project.knowledge.is_whole(name):
            return False
        else:
            waiting += brought
    return True


def _is_of_the_system(package: ProjectPackage, name: str) -> bool:
    """Whether find_package(*name*) finds a library of the system, which finds no package of ROS; one that nobody knows may."""
    project = package.project
    if project.package(name) is not None or project.knowledge.is_package(name) is not False:
        return False
    return (
        name != name.lower()
        or "-" in name
        or project.knowledge.is_key(name)
        or bool(project.knowledge.provider_of_cmake(name))
    )


def _unfound(package: ProjectPackage, use: CMakeCommand, name: str, found: dict[str, CMakeCommand]) -> Finding:
    later = next((command for command in package.commands("find_package") if command.arguments[:1] == (name,)), None)
    if later is not None:
        message = (
            f"ament_target_dependencies({use.arguments[0]}) uses {name} before find_package({name}) in line "
            f"{later.location.line}"
        )
        return _made(
            package, use.location, name, f"{message}: CMake stops; move find_package({name} REQUIRED) before it"
        )
    message = f"ament_target_dependencies({use.arguments[0]}) uses {name} without find_package({name})"
    return _made(package, use.location, name, f"{message}: CMake stops; {_remedy(package, name)}", found)


def _linked(package: ProjectPackage, use: CMakeCommand, name: str, found: dict[str, CMakeCommand]) -> Finding:
    word = next(word for word in use.arguments if word.startswith(f"{name}::"))
    message = (
        f"target {use.arguments[0]} is linked with {word} without find_package({name}): CMake stops, because the "
        f"target {word} does not exist"
    )
    return _made(package, use.location, name, f"{message}; {_remedy(package, name)}", found)


def _included(
    package: ProjectPackage, name: str, header: str, place: Location, found: dict[str, CMakeCommand]
) -> Finding:
    message = (
        f"{package.name} includes {header}, but its CMakeLists.txt has no find_package({name}): the compiler does "
        "not find the header"
    )
    return _made(package, place, name, f"{message}; {_remedy(package, name)}, and link the target with it")


def _remedy(package: ProjectPackage, name: str) -> str:
    return f"add find_package({name} REQUIRED)" + (
        "" if name in package.declared else f", and {dependency_tags(package, 'depend', name)} in package.xml"
    )


def _made(
    package: ProjectPackage, at: Location, name: str, message: str, found: dict[str, CMakeCommand] | None = None
) -> Finding:
    fix = _fix(package, at, name, found) if found and name in package.declared else None
    return Finding(
        at=at,
        message=message,
        about=(package.name, name),
        apart=(name,),
        fixes=() if fix is None else (fix,),
    )


def _fix(package: ProjectPackage, at: Location, name: str, found: dict[str, CMakeCommand]) -> Fix | None:
    """find_package() on a line after the last one before *at*, where that is one line of the package's own file."""
    text = package.project.text(package.cmake_path)
    lines = text.splitlines()
    for command in reversed(list(found.values())):
        number = command.location.line or 0
        if (
            command.is_conditional
            or command.is_test
            or command.location.path != package.cmake_path
            or at.path != package.cmake_path
        ):
            continue
        if number < (at.line or 0) and re.fullmatch(r"find_package\([^()#$]*\)[ \t]*", lines[number - 1]):
            return Fix(
                f"find {name}", (insert_line(package.cmake_path, text, number + 1, f"find_package({name} REQUIRED)"),)
            )
    return None


def _headers(package: ProjectPackage) -> Iterator[tuple[str, str, Location]]:
    """Headers of packages that the manifest declares, each in a directory that only its own package brings."""
    for target in package.cmake.targets.values():
        is_code = target.kind in ("executable", "library", "object") and target.sources
        if not is_code or target.is_conditional or target.is_test or package.cmake.may_change(target.name):
            continue
        for header, place in package.included.of(target).items():
            name = header.partition("/")[0]
            if name in package.declared and _is_its_own(package, name, header):
                yield name, header, place


def _is_its_own(package: ProjectPackage, name: str, header: str) -> bool:
    if _GENERATED.fullmatch(header) is not None or name in _CLIENTS:
        return True
    other = package.project.package(name)
    if other is None or other.ros != 2 or f"{other.path}/include/{header}" not in package.project.workspace.names:
        return False
    path = other.inside(f"include/{header}")
    rows = [row for row in other.build.installed if row.kind == "directory" and path.startswith(f"{row.path}/")]
    return bool(rows) and all(
        row.destination.startswith(f"include/{name}") and not row.path.endswith(f"include/{name}") for row in rows
    )


def _catkin(package: ProjectPackage) -> Iterator[tuple[str, Finding]]:
    """generate_messages(DEPENDENCIES) of ROS 1, and macros that a package brings."""
    found: set[str] = set()
    for command in package.build.commands:
        if command.name == "find_package":
            found.update(command.arguments)
        if command.name in _OF_CATKIN and not command.is_conditional and _lacks_catkin(package, found):
            message = (
                f"{command.name}() is called without a find_package(catkin) before: CMake stops at an unknown command"
            )
            yield "catkin", _made(package, command.location, "catkin", f"{message}; add find_package(catkin REQUIRED)")
        providers = _MACROS.get(command.name, ())
        if providers and not command.is_conditional and _is_undefined(package, found, providers):
            message = f"{command.name}() is called without a find_package() of {providers[0]} before: CMake stops at an unknown command"
            remedy = f"add {providers[0]} to the COMPONENTS of find_package(catkin)"
            yield providers[0], _made(package, command.location, providers[0], f"{message}; {remedy}")
        if command.name == "generate_messages" and not command.is_conditional:
            for name in command.after("DEPENDENCIES", "LANGS"):
                if "$" not in name and _is_lacking(package, found, name):
                    message = (
                        f"generate_messages() depends on {name} without a find_package() of it before: CMake stops"
                    )
                    yield (
                        name,
                        _made(
                            package,
                            command.location,
                            name,
                            f"{message}; add {name} to the COMPONENTS of find_package(catkin)",
                        ),
                    )


def _lacks_catkin(package: ProjectPackage, found: set[str]) -> bool:
    """Whether none of the packages *found* is catkin, or one that may find it: of ROS, of the workspace, or that nobody knows."""
    if package.raw.build_type == "cmake" or any(
        "catkin" in word for c in package.commands("include") for word in c.arguments
    ):
        return False
    return "catkin" not in found and all(name != name.lower() or _is_of_the_system(package, name) for name in found)


CHECK = Check(
    id="package-not-found",
    summary="Package used in CMake without find_package().",
    level=Level.ERROR,
    catalogue="",
    tags=("build", "packages"),
    project=check,
)
