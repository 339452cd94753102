# SPDX-License-Identifier: Apache-2.0
"""Plug-ins of pluginlib: which classes code registers, under which packages descriptions are exported, who loads which."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable
from functools import lru_cache

from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.model.build import Target
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.syntax import Program

#: Macros that register a class with its base, both by the text of the argument (class_loader, register_macro.hpp).
MACROS = ("PLUGINLIB_EXPORT_CLASS", "CLASS_LOADER_REGISTER_CLASS", "PLUGINLIB_REGISTER_CLASS")
#: What registers nodes of BehaviorTree.CPP, which loads their libraries by itself.
_OF_TREES = "BT_REGISTER_NODES"
#: The old one: package, name, class, base.
DECLARE = "PLUGINLIB_DECLARE_CLASS"
_EXPORT = "pluginlib_export_plugin_description_file"
#: What a user asks for a plug-in in: code, parameters, launch files, robots.
_ASKING = (".cpp", ".cc", ".cxx", ".hpp", ".h", ".py", ".yaml", ".yml", ".launch", ".xml", ".xacro", ".urdf", ".json")
_LOADER = regex(r'[({]\s*"([a-z]\w*)"\s*,\s*"(\w+(?:::\w+)+)"\s*[,)}]')
#: Commands that say how a target is compiled.
_DEFINING = ("target_compile_definitions", "target_compile_options", "set_target_properties", "set_property")


@dataclass(frozen=True, slots=True)
class Registration:
    """A macro that registers class *type* as a *base*, as written."""

    type: str
    base: str
    macro: str
    location: Location


def registrations(package: ProjectPackage) -> tuple[Registration, ...]:
    """What the C++ files of *package* register."""
    found = []
    for file in package.files:
        program = package.project.programs.get(file.path)
        for macro, arguments, line, column in program.registered if program is not None else ():
            words = [argument.strip() for argument in arguments]
            if macro == DECLARE and len(words) == 4:
                words = words[2:]
            if (macro in MACROS or macro == DECLARE) and len(words) == 2:
                found.append(Registration(words[0], words[1], macro, Location(file.path, line, column)))
    return tuple(found)


def registers_otherwise(package: ProjectPackage, paths: Iterable[str]) -> bool:
    """Whether files register classes in a way that is not seen through: by macros of their own, or in what was not read."""
    for path in paths:
        program = package.project.programs.get(path)
        if program is None or program.problems:
            return True
        if any(word in body for _, _, body in program.macros for word in (*MACROS, DECLARE)):
            return True
        if _OF_TREES in package.project.text(path):
            return True
        if any(_is_unknown(macro, len(arguments)) for macro, arguments, _, _ in program.registered):
            return True
    return False


def _is_unknown(macro: str, count: int) -> bool:
    if macro in MACROS or macro == DECLARE:
        return count != (4 if macro == DECLARE else 2)
    return any(word in macro for word in ("PLUGIN", "EXPORT", "REGISTER")) and not macro.startswith(
        ("POINT_CLOUD", "RCLCPP_COMPONENTS", "BENCHMARK", "REGISTER_TYPED", "GZ_", "IGNITION_", "GZ_ADD")
    )


def may_be_base(written: str, described: str) -> bool:
    """Whether two names may mean one base class: a name may be shortened where it is written in code, and be an alias."""
    one, other = (name.replace(" ", "").removeprefix("::") for name in (written, described))
    return one == other or "::" not in one or one.rpartition("::")[2] == other.rpartition("::")[2]


def is_tree_node(base: str, exports: Iterable[str]) -> bool:
    """Whether a described class is a node of BehaviorTree.CPP, by its *base*, or the packages that its description is exported to.

    BehaviorTree.CPP loads the library of a node by its own macro; pluginlib has no part in it, whatever describes the class.
    """
    return base.removeprefix("::").startswith("BT::") or all(name.startswith("behaviortree_cpp") for name in exports)


def exported_under(package: ProjectPackage) -> dict[str, dict[str, Location]]:
    """The root-relative plug-in descriptions that *package* exports, each with the packages that it exports them to.

    ROS 1 and Python packages do so in the manifest (``<nav_core plugin="${prefix}/x.xml"/>``), ament_cmake by
    pluginlib_export_plugin_description_file.
    """
    found: dict[str, dict[str, Location]] = {}
    for command in package.commands(_EXPORT):
        place = command.place(command.arguments[1]) if len(command.arguments) > 1 else None
        if place is not None:
            found.setdefault(place, {}).setdefault(command.arguments[0], command.location)
    root = package.manifest
    if root is None or (package.ros == 2 and package.raw.build_type != "ament_python"):
        return found
    for export in root.all("export"):
        for tag in export.children:
            word = tag.attributes.get("plugin", "").strip()
            if word:
                relative = word.replace("${prefix}/", "").replace("${prefix}", ".")
                place = posixpath.normpath(posixpath.join(package.path, relative))
                found.setdefault(place, {}).setdefault(tag.tag, Location(package.manifest_path, tag.line))
    return found


def loaders(project: Project) -> dict[str, dict[str, Location]]:
    """For each base class the packages under which code of the workspace looks for its plug-ins.

    ``pluginlib::ClassLoader<Base> loader("package", "Base")``, also through std::make_unique and in initialisers.
    """
    found: dict[str, dict[str, Location]] = {}
    for package in project.packages:
        if "pluginlib" not in package.declared:
            continue
        for file in package.files:
            text = project.text(file.path) if file.language == "cpp" else ""
            for match in _LOADER.finditer(text):
                line = text.count("\n", 0, match.start(1)) + 1
                found.setdefault(match[2], {}).setdefault(match[1], Location(file.path, line))
    return found


def is_written(name: str, macros: Iterable[str], paths: Iterable[str], project: Project) -> bool:
    """Whether the text of a file has one of *macros* with *name*, outside of line comments: where it was not read as such."""
    macros_ = tuple(macros)
    return any(name in _written(project.text(path), macros_) for path in paths)


@lru_cache(maxsize=512)
def _written(text: str, macros: tuple[str, ...]) -> frozenset[str]:
    """What stands first between the parentheses of the macros, up to each comma."""
    pattern = re.compile(rf"\b(?:{'|'.join(macros)})[ \t]*\(\s*([^()\n]{{1,500}})")
    found: set[str] = set()
    for match in pattern.finditer(text):
        if "/" not in text[text.rfind("\n", 0, match.start()) + 1 : match.start()]:
            parts = match[1].split(",")[:8]
            found.update(",".join(parts[:count]).strip() for count in range(1, len(parts) + 1))
    return frozenset(found)


def is_asked_for(names: Iterable[str], project: Project) -> bool:
    """Whether a file that is no description of plug-ins has one of *names*."""
    sought = tuple(names)
    word = re.compile(rf"(?<![\w/:])(?:{'|'.join(map(re.escape, sought))})(?![\w/:])")
    descriptions = {path for package in project.packages for path in exported_under(package)}
    paths = (path for path in project.workspace.names if path.endswith(_ASKING) and path not in descriptions)
    texts = (project.text(path) for path in paths)
    return any(word.search(text) for text in texts if any(name in text for name in sought))


def class_names(programs: Iterable[Program | None]) -> set[str]:
    """The last parts of the names of all classes and aliases in C++."""
    found: set[str] = set()
    for program in programs:
        if program is not None and program.language == "cpp":
            names = (*(class_.name for class_ in program.classes), *(alias.name for alias in program.aliases))
            found.update(name.rpartition("::")[2] for name in names)
    return found


def file_name(target: Target) -> str:
    """The name of the library's file, without its ending."""
    return f"{target.prefix}{target.output}"


