# SPDX-License-Identifier: Apache-2.0
"""Targets, libraries and sets of them that CMake installs, links or exports, and that the package does not make."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, ProjectPackage, listed, regex
from haros_ci.api.packages import (
    OF_TARGETS,
    CMakeCommand,
    add_dependency,
    is_built_against,
    is_found_by_others,
    may_have_more,
    may_set_variables,
)
from haros_ci.api.targets import KEYWORDS_OF_CATKIN, is_slip_of_target, meant_targets, target_hint

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
        "catkin_install_python",  # its destination ends with the name of the package
    )
)
#: Commands that name targets and sets of them of the whole build.
_OF_BUILD = OF_TARGETS | {"install", "ament_export_targets", "ament_export_interfaces"}
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
            exported: dict[bool, list[str]] = {False: [], True: []}
            for name, what in _unknown(package, command, is_open):
                if name not in reported:
                    reported.add(name)
                    if what == _NOT_FOUND:
                        exported[name in package.cmake.targets].append(name)
                    else:
                        yield _finding(package, command, (name,), what)
            for names in filter(None, exported.values()):
                yield _finding(package, command, tuple(names), _NOT_FOUND)
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
        if not (is_open and command.name in _OF_BUILD) or is_slip_of_target(package, name):
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
        names = command.after("LIBRARIES", *KEYWORDS_OF_CATKIN)
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
    for name in dict.fromkeys(command.after("CATKIN_DEPENDS", *KEYWORDS_OF_CATKIN)):
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
        for name in dict.fromkeys(command.after("DEPENDS", *KEYWORDS_OF_CATKIN))
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
    """Exported libraries that are neither made here nor, by their names, those of the system, and programs among them."""
    tokens = {token for token in re.split(r"[_-]", package.name) if len(token) > 2}
    if package.commands(*_OUTSIDE):
        return
    own = {target.output for target in package.cmake.targets.values() if target.kind in ("library", "interface")}
    linked = {link.word for links in package.cmake.links.values() for link in links}
    for name in words:
        if _is_program(package, name) and name not in own | linked:
            yield name, _NOT_FOUND
        if name in _SETTINGS or _is_made(package, name):
            continue
        if name in own:
            continue
        if name not in linked and (name.startswith(package.name) or tokens & set(re.split(r"[_-]", name))):
            yield name, _NOT_FOUND


def _is_program(package: ProjectPackage, name: str) -> bool:
    """Whether the package builds a program of that name in every build, which nothing can be linked with (``ENABLE_EXPORTS`` of cmake-properties(7))."""
    target = package.cmake.targets.get(name)
    if target is None or target.kind != "executable" or target.is_conditional or package.cmake.may_change(name):
        return False
    return package.cmake.written.isdisjoint(("ENABLE_EXPORTS", "CMAKE_ENABLE_EXPORTS"))


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


def _finding(package: ProjectPackage, command: CMakeCommand, wrong: tuple[str, ...], what: str) -> Finding:
    """Of the names of one command that are *wrong*, of which several are exported libraries."""
    name = wrong[0]
    if what == _NOT_FOUND and name in package.cmake.targets:
        kind = "is a program" if len(wrong) == 1 else "are programs"
        message = f"{command.name}(): {listed(wrong)} {kind} of {package.name}, and no {'library' if len(wrong) == 1 else 'libraries'}"
    elif name in package.cmake.targets or command.name == "ament_export_dependencies":
        message = f"{package.name} exports {name}"
    else:
        kind = "is not a target" if len(wrong) == 1 else "are not targets"
        message = f"{command.name}(): {listed(wrong)} {kind} of {package.name}"
    is_used = what != _NOT_FOUND or is_built_against(package)
    if what == _NOT_FOUND:
        what = (_NOT_FOUND if is_used else _NOT_FOUND_LATER).format("library" if len(wrong) == 1 else "libraries")
    level = Level.WARNING if command.name in _OF_USERS or not is_used else None  # this package builds
    has_headers = command.name != "catkin_package" or command.after("INCLUDE_DIRS", *KEYWORDS_OF_CATKIN)
    is_program = name in package.cmake.targets
    if not is_used and (is_program or not (has_headers or meant_targets(package, command, name))):
        level = Level.NOTE  # there is nothing to build against
    hint = target_hint(package, command, wrong)
    return Finding(
        at=command.location,
        message=f"{message}: {what}{hint}",
        about=(package.name, *wrong),
        apart=wrong,
        level=level,
    )


CHECK = Check(
    id="unknown-target",
    summary="CMake target or library that the package does not build, or exported name without find_package().",
    level=Level.ERROR,
    catalogue="B09",
    tags=("build",),
    project=check,
)
