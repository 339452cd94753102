# SPDX-License-Identifier: Apache-2.0
"""A configuration: what launch files start, each node followed with its names, parameters and remappings."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import replace
from functools import partial
from typing import Any

from haros_ci.follow.follow import Entry
from haros_ci.follow.ros import behavior_trees
from haros_ci.follow.ros.ends import UNNAMED, by, endpoints
from haros_ci.follow.ros.own_name import ANONYMOUS, OwnName, own_name
from haros_ci.follow.ros.paces import paces
from haros_ci.follow.walk import Renamed
from haros_ci.graph.given_parameters import Parameters
from haros_ci.graph.names import clean, resolve, resolve_target
from haros_ci.graph.parameters import ParameterServer, own_parameters
from haros_ci.graph.remap_rules import of_ros1_node, written_rule
from haros_ci.graph.words import scalar, split
from haros_ci.keeping.kept import Followed
from haros_ci.model.architecture import KINDS, Node, Unknown
from haros_ci.model.build import PluginClass
from haros_ci.model.launch import Started
from haros_ci.model.launch_facts import ParameterFileUse
from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass
from haros_ci.systems import outside
from haros_ci.systems.following import Instance, Types, incomplete, run_node
from haros_ci.values.abstract import Known, Opaque, Value

#: What the arguments of the nodelet program can begin with.
LOAD, STANDALONE, MANAGER = "load", "standalone", "manager"
#: What a configuration is called besides in which a node is followed with the nodes of every behaviour tree.
TREES = "behaviour trees"
#: The kind of what is started alone and is no node: it gives itself no name, and makes nothing.
PROGRAM = "program"


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
    #: Whether it is a plug-in that is loaded into a process of others, and has a configuration of its own.
    is_loaded: bool = False
    #: The parameter server of ROS 1 that it reads.
    server: ParameterServer | None = None


def launched(types: Types, started: Started, server: ParameterServer) -> Job:
    """The node that a launch file starts."""
    if (started.package, started.type) not in types.startable:
        handed = types.handed(started.package, started.type)  # a shell script that is another program
        started = started if handed is None else replace(started, package=handed[0], type=handed[1])
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
    if (started.package, started.type) == ("nodelet", "nodelet") and words.rest:
        node, found, process = _nodelet(types, node, words.rest, namespace)
    private = {  # where __ns:= moves the node, they are not below the name that the launch file gives it
        clean(f"{started.name}/{name}"): Known(scalar(value)) for name, value in words.private if "?" not in value
    }

    def parameter(name: str) -> Value | None:
        if own is not None and name.startswith(f"{started.name}/"):
            return private.get(name) or server.get_private(name, started.name, own, started.conditions)
        return private.get(name) or server.get_for(started.name, name, started.conditions)

    own = own_parameters(started.name, started.own) if "?" in started.name else None

    if found is None:
        known = types.known(node.package, outside.look_up(node), 1)
        provided = (namespace, words.rest, parameter, remaps)
        return Job(node, None, lambda: ((outside.described(node, types, known, *provided),), ()))
    entry, files = found
    arguments = None if any("?" in word for word in words.rest) else words.rest
    kept = {"is_launched": True, "has_own": True, "remaps_process": process == started.name}
    instance = Instance(started.name, namespace, arguments, remaps, process, **kept)

    def follow_it() -> tuple[tuple[Node, ...], tuple[Problem, ...]]:
        followed = run_node(types, entry, files, instance, parameter)
        unknowns = (*node.unknowns, *incomplete(followed, entry, node.location))
        ends = endpoints(followed.made, by(remaps), server.get if own is None else parameter)
        return (replace(node, endpoints=ends, unknowns=unknowns, paces=paces(followed.made)),), followed.problems

    return Job(node, (id(entry), instance.name), follow_it, _size(types, files), server=server)


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


def alone(
    types: Types, package: str, name: str, label: str = "", found: tuple[Entry, frozenset[str]] | None = None
) -> Job:
    """A node type started by itself, under the name that it gives itself; ``?`` for what is not known of it.

    With the *label* ``TREES`` a behaviour tree that is not known has the nodes of every one; *found* is the program where the tables do not have it.
    """
    entry, files = found or types.executables[package, name]
    server = ParameterServer(())
    location = Location(entry.source.path, entry.function.line if entry.function is not None else 1)
    chosen = f"/{name.partition('.')[0]}"
    node = Node(name=chosen, kind="node", package=package, type=name, location=location, process=chosen)

    def under(full: str, renames: Callable[[Value, bool | None], bool] = lambda own, anonymous: False) -> Followed:
        return run_node(
            types,
            entry,
            files,
            Instance(full, "/", (), {}, full, has_own=True, has_trees=label == TREES),
            partial(server.get_for, chosen) if label != TREES else lambda name: Opaque(behavior_trees.ANY),
            renames,
        )

    def follow_it() -> tuple[tuple[Node, ...], tuple[Problem, ...]]:
        own = OwnName(chosen)

        def renames(value: Value, is_anonymous: bool | None) -> bool:
            nonlocal own
            own = own_name(((value, is_anonymous),))
            return own.name != chosen

        try:
            followed = under(chosen, renames)
        except Renamed:
            followed = under(own.name)
        names = followed.names
        if names or any(item.kind in KINDS for item in followed.made):  # else it is a program that is no node
            before, own = own.name, own_name(names)
            followed = followed if own.name == before else under(own.name)
        unknowns = incomplete(followed, entry, location)
        if own.reason is not None:
            unknowns = (*unknowns, Unknown("name", own.reason, own.location or location))
        why = ANONYMOUS if own.reason is None else f"{UNNAMED}: {own.reason}"
        ends = endpoints(followed.made, by({}), server.get, why)
        made = replace(node, name=own.name, process=own.name, unknowns=unknowns, endpoints=ends)
        made = replace(made, paces=paces(followed.made))
        return (made if ends or names else replace(made, kind=PROGRAM),), followed.problems

    return Job(node, (id(entry), chosen), follow_it, _size(types, files), label=label, server=server)


#: Why a nodelet that nothing loads has no name of its own (names.cpp of roscpp).
COLON = "its look-up name has a colon, which no node name may have: whoever loads it names it"


def standalone(types: Types, look_up: str) -> Job:
    """A nodelet in a process of its own, under the name that the nodelet program gives it (``pkg_Class``: nodelet.cpp, ``getDefaultName``)."""
    described, entry, files = types.nodelets[look_up]
    is_invalid = ":" in look_up
    name = "/?" if is_invalid else "/" + "_".join(part for part in look_up.split("/") if part)
    instance = Instance(name, "/", (), {}, name, has_own=True)
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
        followed = run_node(types, entry, files, instance, partial(server.get_for, name))
        unknowns = incomplete(followed, entry, node.location)
        if is_invalid:
            unknowns = (*unknowns, Unknown("name", COLON, node.location))
        ends = endpoints(followed.made, by({}), server.get, f"{UNNAMED}: {COLON}" if is_invalid else UNNAMED)
        made = replace(node, unknowns=unknowns, endpoints=ends)
        return (replace(made, paces=paces(followed.made)),), followed.problems

    return Job(node, (id(entry), instance.name), follow_it, _size(types, files), server=server)
