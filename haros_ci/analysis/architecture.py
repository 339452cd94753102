# SPDX-License-Identifier: Apache-2.0
"""From a workspace to its architecture: facts of each file through the cache, then everything linked afresh."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from haros_ci.analysis import header_macros
from haros_ci.analysis.api_rows import api_rows, plugin_rows
from haros_ci.analysis.coverage import Calls
from haros_ci.analysis.coverage_marks import marked
from haros_ci.analysis.kept_nodes import keeper
from haros_ci.analysis.kept_runs import launch_state
from haros_ci.analysis.programs import module_name, programs
from haros_ci.analysis.requested import configurations, named_environment
from haros_ci.analysis.views import joined, started_in
from haros_ci.config.settings import Settings
from haros_ci.declared import hints
from haros_ci.extract.cpp.exact import ExactCall, Place, pick
from haros_ci.forks import shared
from haros_ci.keeping.kept import Earlier
from haros_ci.launch.facts.memory import LaunchMemory, Memo
from haros_ci.launch.ros2.dialect import description_reader
from haros_ci.launch.ros2.places import Places
from haros_ci.model.architecture import Architecture, Configuration
from haros_ci.model.build import Build
from haros_ci.model.faults import FAULTS, fault
from haros_ci.model.launch import LaunchFile
from haros_ci.model.launch_actions import Description
from haros_ci.model.workspace import Problem, Store, Workspace
from haros_ci.records import dataclass, field
from haros_ci.systems.following import KnownNodes
from haros_ci.systems.known.entry import KnownNode
from haros_ci.systems.link import Linked, Requested, Ros2Launch, linked
from haros_ci.timing import stage, timed
from haros_ci.workspace.build import builds
from haros_ci.workspace.environment import environment_of
from haros_ci.workspace.views import views


@dataclass(frozen=True, slots=True)
class Common:
    """What the revisions of one change have in common, so that it is done once.

    *launched* is what launch files start, by the state of all that they are evaluated with (``launch_state``); *records* are those of
    nodes that earlier runs have followed, as they were read; *calls* what is found in the text of files.
    """

    launched: dict[str, Memo] = field(default_factory=dict)
    records: dict[str, Earlier | None] = field(default_factory=dict)
    calls: Calls = field(default_factory=dict)


def architecture(
    workspace: Workspace,
    settings: Settings,
    store: Store,
    *,
    requested: tuple[Requested, ...] | None = None,
    environment: Mapping[str, str] | None = None,
    known_nodes: bool = True,
    exact: bool = False,
    processes: int = 1,
) -> Architecture:
    """The architecture of *workspace* as *settings* (hints, API rows, configurations of the project file) want it.

    *requested* replaces the configurations of the project file; *environment* is what ``$(env)`` of launch files sees. With *exact*
    libclang fills what is not known, where headers are installed. Up to so many *processes* do the work.
    """
    options: dict[str, Any] = {
        "environment": environment,
        "known_nodes": known_nodes,
        "exact": exact,
        "processes": processes,
    }
    return varied(workspace, settings, store, requested=requested, alternatives=False, **options).architecture


@timed("link")
def varied(
    workspace: Workspace,
    settings: Settings,
    store: Store,
    *,
    requested: tuple[Requested, ...] | None = None,
    environment: Mapping[str, str] | None = None,
    known_nodes: bool = True,
    exact: bool = False,
    processes: int = 1,
    alternatives: bool = True,
    common: Common | None = None,
) -> Linked:
    """The same with the presence of all that launch files start, and *alternatives*: nodes of other launch arguments.

    ``under(name, arguments)`` of it is the configuration *name* with these launch arguments, as the command line would set
    them; it is linked when it is asked for, with what has been followed before. *common* has, and gets, what other revisions may share.
    """
    options: dict[str, Any] = {
        "environment": environment,
        "known_nodes": known_nodes,
        "exact": exact,
        "processes": processes,
        "alternatives": alternatives,
        "common": common or Common(),
    }
    parts = views(workspace)
    made = [_of_view(v.workspace, settings, store, requested=started_in(v, requested), **options) for v in parts]
    return joined(workspace, parts, made, settings.project_file or "the project file")


def _of_view(
    workspace: Workspace,
    settings: Settings,
    store: Store,
    *,
    requested: tuple[Requested, ...] | None,
    environment: Mapping[str, str] | None,
    known_nodes: bool,
    exact: bool,
    processes: int,
    alternatives: bool,
    common: Common,
) -> Linked:
    """The same of a workspace in which no two packages have the same name."""
    with stage("build files"):
        built = builds(workspace)
    problems: list[Problem] = []
    where = settings.project_file or "the project file"
    project = settings.project
    chosen_ones = configurations(workspace, project, problems, where) if requested is None else requested
    own = frozenset(package.name for package in workspace.packages)
    known = known_types(project.get("known_nodes"), where, problems, own) if known_nodes else None
    sources = programs(workspace, built, store, problems, processes)
    link_all = partial(
        linked,
        workspace,
        sources,
        launch_reader(workspace),
        built,
        api_rows(project.get("apis"), where, problems, plugin_rows(settings)),
        requested=chosen_ones,
        environment=environment,
        defaults=environment_of(workspace, built).over(named_environment(workspace, project, problems, where)),
        known=known,
        ros2=ros2_launch(workspace, built, common.launched.setdefault(launch_state(workspace), LaunchMemory())),
        share=timed("follow")(partial(shared, processes=processes)),
        alternatives=alternatives,
    )
    macros = header_macros.state({one.path: one.program for one in sources if one.program.language == "cpp"})
    made = link_all(keeper=keeper(workspace, store, common.records, macros))
    if exact:
        from haros_ci.analysis.exactness import ask, doubtful, sourced

        result, notes = ask(workspace, settings, doubtful(made.architecture))
        problems += notes
        if result:
            more = link_all(exact=partial(filled, result))
            made = replace(more, architecture=sourced(more.architecture, made.architecture))
    found = made.architecture
    hinted: list[Configuration] = []
    for configuration in found.configurations:
        configuration, wrong = hints.applied(configuration, workspace.packages, project, where)
        problems += wrong
        hinted.append(configuration)
    said_before = dict.fromkeys((*found.problems, *problems))

    def under(name: str, arguments: Mapping[str, str]) -> Configuration | None:
        with stage("variants", whole=True):  # with all that is launched and followed for them
            other = made.under(name, arguments)
        return hints.applied(other, workspace.packages, project, where)[0] if other is not None else None

    whole = replace(
        found,
        configurations=tuple(hinted),
        problems=tuple(sorted(said_before, key=lambda p: (p.path, p.line or 0, p.message))),
    )
    return marked(replace(made, architecture=whole, under=under), workspace, settings, common.calls)


def filled(
    result: Mapping[Place, tuple[ExactCall, ...]], path: str, line: int, column: int, name: str, count: int
) -> tuple[tuple[tuple[str | None, Any], ...], tuple[str | None, ...]] | None:
    """What the exact tier knows of a call's arguments (type, value) and template arguments; None if nothing."""
    call = pick(result.get((path, line, column), ()), name, count)
    if call is None:
        return None
    return tuple((argument.written or argument.type, argument.value) for argument in call.arguments), call.templates


