# SPDX-License-Identifier: Apache-2.0
"""The order in which Python looks through a class and its bases: C3 (docs.python.org/3/howto/mro.html)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator

from haros_ci import syntax
from haros_ci.follow import expressions, members, python_names
from haros_ci.follow.bases import note_cut
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
    note_cut(walk, found, MOST, source, definition)
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
    own: Entry = (source, definition)
    bases = [entry for base in definition.bases if (entry := entry_of(walk, base, source)) not in ("", "object")]
    lists = [[*(order(walk, *base) if not isinstance(base, str) else (base,))][::-1] for base in bases] + [bases[::-1]]
    found = {_key(own): own}
    behind = Counter(_key(entry) for entries in lists for entry in entries[:-1])  # which another one goes before
    while (lists := [entries for entries in lists if entries]) and len(found) < MOST + 2:
        good = next((entries[-1] for entries in lists if not behind[_key(entries[-1])]), lists[0][-1])
        key = _key(good)
        found.setdefault(key, good)
        for entries in lists:
            if behind[key]:  # no order is right
                entries[:-1] = [entry for entry in entries[:-1] if _key(entry) != key]
            if _key(entries[-1]) == key:
                entries.pop()
                if entries:
                    behind[_key(entries[-1])] -= 1
        behind[key] = 0
    return tuple(found.values())


def _key(entry: Entry) -> int | str:
    return entry if isinstance(entry, str) else id(entry[1])


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
