# SPDX-License-Identifier: Apache-2.0
"""What a package's CMake makes, links, installs and exports, read off the commands that were followed."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING

from haros_ci.model.build import CMakeCommand, Target
from haros_ci.model.unbuilt import is_whole
from haros_ci.records import dataclass

if TYPE_CHECKING:
    from haros_ci.checking.project import ProjectPackage

#: Commands that take the name of a target that has to be there, at first place.
OF_TARGETS = frozenset(
    (
        "target_link_libraries",
        "target_include_directories",
        "target_compile_definitions",
        "target_compile_options",
        "target_compile_features",
        "target_sources",
        "target_link_options",
        "target_precompile_headers",
        "ament_target_dependencies",
        "rosidl_target_interfaces",
        "add_dependencies",
        "set_target_properties",
        "rclcpp_components_register_node",
        "rclcpp_components_register_nodes",
    )
)
#: Commands that neither make, run nor install the targets that they name.
_QUIET = OF_TARGETS | {
    "add_executable",
    "add_library",
    "ament_auto_add_executable",
    "ament_auto_add_library",
    "install",
    "set_property",
    "get_property",
    "get_target_property",
    "catkin_package",
    "find_package",
    "project",
    "ament_export_libraries",
    "ament_export_targets",
    "ament_export_interfaces",
    "ament_export_dependencies",
    "ament_export_include_directories",
    "include_directories",
    "rosidl_get_typesupport_target",
    "ament_package",
    "message",
    "option",
}
#: Commands that are given the name of a target, or a word like it, and neither link nor order it.
_BESIDE = frozenset(
    (
        *("class_loader_hide_library_symbols", "catkin_install_python", "pluginlib_export_plugin_description_file"),
        *(
            "qt4_wrap_cpp",
            "qt5_wrap_cpp",
            "qt4_wrap_ui",
            "qt5_wrap_ui",
            "qt5_use_modules",
            "add_definitions",
            "configure_file",
        ),
        *("ament_environment_hooks", "ament_python_install_package", "target_precompile_headers"),
    )
)
_ARTEFACTS = ("ARCHIVE", "LIBRARY", "RUNTIME", "OBJECTS", "FRAMEWORK", "BUNDLE", "PUBLIC_HEADER", "PRIVATE_HEADER")
_SCOPES = ("PUBLIC", "PRIVATE", "INTERFACE", "LINK_PUBLIC", "LINK_PRIVATE", "LINK_INTERFACE_LIBRARIES")
_WORDS = ("debug", "optimized", "general", "SYSTEM", "BEFORE", "AFTER")
_ENDS = (
    *("DESTINATION", "EXPORT", "COMPONENT", "NAMELINK_COMPONENT", "RENAME", "TYPE", "PATTERN", "REGEX", "FILE_SET"),
    *("PERMISSIONS", "CONFIGURATIONS", "INCLUDES", "FILE_PERMISSIONS", "DIRECTORY_PERMISSIONS", "FILES_MATCHING"),
    *("OPTIONAL", "USE_SOURCE_PERMISSIONS", "MESSAGE_NEVER", "EXCLUDE", "EXCLUDE_FROM_ALL", "NAMELINK_SKIP"),
    *("NAMELINK_ONLY", "RESOURCE", *_ARTEFACTS),
)


@dataclass(frozen=True, slots=True)
class Link:
    """What a target is linked with, or depends on by ament_target_dependencies (then *is_package*)."""

    word: str
    is_public: bool
    is_package: bool
    is_conditional: bool


@dataclass(frozen=True, slots=True)
class Install:
    """One install(): *kind* as written, *things*, the destination by kind of artefact ("" for all), *export*."""

    kind: str
    things: tuple[str, ...]
    destinations: Mapping[str, str]
    export: str
    command: CMakeCommand

    @property
    def is_certain(self) -> bool:
        """Whether all that it installs is known."""
        return not any("${" in thing or "$<" in thing for thing in self.things)

    def place_of(self, target: Target) -> str | None:
        """The directory that *target* is built into; None where CMake does not set it."""
        artefact = "RUNTIME" if target.kind == "executable" else "LIBRARY"
        return self.destinations.get(artefact, self.destinations.get(""))


class CMake:
    """Targets are those of the model, by name; what a command or package outside the workspace may do is not known."""

    def __init__(self, package: ProjectPackage) -> None:
        self.package = package
        self.commands = package.build.commands
        self._words: dict[frozenset[str], tuple[frozenset[str], str]] = {}
        self.targets: Mapping[str, Target] = {target.name: target for target in package.build.targets}

    @cached_property
    def is_whole(self) -> bool:
        """Whether all files and commands that may make something were followed, to the command that ends a package's CMake."""
        return is_whole(self.package.build, self.package.raw)

    @cached_property
    def mentioned(self) -> frozenset[str]:
        """The words among the arguments of commands that may make, run or install a thing of that name."""
        return frozenset(self.mentioners)

    @cached_property
    def mentioners(self) -> Mapping[str, frozenset[str]]:
        """Every word of the commands, with the names of the commands that have it."""
        found: dict[str, set[str]] = {}
        for command in self.commands:
            if command.name not in _QUIET:
                for word in command.arguments:
                    found.setdefault(word, set()).add(command.name)
                    if "$<" in word or "/" in word or " " in word or ";" in word or "=" in word:
                        for part in re.findall(r"[\w.+-]+", word):
                            found.setdefault(part, set()).add(command.name)
        return {word: frozenset(names) for word, names in found.items()}

    def may_change(self, target: str) -> bool:
        """Whether a command that is not known here may link *target*, or order it: those that use its name otherwise do not."""
        return bool(self.mentioners.get(target, frozenset()) - _BESIDE)

    @cached_property
    def uses(self) -> Mapping[str, frozenset[str]]:
        """The names of the commands that each word is an argument of."""
        found: dict[str, set[str]] = {}
        for command in self.commands:
            for word in command.arguments:
                found.setdefault(word, set()).add(command.name)
        return {word: frozenset(names) for word, names in found.items()}

    def words(self, quiet: frozenset[str]) -> tuple[frozenset[str], str]:
        """The arguments of all commands but those named in *quiet*, and all of them as one text."""
        if quiet not in self._words:
            found = frozenset(word for word, names in self.uses.items() if not names <= quiet)
            self._words[quiet] = found, "\n".join(found)
        return self._words[quiet]

    @cached_property
    def written(self) -> frozenset[str]:
        """The words of the texts that its commands stand in, those that begin or go on with the project's name as they are."""
        texts = [self.package.project.text(path) for path in {command.location.path for command in self.commands}]
        return frozenset(word for text in texts for word in re.findall(r"(?:\$\{PROJECT_NAME\}|[\w.+-])+", text))

    @cached_property
    def installs(self) -> tuple[Install, ...]:
        return tuple(_install(command) for command in self.commands if command.name == "install" and command.arguments)

    @cached_property
    def installs_unknown(self) -> bool:
        """Whether an install() may install more than is known."""
        return any(
            not install.is_certain
            for install in self.installs
            if install.kind in ("TARGETS", "IMPORTED_RUNTIME_ARTIFACTS")
        )

    @cached_property
    def links(self) -> Mapping[str, tuple[Link, ...]]:
        """By target: what target_link_libraries and ament_target_dependencies say, and link_libraries before the target is made."""
        found: dict[str, list[Link]] = {}
        for_all: list[tuple[str, Link]] = []  # with the directory that it holds for, and those below
        places = {target.location: target.name for target in self.targets.values()} if self._links_all else {}
        for command in self.commands:
            if command.name == "link_libraries":
                words = (word for word in command.arguments if word not in _WORDS)
                for_all += [(command.directory, Link(word, True, False, command.is_conditional)) for word in words]
            elif for_all and (name := places.get(command.location)) is not None:
                holding = (
                    link
                    for folder, link in for_all
                    if folder in ("", ".") or f"{command.directory}/".startswith(f"{folder}/")
                )
                found.setdefault(name, []).extend(holding)
            if command.name in ("target_link_libraries", "ament_target_dependencies") and command.arguments:
                is_package = command.name == "ament_target_dependencies"
                scope = "PUBLIC"
                for word in command.arguments[1:]:
                    if word in _SCOPES:
                        scope = word
                    elif word not in _WORDS:
                        link = Link(word, "PRIVATE" not in scope, is_package, command.is_conditional)
                        found.setdefault(self.real(command.arguments[0]), []).append(link)
        return {name: tuple(links) for name, links in found.items()}

    @property
    def _links_all(self) -> bool:
        return any(command.name == "link_libraries" for command in self.commands)

    def real(self, name: str) -> str:
        """The name of the target that *name*, perhaps an alias, stands for."""
        target = self.targets.get(name)
        return target.links[0] if target is not None and target.kind == "alias" and target.links else name

    @cached_property
    def by_output(self) -> Mapping[str, Target]:
        """The targets by the names of the libraries that they are on Linux, without their suffix."""
        return {f"{target.prefix or 'lib'}{target.output}": target for target in self.targets.values()}

    def linked(self, name: str) -> Iterator[Target]:
        """The package's own targets that *name* is linked with, directly or through others, each once."""
        seen, todo = {name}, [name]
        while todo:
            target = self.targets.get(todo.pop())
            words = [link.word for link in self.links.get(target.name, ())] if target is not None else []
            for word in (*words, *(target.links if target is not None else ())):
                other = self.real(word.removeprefix(f"{self.package.name}::"))
                if other in self.targets and other not in seen:
                    seen.add(other)
                    todo.append(other)
                    yield self.targets[other]

    def awaited(self, name: str) -> frozenset[str]:
        """The targets that are made before *name*, by add_dependencies of it and of what it is linked with."""
        names = {name, *(target.name for target in self.linked(name))}
        found: set[str] = set()
        todo = list(names)
        while todo:
            item = todo.pop()
            for command in self._dependencies.get(item, ()):
                todo += [word for word in command.arguments[1:] if word in self._dependencies and word not in found]
                found.update(command.arguments[1:])
        return frozenset(found)

    @cached_property
    def _dependencies(self) -> Mapping[str, list[CMakeCommand]]:
        found: dict[str, list[CMakeCommand]] = {}
        for command in self.commands:
            if command.name == "add_dependencies" and command.arguments:
                found.setdefault(self.real(command.arguments[0]), []).append(command)
        return found

    def include_words(self, target: Target) -> tuple[str, ...]:
        """The include directories of *target* and of its own libraries, and those of the directory that makes it."""
        names = {target.name, *(other_target.name for other_target in self.linked(target.name))}
        folder = posixpath.dirname(target.location.path)
        found: list[str] = []
        for command in self.commands:
            if command.name == "target_include_directories" and self.real(command.arguments[0]) in names:
                found += command.arguments[1:]
            elif command.name == "include_directories":
                if command.directory in (".", folder) or f"{folder}/".startswith(f"{command.directory}/"):
                    found += command.arguments
        return tuple(found)

    def destinations(self, name: str) -> tuple[str, ...]:
        """The directories that install(TARGETS) puts a target into."""
        target = self.targets.get(name)
        found = (install.place_of(target) for install in self.installs if target is not None and name in install.things)
        return tuple(place for place in found if place is not None)

    def is_shared(self, target: Target) -> bool | None:
        """Whether a library is one that is loaded when a program starts; None where only a build knows (add_library(7))."""
        if target.kind != "library":
            return False
        for command in self.commands:
            if command.name.endswith("add_library") and command.arguments[:1] == (target.name,):
                kinds = set(command.arguments[1:]) & {"SHARED", "MODULE", "STATIC"}
                if kinds:
                    return "STATIC" not in kinds
        if self.package.ros == 1:  # catkin's all.cmake
            return None if self._sets_shared else True
        return True if self._finds("ament_cmake_ros") and not self._sets_shared else None

    @cached_property
    def _sets_shared(self) -> bool:
        texts = {command.location.path for command in self.commands}
        return any("BUILD_SHARED_LIBS" in self.package.project.text(path) for path in texts)

    def _finds(self, name: str) -> bool:
        return any(command.arguments[:1] == (name,) for command in self.package.commands("find_package"))


def _install(command: CMakeCommand) -> Install:
    kind, rest = command.arguments[0], command.arguments[1:]
    stop = next((at for at, word in enumerate(rest) if word in _ENDS), len(rest))
    destinations: dict[str, str] = {}
    artefact, export = "", ""
    for word, following in zip(rest[stop:], (*rest[stop + 1 :], "")):
        if word in _ARTEFACTS:
            artefact = word
        elif word == "DESTINATION":
            destinations.setdefault(artefact, re.sub("/{2,}", "/", following).rstrip("/"))
        elif word == "EXPORT":
            export = following
    return Install(kind, rest[:stop], destinations, export, command)
