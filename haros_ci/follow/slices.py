# SPDX-License-Identifier: Apache-2.0
"""Python's slices of texts and lists (docs.python.org/3/reference/expressions.html#slicings)."""

from __future__ import annotations

from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import Cell, Choice, Known, Object, Sequence, Value, join

#: What a part of a list is that has nothing as things are.
NOTHING = "a part of a list, which has nothing as it is started"


def part(walk: Walk, frame: Frame, container: Value, bounds: Object) -> Value:
    """``container[a:b:c]``, a new text or list; *bounds* is the object that ``[slice]`` makes.

    Nothing of a list that has something is not known: what is done with each element is looked at once all the same.
    """
    values = [cell.value for cell in bounds.fields.values()]
    numbers = [
        value.value
        for value in values
        if isinstance(value, Known)
        and (value.value is None or (isinstance(value.value, int) and type(value.value) is int))
    ]
    unknown = walk.opaque("a part of what is not known", frame)
    if len(numbers) != 3 or numbers[2] == 0:
        return unknown
    which = slice(*numbers)
    if isinstance(container, Choice):
        result: Value | None = None
        for option in container.options:
            found = part(walk, frame, option, bounds)
            result = found if result is None else join(result, found)
        return result if result is not None else unknown
    if isinstance(container, Known) and issubclass(container.kind, (str, list)):
        return Known(container.of(str)[which] if issubclass(container.kind, str) else container.of(list)[which])
    if isinstance(container, Sequence):
        cells = container.content.value
        if isinstance(cells, tuple) and (cells[which] or not cells):
            return Sequence(Cell(tuple(Cell(cell.value, cell.type) for cell in cells[which])))
        return Sequence(Cell(walk.opaque(NOTHING, frame) if isinstance(cells, tuple) else unknown))
    return unknown
