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

    *remaps* are in scope order, as written but substituted (to be resolved by the node's name and namespace); a later
    pair with the same source wins. *arguments* is the substituted ``args``. What could not be substituted is ``?`` in
    the text, with an entry in *unknowns*; the target of a remap whose condition is undecided is ``?``, too.
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
    """The whole of a launch file in one context.

    *arguments* are its top-level args with their values (``?`` if unknown), *files* all files read, *includes* those of
    them that a launch file includes, both sorted.
    """

    nodes: tuple[Started, ...] = ()
    parameters: tuple[Parameter, ...] = ()
    arguments: tuple[tuple[str, Any], ...] = ()
    files: tuple[str, ...] = ()
    includes: tuple[str, ...] = ()
    problems: tuple[Problem, ...] = ()


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
