# SPDX-License-Identifier: Apache-2.0
"""Components that CMake registers under a class that its library does not register, and the other way round."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, ProjectPackage
from haros_ci.api.packages import PluginClass, Target, is_written

_MACRO = "RCLCPP_COMPONENTS_REGISTER_NODE"
_FACTORY = "rclcpp_components::NodeFactory"
_COMMANDS = ("rclcpp_components_register_node", "rclcpp_components_register_nodes")
_SOURCES = (".cpp", ".cc", ".cxx", ".c++", ".C")
#: Where a class is registered in code: its name as written, which is the name it gets.
Registered = dict[str, Location]


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        components = [plugin for plugin in package.build.plugins if plugin.base == _FACTORY]
        if not components and not package.commands(*_COMMANDS):
            continue
        targets = {target.name: target for target in package.build.targets}
        everywhere = _found([file.path for file in package.files if file.language == "cpp"], project)
        wrong: set[str] = set()
        registered: dict[str, Registered | None] = {}
        for component in components:
            target = targets.get(component.library)
            if target is None or not _is_known(target, package):
                continue
            if target.name not in registered:
                registered[target.name] = _registered(_sources(target, targets), project)
            here = registered[target.name]
            other = everywhere.get(component.type)
            if other is not None and not other.path.endswith(_SOURCES):
                continue  # a header, which one of its sources may include
            if (
                here is not None
                and component.type not in here
                and not is_written(component.type, (_MACRO,), target.sources, project)
            ):
                wrong.add(target.name)
                yield _missing(component, target, package, here, everywhere)
        yield from _unnamed(
            package, [component for component in components if component.library not in wrong], targets, project
        )


def _missing(
    plugin: PluginClass, target: Target, package: ProjectPackage, here: Registered, everywhere: Registered
) -> Finding:
    """The class that CMake names is not one that the library registers."""
    related: tuple[tuple[Location, str], ...] = ()
    last = plugin.type.rpartition("::")[2]
    alike = [name for name in here if name.endswith(last) and name.rpartition("::")[2] == last] or (
        list(here) if len(here) == 1 else []
    )
    if plugin.type in everywhere:
        where = everywhere[plugin.type]
        hint = f"{where.path} registers it, but is not among the library's sources: add the file to the sources"
        related = ((where, f"{plugin.type} is registered here"),)
    elif alike:
        hint = f"the library registers {alike[0]}: write the same name in both places"
        related = ((here[alike[0]], f"{alike[0]} is registered here"),)
    elif here:
        hint = f"the library registers {', '.join(sorted(here)[:3])}"
    else:
        hint = f"add {_MACRO}({plugin.type}) to one of its sources"
    return Finding(
        at=plugin.location,
        message=f"component {plugin.type} cannot be loaded: library {target.name} does not register it; {hint}",
        about=(package.name, plugin.type),
        related=related,
        apart=(plugin.type,),
    )


def _unnamed(
    package: ProjectPackage, components: list[PluginClass], targets: dict[str, Target], project: Project
) -> Iterator[Finding]:
    """What code registers and CMake does not: containers look components up in what CMake writes."""
    if any("$" in word for command in package.commands(*_COMMANDS) for word in command.arguments):
        return
    named = {component.type for component in components}
    libraries = {component.library for component in components}
    for target in targets.values():
        if target.name in libraries and not target.is_test and not target.is_conditional:
            for name, where in (_registered(list(target.sources), project) or {}).items():
                if name not in named and where.path not in target.conditional_sources:
                    yield Finding(
                        at=where,
                        message=f"component {name} is registered here in the code, but CMake calls no {_COMMANDS[0]}() for it in package "
                        f"{package.name}: component containers do not find it; add the call",
                        about=(package.name, name),
                        level=Level.WARNING,
                    )


def _is_known(target: Target, package: ProjectPackage) -> bool:
    """Whether all its sources are."""
    return bool(target.sources) and not any(
        problem.message.startswith(f"{target.name}:") for problem in package.build.problems
    )


def _sources(target: Target, targets: dict[str, Target]) -> list[str]:
    """Its own and those of libraries that become part of it."""
    found = list(target.sources)
    for link in target.links:
        other = targets.get(link)
        if other is not None:
            found += other.sources
    return found


def _registered(paths: list[str], project: Project) -> Registered | None:
    """The classes that files register; None if one of them does so in a way that is not seen through."""
    for path in paths:
        program = project.programs.get(path)
        if program is None or any(_MACRO in body for _, _, body in program.macros) or program.problems:
            return None
        if any("REGISTER" in macro and macro != _MACRO and "POINT" not in macro for macro, *_ in program.registered):
            return None
    return _found(paths, project)


def _found(paths: list[str], project: Project) -> Registered:
    """The classes that files register by the macro."""
    found: Registered = {}
    for path in paths:
        program = project.programs.get(path)
        for macro, arguments, line, column in program.registered if program is not None else ():
            if macro == _MACRO and len(arguments) == 1:
                found.setdefault(arguments[0].strip(), Location(path, line, column))
    return found


CHECK = Check(
    id="component-not-registered",
    summary="Component registered in CMake but not in the library's code, or the reverse.",
    level=Level.ERROR,
    catalogue="B11",
    tags=("build", "components"),
    project=check,
)
