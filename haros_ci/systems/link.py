# SPDX-License-Identifier: Apache-2.0
"""From facts to the architecture: every configuration that is asked for, or that the launch files suggest."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import islice
from typing import Any

from haros_ci.follow.context import Exact
from haros_ci.graph.names import clean
from haros_ci.graph.parameters import ParameterServer
from haros_ci.index.idle import idle_in
from haros_ci.index.index import Source
from haros_ci.launch.facts.memory import LaunchMemory, Memo
from haros_ci.launch.ros1.entry import entry_files
from haros_ci.launch.ros1.roslaunch import evaluate
from haros_ci.launch.ros2.dialect import is_ros2_file
from haros_ci.launch.ros2.entry import entry_files as ros2_entry_files
from haros_ci.launch.ros2.evaluate import launch_system
from haros_ci.launch.ros2.parameter_files import parameter_file
from haros_ci.launch.ros2.places import Places
from haros_ci.model.api import Row
from haros_ci.model.architecture import Architecture, Configuration, Parameter
from haros_ci.model.build import Build
from haros_ci.model.environment import NOTHING, Environment
from haros_ci.model.launch import LaunchFile
from haros_ci.model.launch_actions import Description
from haros_ci.model.launch_facts import LaunchFact
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.records import dataclass, field
from haros_ci.systems import (
    controllers,
    keeping,
    loaded_elsewhere,
    present,
    ros2_library,
    ros2_library_classes,
    ros2_library_modules,
    ros2_system,
    rounds,
    system,
    unstarted,
)
from haros_ci.systems.following import KnownNodes, Types
from haros_ci.systems.hidden_launches import hidden_facts
from haros_ci.systems.keeping import Keeper
from haros_ci.systems.launch_facts import Completion
from haros_ci.systems.node_types import path_name, types_of
from haros_ci.systems.ros2_library import Seen
from haros_ci.systems.simulation import ros1 as ros1_simulation
from haros_ci.systems.simulation import ros2 as ros2_simulation
from haros_ci.systems.simulation.simulators import Completes
from haros_ci.systems.simulation.trees import DescriptionTrees
from haros_ci.systems.system import Job
from haros_ci.systems.work import Result, Share, Work, in_turn
from haros_ci.timing import timed


@dataclass(frozen=True, slots=True, kw_only=True)
class Requested:
    """A configuration that a project file or the command line names. *launch* are root-relative paths."""

    name: str
    launch: tuple[str, ...]
    arguments: Mapping[str, str] = field(default_factory=dict)
    environment: Mapping[str, str] = field(default_factory=dict)
    user_data: Any = None
    closed: bool = False


@dataclass(frozen=True, slots=True)
class Ros2Launch:
    """Launch files of ROS 2: *loader* gives for an environment what gives the description of a file in any dialect, None for another file;
    *places* finds files. *memo* has what was launched before, of ROS 1 too.
    """

    loader: Callable[[Mapping[str, str]], Callable[[str], Description | None]]
    places: Places
    memo: Memo = field(default_factory=LaunchMemory)

    def entries(self, workspace: Workspace, environment: Mapping[str, str]) -> tuple[str, ...]:
        """The launch files that a workspace is started by."""
        is_ros2 = is_ros2_file(workspace)
        return ros2_entry_files(workspace, self.loader(environment), self.places, is_ros2, self.memo, environment)


@dataclass(frozen=True, slots=True)
class Opened:
    """What the launch files of a configuration start, as jobs; and what else they say.

    *others* and *other_parameters* are there with other launch arguments only.
    """

    jobs: tuple[Job, ...]
    parameters: tuple[Parameter, ...]
    arguments: tuple[tuple[str, Any], ...]
    problems: tuple[Problem, ...]
    others: tuple[Job, ...] = ()
    other_parameters: tuple[Parameter, ...] = ()
    facts: tuple[LaunchFact, ...] = ()
    #: What completes simulators with what their plug-ins make.
    completes: tuple[Completes, ...] = ()


@dataclass(frozen=True, slots=True)
class Linked:
    """An architecture; *under* gives a configuration of it by its name, with some launch arguments set otherwise.

    It is linked as any other, with what has been followed before; None if no launch file starts it, or if the steps of the workspace are
    used up. *builds* and *sources* are what was linked. *views* are those of each version of ROS where packages of one name are of both, ()
    elsewhere.
    """

    architecture: Architecture
    under: Callable[[str, Mapping[str, str]], Configuration | None]
    builds: Mapping[str, Build]
    sources: tuple[Source, ...]
    views: tuple[Linked, ...] = ()
    #: What has been worked out of its code, by name (``analysis.code_of``).
    kept: dict[str, Any] = field(default_factory=dict, compare=False, repr=False)


@timed("launch")
def open_(
    types: Types,
    workspace: Workspace,
    load: Callable[[str], LaunchFile | None],
    ros2: Ros2Launch | None,
    expected: Requested,
    environment: Mapping[str, str],
    trees: DescriptionTrees,
    alternatives: bool = False,
) -> Opened:
    """Evaluate the launch files of a configuration, each in its own dialect; perhaps with what other arguments start."""
    describe = ros2.loader(environment) if ros2 is not None else None
    newer = tuple(path for path in expected.launch if describe is not None and describe(path) is not None)
    older = tuple(path for path in expected.launch if path not in newer)
    jobs: list[Job] = []
    parameters: tuple[Parameter, ...] = ()
    other_parameters: tuple[Parameter, ...] = ()
    arguments: list[tuple[str, Any]] = []
    problems: list[Problem] = []
    others: list[Job] = []
    facts: list[LaunchFact] = []
    completes: list[Completes] = []
    if older or not newer:
        memo = ros2.memo if ros2 is not None else None
        launched = evaluate(older, workspace, load, expected.arguments, environment, alternatives, memo)
        server = ParameterServer(launched.parameters)
        robots = ros1_simulation.simulation(types, launched, server, trees, environment)
        jobs += [*(system.launched(types, node, server) for node in launched.nodes if not node.is_test), *robots.jobs()]
        others += present.launched(types, launched)
        parameters, other_parameters = launched.parameters, launched.alternative_parameters
        arguments += launched.arguments
        problems += launched.problems
        facts += launched.facts
        completes.append(robots.complete)
    if newer and ros2 is not None and describe is not None:
        found = launch_system(
            newer, workspace, describe, expected.arguments, environment, ros2.places, ros2.memo, alternatives
        )
        rules_of = partial(parameter_file, ros2.places)
        simulated = ros2_simulation.simulation(found, trees, environment, types.known)
        managers = simulated.managers(rules_of) if simulated is not None else ()
        nodes = controllers.with_controllers(found.nodes, rules_of, managers)
        containers = {
            clean(f"{manager.namespace or '/'}/{manager.name}"): manager
            for manager in (*managers, *nodes)
            if manager.name
        }
        jobs += [ros2_system.launched(types, node, containers) for node in nodes]
        others += present.ros2_launched(types, found, rules_of, managers)
        completes += [simulated.complete] if simulated is not None else []
        arguments += found.arguments
        problems += found.problems
        facts += found.facts
    started = tuple(jobs), parameters, tuple(arguments), tuple(problems)
    return Opened(*started, tuple(others), other_parameters, tuple(facts), tuple(completes))


def linked(
    workspace: Workspace,
    sources: tuple[Source, ...],
    load: Callable[[str], LaunchFile | None],
    builds: Mapping[str, Build],
    rows: Mapping[tuple[str, int], Iterable[Row]],
    *,
    requested: tuple[Requested, ...] | None = None,
    environment: Mapping[str, str] | None = None,
    defaults: Environment = NOTHING,
    known: KnownNodes | None = None,
    exact: Exact | None = None,
    share: Share = in_turn,
    keeper: Keeper | None = None,
    ros2: Ros2Launch | None = None,
    alternatives: bool = False,
) -> Linked:
    """The architecture of *workspace*.

    *sources* are its C++ and Python programs, *load* gives a launch file's facts, *rows* the API rows by language. Without
    *requested*, every launch file that no other includes is a configuration, and every node type that none of them starts
    is one alone. *environment* comes before what a configuration says of variables, *defaults* after it.
    *known* is what is known of node types that are not of the workspace, *exact* what the exact
    tier knows of calls. *share* does the jobs of following nodes; it may do them in other processes. *keeper* has what
    earlier runs followed, *ros2* reads launch files of ROS 2. With *alternatives* each configuration has the nodes that
    are there with other launch arguments, too.
    """
    idle = idle_in(sources)
    types = types_of(workspace, idle.without(sources), builds, rows, known or _nothing, exact, load)
    problems: dict[Problem, None] = {}
    configurations: list[Configuration] = []
    if requested is None:
        paths = (
            *entry_files(workspace, load, defaults.over(environment)),
            *(ros2.entries(workspace, defaults.over(environment)) if ros2 is not None else ()),
        )
        chosen = tuple(Requested(name=path_name(workspace, path), launch=(path,)) for path in sorted(paths))
    else:
        chosen = requested
    jobs: list[Job] = []
    others: list[Job] = []
    started: set[tuple[str, str]] = set()
    launched: list[tuple[Requested, Opened]] = []
    trees = DescriptionTrees(workspace, builds)
    for item in chosen:
        seen = defaults.over(item.environment, environment)
        opened = open_(types, workspace, load, ros2, item, seen, trees, alternatives)
        problems.update(dict.fromkeys(opened.problems))
        started.update(
            (job.node.package, job.node.type)
            for job in opened.jobs
            if types.versions.get(job.node.package) in (None, job.node.ros)  # else it is of the other ROS
        )
        launched.append((item, opened))
        jobs += opened.jobs
        others += opened.others
    if requested is None:
        linked_to = started & types.startable.keys() - types.executables.keys()
        behind_links = {types.startable[pair][1] for pair in linked_to}
        for package, name in sorted(types.executables):
            if (package, name) not in started and types.executables[package, name][1] not in behind_links:
                jobs.append(system.alone(types, package, name))
        jobs += unstarted.ros2_alone(types, started, tuple(jobs))
        problems.update(dict.fromkeys(unstarted.lost(types)))
        for described, _, _ in dict.fromkeys(types.nodelets.values()):
            if system.type_of(described.name, described) not in started:
                jobs.append(system.standalone(types, described.name))
    key = keeping.key_of(types, rows, idle) if keeper is not None else ""
    old = keeping.take_up(types, keeper, key, idle) if keeper is not None else []
    work = Work(types, share)
    done, fresh = rounds.work(work, (*jobs, *others))
    made = ros2_library.seen_in(node for nodes, _ in done[: len(jobs)] for node in nodes)
    more = list(_more(types, made)) if requested is None else []
    brought, fresh_too = rounds.work(work, more)
    if keeper is not None:
        keeping.hand_on(keeper, key, old, [*fresh, *fresh_too])
    present.remember(types, (*fresh, *fresh_too))
    results, other_results = iter(done[: len(jobs)]), iter(done[len(jobs) :])
    completion = Completion(workspace, builds, types)
    by_launch = {item.launch: opened.facts for item, opened in launched if alternatives and requested is None}
    hidden = hidden_facts(
        workspace, load, defaults.over(environment), by_launch, ros2.memo if ros2 is not None else None
    )
    for item, opened in launched:
        followed = list(islice(results, len(opened.jobs)))
        problems.update(dict.fromkeys(problem for _, report in followed for problem in report))
        beside = list(islice(other_results, len(opened.others)))
        opened = replace(opened, facts=(*opened.facts, *hidden.get(item.launch, ())))
        configurations.append(_configuration(completion, item, opened, followed, beside))
    alone = zip(results, jobs[sum(len(opened.jobs) for _, opened in launched) :], strict=True)
    configurations += unstarted.configurations(alone, problems, {item.name for item in configurations})
    for (nodes, _), job in zip(brought, more, strict=True):
        if nodes[0].kind != system.PROGRAM and ros2_library.tells(nodes, made):
            own = f"{nodes[0].package}/{nodes[0].type.removeprefix(f'{nodes[0].package}/')}"
            configurations.append(Configuration(name=f"{own} ({job.label})", nodes=nodes))
    for build in builds.values():
        problems.update(dict.fromkeys(build.problems))
    items = {item.name: item for item, _ in launched}

    def under(name: str, assignment: Mapping[str, str]) -> Configuration | None:
        if name not in items or work.is_over:
            return None
        item = replace(items[name], arguments={**items[name].arguments, **assignment})
        opened = open_(types, workspace, load, ros2, item, defaults.over(item.environment, environment), trees)
        return _configuration(completion, item, opened, rounds.work_here(opened.jobs), ())

    found = Architecture(
        configurations=tuple(configurations),
        packages=workspace.packages,
        problems=tuple(sorted(problems, key=lambda p: (p.path, p.line or 0, p.message))),
    )
    return Linked(found, under, builds, sources)


def _nothing(package: str, name: str, ros: int) -> None:
    """What is known of node types where nothing is."""


def _configuration(
    completion: Completion, item: Requested, opened: Opened, followed: Sequence[Result], others: Sequence[Result]
) -> Configuration:
    """The configuration *item* of what its jobs have given."""
    done = (*zip(opened.jobs, followed, strict=True), *zip(opened.others, others, strict=True))
    files = dict.fromkeys(fact for job, (nodes, _) in done for fact in completion.given(job, nodes))
    nodes = tuple(node for nodes, _ in followed for node in nodes)
    for complete in opened.completes:
        nodes = complete(nodes)
    return Configuration(
        name=item.name,
        launch=tuple(path_name(completion.workspace, path) for path in item.launch),
        nodes=nodes,
        parameters=(*opened.parameters, *_environment(opened.jobs, followed)),
        arguments=tuple((name, str(value)) for name, value in opened.arguments),
        user_data=item.user_data,
        closed=item.closed,
        launch_facts=(*completion.completed(opened.facts), *files),
        alternatives=tuple(node for nodes, _ in others for node in nodes),
        alternative_parameters=(*opened.other_parameters, *_environment(opened.others, others)),
    )


def _environment(jobs: Sequence[Job], results: Sequence[Result]) -> tuple[Parameter, ...]:
    return ros2_system.given_parameters(
        (node, job.parameters)
        for job, (nodes, _) in zip(jobs, results, strict=True)
        for node in nodes
        if job.parameters is not None
    )


def _more(types: Types, made: Seen) -> Iterator[Job]:
    """Classes for the nodes of others, and plug-ins that others load, which make what none of the workspace's nodes has *made*."""
    for library in (*ros2_library_classes.libraries(types, made), *ros2_library_modules.libraries(types, made)):
        yield ros2_library.job(types, library)
    yield from loaded_elsewhere.jobs(types, made)
