# SPDX-License-Identifier: Apache-2.0
"""What is known of a node type: its endpoints as they are written, before there is a node."""

from __future__ import annotations

from typing import Any

from haros_ci.records import dataclass
from haros_ci.systems.known.text import Repetition, Template, Test


@dataclass(frozen=True, slots=True)
class Why:
    """The *reason* why something cannot be known, where a value would stand."""

    reason: str


#: A policy of a quality of service and what it is; ``preset`` comes first, where there is one.
Policies = tuple[tuple[str, "str | int | float | Test | Why"], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class KnownEndpoint:
    """One entry; *present* and *absent* are its ``if`` and ``unless``.

    *type* and *value* are None where a reason stands instead of them; *type_text* is a type with holes. *qos* and
    *read_only* are of ROS 2.
    """

    kind: str
    name: Template
    type: str | None
    type_reason: str = ""
    type_text: Template | None = None
    queue_size: int | Test | None = None
    latched: bool | Test | None = None
    qos: Policies | None = None
    read_only: bool | None = None
    value: Any = None
    value_reason: str = ""
    implicit: bool = False
    each: Repetition | None = None
    present: tuple[Test, ...] = ()
    absent: tuple[Test, ...] = ()
    distributions: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class KnownNode:
    """A node type, or with *nodelet* a nodelet by its look-up name; *source* is the page that describes it.

    *ros* is 1, 2, or None for both. Of ROS 2: *component* is the class that can be loaded in place of the executable,
    *lifecycle* a managed node, *plugin* a node that a host makes of a plug-in (*type* is its look-up name), *node_name*
    what the program calls the node if nothing else does.
    """

    package: str
    type: str
    nodelet: bool = False
    ros: int | None = None
    component: str = ""
    lifecycle: bool = False
    plugin: bool = False
    node_name: str = ""
    #: A script that is not followed: it is known where its package is in the workspace, too.
    script: bool = False
    source: str = ""
    distributions: tuple[str, ...] = ()
    endpoints: tuple[KnownEndpoint, ...] = ()
