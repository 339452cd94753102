# SPDX-License-Identifier: Apache-2.0
"""Numbers and flags that a method sets before anything is called back: they are known, unless a callback writes them, too.

A function that makes nothing and changes numbers only is not followed elsewhere (``inert``). What is registered may run
beside the rest from then on, as threads do, and callbacks of rospy: a name that it assigns to is no setter's any more.
"""

from __future__ import annotations

from itertools import islice

from haros_ci import syntax
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.model.location import Location
from haros_ci.syntax import Function
from haros_ci.syntax.walk import everything
from haros_ci.values.abstract import NONE, Callable, Choice, Known, Opaque
from haros_ci.values.cells import Slot

#: Parts of a body up to which a function is a setter.
PARTS = 150
#: What a setter does not have: what takes many turns, and functions of its own.
LOOPS = (syntax.Loop, syntax.Each, syntax.NestedFunction, syntax.NestedClass, syntax.Lambda)


def is_setter(walk: Walk, definition: Function, source: Source) -> bool:
    """Whether this call of an inert function is followed for the numbers that it changes.

    So it is in the beginning of a node, where calls come one after the other, for a short function without loops.
    """
    changed = walk.relevance.changes(definition, source)
    if walk.quiet or walk.is_called_back or not changed or not changed.isdisjoint(walk.disturbed):
        return False
    key = ("setter", definition.name, source.path, definition.line, id(definition))
    found = walk.found.get(key)
    if found is None:
        found = walk.found[key] = _is_straight(definition)
    return bool(found)


def _is_straight(definition: Function) -> bool:
    parts = list(islice(everything(definition.body), PARTS + 1))
    return len(parts) <= PARTS and not any(isinstance(part, LOOPS) for part in parts)


def followed(walk: Walk, function: Callable, mark: int) -> None:
    """*function* was followed as a setter: note the numbers that it has set since *mark*.

    What else is not known after that, as it was given to a function of which nothing is known, stays as it is: so it does
    where a function is not followed.
    """
    names: dict[Slot, frozenset[str]] = {
        cell: frozenset((name,)) for name, cell in (function.this.fields if function.this else {}).items()
    }
    changed = walk.relevance.changes(function.function, function.source)
    for cell, value in walk.state.undo(mark).items():
        if not _is_number(cell.value):
            continue
        walk.state.put(cell, value)
        if isinstance(value, (Known, Choice)):
            walk.settled[cell] = value, names.get(cell, changed)


def _is_number(held: object) -> bool:
    """Whether what a variable holds is, or may be, a number: of all else a setter changes nothing (``inert``)."""
    if isinstance(held, Choice):
        return all(map(_is_number, held.options))
    return isinstance(held, Opaque) or held == NONE or (isinstance(held, Known) and issubclass(held.kind, (int, float)))


def disturbed(walk: Walk, function: Callable) -> None:
    """*function* may run from here on: what setters have set, and it assigns to, is not known any more."""
    changes = walk.relevance.changes(function.function, function.source)
    walk.disturbed |= changes
    reason = f"{function.function.name or 'a function that is called back'} may change it"
    for cell, (value, names) in walk.settled.items():
        options = cell.value.options if isinstance(cell.value, Choice) else (cell.value,)
        if not names.isdisjoint(changes) and (cell.value == value or value in options):
            where = Location(function.source.path, function.function.line)
            walk.state.forget(cell, Opaque(reason, where, cell.type))
