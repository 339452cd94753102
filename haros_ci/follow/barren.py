# SPDX-License-Identifier: Apache-2.0
"""Functions that could make something, and go on making nothing: after a while they are not followed any more.

So it is in callbacks after few steps. In the beginning of a node, where nearly everything is made, it takes many steps and many calls; then that
is said of the node.
"""

from __future__ import annotations

from haros_ci.follow import call_arguments
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.model.location import Location
from haros_ci.syntax import Function
from haros_ci.values.abstract import Known, Value

#: Steps that callbacks may put into one function that could make something, and has made nothing so far.
IDLE = 800
#: The same of one that the node calls in its beginning, in so many calls: one that makes something may first be called in vain.
BARREN, OFTEN = 12_000, 8
#: The same where nothing was made in so many steps of the node.
BARREN_DRY, OFTEN_DRY, DRY = 300, 4, 20_000
#: What is said of a node of which a function is not followed any more.
NO_MORE = "functions that go on making nothing are not followed any more in the beginning of the node: what else they make is missing"
#: What a function has made, of ``Walk.extent``: what it registers does not count where all are dry, as threads and tasks are registered by the hundred.
MADE = (0, 2, 4)


def _way(walk: Walk, definition: Function) -> tuple[int, bool, bool]:
    """What the steps of a function that makes nothing are counted by: what is ruled out says nothing of what is not."""
    return id(definition), walk.ruled_out() > 0, walk.is_called_back


def is_idle(
    walk: Walk, inner: Frame, definition: Function, arguments: tuple[call_arguments.PassedArgument, ...]
) -> bool:
    """Whether a function that could make something has been followed long enough in vain; of the beginning of a node that is said."""
    steps, times = walk.idle.get(_way(walk, definition), (0, 0))
    if walk.is_called_back:
        return steps > IDLE
    most, often = (BARREN_DRY, OFTEN_DRY) if _is_dry(walk) else (BARREN, OFTEN)
    if steps <= most or times < often:
        return False
    if walk.listed and any(is_plugin(walk, argument.value) for argument in arguments):
        return False
    if not walk.quiet:
        walk.gaps.setdefault(NO_MORE, Location(inner.source.path, definition.line))
        if not walk.ruled_out():
            walk.cut[id(definition)] = inner.source, definition
    return True


def count(walk: Walk, definition: Function, before: int, there: tuple[int, ...]) -> None:
    """Count the steps since *before* that went into a function in vain, and its calls; where there is more than *there* was, from anew."""
    way, taken, now = _way(walk, definition), walk.steps - before, walk.extent()
    has_made = now != there
    if not walk.is_called_back:
        made = now[0] + now[2]
        if made != walk.last[0]:
            walk.last = made, walk.steps - walk.quiet_steps
        has_made = has_made and (not _is_dry(walk) or any(now[item] != there[item] for item in MADE))
    steps, times = walk.idle.get(way, (0, 0))
    walk.idle[way] = (0, 0) if has_made or (walk.is_called_back and taken <= 1) else (steps + taken, times + 1)


def _is_dry(walk: Walk) -> bool:
    """Whether the node has made nothing for many steps."""
    return walk.steps - walk.quiet_steps - walk.last[1] > DRY


def is_plugin(walk: Walk, value: Value) -> bool:
    """Whether a value is the look-up name of a plug-in of which the program goes through all names."""
    return isinstance(value, Known) and any(value.value in walk.context.declared.get(base, ()) for base in walk.listed)
