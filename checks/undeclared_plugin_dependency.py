# SPDX-License-Identifier: Apache-2.0
"""Packages of plug-ins that parameters name, and that the package of the parameters does not depend on."""

from __future__ import annotations

import re
from collections.abc import Container, Iterator, Mapping
from functools import partial

from haros_ci.api import Check, Finding, Level, Location, Project, System, dataclass, listed, regex, spelled_out
from haros_ci.api.launch import FileUse, PackageUse, ParameterFileUse, owner
from haros_ci.api.packages import (
    Package,
    PluginUse,
    Reason,
    asks_what_is_installed,
    brought_by,
    closes_a_cycle,
    dependency_place,
    dependency_tag,
    is_aside,
    is_left_out,
    is_of_node,
    is_to_be_had,
    may_load,
    plugins_in_parameters,
    plugins_in_yaml,
    proposed_before,
    provided,
    said_gone,
    used_by_launch_files,
)

#: Descriptions that only say how to talk to a controller, and plug-ins of tools with a window.
_OTHER = regex(r"moveit_ros_control_interface::ControllerHandleAllocator|(?:rviz\w*|rqt\w*|qt_gui\w*|moveit_setup)::.*")
#: So many places of one package are related.
_SHOWN = 3
#: Files of parameters for tests: who installs the package does not load them.
_OF_TESTS = regex(r"(?:^|/)(?:tests?_[^/]*|[^/]*_tests?(?:_[^/]*)?\.\w+)$", re.IGNORECASE)
_ASIDE = regex(r"(?:^|/)(?:tests?|examples?|doc|docs)/")


@dataclass(frozen=True, slots=True)
class _Named:
    """A plug-in that is named in a parameter, and the launch files that read it there."""

    plugin: PluginUse
    launches: tuple[Location, ...]


def check(project: Project) -> Iterator[Finding]:
    system = next(iter(project.systems), None)
    if system is None:
        return
    exported = {
        name: package.name
        for package in reversed(project.packages)
        for plugin in package.build.plugins
        for name in (plugin.name, plugin.type)
    }
    uses, proposed = _used(project), dict(proposed_before(Reason.PLUGIN, project))
    got: dict[str, tuple[frozenset[str], bool]] = {}
    groups: dict[tuple[str, Level], tuple[Package, dict[str, list[PluginUse]]]] = {}
    for named in _named(project):
        place = named.plugin.location
        package = owner(system, place)
        if package is None or _ASIDE.search(place.path):
            continue
        needed = _package_of(named.plugin, package.ros, project, exported)
        if needed is None or not is_to_be_had(needed, package.ros, system):
            continue
        if needed == package.name or needed in uses.get(package.name, ()):
            continue  # a package that a launch file uses is of undeclared-launch-dependency
        use = _use(needed, place)
        if any(needed in found for found, _ in _got(package, named, uses, system, got)):
            continue
        if is_left_out(package, use, system) or closes_a_cycle(package.name, needed, system.packages, proposed):
            continue
        proposed[package.name] = proposed.get(package.name, frozenset()) | {needed}
        aside = _is_aside(use, system) or all(_is_aside(_use(needed, launch), system) for launch in named.launches)
        level = Level.WARNING if got[package.name][1] and not aside else Level.NOTE
        groups.setdefault((package.name, level), (package, {}))[1].setdefault(needed, []).append(named.plugin)
    yield from (_finding(package, lacking, level) for (_, level), (package, lacking) in groups.items())


def _is_aside(use: PackageUse, system: System) -> bool:
    return (
        _OF_TESTS.search(use.location.path) is not None
        or is_aside(use, system)
        or asks_what_is_installed(use.location.path, system)
    )


def _use(needed: str, place: Location) -> PackageUse:
    return PackageUse(location=place, kind="plugin", package=needed, is_here=False)


def _finding(package: Package, lacking: Mapping[str, list[PluginUse]], level: Level) -> Finding:
    """One for a manifest: *lacking* are the packages that it does not declare, with the places that name their plug-ins."""
    tag = "exec_depend" if package.format > 1 else "run_depend"
    named = listed([f"{plugins[0].name} of {name}" for name, plugins in lacking.items()])
    one = len(lacking) == 1
    return Finding(
        at=dependency_place(package),
        message=f"parameters of {package.name} name the plug-in{'' if one else 's'} {named}, but package.xml does not declare "
        f"{'this package' if one else 'these packages'}: on a machine without {'it' if one else 'them'} the node cannot load the "
        f"plug-in; add {spelled_out([dependency_tag(tag, name, package) for name in lacking])}{said_gone(lacking, package.ros)}",
        about=(package.name, *lacking),
        related=tuple(
            (plugin.location, f"needs {name}") for name, plugins in lacking.items() for plugin in plugins[:_SHOWN]
        ),
        apart=tuple(lacking),
        level=level,
    )


