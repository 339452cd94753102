# SPDX-License-Identifier: Apache-2.0
"""What the simulators of a configuration are given: their worlds and what is spawned, and what its plug-ins make there."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from haros_ci.graph.words import split
from haros_ci.model.architecture import Endpoint, Node, Unknown
from haros_ci.model.launch import LaunchedNode, Started
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.systems.gazebo_plugins import GazeboPlugin
from haros_ci.systems.simulation.endpoints import Spawned, is_idle
from haros_ci.systems.simulation.table import KnownPlugin, library_of, plugins, silent
from haros_ci.systems.simulation.trees import MODEL, DescriptionTree, DescriptionTrees
from haros_ci.systems.simulation.uses import ModelInclude, PluginUse, found

#: The package of the simulator, and its programs.
PACKAGE = "gazebo_ros"
SERVERS = ("gzserver", "gazebo", "debug", "gdbrun", "perf")
#: What the data on known nodes says of the simulator as long as nothing is known of its plug-ins.
UNDECIDED = "the plug-ins of its world and its models decide"
#: Options of Gazebo's server that a value follows.
TAKING = frozenset(
    [
        "-e",
        "--physics",
        "-p",
        "--play",
        "-o",
        "--profile",
        "-s",
        "--server-plugin",
        "-g",
        "--gui-client-plugin",
        "--gui-plugin",
        "--seed",
        "--iters",
        "--record_encoding",
        "--record_path",
        "--record_period",
        "--record_filter",
        "--initial_sim_time",
        "--params-file",
    ]
)
#: Services of the simulator by which any node can bring a model.
SPAWNING = frozenset(("gazebo_msgs/SpawnModel", "gazebo_msgs/srv/SpawnEntity"))
#: From the nodes of a configuration to the same with what plug-ins make.
Completes = Callable[[Sequence[Node]], tuple[Node, ...]]
#: Plug-ins and included models that one simulator may have, and models in one another.
MOST = 2_000
DEEPEST = 10
#: Elements of descriptions that are looked through for one simulator; the last description is looked through to its end.
MAX_ELEMENTS = 200_000
NONE: Mapping[str, Sequence[GazeboPlugin]] = {}
TOO_MANY = "it has more plug-ins and models than are looked at"


@dataclass(slots=True)
class SimulatorPlugins:
    """The plug-ins of one simulator, each with its row and how it was brought; *lost* says where there may be more.

    *ours* are the plug-ins that the workspace builds, by library, *built* those of them that are used. *libraries* are the plug-ins that its command line names; *included* is the number of models that others include,
    *elements* that of the elements that have been looked through.
    """

    ours: Mapping[str, Sequence[GazeboPlugin]] = field(default_factory=dict)
    uses: list[tuple[PluginUse, KnownPlugin, Spawned]] = field(default_factory=list)
    built: list[tuple[PluginUse, GazeboPlugin, Spawned]] = field(default_factory=list)
    lost: dict[str, Location | None] = field(default_factory=dict)
    libraries: tuple[str, ...] = ()
    included: int = 0
    elements: int = 0

    def lose(self, reason: str, location: Location | None) -> None:
        if len(self.lost) < MOST:
            self.lost.setdefault(reason, location)


@dataclass(frozen=True, slots=True)
class CommandLine:
    """What a server is started with: *world* ("" for none, None if it is not known) and the *plugins* that ``-s`` names."""

    world: str | None
    plugins: tuple[str, ...]


def command_line(words: Iterable[str]) -> CommandLine:
    """The world and plug-ins that Gazebo's server is given in *words*."""
    world: str | None = ""
    named: list[str] = []
    taking = ""
    is_ros = False
    for word in words:
        if is_ros:
            is_ros = word != "--"
        elif taking:
            if taking in ("-s", "--server-plugin"):
                named.append(library_of(word))
            taking = ""
        elif word == "--ros-args":
            is_ros = True
        elif word in TAKING:
            taking = word
        elif word.startswith("--server-plugin="):
            named.append(library_of(word.partition("=")[2]))
        elif word.startswith("-"):
            continue
        elif "?" in word:
            world = None
        elif world == "":
            world = word
    return CommandLine(world, tuple(named))


def of_server(
    trees: DescriptionTrees,
    server: Started | LaunchedNode,
    ros: int,
    accounted: Container[str],
    ours: Mapping[str, Sequence[GazeboPlugin]] = NONE,
) -> SimulatorPlugins:
    """What the command line of a *server* brings: the plug-ins of its world, and those that it names itself.

    What it names and is not *accounted* for may make more than is known.
    """
    into = SimulatorPlugins(ours)
    line = command_line(split(server.arguments).rest)
    into.libraries = line.plugins
    if line.world is None:
        into.lose("which world it is given is not known", server.location)
    else:
        gather(trees, trees.of_world(line.world), Spawned(), ros, into, server.location)
    for library in line.plugins:
        if library not in accounted:
            into.lose(f"what the plug-in {library} makes is not known", server.location)
    return into


