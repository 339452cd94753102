# SPDX-License-Identifier: Apache-2.0
"""Following one node of a configuration, unless all that it asks for is as it was when it was followed before."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from haros_ci.follow.context import Context, Exact
from haros_ci.follow.follow import Entry, follow
from haros_ci.follow.made import MadeEntity
from haros_ci.follow.ros import behavior_trees
from haros_ci.follow.ros.own_name import counting
from haros_ci.follow.walk import Walk
from haros_ci.graph.parameters import YamlFiles
from haros_ci.index.behavior_tree_files import TreeFiles
from haros_ci.index.plugins import PluginDescription
from haros_ci.index.relevance import Relevance
from haros_ci.index.trace import Trace
from haros_ci.index.xml_files import XmlFileReader
from haros_ci.keeping.consulted import small
from haros_ci.keeping.kept import Followed, digest_of
from haros_ci.model.api import Row
from haros_ci.model.architecture import Endpoint, Unknown
from haros_ci.model.build import ConfigFile, PluginClass
from haros_ci.model.faults import FAULTS, fault
from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass, field
from haros_ci.systems.entries import Programs
from haros_ci.systems.known.entry import KnownNode
from haros_ci.values.abstract import Value
from haros_ci.values.given import Unseen

#: What is known of a node type outside the workspace, by package, executable or look-up name, and ROS version.
KnownNodes = Callable[[str, str, int], KnownNode | None]
#: What is said of a node that is not followed to its end.
TOO_LARGE = "the node is too large to be followed to its end; some of what it makes may be missing"
FAULT = "the node could not be followed to its end"
#: Nodelets that load nodelets that load nodelets.
DEEPEST = 3


@dataclass(frozen=True, slots=True)
class Controller:
    """A controller or hardware component of ros2_control: its look-up *name*, class *type*, and where it begins."""

    package: str
    name: str
    type: str
    entry: Entry
    files: frozenset[str]
    is_controller: bool


@dataclass(frozen=True, slots=True)
class Types:
    """The node types of the workspace, and all that following them needs."""

    programs: Programs
    executables: Mapping[tuple[str, str], tuple[Entry, frozenset[str]]]
    #: The same, with those that are built for tests.
    startable: Mapping[tuple[str, str], tuple[Entry, frozenset[str]]]
    nodelets: Mapping[str, tuple[PluginClass, Entry, frozenset[str]]]
    #: By language and ROS version: API rows by call, and what they make relevant.
    rows: Mapping[tuple[str, int], Mapping[str, tuple[Row, ...]]]
    plugins: Mapping[str, PluginDescription]
    #: The last part of the base class's name of each plug-in, and the files of its library.
    plugin_files: list[tuple[str, frozenset[str]]]
    relevance: Mapping[tuple[str, int], Relevance]
    configs: Mapping[str, ConfigFile]
    read_yaml: YamlFiles
    #: What is known of node types outside the workspace, by package and type.
    known: KnownNodes
    #: What following has given so far, with the parameters that it depended on.
    followed: dict[Any, list[Followed]] = field(default_factory=dict)
    exact: Exact | None = None
    #: What nodes of one language and set of files have consulted, and what was followed in this run.
    traces: dict[Any, Trace] = field(default_factory=dict)
    fresh: list[tuple[Any, Followed]] = field(default_factory=list)
    #: The steps of each result that counts for a ROS 2 entry, by its key and a digest of what it is of.
    counted: dict[Any, dict[str, int]] = field(default_factory=dict)
    #: The steps of each result that the present job uses, by a digest of what it is of.
    used: dict[str, int] = field(default_factory=dict)
    views: dict[frozenset[str], Relevance] = field(default_factory=dict)
    #: ROS 2: executables and components, by package and executable or class.
    ros2_programs: Mapping[tuple[str, str], tuple[Entry, frozenset[str]]] = field(default_factory=dict)
    components: Mapping[tuple[str, str], tuple[Entry, frozenset[str]]] = field(default_factory=dict)
    #: Plug-ins that a program outside the workspace loads, by package and class.
    hosted: Mapping[tuple[str, str], tuple[Entry, frozenset[str]]] = field(default_factory=dict)
    #: Controllers and hardware components that a controller manager loads, by look-up name.
    controllers: Mapping[str, Controller] = field(default_factory=dict)
    #: The plug-ins of Gazebo that the workspace builds, by library (``gazebo_plugins.GazeboPlugin``).
    gazebo: Mapping[str, list[Any]] = field(default_factory=dict)
    #: The plug-ins of the workspace by base class.
    of_base: Mapping[str, tuple[PluginDescription, ...]] = field(default_factory=dict)
    #: The look-up names of all plug-ins of a base class of the workspace.
    declared: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    #: Behaviour trees in files of the workspace; None where nothing makes any.
    trees: TreeFiles | None = None
    xml: XmlFileReader | None = None
    #: Results under the names and parameters of a node, with what they are made of, by both; and their endpoints by node.
    put: dict[Any, tuple[Followed, Followed | None]] = field(default_factory=dict)
    ends: dict[int, tuple[Followed, dict[str, tuple[Endpoint, ...]]]] = field(default_factory=dict)
    #: What each result of a ROS 2 entry is known by, with the result.
    digests: dict[int, tuple[Followed, str]] = field(default_factory=dict)
    #: The ROS version of each package, None where it does not tell.
    versions: Mapping[str, int | None] = field(default_factory=dict)
    #: The files of programs that are of the other ROS than their package, with that ROS.
    left_out: Mapping[str, int] = field(default_factory=dict)
    #: What finds shell scripts by package and name; "" where there is none.
    shell_script: Callable[[str, str], str] = lambda package, name: ""
    #: The program, by package and name, that a shell script hands its words to.
    handed: Callable[[str, str], tuple[str, str] | None] = lambda package, name: None
    #: Files of Python that are run by themselves, by path.
    by_file: dict[str, tuple[Entry, frozenset[str]]] = field(default_factory=dict)

    def file(self, path: str) -> tuple[Entry, frozenset[str]] | None:
        """The program that a file of Python is."""
        if path not in self.by_file and path in self.programs.sources:
            self.by_file[path] = Entry(self.programs.sources[path]), frozenset((path,))
        return self.by_file.get(path)


@dataclass(frozen=True, slots=True)
class Instance:
    """One node to be followed: its names, its command line and how it is wired."""

    name: str
    namespace: str
    arguments: tuple[str, ...] | None
    remaps: Mapping[str, str]
    process: str
    #: How many nodelets load each other around it.
    depth: int = 0
    #: Whether a launch file starts it: roslaunch adds words to its command line.
    is_launched: bool = False
    #: Whether all that is set below its name is known, though a part of the name may not be.
    has_own: bool = False
    #: Whether its remappings are those of the process; a nodelet's are its own, and not those of its manager.
    remaps_process: bool = True
    #: Whether, of a behaviour tree that is not known, the nodes of every tree of the workspace are.
    has_trees: bool = False


def run_node(
    types: Types,
    entry: Entry,
    files: frozenset[str],
    instance: Instance,
    parameter: Callable[[str], Value | None],
    renames: Callable[[Value, bool | None], bool] = lambda name, anonymous: False,
) -> Followed:
    """Follow one node, unless it has been followed under the same names and all that it asked for is the same again.

    With the nodes of every behaviour tree it is followed only where it creates one that is not known without them.
    """
    if instance.has_trees:
        plain = run_node(types, entry, files, replace(instance, has_trees=False), parameter, renames)
        if behavior_trees.UNKNOWN not in plain.gaps and not plain.problems:
            return plain
    wiring = tuple(sorted(instance.remaps.items()))
    words = instance.arguments, instance.is_launched, instance.has_own, instance.remaps_process, instance.has_trees
    key = (entry.key, files_key(files), instance.name, instance.namespace, *words, wiring, instance.process)
    earlier = types.followed.setdefault(key, [])
    for done in earlier:
        if all(same(parameter(name), value) for name, value in done.asked.items()):
            return _used(types, key, instance, done)
    requested: dict[str, Value | None] = {}

    def ask(name: str) -> Value | None:
        value = requested[name] = parameter(name)
        return value

    context = Context(
        name=instance.name,
        namespace=instance.namespace,
        arguments=instance.arguments,
        is_launched=instance.is_launched,
        has_own=instance.has_own,
        plugins=types.plugins,
        declared=types.declared,
        trees=types.trees,
        any_tree=instance.has_trees,
        xml=types.xml,
        parameter=ask,
        read_yaml=types.read_yaml,
        remap=lambda name: instance.remaps.get(name, name),
        remaps=instance.remaps,
        nodelet=partial(_loaded, types, instance),
        process_name=instance.process,
        process_namespace=instance.process.rpartition("/")[0] or "/",
        remaps_process=instance.remaps_process,
        renames=renames,
    )
    earlier.append(followed_in(types, entry, files, context, requested, key))
    return _used(types, key, instance, earlier[-1])


def _used(types: Types, key: Any, instance: Instance, done: Followed) -> Followed:
    """*done*, counted for the present job; what a nodelet loads is not, as another process may have followed it."""
    if not instance.depth:
        types.used[digest_of(key, *done.asked.items())] = done.steps
    return done


def relevance_of(
    types: Types, entry: Entry, version: tuple[str, int], files: frozenset[str]
) -> tuple[Relevance, tuple[str, int, frozenset[str]]]:
    """What matters in the code that a node type of *files* can reach; and the version and files that say so."""
    if version != ("cpp", 2) or not files:
        return types.relevance[version], (*version, frozenset())
    own = files | {entry.source.path}
    if own not in types.views:
        visible = types.programs.cpp.visible_from(own, types.plugin_files)
        types.views[own] = types.relevance[version].within(visible)
    return types.views[own], (*version, own)


def same(one: Value | Unseen | None, other: Value | Unseen | None) -> bool:
    """Whether two values are the same, and not only equal as ``1`` and ``True`` are."""
    return one is other or (one == other and repr(one) == repr(other))


def files_key(files: frozenset[str]) -> str:
    """A short name for the files that a node type is made of."""
    return digest_of(sorted(files))[:16]


def followed_in(
    types: Types, entry: Entry, files: frozenset[str], context: Context, requested: Mapping[str, Value | None], key: Any
) -> Followed:
    """Follow from *entry* in *context*; what goes wrong is a problem, and what was made until then counts."""
    index = types.programs.index_of(entry)
    trace = types.traces.setdefault((entry.source.separator, files, context.of_base is not None), Trace())
    before = index.trace
    index.traced(trace)
    try:
        return _followed_in(types, entry, files, context, requested, key, trace)
    finally:
        index.traced(before)


def _followed_in(
    types: Types,
    entry: Entry,
    files: frozenset[str],
    context: Context,
    requested: Mapping[str, Value | None],
    key: Any,
    trace: Trace,
) -> Followed:
    index = types.programs.index_of(entry)
    trace.paths |= {entry.source.path, *files}
    if entry.source.separator == "::" and context.process is not None and files:
        trace.roots |= {entry.source.path, *files}
    language = "python" if entry.source.program.language == "python" else "cpp"
    version = (language, 1 if context.process is None else 2)
    relevance, view = relevance_of(types, entry, version, files)
    walk = Walk(index, types.rows[version], context, types.configs, relevance, files, types.exact, entry.target)
    problems: tuple[Problem, ...] = ()
    try:
        if not follow(walk, entry):
            problems = (Problem(entry.source.path, TOO_LARGE),)
    except FAULTS as err:
        problems = (Problem(entry.source.path, fault(FAULT, err)),)
    if context.loaded:
        trace.is_whole = False
    trace.names.update(relevance.asked())
    made, nodes = (*walk.made.values(), *(pace for pace, _ in walk.paces.values())), tuple(walk.nodes)
    settled = context.marks.settled(requested)
    followed = Followed(
        made,
        problems,
        counting(walk.names),
        walk.gaps,
        settled,
        nodes,
        tuple(walk.twins.values()),
        small(trace, relevance, view),
        walk.steps,
        context.marks.answers(),
    )
    types.fresh.append((key, followed))
    return followed


def _loaded(
    types: Types,
    loader: Instance,
    look_up: str,
    name: str,
    above: str,
    parameter: Callable[[str], Value | None],
) -> tuple[tuple[MadeEntity, ...], Mapping[str, Location]] | None:
    """What a nodelet makes that *loader* loads under the full *name*, in the namespace *above*; why there may be more."""
    if look_up not in types.nodelets:
        return None
    _, entry, files = types.nodelets[look_up]
    if loader.depth >= DEEPEST:
        return (), {"nodelets load each other too deeply to be followed": Location(entry.source.path)}
    inner = Instance(
        name, above, None, loader.remaps, loader.process, loader.depth + 1, remaps_process=loader.remaps_process
    )
    followed = run_node(types, entry, files, inner, parameter)
    problems = {problem.message: Location(problem.path, problem.line) for problem in followed.problems}
    return followed.made, {**problems, **followed.gaps}


def incomplete(followed: Followed, entry: Entry, location: Location | None) -> tuple[Unknown, ...]:
    """Why a node may have more endpoints than are known."""
    found = [Unknown("endpoints", problem.message, location) for problem in followed.problems]
    found += [Unknown("endpoints", text, where) for text, where in sorted(followed.gaps.items())]
    if entry.definition is None and not entry.source.program.functions and entry.source.program.problems:
        line, message = entry.source.program.problems[0]
        found.append(Unknown("endpoints", message, Location(entry.source.path, line)))
    return tuple(found)
