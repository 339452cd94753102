# SPDX-License-Identifier: Apache-2.0
"""The architecture: per configuration, its nodes with all their endpoints, and the parameters set from outside.

``haros-ci model --format json`` prints it; names of attributes here are the keys there.
"""

from __future__ import annotations

from typing import Any

from haros_ci.model.dependence import Dependence
from haros_ci.model.launch_facts import LaunchFact
from haros_ci.model.location import Location
from haros_ci.model.package import Package
from haros_ci.model.presence import ALWAYS, Presence
from haros_ci.model.rates import Pace, Rates
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass, field

#: Kinds of endpoints, in the order in which they are listed.
KINDS = (
    "publishers",
    "subscribers",
    "servers",
    "clients",
    "action_servers",
    "action_clients",
    "getters",
    "setters",
    "parameters",
)

#: The kind of what a class of a library brings into the node of whoever uses it, and what its configuration is called besides.
LIBRARY = "library"

#: Where an entity was learned: the source, a launch file, a hint of the project file, the data on known nodes, or the
#: exact second tier of the C++ front end.
PROVENANCES = ("source", "launch", "hint", "known-node", "exact-tier")


@dataclass(frozen=True, slots=True)
class Unknown:
    """Why *field* of an entity is not known (its value is None, or has ``?`` for the unknown part), and where."""

    field: str
    reason: str
    location: Location | None = None


