# SPDX-License-Identifier: Apache-2.0
"""The node types of a workspace: where each begins, and all that following them needs."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import partial

from haros_ci.follow.context import Exact
from haros_ci.follow.follow import Entry
from haros_ci.follow.ros import api_rows
from haros_ci.graph.parameters import YamlFiles
from haros_ci.index import behavior_tree_files
from haros_ci.index.behavior_tree_files import TreeFiles
from haros_ci.index.build import build_index
from haros_ci.index.index import BEHAVIOR_TREE_NODE, Source
from haros_ci.index.relevance import Relevance
from haros_ci.index.xml_files import XmlFileReader
from haros_ci.model.api import Row
from haros_ci.model.build import Build
from haros_ci.model.launch import LaunchFile
from haros_ci.model.once import once
from haros_ci.model.package import Package
from haros_ci.model.workspace import Workspace
from haros_ci.substitutions.files import files_of
from haros_ci.systems import client_libraries, definitions, gazebo_plugins, other_ros, ros2_controllers, ros2_entries
from haros_ci.systems.entries import Programs, declared, executables, nodelets, plugin_files, plugins, plugins_of_base
from haros_ci.systems.following import KnownNodes, Types
from haros_ci.systems.ros2_entries import Found
from haros_ci.systems.shell_scripts import ShellScripts
from haros_ci.timing import timed


@timed("index")
def types_of(
    workspace: Workspace,
    sources: Iterable[Source],
    builds: Mapping[str, Build],
    rows: Mapping[tuple[str, int], Iterable[Row]],
    known: KnownNodes,
    exact: Exact | None = None,
    load: Callable[[str], LaunchFile | None] = lambda path: None,
) -> Types:
    """The node types of a workspace, ready to be followed."""
    sources = sorted(sources, key=lambda source: source.path)
    library_files = client_libraries.library_files(sources, builds, rows)
    by_path = {source.path: source for source in sources if source.path not in library_files}
    cpp = build_index(s for s in by_path.values() if s.program.language != "python")
    python = build_index(s for s in by_path.values() if s.program.language == "python")
    python.interfaces = frozenset(interface.name for build in builds.values() for interface in build.interfaces)
    cpp.defined = {build.package: build.defined for build in builds.values() if build.defined}
    targets = [target for build in builds.values() for target in build.targets]
    cpp.conditional = frozenset(path for target in targets for path in target.conditional_sources)
    cpp.compiled = definitions.compiled_files(builds)
    python.packages = frozenset(package.name for package in workspace.packages)
    programs = Programs(cpp, python, by_path, builds)
    held = {version: tuple(items) for version, items in rows.items()}
    tables = {version: by_call(items) for version, items in held.items()}
    cpp.library = frozenset().union(
        *(api_rows.all_names(items) for version, items in held.items() if version[0] == "cpp")
    )
    configs = {
        f"{config.package}::{config.name}Config": config
        for _, build in sorted(builds.items())
        for config in build.configs
    }
    relevance = {
        version: Relevance(python if version[0] == "python" else cpp, items) for version, items in held.items()
    }
    files = files_of(workspace)
    reader, xml = YamlFiles(files), XmlFileReader(load, files)
    tree_libraries = behavior_tree_files.library_files(cpp, builds)
    versions = {package.name: package.ros for package in workspace.packages}
    shell = ShellScripts(workspace, builds)
    of_version = partial(_of_version, programs, versions)
    older = executables(programs)
    ordinary = of_version(older, 1)
    every = of_version({**linked(workspace, programs), **executables(programs, tests=True)}, 1)
    startable = {**every, **ordinary}
    components = ros2_entries.components(programs)
    loadable = of_version(components, 2)
    newer = ros2_entries.programs_of(programs, loadable)
    return Types(
        programs,
        ordinary,
        startable,
        nodelets(programs),
        tables,
        plugins(programs),
        [*plugin_files(programs), *((BEHAVIOR_TREE_NODE, found) for found in tree_libraries)],
        relevance,
        configs,
        reader,
        known,
        exact=exact,
        of_base=plugins_of_base(programs),
        declared=declared(programs),
        ros2_programs=of_version(newer, 2),
        components=loadable,
        hosted=of_version(ros2_entries.hosted(programs, tables.get(("cpp", 2), {})), 2),
        controllers=ros2_controllers.controllers(programs, versions),
        gazebo=gazebo_plugins.built(programs),
        trees=TreeFiles(xml, cpp, builds) if behavior_tree_files.users(cpp) else None,
        xml=xml,
        versions=versions,
        shell_script=shell.find,
        handed=shell.program,
        left_out=other_ros.left_out(programs, (older, components, newer), versions),
    )


@once
def by_call(rows: tuple[Row, ...]) -> Mapping[str, tuple[Row, ...]]:
    """The rows by the names of what is called, in their order."""
    table: dict[str, list[Row]] = {}
    for row in rows:
        table.setdefault(row.call, []).append(row)
    return {name: tuple(found) for name, found in table.items()}


def _of_version(
    programs: Programs, versions: Mapping[str, int | None], found: Mapping[tuple[str, str], Found], ros: int
) -> dict[tuple[str, str], Found]:
    """Of node types those of that ROS: their package's, else that of the client library that they use, else ROS 1."""

    def version(package: str, entry: Entry) -> int:
        return versions.get(package) or other_ros.client_of(programs, entry.source) or 1

    return {key: made for key, made in found.items() if version(key[0], made[0]) == ros}


def linked(workspace: Workspace, programs: Programs) -> dict[tuple[str, str], tuple[Entry, frozenset[str]]]:
    """The Python scripts that can be started by the names of symbolic links to them, as ``executables`` has them."""
    scripts = {path for build in programs.builds.values() for path in build.scripts}
    found = {}
    for path, target in workspace.links:
        package = path_name(workspace, path).partition("/")[0]
        if target in scripts and target in programs.sources and package in programs.builds:
            found[package, path.rpartition("/")[2]] = Entry(programs.sources[target]), frozenset((target,))
    return found


def path_name(workspace: Workspace, path: str) -> str:
    """``package/path`` as HAROS project files name launch files; the path itself outside any package."""
    homes, folder = _homes(workspace.packages), path
    while folder:
        folder = folder.rpartition("/")[0]
        if (name := homes.get(folder or ".")) is not None:
            return f"{name}/{path[len(folder) + 1 :] if folder else path}"
    return path


@once
def _homes(packages: tuple[Package, ...]) -> Mapping[str, str]:
    """The names of *packages* by their directories."""
    return {package.path: package.name for package in reversed(packages)}
