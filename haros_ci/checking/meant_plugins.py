# SPDX-License-Identifier: Apache-2.0
"""Plug-in descriptions that name a class which nothing registers, where another class is registered that no description names."""

from __future__ import annotations

import posixpath
from collections.abc import Iterable, Iterator, Mapping

from haros_ci.checking.plugins import (
    MACROS,
    Registration,
    class_names,
    compiled_into,
    exported_under,
    file_name,
    is_tree_node,
    is_written,
    may_be_base,
    registers_otherwise,
    registrations,
)
from haros_ci.checking.project import ProjectPackage
from haros_ci.model.build import PluginClass, Target

_COMPONENT = "rclcpp_components::NodeFactory"


def described_classes(package: ProjectPackage, exports: Mapping[str, Iterable[str]]) -> Iterator[PluginClass]:
    """The classes of the descriptions that *package* exports, without components and nodes of behaviour trees."""
    for plugin in package.build.plugins:
        path = plugin.location.path
        if plugin.base != _COMPONENT and path in exports and not is_tree_node(plugin.base, exports[path]):
            yield plugin


def library_of(plugin: PluginClass, libraries: Mapping[str, Target], ros: int | None) -> Target | None:
    """The one of the *libraries* (by the names of their files) that the description names.

    ROS 2 tries the name with and without ``lib`` before it, ROS 1 takes it as it is (pluginlib's class_loader_imp.hpp); both look
    for the last part of a path, too.
    """
    name = posixpath.basename(plugin.library).removesuffix(".so")
    names = [name]
    if ros != 1:
        names.append(name.removeprefix("lib") if name.startswith("lib") else f"lib{name}")
    return next((libraries[name] for name in names if name in libraries), None)


def is_seen_through(library: Target, package: ProjectPackage) -> bool:
    """Whether all that *library* registers is known: its sources are, and no macro of its own registers more."""
    is_whole = bool(library.sources) and not any(
        problem.message.startswith(f"{library.name}:") for problem in package.build.problems
    )
    return is_whole and not registers_otherwise(package, compiled_into(library, package))


def meant_classes(package: ProjectPackage) -> Mapping[PluginClass, Registration]:
    """The described classes that nothing registers, and that the package does not have, each with the one that is registered in its place.

    That is a class of the same base in the same library that no description names, if there is one such description and one such class.
    """
    exports = exported_under(package)
    described = list(described_classes(package, exports))
    own = registrations(package)
    registered, names = {macro.type for macro in own}, {plugin.type for plugin in described}
    lost = [plugin for plugin in described if plugin.type not in registered and "." not in plugin.type]
    free = [macro for macro in own if macro.type not in names and macro.macro.startswith("PLUGINLIB_")]
    if not lost or not free:
        return {}
    there = class_names(package.project.programs.get(file.path) for file in package.files)
    libraries = {file_name(target): target for target in package.build.targets if target.kind == "library"}
    alone: dict[tuple[str, str], list[PluginClass]] = {}
    for plugin in lost:
        library = library_of(plugin, libraries, package.ros)
        if library is not None and _last(plugin.type) not in there:
            alone.setdefault((file_name(library), plugin.base), []).append(plugin)
    found = {}
    for (name, base), plugins in alone.items():
        sources = compiled_into(libraries[name], package)
        macros = [macro for macro in free if macro.location.path in sources and may_be_base(macro.base, base)]
        if len(plugins) == len(macros) == 1 and is_seen_through(libraries[name], package):
            if not is_written(plugins[0].type, MACROS, sources, package.project):
                found[plugins[0]] = macros[0]
    return found


def _last(name: str) -> str:
    return name.rpartition("::")[2].strip()
