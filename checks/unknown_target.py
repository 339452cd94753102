# SPDX-License-Identifier: Apache-2.0
"""Targets, libraries and sets of them that CMake installs, links or exports, and that the package does not make."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import get_close_matches
from functools import lru_cache

from haros_ci.api import Check, Finding, Level, Project, ProjectPackage, is_slip, listed, regex
from haros_ci.api.packages import (
    OF_TARGETS,
    CMakeCommand,
    add_dependency,
    is_built_against,
    is_found_by_others,
    may_have_more,
    may_set_variables,
)

#: Targets that CMake, catkin and rosidl make by themselves.
_GIVEN = regex(
    r".*__\w+|.*_(?:generate_messages|gencpp|genpy|geneus|genlisp|gennodejs|gencfg|EXPORTED_TARGETS)\w*"
    r"|all|clean|install|test|tests|run_tests|doxygen|uninstall|rebuild_cache|.*(?:::|\$|/).*|-.*|"
)
#: Commands that make no target, though they may name one like their package.
_NO_TARGETS = frozenset(
    (
        "pluginlib_export_plugin_description_file",
        "ament_python_install_package",
        "ament_environment_hooks",
        "rclcpp_components_register_node",
        "rclcpp_components_register_nodes",
    )
)
#: Commands that name targets and sets of them of the whole build.
_OF_BUILD = OF_TARGETS | {"install", "ament_export_targets", "ament_export_interfaces"}
#: What exports libraries; catkin_package() has them behind LIBRARIES.
_OF_LIBRARIES = ("catkin_package", "ament_export_libraries")
#: What only packages that use this one come to feel.
_OF_USERS = ("ament_export_libraries", "ament_export_dependencies")
#: What comes of an exported library that is not made, where packages of the workspace are built against it, and where not.
_NOT_FOUND = "packages that use it cannot find the {}"
_NOT_FOUND_LATER = "no package here is built against it yet; one that is will not find the {}"
#: Commands by which another build makes libraries that this one does not know.
_OUTSIDE = (
    *("externalproject_add", "fetchcontent_declare", "fetchcontent_makeavailable", "ament_vendor"),
    *("add_custom_command", "add_custom_target", "execute_process"),
)
#: Those of catkin_package().
_KEYWORDS = (
    *("INCLUDE_DIRS", "LIBRARIES", "CATKIN_DEPENDS", "DEPENDS", "CFG_EXTRAS", "EXPORTED_TARGETS"),
    *("SKIP_CMAKE_CONFIG_GENERATION", "SKIP_PKG_CONFIG_GENERATION"),
)
#: What stands behind DEPENDS in the template of catkin_create_pkg (catkin_pkg/templates/CMakeLists.txt.in).
_PLACEHOLDER = "system_lib"
_SETTINGS = frozenset(("debug", "optimized", "general"))


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        if not package.cmake.is_whole:
            continue
        reported: set[str] = set()
        is_open = may_have_more(package)
        for command in _in_force(package):
            exported: list[str] = []
            for name, what in _unknown(package, command, is_open):
                if name not in reported:
                    reported.add(name)
                    if what == _NOT_FOUND:
                        exported.append(name)
                    else:
                        yield _finding(package, command, (name,), what)
            if exported:
                yield _finding(package, command, tuple(exported), _NOT_FOUND)
            if command.name == "catkin_package":
                yield from _dependencies(package, command)


def _in_force(package: ProjectPackage) -> list[CMakeCommand]:
    """The commands that are run in every build; of catkin_package() the last one of a directory, which writes the configuration anew.

    Where that one may be left out, nobody knows which one counts.
    """
    last = {command.directory: command for command in package.commands("catkin_package")}
    return [
        command
        for command in package.build.commands
        if not command.is_conditional and (command.name != "catkin_package" or command is last[command.directory])
    ]


def _unknown(package: ProjectPackage, command: CMakeCommand, is_open: bool) -> Iterator[tuple[str, str]]:
    """The names in *command* that stand for nothing, each with what comes of it; *is_open* if others may make targets, too.

    Those that others make have names of their own: one that differs from a target of the package by a slip is none of them.
    """
    for name, what in _unmade(package, command):
        if not (is_open and command.name in _OF_BUILD) or _is_slip_of_target(package, name):
            yield name, what


def _unmade(package: ProjectPackage, command: CMakeCommand) -> Iterator[tuple[str, str]]:
    """The same of what the package itself makes."""
    cmake, words = package.cmake, command.arguments
    if command.name in OF_TARGETS and words and not command.is_test:
        end = words.index("PROPERTIES") if "PROPERTIES" in words else 1
        names = words[:end] if command.name == "set_target_properties" else words[:1]
        yield from ((name, f"{command.name}() stops the build") for name in names if not _is_made(package, name))
    elif command.name == "install" and words[:1] == ("TARGETS",) and not command.is_test:
        things = [name for install in cmake.installs if install.command is command for name in install.things]
        yield from ((name, "install() stops the build") for name in things if not _is_made(package, name))
    elif command.name in ("ament_export_targets", "ament_export_interfaces"):
        for name in _sets(package, command):
            yield name, "no install(TARGETS ... EXPORT) adds a target to it, and CMake stops"
    elif command.name == "catkin_package":
        names = command.after("LIBRARIES", *_KEYWORDS)
        yield from _exported(package, names)
        yield from _under_other_names(package, names)
    elif command.name == "ament_export_libraries":
        yield from _exported(package, words)
    elif command.name == "ament_export_dependencies":
        yield from _needed(package, words)


def _under_other_names(package: ProjectPackage, names: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Libraries of the package that are exported by their targets' *names*, and whose files are called otherwise."""
    targets = package.cmake.targets
    for target in (targets[name] for name in names if name in targets):
        if target.kind == "library" and target.output != target.name and not target.is_conditional:
            file = f"{target.prefix}{target.output}{target.suffix}"
            yield target.name, f"its file is {file}, but packages that use it search for {target.name}"


