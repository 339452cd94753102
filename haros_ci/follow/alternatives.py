# SPDX-License-Identifier: Apache-2.0
"""Objects of which one exists, and there is no telling which: plug-ins of one base class, loaded at one place.

What is done to the one that exists is done to it for sure: there is no way on which the others are there without it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.follow import copies
from haros_ci.index.types import MAPS, SEQUENCES, pointee
from haros_ci.values.abstract import Cell, Mapped, Object, Sequence, Value
from haros_ci.values.cells import Slot

if TYPE_CHECKING:
    from collections.abc import Sequence as Sequence_

    from haros_ci.follow.frames import Frame
    from haros_ci.follow.walk import Walk
    from haros_ci.syntax import Type
    from haros_ci.values.state import Writes

#: Objects inside objects that are looked into.
NESTED = 3


def mark(walk: Walk, base: str, options: Sequence_[Value]) -> None:
    """Of the objects among *options*, plug-ins of the class *base*, one exists."""
    walk.alternatives.append((base, tuple(option for option in options if isinstance(option, Object))))


def are(walk: Walk, options: Sequence_[Value]) -> bool:
    """Whether *options* are objects of which one exists."""
    return any(all(any(option is object_ for object_ in group) for option in options) for _, group in walk.alternatives)


def of_base(walk: Walk, base: str) -> tuple[Object, ...]:
    """What an object of the class *base* may be that is not known: the plug-ins that have been loaded so far."""
    return tuple(object_ for known, group in walk.alternatives if known == base for object_ in group)


def looked_up(walk: Walk, frame: Frame, cell: Cell) -> Cell:
    """One element of a list; of the look-up names of plug-ins none is picked where the program does not come as things are."""
    if (walk.dead or frame.is_dead) and id(cell.value) in walk.look_ups:
        return Cell(walk.opaque("it is one of the plug-ins that there are", frame, None, cell.type), cell.type)
    return cell


def element(walk: Walk, kind: Type, name: str) -> Type | None:
    """The type of what the method *name* of a container of plug-ins gives; None if it is no such container."""
    if name not in ("at", "front", "back") or kind.name not in SEQUENCES | MAPS or not kind.arguments:
        return None
    held = kind.of(1 if kind.name in MAPS and len(kind.arguments) > 1 else 0)
    return held if held is not None and of_base(walk, pointee(held).name) else None


def have(walk: Walk, this: Object | None) -> bool:
    """Whether *this* is a plug-in, or of the class of one."""
    return this is not None and any(this.name == object_.name for _, group in walk.alternatives for object_ in group)


def certain(options: Sequence_[Value], branches: list[Writes]) -> None:
    """Let what the branch of each of *options* writes to that object hold after every branch: it exists in its own alone."""
    for option, branch in zip(options, branches, strict=True):
        own = {cell: branch[cell] for cell in _cells(option, NESTED) if cell in branch}
        for other in branches:
            if other is not branch:
                other.update(own)


def own(walk: Walk, writes: Writes) -> Writes:
    """What a way writes to plug-ins, which are there on this way only: it holds wherever they are."""
    if not writes:
        return {}
    objects = (object_ for _, group in walk.alternatives for object_ in group)
    return {cell: writes[cell] for object_ in objects for cell in _cells(object_, NESTED) if cell in writes}


def _cells(value: Value, depth: int) -> Iterator[Slot]:
    """The variables that are part of an object: its members, what is in them, no object that they point to."""
    for cell in value.fields.values() if isinstance(value, Object) else ():
        yield cell
        inner = cell.value
        if isinstance(inner, (Sequence, Mapped)):
            yield inner.content
        elif isinstance(inner, Object) and depth and copies.is_by_value(cell.type):
            yield from _cells(inner, depth - 1)
