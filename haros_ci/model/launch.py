# SPDX-License-Identifier: Apache-2.0
"""What a launch file starts and sets, once its arguments are chosen and its includes are read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from haros_ci.model.architecture import Condition, Parameter, Unknown
from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem


@dataclass(frozen=True, slots=True, kw_only=True)
class Started:
    """One ``<node>`` or ``<test>`` tag. *name* is full; *namespace* is the one it runs in (``/`` or ``/a/b``).

    *remaps* are in scope order, as written but substituted (to be resolved by the node's name and namespace); a later pair with the same
    source wins. *arguments* is the substituted ``args``. What could not be substituted is ``?`` in the text, with an entry in *unknowns*.
    """

    name: str
    namespace: str
    package: str
    type: str
    location: Location
    arguments: str = ""
    remaps: tuple[tuple[str, str, Location], ...] = ()
    conditions: tuple[Condition, ...] = ()
    environment: tuple[tuple[str, str], ...] = ()
    machine: str | None = None
    is_test: bool = False
    respawn: bool = False
    required: bool = False
    launch_prefix: str = ""
    unknowns: tuple[Unknown, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Launched:
    """The whole of a launch file in one context. *arguments* are its top-level args with their values; *files* all files read, sorted."""

    nodes: tuple[Started, ...] = ()
    parameters: tuple[Parameter, ...] = ()
    arguments: tuple[tuple[str, Any], ...] = ()
    files: tuple[str, ...] = ()
    includes: tuple[str, ...] = ()
    problems: tuple[Problem, ...] = ()
