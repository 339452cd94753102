# SPDX-License-Identifier: Apache-2.0
"""What loops have changed when they were followed before, so that the same need not be found out again.

A turn that changes what was known before it has been followed in vain: the loop begins again without that. Where a loop is followed once more, in
another call or after a rehearsal, what it changed then is not known from the first turn on, where it holds what it held then. The turn has to
change all of it, else the loop begins again with what it did change: so the result is the same, and a turn less is followed (decision 0036).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

from haros_ci.values.abstract import Choice, Known, Library, Mapped, Object, Opaque, Pointer, Sequence, same
from haros_ci.values.cells import Slot

if TYPE_CHECKING:
    from haros_ci.follow.frames import Frame
    from haros_ci.follow.walk import Walk
    from haros_ci.syntax import Each, Loop

#: Members of members, and elements, that are looked into for what a loop has changed.
NESTED = 3
#: How the function of a loop comes to a cell: frames outward, a variable or ``this``, members of it.
Place = tuple[int, tuple[str, ...]]
#: By the identity of a loop's statement: the places that it has changed, each with what was there before; None where it was wrong to foresee that.
Foreseen = dict[int, dict[Place, object]]


def changes(walk: Walk, frame: Frame, statement: Loop | Each) -> dict[Slot, object]:
    """The cells that a loop is going to change, as it did before where they held the same, with what is known of them now."""
    found = dict[Slot, object]()
    for place, before in walk.foreseen.get(id(statement), {}).items():
        cell = _cell(frame, place) if before is not None else None
        if cell is not None and _is_alike(cell.value, before):
            found[cell] = cell.value
    return found


def note(walk: Walk, frame: Frame, statement: Loop | Each, cells: Mapping[Slot, object]) -> None:
    """A loop has changed *cells* that held these values. What it does not come to by names is not foreseen: mostly that is gone with the callback."""
    left = dict(cells)
    known = walk.foreseen.setdefault(id(statement), {})
    for place, cell in _places(frame) if left else ():
        if cell in left:
            held = left.pop(cell)
            if known.get(place, held) is not None:
                known[place] = held
            if not left:
                return


def missed(walk: Walk, frame: Frame, statement: Loop | Each, cells: Iterable[Slot]) -> None:
    """It was wrong to foresee that a loop changes *cells*: it is not any more."""
    wrong = set(cells)
    known = walk.foreseen[id(statement)]
    for place in known:
        if _cell(frame, place) in wrong:
            known[place] = None


def _is_alike(held: object, before: object) -> bool:
    """Whether a value decides what another one did, as far as that is plain: a loop that asks for it may leave another one as it is.

    A value from outside is looked at by none of this (``values.given``).
    """
    if held is before:
        return not isinstance(held, Opaque)
    if held.__class__ is not before.__class__ or isinstance(held, Opaque):
        return False
    if held.__class__ is Known:
        return same(held.value, before.value)  # type: ignore[attr-defined]  # both are
    if isinstance(held, Choice) and isinstance(before, Choice):
        return len(held.options) == len(before.options) and all(map(_is_alike, held.options, before.options))
    if isinstance(held, (Object, Library)) and isinstance(before, (Object, Library)):
        return held.name == before.name
    if isinstance(held, dict) and isinstance(before, dict):
        return held.keys() == before.keys()
    return isinstance(held, tuple) and isinstance(before, tuple) and len(held) == len(before)


def _cell(frame: Frame, place: Place) -> Slot | None:
    """The cell at a place, if there is one now."""
    outward, (first, *rest) = place
    around: Frame | None = frame
    for _ in range(outward):
        around = around.outer if around is not None else None
    if around is None:
        return None
    cell: Slot | None = None
    value: object = around.this
    if first != "this":
        cell = next((scope[first] for scope in reversed(around.scopes) if first in scope), None)
        value = cell.value if cell is not None else None
    for name in rest:
        cell = next((inner for known, inner in _inside(value) if known == name), None)
        if cell is None:
            return None
        value = cell.value
    return cell


def _places(frame: Frame) -> Iterator[tuple[Place, Slot]]:
    """The cells that a function comes to, those with the shortest ways first; each once."""
    seen = set[int]()
    level = list[tuple[Place, Slot]]()
    around: Frame | None = frame
    outward = 0
    while around is not None:
        level += [((outward, (name,)), cell) for scope in reversed(around.scopes) for name, cell in scope.items()]
        level += [((outward, ("this", name)), cell) for name, cell in _inside(around.this)]
        around, outward = around.outer, outward + 1
    for _ in range(NESTED + 1):
        level = [item for item in level if id(item[1]) not in seen]
        seen.update(id(cell) for _, cell in level)
        yield from level
        level = [
            ((outward, (*path, name)), inner) for (outward, path), cell in level for name, inner in _inside(cell.value)
        ]


def _inside(value: object) -> Iterable[tuple[str, Slot]]:
    """The cells inside of a value, by name: the members of an object, the content of a sequence or map, what a pointer leads to."""
    if isinstance(value, Object):
        return value.fields.items()
    if isinstance(value, (Sequence, Mapped)):
        return (("[]", value.content),)
    return (("*", value.cell),) if isinstance(value, Pointer) else ()
