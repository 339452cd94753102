# SPDX-License-Identifier: Apache-2.0
"""What is known of a node type: its endpoints as they are written, before there is a node."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from haros_ci.link.known.text import Each, Template, Test


@dataclass(frozen=True, slots=True, kw_only=True)
class KnownEndpoint:
    """One entry; *present* and *absent* are its ``if`` and ``unless``.

    *type* and *value* are None where a reason stands instead of them.
    """

    kind: str
    name: Template
    type: str | None
    type_reason: str = ""
    queue_size: int | Test | None = None
    latched: bool | Test | None = None
    value: Any = None
    value_reason: str = ""
    implicit: bool = False
    each: Each | None = None
    present: tuple[Test, ...] = ()
    absent: tuple[Test, ...] = ()
    distributions: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class KnownNode:
    """A node type, or with *nodelet* a nodelet by its look-up name; *source* is the page that describes it."""

    package: str
    type: str
    nodelet: bool = False
    source: str = ""
    distributions: tuple[str, ...] = ()
    endpoints: tuple[KnownEndpoint, ...] = ()
