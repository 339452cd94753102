# SPDX-License-Identifier: Apache-2.0
"""A class of C++ and what it is derived from."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sized
from itertools import islice
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.index.index import Source
from haros_ci.model.location import Location
from haros_ci.model.reached import reached
from haros_ci.syntax import Class

if TYPE_CHECKING:
    from haros_ci.follow.walk import Walk

#: Of a class that is no template, or of which nothing is known.
NOTHING: Mapping[str, syntax.Argument] = {}
#: A class of the workspace, and what its template parameters stand for.
Owner = tuple[Source, Class, Mapping[str, syntax.Argument]]
#: Such a class, or the name of one that the workspace does not have.
Entry = Owner | str

#: So many classes above a class are looked at.
MOST = 200
CUT = "a class has more than {} classes above it: the others are not looked at"


def lineage(
    walk: Walk, source: Source, definition: Class, templates: Mapping[str, syntax.Argument] = NOTHING
) -> tuple[Entry, ...]:
    """A class of C++ and all that it is derived from, depth first; what is reached by several ways stands there once."""
    key = ("lineage", id(definition), walk.numbered(templates) if templates else 0)
    if key not in walk.found:
        walk.found[key] = depth_first(walk, (source, definition, templates), _bases)
    found: tuple[Entry, ...] = walk.found[key]
    note_cut(walk, found, MOST, source, definition)
    return found


def depth_first(walk: Walk, first: Entry, above: Callable[[Walk, Owner], Iterable[Entry]]) -> tuple[Entry, ...]:
    """A class and all that *above* gives for it and these; one more than MOST above it where there are more."""

    def onward(entry: Entry) -> Iterable[Entry]:
        return () if isinstance(entry, str) else above(walk, entry)

    def key(entry: Entry) -> str | tuple[int, int]:
        return entry if isinstance(entry, str) else (id(entry[1]), walk.numbered(entry[2]) if entry[2] else 0)

    return tuple(islice(reached(first, onward, key), MOST + 2))


def note_cut(walk: Walk, entries: Sized, most: int, source: Source, definition: Class) -> None:
    """Say of the node that classes are left out where *entries*, a class and what is above it, are more than *most* above it."""
    if len(entries) > most + 1:
        walk.gaps.setdefault(CUT.format(most), Location(source.path, definition.line))


def of_workspace(entries: Iterable[Entry]) -> Iterator[Owner]:
    """Those of *entries* that are classes of the workspace."""
    return (entry for entry in entries if not isinstance(entry, str))


def _bases(walk: Walk, owner: Owner) -> Iterator[Entry]:
    """The bases of a class, in the order in which they are written."""
    source, definition, templates = owner
    for base in walk.bases(source, definition, templates):
        found = walk.class_of(base.name, source)
        if found is None:
            yield base.name
        else:
            bound = dict(zip(found[1].templates, base.arguments, strict=False)) if found[1].templates else NOTHING
            yield *found, bound


def classes(walk: Walk, source: Source, definition: Class) -> list[tuple[Source, Class]]:
    """A class of C++ and its bases in the workspace."""
    return [(where, known) for where, known, _ in of_workspace(lineage(walk, source, definition))]


def derives(walk: Walk, one: tuple[Source, Class], base: Class) -> bool:
    """Whether class *one* is *base* or derived from it."""
    return any(known is base or known.name == base.name for _, known in classes(walk, *one))


def declaring(walk: Walk, source: Source, definition: Class, name: str) -> str:
    """The name of the class that declares the static member *name* of a class: one variable for all that are derived from it.

    That of a template has one for each of its specialisations: it counts as the class's own.
    """
    owners = [known for _, known in classes(walk, source, definition) if any(f.name == name for f in known.fields)]
    return owners[0].name if owners and not owners[0].templates else definition.name
