# SPDX-License-Identifier: Apache-2.0
"""Nodes of one name that a process has at the same time, where that is certain: by what stands when the second one is made."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.index.mentions import last
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.syntax import Block, Expression, Function

if TYPE_CHECKING:
    from haros_ci.follow.walk import Walk
    from haros_ci.values.abstract import Object

#: Functions and methods after which a node may be gone.
_ENDING = frozenset(("destroy_node", "destroy", "shutdown", "try_shutdown", "reset", "release", "swap"))
#: So many nodes of a process are compared.
MOST = 200


@dataclass(frozen=True, slots=True)
class Twin:
    """The places where a process makes two nodes of the full *name* that it has at the same time."""

    name: str
    first: Location
    second: Location


@dataclass(frozen=True, slots=True)
class Standing:
    """A node that is made whatever happens: its full *name*, and as the code has it; *inside* which functions, outermost first."""

    target: Object
    name: str
    coded: str
    inside: tuple[Function, ...]
    is_called_back: bool

    def stands(self, walk: Walk, inside: tuple[Function, ...]) -> bool:
        """Whether it is sure to be there still: the function that made it has not returned, or is the process's own."""
        if self.is_called_back != walk.is_called_back:
            return len(self.inside) <= 1 and not self.is_called_back
        return self.inside == inside[: len(self.inside)]


def called(walk: Walk, callee: Expression) -> None:
    """A call, after which a node may be gone."""
    if last(syntax.name_of(callee)) in _ENDING:
        walk.has_ended = True


def made(walk: Walk, target: Object, name: str, coded: str, location: Location) -> None:
    """The node *target* is made; *coded* is the name that it has without what the process is given."""
    if walk.quiet or walk.conditions or walk.doubts or walk.dead or walk.beyond or walk.trying or "?" in name + coded:
        return
    inside = tuple(
        function
        for function in walk.active
        if function.kind != "constructor" and not function.name.endswith(".__init__")
    )
    if any(_has_scopes(function) for function in inside) or len(walk.standing) >= MOST:
        return
    place = target.location or location
    for other in walk.standing:
        first = other.target.location or location
        if other.target is target or first == place or walk.has_ended:
            continue
        if (other.name, other.coded) == (name, coded) and other.stands(walk, inside):
            walk.twins.setdefault(name, Twin(name, first, place))
    walk.standing.append(Standing(target, name, coded, inside, walk.is_called_back))


def _has_scopes(function: Function) -> bool:
    """Whether the function has blocks of its own, which an object does not outlive."""
    return function.body is not None and _has_block(function.body)


def _has_block(body: Block) -> bool:
    return any(type(statement) is syntax.Nested for statement in body)