def spawned_by(
    spawner: Started | LaunchedNode, server: Started | LaunchedNode, model: str | None, namespace: str | None
) -> Spawned:
    """How a *spawner* brings the *model* that its command line names, in that *namespace*, to the *server*."""
    conditions = tuple(condition for condition in spawner.conditions if condition not in server.conditions)
    return Spawned(model="?" if not model or "?" in model else model, namespace=namespace, conditions=conditions)


def of_file_or_model(trees: DescriptionTrees, words: Sequence[str]) -> DescriptionTree | None:
    """The description that a spawner's *words* name as a file or as a model of the database; None if they name neither."""
    file, model = option(words, "-file"), option(words, "-database")
    if file is not None:
        return trees.of_file(file)
    return trees.of_model(f"{MODEL}{model}") if model is not None else None


def option(words: Sequence[str], name: str) -> str | None:
    """The word that follows an option, which may be written with one or two dashes."""
    for number, word in enumerate(words):
        if word in (name, f"-{name}") and number + 1 < len(words):
            return words[number + 1]
        if word.startswith((f"{name}=", f"-{name}=")):
            return word.partition("=")[2]
    return None


def gather(
    trees: DescriptionTrees,
    tree: DescriptionTree,
    spawned: Spawned,
    ros: int,
    into: SimulatorPlugins,
    place: Location | None,
    depth: int = 0,
) -> None:
    """The plug-ins of a description, and of the models that it includes."""
    if tree.reason:
        into.lose(tree.reason, place)
    if tree.root is None:
        return
    if into.elements >= MAX_ELEMENTS:
        into.lose(TOO_MANY, place)
        return
    into.elements += sum(1 for _ in tree.root.walk())
    for use in found(tree.root, spawned.model):
        if max(len(into.uses) + len(into.built), into.included) >= MOST or depth > DEEPEST:
            into.lose(TOO_MANY, place)
            return
        if isinstance(use, PluginUse):
            _take(use, spawned, ros, into)
        else:
            _include(trees, use, spawned, ros, into, depth)


def _include(
    trees: DescriptionTrees, include: ModelInclude, spawned: Spawned, ros: int, into: SimulatorPlugins, depth: int
) -> None:
    if include.uri is None:
        into.lose("which model an <include> brings is not known", include.element.location)
        return
    into.included += 1
    name = include.name or include.uri.strip("/").rpartition("/")[2]
    inner = replace(spawned, model=name if not spawned.model else "?")
    gather(trees, trees.of_model(include.uri), inner, ros, into, include.element.location, depth + 1)


def _take(use: PluginUse, spawned: Spawned, ros: int, into: SimulatorPlugins) -> None:
    if use.filename is None:
        into.lose("which library a plug-in is, is not known", use.element.location)
        return
    library = library_of(use.filename)
    known, own = plugins(ros).get(library), into.ours.get(library, ())
    if known is not None and (not own or any(gazebo_plugin.package == known.package for gazebo_plugin in own)):
        if not is_idle(use, known):
            into.uses.append((use, known, spawned))
    elif len(own) == 1:
        if own[0].at == use.at:
            into.built.append((use, own[0], spawned))
    elif library not in silent():
        into.lose(f"what the plug-in {use.filename[:100]} makes is not known", use.element.location)


def completed(node: Node, made: Iterable[Endpoint], lost: Mapping[str, Location | None]) -> Node:
    """The simulator's *node* with what its plug-ins make; where there may be more, that is said with the reasons."""
    ends: list[Endpoint] = []
    reason = next(iter(lost), "")
    for end in node.endpoints:
        if not any(unknown.reason == UNDECIDED for unknown in end.unknowns):
            ends.append(end)
        elif lost:
            messages = tuple(replace(u, reason=reason) if u.reason == UNDECIDED else u for u in end.unknowns)
            ends.append(replace(end, unknowns=messages))
    unknowns = tuple(Unknown("endpoints", why, place or node.location) for why, place in lost.items())
    return replace(node, endpoints=distinct((*ends, *made)), unknowns=(*node.unknowns, *unknowns))


def distinct(ends: Iterable[Endpoint]) -> tuple[Endpoint, ...]:
    """*ends* in their order, topics, services and actions that are the same once; a parameter may have a list for its value."""
    seen: dict[object, Endpoint] = {}
    for end in ends:
        seen.setdefault(id(end) if end.kind in ("getters", "setters", "parameters") else end, end)
    return tuple(seen.values())


def unpredictable(nodes: Iterable[Node], spawners: frozenset[str]) -> Iterator[str]:
    """Why models may come while the system runs: nodes that can bring some, but for the known programs that do."""
    for node in nodes:
        if node.type not in spawners and any(e.kind == "clients" and e.type in SPAWNING for e in node.endpoints):
            yield f"{node.name} may bring models while it runs"
