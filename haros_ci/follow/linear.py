# SPDX-License-Identifier: Apache-2.0
"""The order in which Python looks through a class and its bases: C3 (docs.python.org/3/howto/mro.html)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from haros_ci import syntax
from haros_ci.follow import expressions, members, python_names
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.syntax import Class, Type
from haros_ci.values.abstract import ClassValue, Library, Value
from haros_ci.values.iterators import class_meant

#: A class of the workspace, or the name of one of a library.
Entry = tuple[Source, Class] | str
#: Classes above a class that are looked at.
MOST = 64


def order(walk: Walk, source: Source, definition: Class) -> tuple[Entry, ...]:
    """A class of the workspace and all above it, in the order in which Python looks through them; without ``object``."""
    key = ("order", id(definition))
    if key not in walk.found:
        walk.found[key] = ((source, definition),)  # while a base leads back to it
        walk.found[key] = _order(walk, source, definition)
    found: tuple[Entry, ...] = walk.found[key]
    return found


def of_workspace(entries: Iterable[Entry]) -> Iterator[tuple[Source, Class]]:
    """Those of *entries* that are classes of the workspace."""
    return (entry for entry in entries if not isinstance(entry, str))


def above(walk: Walk, owner: tuple[Source, Class], last: Class) -> tuple[Entry, ...] | None:
    """What comes after the class *last* in the order of a class; None if it is not in it."""
    every = order(walk, *owner)
    for number, entry in enumerate(every):
        if not isinstance(entry, str) and entry[1] is last:
            return every[number + 1 :]
    return None


def _order(walk: Walk, source: Source, definition: Class) -> tuple[Entry, ...]:
    bases = [entry for base in definition.bases if (entry := entry_of(walk, base, source)) not in ("", "object")]
    lists = [[*(order(walk, *base) if not isinstance(base, str) else (base,))] for base in bases] + [bases]
    found: list[Entry] = [(source, definition)]
    while (lists := [entries for entries in lists if entries]) and len(found) < MOST:
        good = next((one[0] for one in lists if not any(_has(other[1:], one[0]) for other in lists)), lists[0][0])
        if not _has(found, good):
            found.append(good)
        lists = [[entry for entry in entries if not _is(entry, good)] for entries in lists]
    return tuple(found)


def _is(one: Entry, other: Entry) -> bool:
    if isinstance(one, str) or isinstance(other, str):
        return one is other or (isinstance(one, str) and one == other)
    return one[1] is other[1]


def _has(entries: list[Entry], one: Entry) -> bool:
    return any(_is(entry, one) for entry in entries)


def entry_of(walk: Walk, base: Type, source: Source) -> Entry:
    """What a base class is; "" where that is not known."""
    frame = python_names.module_frame(walk, source)
    value: Value = expressions.evaluate(walk, frame, syntax.Name(base.name.split(".")[0]))
    for part in base.name.split(".")[1:]:
        value = members.attribute(walk, value, part, Frame(source, ""))
    value = class_meant(value)
    if isinstance(value, ClassValue):
        return value.source, value.definition
    return value.name if isinstance(value, Library) else ""
