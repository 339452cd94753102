# SPDX-License-Identifier: Apache-2.0
"""An activation of a function and a loop that are being followed, and how blocks end."""

from __future__ import annotations

from collections.abc import Mapping, Set
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.index.index import Source
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.syntax import Function
from haros_ci.values.abstract import Cell, Object, Opaque, Value
from haros_ci.values.cells import Closure
from haros_ci.values.state import Writes

if TYPE_CHECKING:
    from haros_ci.follow.early import Exit

#: How a block ends: it falls through, or it leaves in one of these ways.
NEXT, RETURN, BREAK, CONTINUE, THROW = "next", "return", "break", "continue", "throw"
#: It ends by an exception that goes on through the functions around it (``follow.thrown``).
RAISED = "raised"

#: How reasons begin that name a bound.
BOUND = "the bound of "


def of_element(key: object) -> str:
    """Why the element at *key* is not known: a bound that the key is not known for, or nothing of its own."""
    if isinstance(key, Opaque) and key.reason.startswith(BOUND):
        return key.reason
    return "an element that is not known"


@dataclass(slots=True)
class Frame(Closure):
    """An activation of a function: its names, what its template parameters mean, what it has returned so far."""

    source: Source
    scope: str
    function: Function | None = None
    this: Object | None = None
    scopes: list[dict[str, Cell]] = field(default_factory=lambda: [{}])
    templates: Mapping[str, syntax.Argument] = field(default_factory=dict)
    outer: Frame | None = None
    mark: int = 0
    returned: list[Value] = field(default_factory=list)
    exits: list[Writes] = field(default_factory=list)
    #: Whether what is followed cannot be reached as things are: it is gone through for what it makes only.
    is_dead: bool = False
    #: The early ways out of it and of turns of its loops so far (``follow.early``).
    early: list[Exit] = field(default_factory=list)
    #: What getters give that are not known, as the tests around say (``follow.narrowing``).
    beliefs: dict[str, Value] = field(default_factory=dict)
    #: Whether the program ends where it says that it has failed.
    is_start: bool = False

    def find(self, name: str) -> Cell | None:
        frame: Frame | None = self
        while frame is not None:
            for scope in reversed(frame.scopes):
                if name in scope:
                    return scope[name]
            frame = frame.outer
        return None

    def declare(self, name: str, cell: Cell) -> Cell:
        self.scopes[-1][name] = cell
        return cell


def looked_up_from(inner: Set[str], frame: Frame) -> str:
    """The scope from which names are looked up in *frame*: the function itself if it is among *inner*, which define classes ([class.local])."""
    around: Frame | None = frame if inner else None
    while around is not None and around.function is not None:
        if around.function.name in inner:
            return around.function.name
        around = around.outer
    return frame.scope


@dataclass(slots=True)
class Loop:
    """A loop (or switch) that is being followed: what the ways that break or continue have written since *mark*."""

    mark: int
    is_switch: bool = False
    #: How many turns have been gone through, where that is done one by one.
    turn: int = 0
    #: Whether only what is inside ends it, as far as its test tells.
    is_endless: bool = False
    #: Whether it goes on for as long as the program does, and is no callback's: other callbacks come between its turns.
    runs_on: bool = False
    #: The bound that its turns have reached, as a reason; "" if none.
    bound: str = ""
    #: By place the names of parameters that its turns have read, and whether something sets them.
    asked: dict[Location, dict[str, bool]] = field(default_factory=dict)
    breaks: list[Writes] = field(default_factory=list)
    continues: list[Writes] = field(default_factory=list)
