# SPDX-License-Identifier: Apache-2.0
"""Keeps launch facts in the order in which they are met, each once, up to a limit."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import fields
from functools import lru_cache
from operator import attrgetter
from typing import Any

from haros_ci.model.launch_facts import ArgumentDeclaration, LaunchFact, ParameterFileUse
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field

MAX_FACTS = 50_000


@dataclass(slots=True)
class Recorder:
    """Facts so far; *is_open* once something may have been set that is not known."""

    found: dict[Hashable, LaunchFact] = field(default_factory=dict)
    #: Declarations of arguments, with the launch file that makes them; whether they are used is known at the end.
    declared: dict[Hashable, tuple[ArgumentDeclaration, str]] = field(default_factory=dict)
    #: The includes that lead somewhere, by those around and the last one: each is one object, with those around.
    chains: dict[tuple[int, Location], tuple[tuple[Location, ...], tuple[Location, ...]]] = field(default_factory=dict)
    #: Launch configurations that have been read.
    read: set[str] = field(default_factory=set)
    #: What launch arguments and configurations have been given so far, by name.
    values: dict[str, dict[str, None]] = field(default_factory=dict)
    #: The parameter files of the node that is being performed.
    files: list[ParameterFileUse] = field(default_factory=list)
    is_open: bool = False
    #: ROS 1: the args that each file reads, and whether there may be more; and args that an include does not set, but its file reads.
    texts: dict[str, tuple[frozenset[str], bool]] = field(default_factory=dict)
    absent: dict[tuple[Location, str], set[str]] = field(default_factory=dict)

    def chain(self, around: tuple[Location, ...], last: Location) -> tuple[Location, ...]:
        """The includes that lead into *last*, inside of those *around*: for the same ones the same object."""
        return self.chains.setdefault((id(around), last), (around, (*around, last)))[1]

    def add(self, fact: LaunchFact) -> None:
        if len(self.found) < MAX_FACTS:
            self.found.setdefault(_key(fact), fact)

    def declare(self, declaration: ArgumentDeclaration, path: str) -> None:
        """A *declaration* that the launch file at *path* makes."""
        if len(self.declared) < MAX_FACTS:
            self.declared.setdefault(_key(declaration), (declaration, path))

    def taken(self) -> tuple[ParameterFileUse, ...]:
        """The parameter files since the last time."""
        files, self.files = tuple(self.files), []
        return files


def _key(fact: LaunchFact) -> Hashable:
    """What a fact differs by from others: its includes, up to 80, by their object (``Recorder.chain``)."""
    kind: Any = type(fact)
    return kind, id(fact.included), _values(kind)(fact)


@lru_cache
def _values(kind: Any) -> Any:
    return attrgetter(*(item.name for item in fields(kind) if item.name != "included"))
