# SPDX-License-Identifier: Apache-2.0
"""From facts to the architecture: every configuration that is asked for, or that the launch files suggest."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import islice
from typing import Any

from haros_ci.link import api_rows, keeping, ros2_entries, ros2_system, system
from haros_ci.link.entries import Programs, executables, nodelets, plugins
from haros_ci.link.follow import Entry
from haros_ci.link.index import Source, build_index
from haros_ci.link.keeping import Keeper
from haros_ci.link.kept import Followed
from haros_ci.link.known.entry import KnownNode
from haros_ci.link.parameters import ParameterServer, yaml_reader
from haros_ci.link.relevance import Relevance
from haros_ci.link.roslaunch import evaluate
from haros_ci.link.roslaunch_entry import entry_files
from haros_ci.link.roslaunch_files import files_of
from haros_ci.link.run import Exact
from haros_ci.link.system import Job, Types
from haros_ci.model.api import Row
from haros_ci.model.architecture import Architecture, Configuration, Node
from haros_ci.model.build import Build
from haros_ci.model.launch import Launched, LaunchFile
from haros_ci.model.workspace import Problem, Workspace

#: A node with its endpoints, and what went wrong.
Result = tuple[tuple[Node, ...], tuple[Problem, ...]]
#: Does jobs, each of a group that has work in common, and gives their results in order.
Share = Callable[[Sequence[Callable[[], Any]], Sequence[Hashable]], Sequence[Any]]
#: What is known of a node type outside the workspace, by package and executable or nodelet's look-up name.
KnownNodes = Callable[[str, str], KnownNode | None]


def in_turn(jobs: Sequence[Callable[[], Any]], groups: Sequence[Hashable]) -> Sequence[Any]:
    """Do the jobs here, one after the other."""
    return [job() for job in jobs]


@dataclass(frozen=True, slots=True, kw_only=True)
class Wanted:
    """A configuration that a project file or the command line names. *launch* are root-relative paths."""

    name: str
    launch: tuple[str, ...]
    arguments: Mapping[str, str] = field(default_factory=dict)
    environment: Mapping[str, str] = field(default_factory=dict)
    user_data: Any = None


def link(
    workspace: Workspace,
    sources: Iterable[Source],
    load: Callable[[str], LaunchFile | None],
    builds: Mapping[str, Build],
    rows: Mapping[tuple[str, int], Iterable[Row]],
    *,
    wanted: tuple[Wanted, ...] | None = None,
    environment: Mapping[str, str] | None = None,
    known: KnownNodes | None = None,
    exact: Exact | None = None,
    share: Share = in_turn,
    keeper: Keeper | None = None,
) -> Architecture:
    """The architecture of *workspace*.

    *sources* are its C++ and Python programs, *load* gives a launch file's facts, *rows* the API rows by language. Without
    *wanted*, every launch file that no other includes is a configuration, and every node type that none of them starts
    is one alone. *known* tells what is known of node types that are not of the workspace, *exact* what the exact
    tier knows of calls. *share* does the jobs of following nodes; it may do them in other processes. *keeper* has what
    earlier runs followed.
    """
    types = types_of(workspace, sources, builds, rows, known or (lambda package, name: None), exact)
    problems: dict[Problem, None] = {}
    configurations: list[Configuration] = []
    if wanted is None:
        chosen = tuple(Wanted(name=path_name(workspace, path), launch=(path,)) for path in entry_files(workspace, load))
    else:
        chosen = wanted
    jobs: list[Job] = []
    started: set[tuple[str, str]] = set()
    opened: list[tuple[Wanted, Launched, int]] = []
    for item in chosen:
        seen = {**item.environment, **(environment or {})}
        launched = evaluate(item.launch, workspace, load, item.arguments, seen)
        problems.update(dict.fromkeys(launched.problems))
        server = ParameterServer(launched.parameters)
        nodes = [system.launched(types, each, server) for each in launched.nodes if not each.is_test]
        started.update((job.node.package, job.node.type) for job in nodes)
        opened.append((item, launched, len(nodes)))
        jobs += nodes
    if wanted is None:
        others = started & types.startable.keys() - types.executables.keys()
        behind_links = {types.startable[each][1] for each in others}
        for package, name in sorted(types.executables):
            if (package, name) not in started and types.executables[package, name][1] not in behind_links:
                jobs.append(system.alone(types, package, name))
        jobs += ros2_alone(types, started)
        for described, _, _ in dict.fromkeys(types.nodelets.values()):
            if system.type_of(described.name, described) not in started:
                jobs.append(system.standalone(types, described.name))
    key = keeping.key_of(types, rows) if keeper is not None else ""
    old = keeping.take_up(types, keeper, key) if keeper is not None else []
    order = sorted(range(len(jobs)), key=lambda number: -jobs[number].size)  # large ones first: nobody waits at the end
    work = [partial(_worked, types, jobs[number]) for number in order]
    done = dict(zip(order, share(work, [jobs[number].group for number in order]), strict=True))
    if keeper is not None:
        keeping.hand_on(keeper, key, old, [each for _, fresh in done.values() for each in fresh])
    results = (done[number][0] for number in range(len(jobs)))
    for item, launched, count in opened:
        followed = list(islice(results, count))
        problems.update(dict.fromkeys(problem for _, said in followed for problem in said))
        configurations.append(
            Configuration(
                name=item.name,
                launch=tuple(path_name(workspace, path) for path in item.launch),
                nodes=tuple(node for nodes, _ in followed for node in nodes),
                parameters=launched.parameters,
                arguments=tuple((name, str(value)) for name, value in launched.arguments),
                user_data=item.user_data,
            )
        )
    for nodes, said in results:
        node = nodes[0]
        if node.kind != system.PROGRAM:
            problems.update(dict.fromkeys(said))
            name = f"{node.package}/{node.type}"
            taken = node.kind == "nodelet" and any(c.name == name for c in configurations)
            configurations.append(Configuration(name=f"{name} (nodelet)" if taken else name, nodes=nodes))
    for build in builds.values():
        problems.update(dict.fromkeys(build.problems))
    return Architecture(
        configurations=tuple(configurations),
        packages=workspace.packages,
        problems=tuple(sorted(problems, key=lambda p: (p.path, p.line or 0, p.message))),
    )


def _worked(types: Types, job: Job) -> tuple[Result, list[tuple[Any, Followed]]]:
    """What a job gives, and all that was followed for it."""
    before = len(types.fresh)
    return job.follow(), types.fresh[before:]


def types_of(
    workspace: Workspace,
    sources: Iterable[Source],
    builds: Mapping[str, Build],
    rows: Mapping[tuple[str, int], Iterable[Row]],
    known: KnownNodes,
    exact: Exact | None = None,
) -> Types:
    """The node types of a workspace, ready to be followed."""
    by_path = {source.path: source for source in sorted(sources, key=lambda s: s.path)}
    cpp = build_index(s for s in by_path.values() if s.program.language != "python")
    python = build_index(s for s in by_path.values() if s.program.language == "python")
    python.interfaces = frozenset(each.name for build in builds.values() for each in build.interfaces)
    cpp.defined = {build.package: build.defined for build in builds.values() if build.defined}
    python.packages = frozenset(package.name for package in workspace.packages)
    programs = Programs(cpp, python, by_path, builds)
    tables: dict[tuple[str, int], dict[str, tuple[Row, ...]]] = {}
    for version, items in rows.items():
        table: dict[str, list[Row]] = {}
        for row in items:
            table.setdefault(row.call, []).append(row)
        tables[version] = {name: tuple(found) for name, found in table.items()}
    libraries = (row for version, items in rows.items() if version[0] == "cpp" for row in items)
    cpp.library = frozenset(name for row in libraries for name in api_rows.names_of(row))
    configs = {
        f"{config.package}::{config.name}Config": config
        for _, build in sorted(builds.items())
        for config in build.configs
    }
    relevance = {
        version: Relevance(python if version[0] == "python" else cpp, [row for found in table.values() for row in found])
        for version, table in tables.items()
    }
    reader = yaml_reader(files_of(workspace))
    versions = {package.name: package.ros for package in workspace.packages}
    ordinary = of_version(executables(programs), versions, 1)
    every = of_version({**linked(workspace, programs), **executables(programs, tests=True)}, versions, 1)
    startable = {**every, **ordinary}
    loadable = of_version(ros2_entries.components(programs), versions, 2)
    return Types(
        programs,
        ordinary,
        startable,
        nodelets(programs),
        tables,
        plugins(programs),
        relevance,
        configs,
        reader,
        known,
        exact=exact,
        ros2_programs=of_version(ros2_entries.programs_of(programs, loadable), versions, 2),
        components=loadable,
        versions=versions,
    )


def of_version(
    found: Mapping[tuple[str, str], tuple[Entry, frozenset[str]]], versions: Mapping[str, int | None], ros: int
) -> dict[tuple[str, str], tuple[Entry, frozenset[str]]]:
    """Of node types those in packages of that ROS version; packages that do not tell are of ROS 1."""
    return {key: entry for key, entry in found.items() if (versions.get(key[0]) == 2) == (ros == 2)}


def ros2_alone(types: Types, started: set[tuple[str, str]]) -> Iterator[Job]:
    """The ROS 2 node types that nothing starts: executables, and components that no executable runs."""
    running = {id(types.components[each][0]) for each in started if each in types.components}
    for package, name in sorted(types.ros2_programs):
        entry = types.ros2_programs[package, name][0]
        if (package, name) not in started and id(entry) not in running:
            running.add(id(entry))
            yield ros2_system.alone(types, package, name)
    for package, name in sorted(types.components):
        if id(types.components[package, name][0]) not in running:
            yield ros2_system.alone(types, package, name, is_component=True)


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
    best = None
    for package in workspace.packages:
        inside = package.path == "." or path.startswith(f"{package.path}/")
        if inside and (best is None or len(package.path) > len(best.path)):
            best = package
    if best is None:
        return path
    rest = path if best.path == "." else path[len(best.path) + 1 :]
    return f"{best.name}/{rest}"
