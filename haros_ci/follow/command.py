# SPDX-License-Identifier: Apache-2.0
"""What a node knows of the commands of its program (click, Typer)."""

from __future__ import annotations

from haros_ci.records import dataclass, field
from haros_ci.values.abstract import Callable, Value


@dataclass(frozen=True, slots=True, eq=False)
class Command:
    """A command: its name, its function (None of a group that is an object), and what it is as a group."""

    name: str
    function: Callable | None
    #: The group that it belongs to, the callback of a group, and what is a group itself: by identity.
    within: int | None = None
    is_callback: bool = False
    group: int | None = None
    #: Whether it is a group that runs its only command without a name.
    is_typer: bool = False


@dataclass(slots=True)
class Commands:
    """What decorators make of functions, by line, name and file; what is added to groups; and the context of the command that runs."""

    known: dict[tuple[int, str, str], Command | None] = field(default_factory=dict)
    added: dict[int, tuple[Command, ...]] = field(default_factory=dict)
    context: Value | None = None