def ros2_launch(workspace: Workspace, built: Mapping[str, Build], launched: Memo) -> Ros2Launch:
    """Launch files of ROS 2 in all dialects; *launched* has what was launched before."""
    places = Places(workspace, built)
    modules = {
        module_name(file.path, [(d, n) for build in built.values() for n, d in build.python_roots]): file.path
        for file in workspace.files
        if file.language == "python"
    }

    def locate(text: str) -> tuple[str, str] | None:
        path, content, _ = places.read(text)
        return (path, content) if path is not None else None

    def read(text: str) -> str | None:
        found = locate(text)
        return found[1] if found is not None else None

    def module(dotted: str) -> tuple[str, str] | None:
        path = modules.get(dotted)
        return (path, workspace.text(path)) if path is not None else None

    def read_python(path: str, environment: Mapping[str, str]) -> Description | None:
        from haros_ci.launch.python.interpret import interpret

        text = workspace.text(path)
        return interpret(path, text, read, environment, module, locate=locate) if text else None

    def read_xml(launch: LaunchFile, path: str) -> Description:
        from haros_ci.extract.launch.ros2_xml import read_ros2_xml

        return read_ros2_xml(launch, path)

    def read_yaml(text: str, path: str) -> Description | None:
        from haros_ci.extract.launch.ros2_yaml import read_ros2_yaml

        return read_ros2_yaml(text, path)

    loader = description_reader(workspace, read_python, launch_reader(workspace), read_xml, read_yaml)
    return Ros2Launch(loader, places, launched)


def launch_reader(workspace: Workspace) -> Callable[[str], LaunchFile | None]:
    """A function from a root-relative path, or a line feed and the text itself, to the tags; None if there is no such file."""
    from haros_ci.extract.launch.xml import read_launch

    read: dict[str, LaunchFile | None] = {}

    def load(path: str) -> LaunchFile | None:
        if path not in read:
            text = path[1:] if path.startswith("\n") else workspace.text(path)
            try:
                read[path] = read_launch(text) if text else None
            except FAULTS as err:
                read[path] = LaunchFile(None, ((1, fault("the launch file could not be read", err)),))
        return read[path]

    return load


def known_types(declared: object, where: str, problems: list[Problem], here: frozenset[str]) -> KnownNodes:
    """What is known of node types outside the workspace; a project file's ``known_nodes`` come first.

    Of the packages that are *here*, in the workspace, the project file alone is asked; but for scripts that are not followed.
    """
    from haros_ci.systems.known.load import load_known, load_user

    own: Mapping[str, Mapping[str, KnownNode]] = {}
    if isinstance(declared, Mapping):
        own, notes = load_user(declared, where)
        problems += notes

    def known(package: str, name: str, ros: int) -> KnownNode | None:
        for nodes, is_ours in ((own.get(package), False), (load_known(package, ros), package in here)):
            found = nodes.get(name) if nodes is not None else None
            if found is not None and found.ros in (None, ros) and (found.script or not is_ours):
                return found
        return None

    return known
