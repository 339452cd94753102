# SPDX-License-Identifier: Apache-2.0
"""A class of C++ and what it is derived from."""

from __future__ import annotations

from haros_ci.follow import methods
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.syntax import Class

#: So many classes of a lineage are looked at.
MOST_BASES = 40


def derives(walk: Walk, one: tuple[Source, Class], base: Class, depth: int = 0) -> bool:
    """Whether class *one* is *base* or derived from it."""
    if one[1] is base or one[1].name == base.name:
        return True
    if depth >= methods.BASES:
        return False
    owners = [walk.class_of(type_.name, one[0]) for type_ in walk.bases(one[0], one[1], {})]
    others = [owner for owner in owners if owner is not None and owner[1] is not one[1]]
    return any(derives(walk, owner, base, depth + 1) for owner in others)


def lineage(walk: Walk, source: Source, definition: Class) -> list[tuple[Source, Class]]:
    """A class of C++ and its bases in the workspace."""
    key = ("lineage", id(definition))
    if key not in walk.found:
        found, at = [(source, definition)], 0
        while at < len(found) < MOST_BASES:
            where, known = found[at]
            at += 1
            owners = (walk.class_of(base.name, where) for base in walk.bases(where, known, {}))
            found += [item for item in owners if item is not None and all(item[1] is not other for _, other in found)]
        walk.found[key] = found
    classes: list[tuple[Source, Class]] = walk.found[key]
    return classes


def declaring(walk: Walk, source: Source, definition: Class, name: str) -> str:
    """The name of the class that declares the static member *name* of a class: one variable for all that are derived from it.

    That of a template has one for each of its specialisations: it counts as the class's own.
    """
    owners = [known for _, known in lineage(walk, source, definition) if any(f.name == name for f in known.fields)]
    return owners[0].name if owners and not owners[0].templates else definition.name