def _sets(package: ProjectPackage, command: CMakeCommand) -> Iterator[str]:
    """The sets of targets that *command* exports and that nothing is put into."""
    sets = {install.export for install in package.cmake.installs if install.kind == "TARGETS"}
    if any("$" in name for name in sets):
        return
    words = (
        command.arguments[: command.arguments.index("NAMESPACE")]
        if "NAMESPACE" in command.arguments
        else command.arguments
    )
    for name in words:
        if name != "HAS_LIBRARY_TARGET" and name not in sets and "$" not in name:
            if package.cmake.uses.get(name, frozenset()) <= {command.name}:
                yield name


def _dependencies(package: ProjectPackage, command: CMakeCommand) -> Iterator[Finding]:
    """What catkin_package() exports and that is not found, or that nobody who installs the package has."""
    kinds = ("depend", "exec_depend", "run_depend", "build_export_depend")
    there = {dependency.name for dependency in package.raw.dependencies if dependency.kind in kinds}
    for name in dict.fromkeys(command.after("CATKIN_DEPENDS", *_KEYWORDS)):
        if name not in there and "$" not in name and package.manifest is not None:
            tag = "exec_depend" if package.raw.format > 1 else "run_depend"
            fix = add_dependency(package, "exec_depend", name)
            yield Finding(
                at=command.location,
                message=f"catkin_package() exports {name}, which is not a <{tag}> of {package.name}: CMake stops; add the tag, or "
                "remove the name",
                about=(package.name, name),
                apart=(name,),
                fixes=(fix,) if fix is not None else (),
            )
    lost = [
        name
        for name in dict.fromkeys(command.after("DEPENDS", *_KEYWORDS))
        if not may_set_variables(package, name) and not is_found_by_others(package, name)
    ]
    if _PLACEHOLDER in lost:
        lost.remove(_PLACEHOLDER)
        yield Finding(
            at=command.location,
            message=f"catkin_package() exports {_PLACEHOLDER}, which catkin_create_pkg writes in the place of a name: there is no such library, and "
            "CMake warns of it in each build; remove the name",
            about=(package.name, _PLACEHOLDER),
            level=Level.NOTE,
        )
    if lost:
        yield Finding(
            at=command.location,
            message=f"catkin_package() exports {' and '.join(lost)} without a find_package() of it: packages that use "
            f"{package.name} get neither its headers nor its libraries; add find_package()",
            about=(package.name, "DEPENDS"),
            level=Level.WARNING,
        )