def _files(project: Project) -> dict[str, dict[Location, None]]:
    """The YAML files that launch files name, and where."""
    files: dict[str, dict[Location, None]] = {}
    for system in project.systems:
        uses = [(use.path, use.location) for use in system.facts(FileUse)]
        uses += [(use.path, use.location) for use in system.facts(ParameterFileUse)]
        for path, at in uses:
            if path is not None and path.endswith((".yaml", ".yml")) and not _ASIDE.search(at.path):
                files.setdefault(path, {})[at] = None
    return files


def _named(project: Project) -> Iterator[_Named]:
    """The plug-ins of the YAML files that launch files name, and those that launch files set in parameters."""
    files = _files(project)
    plugins = {path: list(plugins_in_yaml(path, project.text(path))) for path in sorted(files)}
    unread = _unread(
        project, {(path, plugin_use.location.line or 0) for path, found in plugins.items() for plugin_use in found}
    )
    for path, found in plugins.items():
        for plugin in found:
            if (path, plugin.location.line or 0) not in unread:
                yield _Named(plugin, tuple(files[path]))
    for plugin in plugins_in_parameters(project.systems, partial(may_load, project)):
        yield _Named(plugin, (plugin.location,))


def _unread(project: Project, lines: Container[tuple[str, int]]) -> frozenset[tuple[str, int]]:
    """Those of the *lines* of YAML files whose parameters only nodes get that load no plug-ins by them."""
    read: dict[tuple[str, int], bool] = {}
    for system in project.systems:
        for parameter in system.parameters:
            place = (parameter.origin.path, parameter.origin.line or 0) if parameter.origin is not None else ("", 0)
            if place in lines and isinstance(parameter.value, str) and not read.get(place, False):
                key = parameter.name.replace("/", ".").rpartition(".")[2]
                read[place] = not is_of_node(system, parameter) or may_load(project, system, parameter, key)
    return frozenset(place for place, is_read in read.items() if not is_read)


def _used(project: Project) -> Mapping[str, frozenset[str]]:
    """By package what the launch files of all systems use."""
    found: dict[str, frozenset[str]] = {}
    for system in project.systems:
        for name, names in used_by_launch_files(system).items():
            found[name] = found.get(name, frozenset()) | names
    return found


def _got(
    package: Package,
    named: _Named,
    uses: Mapping[str, frozenset[str]],
    system: System,
    got: dict[str, tuple[frozenset[str], bool]],
) -> list[tuple[frozenset[str], bool]]:
    """What *package* gets, the packages whose launch files read the parameter, and those whose nodes these start."""
    packages = {
        other_package.name: other_package
        for place in named.launches
        if (other_package := owner(system, place)) is not None
    }
    packages[package.name] = package
    found = []
    for other_package in packages.values():
        if other_package.name not in got:
            names, is_whole = provided(other_package, system)
            further, is_all = brought_by(uses.get(other_package.name, ()), other_package.ros, system)
            got[other_package.name] = names | further, is_whole and is_all
        found.append(got[other_package.name])
    return found


def _package_of(plugin: PluginUse, ros: int | None, project: Project, exported: Mapping[str, str]) -> str | None:
    """The package that surely exports *plugin*; None where that is not known, or several do.

    By what the workspace exports, then by what released packages do, then by the look-up name, which begins with the package's
    name by convention (pluginlib): this only below a key that always names a plug-in.
    """
    if plugin.name in exported:
        return exported[plugin.name]
    space = re.split("::|/", plugin.name)[0]
    if project.package(space) is not None:
        return space if plugin.is_sure else None
    released = project.knowledge.plugins(plugin.name)
    if released is not None:
        owners = {package for package, base in released if not _OTHER.fullmatch(base)}
        owners = {item for item in owners if project.knowledge.is_current(item, ros)}
        return next(iter(owners)) if len(owners) == 1 else None
    if not plugin.is_sure or project.knowledge.is_metapackage(space, ros) or not project.knowledge.is_package(space):
        return None
    return space


CHECK = Check(
    id="undeclared-plugin-dependency",
    summary="Package of a plug-in named in parameters that package.xml does not declare.",
    level=Level.WARNING,
    tags=("parameters", "packages", "plugins"),
    project=check,
)
