# SPDX-License-Identifier: Apache-2.0
"""A ROS 2 configuration: what launch files start, each process followed; every node of it with its own endpoints."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace

from haros_ci.follow.follow import Entry
from haros_ci.follow.made import MadeEntity
from haros_ci.follow.ros import outside_nodes
from haros_ci.follow.ros.ends import endpoints
from haros_ci.follow.ros.paces import paces
from haros_ci.follow.ros.ros2_nodes import ALONE, SIM_TIME, UNDECLARED
from haros_ci.graph.given_parameters import InContainer, Parameters
from haros_ci.graph.names import clean
from haros_ci.graph.parameters import ParameterServer
from haros_ci.graph.remap_rules import of_ros2_node, ros2_rules
from haros_ci.graph.ros2_process import RemappingRule, RosNode, ros_arguments, rule_of, schemed
from haros_ci.graph.words import shell_words, with_parts
from haros_ci.keeping.kept import Followed
from haros_ci.model.architecture import KINDS, Endpoint, Node, Parameter, Unknown
from haros_ci.model.launch import LaunchedNode
from haros_ci.model.location import Location
from haros_ci.model.presence import together
from haros_ci.model.workspace import Problem
from haros_ci.systems import outside
from haros_ci.systems.following import Controller, Types, incomplete
from haros_ci.systems.ros2_implicit import implicit
from haros_ci.systems.ros2_processes import Started, run_process
from haros_ci.systems.system import PROGRAM, TREES, Job
from haros_ci.values.abstract import Known, Opaque

NOTHING = ParameterServer(())
#: Kinds of endpoints that rules for services rename.
SERVICES = ("servers", "clients")
#: What a configuration is called besides in which a node is followed with every plug-in.
PLUGINS = "plug-ins"
#: Why nothing is known of a process.
UNSEEN = "no node is seen in its program"


def launched(types: Types, node: LaunchedNode, containers: Mapping[str, LaunchedNode]) -> Job:
    """What a launch file starts: a process with its nodes, or a component of one of *containers* (by full name)."""
    container = containers.get(node.container or "")
    controller = types.controllers.get(node.type) if node.kind == "node" and node.container is not None else None
    started = _started_in(node, container, controller is not None)
    key = (node.package, node.type)
    if node.kind in ("node", "lifecycle") and not (node.path or key in types.ros2_programs):
        key = types.handed(*key) or key  # a shell script that is another program
        node = replace(node, package=key[0], type=key[1])
    found = types.components.get(key) if node.kind == "component" else types.ros2_programs.get(key)
    if controller is not None:
        found = controller.entry, controller.files
    if node.path:
        found = types.file(node.path)
    basic = _basic(node, controller)
    if found is None:
        outside_it = lambda: (_not_followed(types, node, basic, started), ())  # noqa: E731 - one of two bodies of the same name
        return Job(basic, None, outside_it, parameters=started.parameters, files=node.files)
    entry, files = found
    return Job(
        basic,
        id(entry),
        lambda: nodes_of(types, entry, files, basic, started, node.name is not None or node.namespace is not None),
        size_of(types, files),
        started.parameters,
        node.files,
        is_loaded=controller is not None,
    )


def _started_in(node: LaunchedNode, container: LaunchedNode | None, is_controller: bool) -> Started:
    """What a launched node begins with, in its *container* if that is launched too."""
    started = started_by(node)
    if node.kind == "component" and container is not None:
        whole = clean(f"{node.namespace or '/'}/{node.name}") if node.name is not None else None
        around = started_by(container).parameters
        started = replace(started, parameters=InContainer(started.parameters, whole, around))
    if is_controller:
        naming = _naming(node.container or "") if container is not None else ()
        started = replace(started, is_component=True, around=naming)
    return started


def _basic(node: LaunchedNode, controller: Controller | None) -> Node:
    """A launched node without what its code makes."""
    name = clean(f"{node.namespace or '/'}/{node.name or '?'}")
    return Node(
        name=name,
        kind="node" if node.kind == "container" else node.kind,
        package=controller.package if controller is not None else node.package,
        type=node.type,
        arguments=node.arguments,
        conditions=node.conditions,
        presence=node.presence,
        location=node.location,
        container=node.container,
        process=node.container or name,
        source="launch",
        unknowns=node.unknowns,
        class_name=controller.type if controller is not None else node.type if node.kind == "component" else None,
        ros=2,
    )


def started_by(node: LaunchedNode) -> Started:
    """The rules, parameters and words that a launched node begins with."""
    message = ros_arguments(_words(node.ros_arguments, "--ros-args"))
    more = ros_arguments(_words(node.arguments))
    naming: list[RemappingRule] = []
    if node.name is not None:
        naming.append(RemappingRule("", "__node", node.name))
    if node.namespace is not None:
        naming.append(RemappingRule("", "__ns", node.namespace))
    remaps = [rule for source, target, _ in node.remaps if (rule := rule_of(f"{source}:={target}")) is not None]
    rules = (*more.rules, *message.rules, *naming, *remaps)
    around: tuple[RemappingRule, ...] = ()
    if node.kind == "component" and node.container is not None:
        around = _naming(node.container)
    written = ros2_rules((*more.rules, *message.rules), node.rules, node.location)
    words = with_parts(node.arguments, more.rest)
    return Started(
        rules, Parameters(node.parameters), words, node.kind == "component", written, around, is_launched=True
    )


def _naming(full: str) -> tuple[RemappingRule, ...]:
    """The rules that a launch file gives a process whose node is to have that name; none where it is not known."""
    space, _, name = full.rpartition("/")
    return () if "?" in full else (RemappingRule("", "__node", name), RemappingRule("", "__ns", space or "/"))


def _words(text: str, first: str = "") -> list[str]:
    words = shell_words(text)
    return [first, *words] if first and words and words[0] != first else words


def alone(
    types: Types,
    package: str,
    name: str,
    is_component: bool = False,
    label: str = "",
    found: tuple[Entry, frozenset[str]] | None = None,
) -> Job:
    """A node type started by itself, under the name that it gives itself; perhaps with every plug-in of the workspace.

    *label* is ``PLUGINS`` then, or ``TREES``; *found* is the program where the tables do not have it.
    """
    entry, files = found or (types.components if is_component else types.ros2_programs)[package, name]
    line = entry.function.line if entry.function else entry.definition.line if entry.definition else 1
    chosen = f"/{name.rpartition('::')[2]}"
    node = Node(
        name=chosen,
        kind="component" if is_component else "node",
        package=package,
        type=name,
        location=Location(entry.source.path, line),
        process=chosen,
        class_name=name if is_component else None,
        ros=2,
    )
    started = Started((), Parameters(()), (), is_component, has_plugins=label == PLUGINS, has_trees=label == TREES)
    return Job(
        node,
        (id(entry), label) if label == PLUGINS else id(entry),
        lambda: nodes_of(types, entry, files, node, started, False),
        size_of(types, files),
        label=label,
    )


def plugin(types: Types, package: str, name: str) -> Job:
    """A plug-in of a program outside the workspace by itself, on the node that this program has by default."""
    entry, files = types.hosted[package, name]
    assert entry.definition is not None
    place = Location(entry.source.path, entry.definition.line)
    node = Node(
        name="/?", kind="node", package=package, type=name, location=place, process="/?", class_name=name, ros=2
    )
    started = Started((), Parameters(()), (), False)

    def follow() -> tuple[tuple[Node, ...], tuple[Problem, ...]]:
        nodes, problems = nodes_of(types, entry, files, node, started, False)
        makes = any(not end.implicit for node in nodes for end in node.endpoints)
        return (nodes if makes else (replace(node, kind=PROGRAM),)), problems

    return Job(node, id(entry), follow, size_of(types, files))


def size_of(types: Types, files: frozenset[str]) -> int:
    """The number of functions in *files*."""
    sources = types.programs.sources
    return sum(len(sources[path].program.functions) for path in files if path in sources)


def nodes_of(
    types: Types, entry: Entry, files: frozenset[str], node: Node, started: Started, is_named: bool
) -> tuple[tuple[Node, ...], tuple[Problem, ...]]:
    """The nodes of a process with what each has."""
    followed = run_process(types, entry, files, started, node)
    unknowns = (*node.unknowns, *incomplete(followed, entry, node.location))
    if not followed.nodes:
        ends = endpoints(followed.made, lambda item: item.name, NOTHING.get)
        is_node = is_named or ends or node.source == "launch" or outside_nodes.NO_NODE in followed.gaps
        if node.source != "launch":
            node = replace(node, name="/?", process="/?") if is_node else node
        made = replace(node, kind=node.kind if is_node else PROGRAM, endpoints=ends, paces=paces(followed.made))
        made = replace(made, unknowns=(*unknowns, *_of_no_node(made, followed)))
        return (_with_rules(made, started),), followed.problems
    found: list[Node] = []
    ends_of = _ends(types, followed)
    main = followed.nodes[0]
    twins = {twin.name: (twin.first, twin.second) for twin in followed.twins}
    for other_node in followed.nodes:
        if other_node is not main and other_node.name in (other.name for other in found):
            continue  # the same node on another way
        own = [] if other_node is not main else list(unknowns)
        if other_node.why is not None:
            own.append(Unknown("name", other_node.why[0], other_node.why[1] or other_node.location))
        kind = "lifecycle" if other_node.kind == "lifecycle" else node.kind if other_node is main else "node"
        ends = ends_of.get(other_node.name, ())
        found.append(
            replace(
                node,
                name=other_node.name,
                kind=kind,
                process=node.container or main.name,
                class_name=node.class_name if other_node is main and node.class_name else _class_name(other_node),
                remaps=_remaps(other_node, ends),
                rules=of_ros2_node(started.written, other_node.whole),
                conditions=(*node.conditions, *other_node.conditions),
                location=node.location if node.source == "launch" and other_node is main else other_node.location,
                source=node.source if other_node is main else "source",
                unknowns=tuple(own),
                twins=twins.get(other_node.name, ()),
                takes_undeclared=other_node.options.get(UNDECLARED, False),
                endpoints=_sorted((*ends, *_implicit(other_node, kind, started, ends))),
                paces=paces(followed.made, other_node.name),
            )
        )
    return tuple(found), followed.problems


def _of_no_node(node: Node, followed: Followed) -> Iterable[Unknown]:
    """What is not known of a process of which no node is seen."""
    if node.kind != PROGRAM and not followed.gaps and not followed.problems:
        yield Unknown("endpoints", UNSEEN, node.location)
    if node.kind != PROGRAM and "?" in node.name and all(unknown.field != "name" for unknown in node.unknowns):
        yield Unknown("name", UNSEEN, node.location)


def _ends(types: Types, followed: Followed) -> Mapping[str, tuple[Endpoint, ...]]:
    """The endpoints of each node of a process, made once for all that are alike."""
    if id(followed) not in types.ends:
        made = {name: endpoints(items, final, NOTHING.get) for name, items in grouped(followed).items()}
        types.ends[id(followed)] = (followed, made)
    return types.ends[id(followed)][1]


def _class_name(node: RosNode) -> str | None:
    return None if node.class_name in ("rclcpp::Node", "rclpy.node.Node") else node.class_name


def _implicit(node: RosNode, kind: str, started: Started, ends: tuple[Endpoint, ...]) -> Iterable[Endpoint]:
    sim = None if node.options.get(ALONE) else started.parameters.get(node.name, SIM_TIME)
    value = node.options.get(SIM_TIME, sim.value if isinstance(sim, Known) else None)
    there = {(end.kind, end.name) for end in ends}
    for end in implicit(node.name, kind, node.options, value, node.location):
        final_name = end.name if end.kind == "parameters" else node.remap(end.name, end.kind in SERVICES)
        if isinstance(sim, Opaque) and value is None and end.kind == "parameters":
            end = replace(end, effective=None, unknowns=(Unknown("value", sim.reason, sim.location),))
        if (end.kind, final_name) not in there:
            yield end if final_name == end.name else replace(end, name=final_name)


def _sorted(ends: Iterable[Endpoint]) -> tuple[Endpoint, ...]:
    return tuple(
        sorted(
            ends, key=lambda e: (KINDS.index(e.kind), e.location.sort_key if e.location else (), e.name, e.type or "")
        )
    )


def grouped(followed: Followed) -> Mapping[str, tuple[MadeEntity, ...]]:
    """What was made, by the full name of the node that has it; what has none is the first node's."""
    first = followed.nodes[0].name
    found: dict[str, list[MadeEntity]] = {}
    for item in followed.made:
        found.setdefault(item.node.name if item.node is not None else first, []).append(item)
    return {name: tuple(items) for name, items in found.items()}