def _exported(package: ProjectPackage, words: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Exported libraries that are neither made here nor, by their names, those of the system."""
    tokens = {token for token in re.split(r"[_-]", package.name) if len(token) > 2}
    if package.commands(*_OUTSIDE):
        return
    own = {target.output for target in package.cmake.targets.values() if target.kind in ("library", "interface")}
    linked = {link.word for links in package.cmake.links.values() for link in links}
    for name in words:
        if name in _SETTINGS or _is_made(package, name):
            continue
        if name in own:
            continue
        if name not in linked and (name.startswith(package.name) or tokens & set(re.split(r"[_-]", name))):
            yield name, _NOT_FOUND


def _needed(package: ProjectPackage, words: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Exported dependencies that this package does not find itself, and that nobody knows."""
    project = package.project
    finds = package.commands("find_package", "pkg_check_modules", "find_library", "fetchcontent_declare")
    found = {word for find in finds for word in find.arguments}
    scripts = [path for path in project.workspace.names if path.endswith(".cmake")]
    for name in words:
        if name in found or "$" in name or project.package(name) is not None or not _is_written(package, name):
            continue
        known = project.knowledge.is_package(name) or project.knowledge.provider_of_cmake(name)
        if project.knowledge.is_package(name) is None or known or package.build.problems:
            continue
        if not any(path.endswith((f"Find{name}.cmake", f"{name}Config.cmake")) for path in scripts):
            yield name, "find_package() finds no package of this name, and packages that use it stop there"


def _is_made(package: ProjectPackage, name: str) -> bool:
    """Whether the target is there, or may be made by what is not known here."""
    cmake = package.cmake
    if name in cmake.targets or cmake.mentioners.get(name, frozenset()) - _NO_TARGETS or _GIVEN.fullmatch(name):
        return True
    return not _is_written(package, name)


def _is_written(package: ProjectPackage, name: str) -> bool:
    """Whether the name comes of the package's own text: as it stands, or with its project's name in it."""
    written = package.cmake.written
    return name in written or "${PROJECT_NAME}".join(name.split(package.name)) in written


#: Names that are compared with one that is not known.
MAX_NAMES = 300


def _is_slip_of_target(package: ProjectPackage, name: str) -> bool:
    return any(is_slip(name, target) for target in list(package.cmake.targets)[:MAX_NAMES])


def _finding(package: ProjectPackage, command: CMakeCommand, wrong: tuple[str, ...], what: str) -> Finding:
    """Of the names of one command that are *wrong*, of which several are exported libraries."""
    name = wrong[0]
    is_only_exported = name in package.cmake.targets or command.name == "ament_export_dependencies"
    message = (
        f"{package.name} exports {name}"
        if is_only_exported
        else f"{command.name}(): {listed(wrong)} {'is not a target' if len(wrong) == 1 else 'are not targets'} of {package.name}"
    )
    is_used = what != _NOT_FOUND or is_built_against(package)
    if what == _NOT_FOUND:
        what = (_NOT_FOUND if is_used else _NOT_FOUND_LATER).format("library" if len(wrong) == 1 else "libraries")
    level = Level.WARNING if command.name in _OF_USERS or not is_used else None  # this package builds
    has_headers = command.name != "catkin_package" or command.after("INCLUDE_DIRS", *_KEYWORDS)
    if not (is_used or has_headers or _candidates(package, command, name)):
        level = Level.NOTE  # there is nothing to build against
    hint = _hint(package, command, name) if len(wrong) == 1 else _hint_of_several(package, command, wrong)
    return Finding(
        at=command.location,
        message=f"{message}: {what}{hint}",
        about=(package.name, *wrong),
        apart=wrong,
        level=level,
    )


def _hint(package: ProjectPackage, command: CMakeCommand, name: str) -> str:
    """What to write instead of *name*."""
    if name in package.cmake.targets:
        return ""
    near = _near(package, command, name)
    if near and command.name == "ament_export_dependencies" and _squeezed(near) == _squeezed(name):
        return f"; write {near}, as find_package() has it here"
    names = _candidates(package, command, name)
    if _is_library(command, name) and not names and package.cmake.targets:
        where = "LIBRARIES" if command.name == "catkin_package" else f"{command.name}()"
        return f"; {where} takes libraries, and the package builds none: remove the name"
    if near:
        return f"; did you mean {near}?"
    return "; correct the name, or remove it" if command.name == "ament_export_dependencies" else _instead(names)


def _hint_of_several(package: ProjectPackage, command: CMakeCommand, wrong: tuple[str, ...]) -> str:
    """What to write instead of the libraries *wrong*: for each another one, or nothing."""
    near = [_near(package, command, name) for name in wrong]
    if all(near) and len(set(near)) == len(near):
        return f"; did you mean {listed(near)}?"
    names = [candidate for candidate in _candidates(package, command, wrong[0]) if candidate not in command.arguments]
    return f"{_instead(names)}: write the right ones, or remove the names" if names else "; remove the names"


def _is_library(command: CMakeCommand, name: str) -> bool:
    return command.name in _OF_LIBRARIES and name not in command.after("INCLUDE_DIRS", *_KEYWORDS)


def _candidates(package: ProjectPackage, command: CMakeCommand, name: str) -> list[str]:
    """What *name* may be meant for."""
    if command.name == "ament_export_dependencies":
        return sorted(
            {word for other_command in package.commands("find_package") for word in other_command.arguments[:1]}
        )
    names = sorted(package.cmake.targets)
    if _is_library(command, name):  # an executable is no library that others could link
        return [item for item in names if package.cmake.targets[item].kind != "executable"]
    return names


def _near(package: ProjectPackage, command: CMakeCommand, name: str) -> str:
    """The one that *name* is meant for; "" where none is like it."""
    names = _candidates(package, command, name)
    near = _by_squeezed(tuple(names)).get(_squeezed(name), [])
    if _is_library(command, name) and not near:
        near = _only_installed(package, names)
    near = near or get_close_matches(name[:100], names[:MAX_NAMES], 1, 0.75)
    return near[0] if near else ""


def _only_installed(package: ProjectPackage, libraries: list[str]) -> list[str]:
    """The one of *libraries* that the package installs; none where there are several, or what it installs is not known."""
    keywords = "ARCHIVE LIBRARY RUNTIME EXPORT DESTINATION PUBLIC_HEADER INCLUDES OBJECTS COMPONENT".split()
    words = {word for command in package.commands("install") for word in command.after("TARGETS", *keywords)}
    found = [name for name in libraries if name in words]
    return found if len(found) == 1 and not any("$" in word for word in words) else []


@lru_cache(maxsize=4)
def _by_squeezed(names: tuple[str, ...]) -> dict[str, list[str]]:
    """Those that differ in nothing else together, in their order: what is unknown in a package is looked up in the same names."""
    found: dict[str, list[str]] = {}
    for name in names:
        found.setdefault(_squeezed(name), []).append(name)
    return found


def _squeezed(name: str) -> str:
    """*name* without what names of CMake, ROS and file systems differ in: case, hyphens and underscores."""
    return name.replace("-", "").replace("_", "").lower()


def _instead(targets: list[str]) -> str:
    """What to write for a name that is like none of *targets*."""
    if not targets:
        return "; remove the name"
    more = f" and {len(targets) - 3} more" if len(targets) > 3 else ""
    return f"; the package builds {', '.join(targets[:3])}{more}"


CHECK = Check(
    id="unknown-target",
    summary="CMake target or library that the package does not build, or exported name without find_package().",
    level=Level.ERROR,
    catalogue="B09",
    tags=("build",),
    project=check,
)
