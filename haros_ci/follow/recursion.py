# SPDX-License-Identifier: Apache-2.0
"""Functions that call themselves: how often they are followed inside themselves, and what is said where that ends."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci.follow import inert, thrown
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import DEPTH, Walk
from haros_ci.model.location import Location
from haros_ci.values.abstract import Callable

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: Calls of a function inside itself that are followed though the ones before make nothing new.
BARREN = 8
NO_MORE = "{} calls itself: what calls inside calls make is not followed to the end"


def is_over(walk: Walk, frame: Frame, inner: Frame, function: Callable, args: tuple[PassedArgument, ...]) -> bool:
    """Whether a call is not followed as there are too many around it; it may make something then that is not known.

    A function is followed twice inside itself, and as long as nothing but what is known decides that it calls itself again.
    """
    definition = function.function
    times, is_deep = walk.active.count(definition), len(walk.active) >= DEPTH
    if times <= 1 and not is_deep:
        return False
    if walk.dead or walk.beyond or frame.is_dead or not inert.may_make(walk, function, args, inner.templates):
        return True
    before = walk.entered[len(walk.active) - 1 - walk.active[::-1].index(definition)] if times else (-1, -1)
    is_new = len(walk.made) > before[1]
    if not is_deep and thrown.depth(walk) == before[0] and (is_new or times <= BARREN):
        return False
    if is_new and not walk.quiet:
        walk.gaps.setdefault(NO_MORE.format(definition.name), Location(inner.source.path, definition.line))
    return True
