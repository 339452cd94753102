# SPDX-License-Identifier: Apache-2.0
"""Subscriptions that filters pass on: from the subscriber over synchronizers to the functions that ``registerCallback`` is given.

docs.ros.org: message_filters, tf2_ros/message_filter.h.
"""

from __future__ import annotations

from collections.abc import Iterator
from operator import attrgetter

from haros_ci import syntax
from haros_ci.code.callbacks import Callback, callbacks
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.dependence.steps import Step, all_nodes, steps
from haros_ci.dependence.uses import uses, uses_of
from haros_ci.dependence.variables import Held, chain, held
from haros_ci.model.location import Location

#: Filters behind one another.
DEPTH = 4
#: The same in every run, whoever asked first.
_ORDER = attrgetter("kind", "owner", "name")


def passed_on(code: Codebase, location: Location) -> tuple[Callback, ...]:
    """The callbacks that get what the subscription made at *location* receives, through filters; none where that is not seen."""
    key = ("passed on", location)
    if key not in code.kept:
        code.kept[key] = tuple(_passed_on(code, location))
    found: tuple[Callback, ...] = code.kept[key]
    return found


def _passed_on(code: Codebase, location: Location) -> Iterator[Callback]:
    registered = [one for one in callbacks(code) if one.call.name == "registerCallback"]
    if not registered:
        return
    for routine in code.routines(location.path):
        for step in steps(code, routine):
            if _is_at(step, location):
                near = _near(code, routine, step)
                yield from (one for one in registered if _receiver(code, one) in near)


def _is_at(step: Step, location: Location) -> bool:
    at = location.line or 0, location.column or 0
    if (step.line, step.column) == at:
        return True
    made = (node for node in all_nodes(step.values) if isinstance(node, (syntax.Call, syntax.New)))
    return any((node.line, node.column) == at for node in made)


def _near(code: Codebase, routine: Routine, step: Step) -> set[Held]:
    """What keeps a subscriber, and all filters that it is connected to."""
    found = _kept(code, routine, step)
    waiting = [(what, 0) for what in sorted(found, key=_ORDER)]
    while waiting:
        what, depth = waiting.pop()
        for where, use in uses_of(code, what, routine.is_python):
            if depth < DEPTH and use.role in ("given", "read", "kept"):
                for other in sorted(_kept(code, where, use.step) - found, key=_ORDER):
                    found.add(other)
                    waiting.append((other, depth + 1))
    return found


def _kept(code: Codebase, routine: Routine, step: Step) -> set[Held]:
    """What a step assigns to, or calls a method of."""
    return {
        use.what
        for use in uses(code, routine)
        if use.step is step and (use.role in ("whole", "set") or (use.role == "called" and use.is_direct))
    }


def _receiver(code: Codebase, callback: Callback) -> Held | None:
    receiver = callback.call.receiver
    every, _ = chain(receiver) if receiver is not None else ([], False)
    return held(code, callback.maker, every[-1]) if every else None
