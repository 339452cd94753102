# SPDX-License-Identifier: Apache-2.0
"""A configuration: what launch files start, each node followed with its names, parameters and remappings."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

from haros_ci.follow.context import Context, Exact
from haros_ci.follow.follow import Entry, follow
from haros_ci.follow.made import Made
from haros_ci.follow.ros.ends import ANONYMOUS, UNNAMED, by, endpoints
from haros_ci.follow.run import Renamed, Run
from haros_ci.graph.names import clean, pattern, resolve, resolve_target
from haros_ci.graph.parameters import ParameterServer
from haros_ci.graph.remap_rules import of_ros1_node, written_rule
from haros_ci.graph.ros2_process import Parameters
from haros_ci.graph.words import scalar, split
from haros_ci.index.behavior_tree_files import TreeFiles
from haros_ci.index.index import Source
from haros_ci.index.relevance import Relevance
from haros_ci.index.trace import Trace
from haros_ci.index.xml_files import Reader
from haros_ci.keeping.consulted import small
from haros_ci.keeping.kept import Followed, digest_of
from haros_ci.model.api import Row
from haros_ci.model.architecture import Node, Unknown
from haros_ci.model.build import ConfigFile, PluginClass
from haros_ci.model.launch import Started
from haros_ci.model.launch_facts import ParameterFileUse
from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem
from haros_ci.syntax import Class
from haros_ci.systems import outside
from haros_ci.systems.entries import Programs
from haros_ci.systems.known.entry import KnownNode
from haros_ci.values.abstract import Known, Value

#: What the arguments of the nodelet program can begin with.
LOAD, STANDALONE, MANAGER = "load", "standalone", "manager"
#: The kind of what is started alone and is no node: it gives itself no name, and makes nothing.
PROGRAM = "program"
#: What is known of a node type outside the workspace, by package, executable or look-up name, and ROS version.
KnownNodes = Callable[[str, str, int], KnownNode | None]
#: Nodelets that load nodelets that load nodelets.
DEEPEST = 3


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
    plugins: Mapping[str, tuple[Source, Class]]
    #: The last part of the base class's name of each plug-in, and the files of its library.
    plugin_files: list[tuple[str, frozenset[str]]]
    relevance: Mapping[tuple[str, int], Relevance]
    configs: Mapping[str, ConfigFile]
    read_yaml: Any
    #: What is known of node types outside the workspace, by package and type.
    known: KnownNodes
    #: What following has given so far, with the parameters that it depended on.
    followed: dict[Any, list[Followed]] = field(default_factory=dict)
    exact: Exact | None = None
    #: What nodes of one language and set of files have consulted, and what was followed in this run.
    traces: dict[Any, Trace] = field(default_factory=dict)
    fresh: list[tuple[Any, Followed]] = field(default_factory=list)
    views: dict[frozenset[str], Relevance] = field(default_factory=dict)
    #: ROS 2: executables and components, by package and executable or class.
    ros2_programs: Mapping[tuple[str, str], tuple[Entry, frozenset[str]]] = field(default_factory=dict)
    components: Mapping[tuple[str, str], tuple[Entry, frozenset[str]]] = field(default_factory=dict)
    #: Plug-ins that a program outside the workspace loads, by package and class.
    hosted: Mapping[tuple[str, str], tuple[Entry, frozenset[str]]] = field(default_factory=dict)
    #: The plug-ins of the workspace by base class.
    of_base: Mapping[str, tuple[tuple[Source, Class], ...]] = field(default_factory=dict)
    #: Behaviour trees in files of the workspace; None where nothing makes any.
    trees: TreeFiles | None = None
    xml: Reader | None = None
    #: The ROS version of each package, None where it does not tell.
    versions: Mapping[str, int | None] = field(default_factory=dict)


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


@dataclass(frozen=True, slots=True)
class Job:
    """A node that can be followed: *follow* gives it with its endpoints.

    Jobs of one *group* have work in common. *size* is the number of functions in the files that the node is made of.
    """

    node: Node
    group: Hashable
    follow: Callable[[], tuple[tuple[Node, ...], tuple[Problem, ...]]]
    size: int = 0
    #: What a ROS 2 process is given from outside.
    parameters: Parameters | None = None
    #: The parameter files that a launch file gives to a ROS 2 process.
    files: tuple[ParameterFileUse, ...] = ()
    #: What its configuration is called besides, where the node is followed alone.
    label: str = ""


def launched(types: Types, started: Started, server: ParameterServer) -> Job:
    """The node that a launch file starts."""
    words = split(started.arguments)
    namespace = started.namespace if started.namespace.startswith("/") else f"/{started.namespace}"
    for special, value in words.special:
        if special == "ns":
            namespace = clean(f"/{value}")
            started = replace(started, name=clean(f"{namespace}/{started.name.rpartition('/')[2]}"))
    remaps = {
        resolve(source, namespace, started.name): resolve_target(target, namespace, started.name)
        for source, target, _ in started.remaps
    }
    rules = [*started.rules]
    for source, target in words.remaps:
        rules.append(written_rule(source, target, started.location))
        if "?" not in source:
            remaps[resolve(source, namespace, started.name)] = resolve_target(target, namespace, started.name)
    node = Node(
        name=started.name,
        kind="node",
        package=started.package,
        type=started.type,
        arguments=started.arguments,
        remaps=tuple(sorted(remaps.items())),
        rules=of_ros1_node(rules, namespace, started.name),
        conditions=started.conditions,
        presence=started.presence,
        location=started.location,
        process=started.name,
        source="launch",
        unknowns=started.unknowns,
    )
    found = types.startable.get((started.package, started.type))
    process = started.name
    if found is None and (started.package, started.type) == ("nodelet", "nodelet") and words.rest:
        node, found, process = _nodelet(types, node, words.rest, namespace)
    private = {  # where __ns:= moves the node, they are not below the name that the launch file gives it
        clean(f"{started.name}/{name}"): Known(scalar(value)) for name, value in words.private if "?" not in value
    }

    def parameter(name: str) -> Value | None:
        return private.get(name) or server.get(name, started.conditions)

    if found is None:
        known = types.known(node.package, outside.look_up(node), 1)
        given = (namespace, words.rest, parameter, remaps)
        return Job(node, None, lambda: ((outside.described(node, types.programs, known, *given),), ()))
    entry, files = found
    arguments = None if any("?" in word for word in words.rest) else words.rest
    instance = Instance(started.name, namespace, arguments, remaps, process)

    def follow_it() -> tuple[tuple[Node, ...], tuple[Problem, ...]]:
        followed = run_node(types, entry, files, instance, parameter)
        unknowns = (*node.unknowns, *incomplete(followed, entry, node.location))
        ends = endpoints(followed.made, by(remaps), server)
        return (replace(node, endpoints=ends, unknowns=unknowns),), followed.problems

    return Job(node, (id(entry), instance.name), follow_it, _size(types, files))


def _size(types: Types, files: frozenset[str]) -> int:
    sources = types.programs.sources
    return sum(len(sources[path].program.functions) for path in files if path in sources)


def _nodelet(types: Types, node: Node, words: tuple[str, ...], namespace: str) -> tuple[Node, Any, str]:
    verb = words[0]
    if verb in (LOAD, STANDALONE) and len(words) > 1:
        described = types.nodelets.get(words[1])
        package, name = type_of(words[1], described[0] if described else None)
        container = None
        if verb == LOAD and len(words) > 2:
            container = resolve(words[2], namespace, node.name)
        process = container or node.name
        node = replace(
            node,
            kind="nodelet",
            package=package,
            type=name,
            container=container,
            process=process,
            class_name=described[0].type.strip() if described else None,
        )
        return node, (described[1], described[2]) if described else None, process
    return node, None, node.name


def type_of(look_up: str, described: PluginClass | None) -> tuple[str, str]:
    """The package and type of a nodelet by its look-up name; one without a package in it is of who describes it."""
    package, slash, name = look_up.partition("/")
    return (package, name) if slash else (described.package if described is not None else "", look_up)


def alone(types: Types, package: str, name: str) -> Job:
    """A node type started by itself, under the name that it gives itself (or its executable's)."""
    entry, files = types.executables[package, name]
    server = ParameterServer(())
    location = Location(entry.source.path, entry.function.line if entry.function is not None else 1)
    chosen = f"/{name.partition('.')[0]}"
    instance = Instance(chosen, "/", (), {}, chosen)
    node = Node(name=chosen, kind="node", package=package, type=name, location=location, process=chosen)

    def renames(value: Value, anonymous: bool) -> bool:
        nonlocal chosen
        text, why, _ = pattern(value)
        own = clean(f"{text}_?" if anonymous else text) if why is None and text else chosen
        before, chosen = chosen, own
        return own != before

    def follow_it() -> tuple[tuple[Node, ...], tuple[Problem, ...]]:
        try:
            followed = run_node(types, entry, files, instance, server.get, renames)
        except Renamed:
            followed = run_node(types, entry, files, Instance(chosen, "/", (), {}, chosen), server.get)
        unknowns = incomplete(followed, entry, location)
        ends = endpoints(followed.made, by({}), server, ANONYMOUS if chosen.endswith("_?") else UNNAMED)
        kind = "node" if ends or followed.names else PROGRAM
        made = replace(node, name=chosen, process=chosen, kind=kind, unknowns=unknowns, endpoints=ends)
        return (made,), followed.problems

    return Job(node, (id(entry), instance.name), follow_it, _size(types, files))


def standalone(types: Types, look_up: str) -> Job:
    """A nodelet in a process of its own, under the name that the nodelet program gives it (``pkg_Class``)."""
    described, entry, files = types.nodelets[look_up]
    name = "/" + "_".join(part for part in look_up.replace(":", "/").split("/") if part)
    instance = Instance(name, "/", (), {}, name)
    server = ParameterServer(())
    package, last = type_of(look_up, described)
    line = entry.definition.line if entry.definition is not None else 1
    node = Node(
        name=name,
        kind="nodelet",
        package=package,
        type=last,
        location=Location(entry.source.path, line),
        process=name,
        class_name=described.type.strip(),
    )

    def follow_it() -> tuple[tuple[Node, ...], tuple[Problem, ...]]:
        followed = run_node(types, entry, files, instance, server.get)
        unknowns = incomplete(followed, entry, node.location)
        made = replace(node, unknowns=unknowns, endpoints=endpoints(followed.made, by({}), server))
        return (made,), followed.problems

    return Job(node, (id(entry), instance.name), follow_it, _size(types, files))


def run_node(
    types: Types,
    entry: Entry,
    files: frozenset[str],
    instance: Instance,
    parameter: Callable[[str], Value | None],
    renames: Callable[[Value, bool], bool] = lambda name, anonymous: False,
) -> Followed:
    """Follow one node, unless it has been followed under the same names and all that it asked for is the same again."""
    wiring = tuple(sorted(instance.remaps.items()))
    key = (entry.key, files_key(files), instance.name, instance.namespace, instance.arguments, wiring, instance.process)
    earlier = types.followed.setdefault(key, [])
    for done in earlier:
        if all(same(parameter(name), value) for name, value in done.asked.items()):
            return done
    asked: dict[str, Value | None] = {}

    def ask(name: str) -> Value | None:
        value = asked[name] = parameter(name)
        return value

    context = Context(
        name=instance.name,
        namespace=instance.namespace,
        arguments=instance.arguments,
        plugins=types.plugins,
        parameter=ask,
        read_yaml=types.read_yaml,
        remap=lambda name: instance.remaps.get(name, name),
        remaps=instance.remaps,
        nodelet=partial(_loaded, types, instance),
        process_name=instance.process,
        process_namespace=instance.process.rpartition("/")[0] or "/",
        renames=renames,
    )
    earlier.append(followed_in(types, entry, files, context, asked, key))
    return earlier[-1]


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


def same(one: Value | None, other: Value | None) -> bool:
    """Whether two values are the same, and not only equal as ``1`` and ``True`` are."""
    return one is other or (one == other and repr(one) == repr(other))


def files_key(files: frozenset[str]) -> str:
    """A short name for the files that a node type is made of."""
    return digest_of(sorted(files))[:16]


def followed_in(
    types: Types, entry: Entry, files: frozenset[str], context: Context, asked: Mapping[str, Value | None], key: Any
) -> Followed:
    """Follow from *entry* in *context*; what goes wrong is a problem, and what was made until then counts."""
    index = types.programs.index_of(entry)
    trace = types.traces.setdefault((entry.source.separator, files, context.of_base is not None), Trace())
    before = index.trace
    index.traced(trace)
    try:
        return _followed_in(types, entry, files, context, asked, key, trace)
    finally:
        index.traced(before)


def _followed_in(
    types: Types,
    entry: Entry,
    files: frozenset[str],
    context: Context,
    asked: Mapping[str, Value | None],
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
    run = Run(index, types.rows[version], context, types.configs, relevance, files, types.exact)
    problems: tuple[Problem, ...] = ()
    try:
        if not follow(run, entry):
            said = "the node is too large to be followed to its end; some of what it makes may be missing"
            problems = (Problem(entry.source.path, said),)
    except (ArithmeticError, AttributeError, LookupError, NameError, RecursionError, TypeError, ValueError) as err:
        said = (
            f"the node could not be followed to its end ({type(err).__name__}): a fault of haros-ci, please report it"
        )
        problems = (Problem(entry.source.path, said),)
    if context.loaded:
        trace.is_whole = False
    trace.names.update(relevance.asked())
    made, nodes = tuple(run.made.values()), tuple(run.nodes)
    followed = Followed(
        made,
        problems,
        tuple(run.names),
        run.gaps,
        asked,
        nodes,
        tuple(run.twins.values()),
        small(trace, relevance, view),
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
) -> tuple[tuple[Made, ...], Mapping[str, Location]] | None:
    """What a nodelet makes that *loader* loads under the full *name*, in the namespace *above*; why there may be more."""
    if look_up not in types.nodelets:
        return None
    _, entry, files = types.nodelets[look_up]
    if loader.depth >= DEEPEST:
        return (), {"nodelets load each other too deeply to be followed": Location(entry.source.path)}
    inner = Instance(name, above, None, loader.remaps, loader.process, loader.depth + 1)
    followed = run_node(types, entry, files, inner, parameter)
    problems = {problem.message: Location(problem.path, problem.line) for problem in followed.problems}
    return followed.made, {**problems, **followed.gaps}


def incomplete(followed: Followed, entry: Entry, location: Location | None) -> tuple[Unknown, ...]:
    """Why a node may have more endpoints than are known."""
    found = [Unknown("endpoints", problem.message, location) for problem in followed.problems]
    found += [Unknown("endpoints", said, where) for said, where in sorted(followed.gaps.items())]
    if entry.definition is None and not entry.source.program.functions and entry.source.program.problems:
        line, message = entry.source.program.problems[0]
        found.append(Unknown("endpoints", message, Location(entry.source.path, line)))
    return tuple(found)