@dataclass(frozen=True, slots=True)
class Condition:
    """A statement around an entity: if, else, for, while, do, switch, catch, #if, unless; at its keyword.

    *is_early* if it stands before the entity instead, and ends the function or the turn of a loop on its other way.
    """

    statement: str
    condition: str
    location: Location
    is_early: bool = field(default=False, compare=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Qos:
    """The quality of service of a ROS 2 topic or service end: words in lower case, times in seconds.

    None is the middleware's default, ``?`` not known. *history* is ``keep_last`` or ``keep_all``, *reliability* reliable,
    best_effort or best_available, *durability* volatile, transient_local or best_available, *liveliness* automatic or
    manual_by_topic.
    """

    history: str | None = None
    depth: int | str | None = None
    reliability: str | None = None
    durability: str | None = None
    deadline: float | str | None = None
    lifespan: float | str | None = None
    liveliness: str | None = None
    lease: float | str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Endpoint:
    """One end of a topic, service, action or parameter. *kind* is one of ``KINDS``; ``parameters`` are ROS 2 declarations.

    *name* is resolved and remapped, *original_name* resolved before remapping, *written* as the call gives it, ``?`` for unknown
    parts (None if no call tells). *value* is a getter's or a declaration's
    default in the code, or what a setter writes; None if it has none or it is unknown. *effective* is what a declared
    parameter has once launch files and YAML are applied, *range* its least and greatest value and step, *is_dynamic* whether it
    may change its type, or whether that is not known. *is_strict* says that the call fails, and nobody around it catches that: a
    declaration where the parameter has no value, a reading where it is not declared. *is_ruled_out* says that a condition around it
    does not hold as things are, so that it is not made. *queue_size* and
    *latched* are of ROS 1 topics, *qos* of ROS 2 topics and services. *conditions* stand around it, *early_ways* before it: HAROS, and
    what checks and queries call conditional, know the former alone.
    """

    kind: str
    name: str
    original_name: str
    type: str | None
    location: Location | None
    conditions: tuple[Condition, ...] = ()
    early_ways: tuple[Condition, ...] = ()
    queue_size: int | None = None
    latched: bool | None = None
    value: Any = None
    implicit: bool = False
    source: str = "source"
    unknowns: tuple[Unknown, ...] = ()
    qos: Qos | None = None
    effective: Any = None
    read_only: bool | None = None
    range: tuple[float | None, float | None, float | None] | None = None
    written: str | None = field(default=None, compare=False)
    is_dynamic: bool = False
    is_strict: bool = False
    is_ruled_out: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class RemapRule:
    """Where a remapping rule of a node stands. *source* and *target* are as written, substitutions performed.

    *source_name* and *target_name* are full, None where a part is not known or the rule is none that names a topic. *node* is the
    one node of the process that it is for (``node:from:=to``), "" for all; *is_global* if it is set for all nodes
    of a scope (ROS 2 SetRemap, ROS 1 a ``<remap>`` outside the ``<node>``). *conditions* are undecided ones around the rule itself.
    """

    source: str
    target: str
    location: Location
    source_name: str | None = None
    target_name: str | None = None
    node: str = ""
    presence: Presence = ALWAYS
    conditions: tuple[Condition, ...] = ()
    is_global: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Node:
    """A node of a running system. *kind* is node, nodelet, component or lifecycle; *ros* is 1 or 2; *type* the executable, or a nodelet's class as looked up.

    Of the kind library is what a class of a library, its *type*, brings into the node of whoever uses it.
    *package* and *type* are ``kobuki_node`` and ``KobukiNodelet`` for ``kobuki_node/KobukiNodelet``; *class_name* is the C++
    class of a nodelet; *container* the manager's full name; *process* is shared by the nodes of one process.
    *remaps* are fully resolved pairs, *rules* the remapping rules that they come from in the order in which they apply;
    *arguments* is the text of the launch file's ``args``. *takes_undeclared* says of a ROS 2 node
    that it has, or may have, parameters that it does not declare.
    """

    name: str
    kind: str
    package: str
    type: str
    arguments: str = ""
    remaps: tuple[tuple[str, str], ...] = ()
    rules: tuple[RemapRule, ...] = ()
    conditions: tuple[Condition, ...] = ()
    location: Location | None = None
    endpoints: tuple[Endpoint, ...] = ()
    class_name: str | None = None
    container: str | None = None
    process: str | None = None
    source: str = "source"
    unknowns: tuple[Unknown, ...] = ()
    ros: int = 1
    #: Under which launch arguments it is there.
    presence: Presence = ()
    takes_undeclared: bool = False
    #: The timers and rates that it makes, by place.
    paces: tuple[Pace, ...] = field(default=(), compare=False)
    #: Where its process makes two nodes of this name that there are at the same time; () if none are known.
    twins: tuple[Location, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Parameter:
    """A parameter set from outside: by a launch file (*location*: its tag) or YAML (*origin*: the line that says it)."""

    name: str
    type: str | None
    value: Any
    conditions: tuple[Condition, ...] = ()
    location: Location | None = None
    origin: Location | None = None
    source: str = "launch"
    unknowns: tuple[Unknown, ...] = ()
    #: Under which launch arguments it is there.
    presence: Presence = ()
    #: The command whose output is its value, ``?`` for what is not known in it; "" without one.
    command: str = field(default="", compare=False)
    #: Whether it stands in the tag of a node, whose own it is.
    is_of_node: bool = field(default=False, compare=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Configuration:
    """One system: the nodes that *launch* (paths ``package/path``) starts together. *arguments* are its launch args.

    *closed* says that nothing outside it takes part, so that what is not there is missing. *launch_facts* is what its
    launch files say besides, for checks.
    """

    name: str
    launch: tuple[str, ...] = ()
    nodes: tuple[Node, ...] = ()
    parameters: tuple[Parameter, ...] = ()
    arguments: tuple[tuple[str, str], ...] = ()
    user_data: Any = None
    closed: bool = False
    #: Nodes that are there under other arguments only, each with its presence, and what is set under them.
    alternatives: tuple[Node, ...] = ()
    alternative_parameters: tuple[Parameter, ...] = ()
    launch_facts: tuple[LaunchFact, ...] = ()
    #: Whether it is a program that no build installs, started by its path: checks pass it over.
    is_loose: bool = False
    #: How often its nodes publish, where that was asked for.
    rates: Rates | None = field(default=None, compare=False)
    #: Which inputs of its nodes can cause which outputs, where that was asked for.
    dependence: Dependence | None = field(default=None, compare=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Architecture:
    """All configurations of a workspace; *problems* become notifications."""

    configurations: tuple[Configuration, ...] = ()
    packages: tuple[Package, ...] = ()
    problems: tuple[Problem, ...] = ()