def own_classes(package: ProjectPackage) -> set[str]:
    """The full names of the package's classes; none where macros may make more, or a file was not read whole."""
    names: set[str] = set()
    for file in package.files:
        program = package.project.programs.get(file.path)
        if program is None or file.language != "cpp":
            continue
        if program.problems or any("class" in body or "struct" in body for _, _, body in program.macros):
            return set()
        names.update(class_.name for class_ in program.classes)
    return names


def compiled_into(library: Target, package: ProjectPackage) -> list[str]:
    """The sources of a *library* of *package* and of those that become part of it."""
    targets = {target.name: target for target in package.build.targets}
    inner = [targets[link] for link in library.links if link in targets]
    return [path for target in (library, *inner) for path in target.sources if not path.endswith(".c")]


def variant(package: ProjectPackage, library: Target) -> tuple[frozenset[str], frozenset[str]]:
    """What makes *library* another one than a second of the same source: its definitions, and the other targets of the package in it."""
    defined: set[str] = set()
    for command in package.commands(*_DEFINING):
        words = command.arguments
        is_meant = "COMPILE" in "".join(words) or command.name.startswith("target_")
        if library.name in words and is_meant:
            defined.update(word for word in words if word != library.name)
    own = {target.name for target in package.build.targets if not set(target.sources) & set(library.sources)}
    return frozenset(defined), frozenset(own.intersection(library.links))