def final(item: MadeEntity) -> str:
    """The name of what is made after remapping; parameters are not remapped."""
    if item.node is None or item.kind in ("getters", "setters", "parameters") or "?" in item.name:
        return item.name
    return item.node.remap(item.name, item.kind in SERVICES)


def _remaps(node: RosNode, ends: tuple[Endpoint, ...]) -> tuple[tuple[str, str], ...]:
    rules = {
        node.expand(schemed(rule.source)[1]): node.target(rule)
        for rule in reversed(node.rules)
        if not rule.source.startswith("__")
        and "?" not in rule.source
        and rule.node in ("", node.name.rpartition("/")[2])
    }
    return tuple(sorted(rules.items()))


def _not_followed(types: Types, launched_node: LaunchedNode, node: Node, started: Started) -> tuple[Node, ...]:
    """A node whose code is not in the workspace: with what is known of its type."""
    made = outside.ros2_described(node, types, launched_node, started.rules, started.parameters)
    return (_with_rules(made, started),)


def _with_rules(node: Node, started: Started) -> Node:
    """*node* with the rules of launch files by the names that they have there."""
    space = node.name.rpartition("/")[0] or "/"
    itself = RosNode(node.name, space, space, node.kind, "", node.location or Location(""))
    return replace(node, rules=of_ros2_node(started.written, itself))


def given_parameters(nodes: Iterable[tuple[Node, Parameters]]) -> tuple[Parameter, ...]:
    """The parameters that each node is given from outside, by full name of node and parameter."""
    found: dict[tuple[str, Location, Location | None], Parameter] = {}
    for node, parameters in nodes:
        for name, rule in sorted(parameters.of(node.name).items()):
            made = Parameter(
                name=f"{node.name}:{name}",
                type=rule.type,
                value=rule.value,
                conditions=(*node.conditions, *rule.conditions),
                presence=together(node.presence, rule.presence) or node.presence,
                location=rule.location,
                origin=rule.origin,
                unknowns=rule.unknowns,
            )
            found[made.name, rule.location, rule.origin] = made
    return tuple(found.values())


Followable = Callable[[], tuple[tuple[Node, ...], tuple[Problem, ...]]]
