# SPDX-License-Identifier: Apache-2.0
"""The order of the elements of ``std::set`` and ``std::map``: by their values and keys, whatever the order in which they came ([associative.reqmts]).

Other orders (a comparison of one's own, ``std::unordered_map``) are as they came: what counts such elements is rare.
"""

from __future__ import annotations

from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import Cell, Known, Mapped, Sequence, Value

SET, GREATER = "std::set", "std::greater"


def put(walk: Walk, value: Value) -> None:
    """Put the elements of a set or map of C++ in their order, each of a set once; where one is not known, nothing is done."""
    if isinstance(value, Mapped):
        pairs = value.content.value
        if isinstance(pairs, dict) and len(pairs) > 1:
            keys = _in_order(list(pairs))
            if keys and keys != list(pairs):
                walk.state.write(value.content, {key: pairs[key] for key in keys})
    elif isinstance(value, Sequence) and value.type is not None and value.type.name == SET:
        cells = value.content.value
        comparison = value.type.of(1)
        if isinstance(cells, tuple) and len(cells) > 1 and (comparison is None or comparison.name == GREATER):
            _put(walk, value, cells, comparison is not None)


def put_before(walk: Walk, value: Value, name: str) -> None:
    """``put``, if the method *name* is one that gives the first element."""
    if name in ("begin", "cbegin"):
        put(walk, value)


def _put(walk: Walk, value: Sequence, cells: tuple[Cell, ...], is_reversed: bool) -> None:
    found: dict[object, Cell] = {}
    for cell in cells:
        if not isinstance(cell.value, Known) or isinstance(cell.value.value, (list, dict)):
            return
        found.setdefault(cell.value.value, cell)
    keys = _in_order(list(found))
    if keys:
        there = tuple(found[key] for key in (reversed(keys) if is_reversed else keys))
        if there != cells:
            walk.state.write(value.content, there)


def _in_order(keys: list[object]) -> list[object]:
    """The *keys*, from the lowest on; none where they cannot be compared with each other: they are neither texts alone nor numbers alone."""
    texts = [key for key in keys if isinstance(key, str)]
    numbers = [key for key in keys if isinstance(key, (int, float))]
    if len(texts) == len(keys):
        return [*sorted(texts)]
    return [*sorted(numbers)] if len(numbers) == len(keys) else []
