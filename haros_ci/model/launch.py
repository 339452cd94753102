# SPDX-License-Identifier: Apache-2.0
"""What a launch file starts and sets, once its arguments are chosen and its includes are read."""

from __future__ import annotations

from typing import Any

from haros_ci.model.architecture import Condition, Parameter, RemapRule, Unknown
from haros_ci.model.launch_facts import LaunchFact, ParameterFileUse
from haros_ci.model.location import Location
from haros_ci.model.presence import Presence
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Started:
    """One ``<node>`` or ``<test>`` tag. *name* is full; *namespace* is the one it runs in (``/`` or ``/a/b``).

    *remaps* are in scope order, as written but substituted (to be resolved by the node's name and namespace); a later
    pair with the same source wins. *arguments* is the substituted ``args``. What could not be substituted is ``?`` in
    the text, with an entry in *unknowns*; the target of a remap whose condition is undecided is ``?``, too. *rules* are
    the same remaps as they are written, with their conditions, names not yet resolved.
    """

    name: str
    namespace: str
    package: str
    type: str
    location: Location
    arguments: str = ""
    remaps: tuple[tuple[str, str, Location], ...] = ()
    rules: tuple[RemapRule, ...] = ()
    conditions: tuple[Condition, ...] = ()
    environment: tuple[tuple[str, str], ...] = ()
    machine: str | None = None
    is_test: bool = False
    respawn: bool = False
    required: bool = False
    launch_prefix: str = ""
    unknowns: tuple[Unknown, ...] = ()
    #: Under which launch arguments it is there.
    presence: Presence = ()
    #: What its tag sets, where a part of its name is not known.
    own: tuple[Parameter, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Launched:
    """The whole of a launch file in one context.

    *arguments* are its top-level args with their values (``?`` if unknown), *files* all files read, *includes* those of
    them that a launch file includes, both sorted. *alternatives* and *alternative_parameters* are there under other
    arguments only. *facts* is what the launch files say besides, in launch order.
    """

    nodes: tuple[Started, ...] = ()
    parameters: tuple[Parameter, ...] = ()
    arguments: tuple[tuple[str, Any], ...] = ()
    files: tuple[str, ...] = ()
    includes: tuple[str, ...] = ()
    problems: tuple[Problem, ...] = ()
    alternatives: tuple[Started, ...] = ()
    alternative_parameters: tuple[Parameter, ...] = ()
    facts: tuple[LaunchFact, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ParameterRule:
    """A parameter that ROS 2 nodes are given: *node* is the pattern of full node names that it is for.

    In it ``*`` is one part of a name, ``**`` any number of them (``/**``, ``/*/planner``, ``/ns/node``); *name* is dotted.
    *location* is the tag or call, *origin* the line of YAML. An unknown *value* is None with an entry in *unknowns*; a
    parameter file that is not known is one rule with the name ``?``.
    """

    node: str
    name: str
    type: str | None
    value: Any
    location: Location
    origin: Location | None = None
    conditions: tuple[Condition, ...] = ()
    unknowns: tuple[Unknown, ...] = ()
    #: Under which launch arguments it is there.
    presence: Presence = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchedNode:
    """A ROS 2 node, container or composable that a launch file starts.

    *kind* is node, lifecycle, container or component, or ``loading``: no node, but a command that asks a controller manager for
    one. *type* is the executable, a component's full class (``ns::Class``). *name* has no namespace, None where the program names itself; *namespace* is full, None where nothing
    gives it. *container* is the full name of a component's container. *parameters* are in order: of those that match
    a node the last counts, but one that names the node outright beats a wildcard of the same source. *remaps* are in order, the first
    that matches counts; a source may be ``node:from``; *rules* are the same, as in ``Started``. *arguments* is the substituted ``args``, *ros_arguments* what
    follows ``--ros-args``; *files* are the parameter files. What could not be substituted is ``?`` in the text, with an entry in *unknowns*.
    """

    kind: str
    package: str
    type: str
    location: Location
    name: str | None = None
    namespace: str | None = None
    container: str | None = None
    parameters: tuple[ParameterRule, ...] = ()
    remaps: tuple[tuple[str, str, Location], ...] = ()
    rules: tuple[RemapRule, ...] = ()
    files: tuple[ParameterFileUse, ...] = ()
    arguments: str = ""
    ros_arguments: str = ""
    conditions: tuple[Condition, ...] = ()
    environment: tuple[tuple[str, str], ...] = ()
    launch_prefix: str = ""
    respawn: bool = False
    unknowns: tuple[Unknown, ...] = ()
    #: Under which launch arguments it is there.
    presence: Presence = ()
    #: The file that an interpreter runs, where that is no program of the package.
    path: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchedSystem:
    """The whole of a ROS 2 launch file in one context; *arguments*, *files* and *includes* as in ``Launched``."""

    nodes: tuple[LaunchedNode, ...] = ()
    arguments: tuple[tuple[str, Any], ...] = ()
    files: tuple[str, ...] = ()
    includes: tuple[str, ...] = ()
    problems: tuple[Problem, ...] = ()
    alternatives: tuple[LaunchedNode, ...] = ()
    facts: tuple[LaunchFact, ...] = ()


@dataclass(frozen=True, slots=True)
class LaunchElement:
    """One tag of a launch file as it is written; *line* and *column* are of its ``<``.

    *text* is the character data directly in it, comments dropped, "" if it is blank. *text_lines* are pairs of an
    offset in *text* and the line of the file that it stands on, one for the beginning and one after each gap;
    between them each line feed counts one.
    """

    tag: str
    line: int
    column: int
    attributes: tuple[tuple[str, str], ...] = ()
    text: str = ""
    text_lines: tuple[tuple[int, int], ...] = ()
    children: tuple[LaunchElement, ...] = ()

    def get(self, name: str) -> str | None:
        """The attribute *name* as written; None if it is not there."""
        return next((value for key, value in self.attributes if key == name), None)


@dataclass(frozen=True, slots=True)
class LaunchFile:
    """A launch file's facts: its tags, None if it is not XML. *problems* are pairs of a line and what is wrong."""

    root: LaunchElement | None
    problems: tuple[tuple[int, str], ...] = ()
