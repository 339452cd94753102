# SPDX-License-Identifier: Apache-2.0
"""Python's sets, and methods and functions that put lists together (docs.python.org/3/library/stdtypes.html, itertools.html).

A set has its elements in an order that is not known: it is gone through as it is written, and a list of several that is made of it is not known.
"""

from __future__ import annotations

from itertools import product
from math import prod
from typing import TYPE_CHECKING, TypeVar

from haros_ci import syntax
from haros_ci.follow import comprehensions
from haros_ci.values.abstract import LIST_LIMIT, NONE, Cell, Elements, Known, Sequence, Value, same
from haros_ci.values.state import certain

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument
    from haros_ci.follow.frames import Frame
    from haros_ci.follow.walk import Walk

Kind = TypeVar("Kind")
SET = syntax.Type("set")
#: What the methods of sets compute, as operators write it; those that change the set itself after ``=``.
METHODS = {
    "union": "|",
    "intersection": "&",
    "difference": "-",
    "symmetric_difference": "^",
    "update": "|=",
    "difference_update": "-=",
}
METHODS["intersection_update"] = "&="
OPERATORS = frozenset("|&-^")
#: What changes a list or set itself before ``=``.
CHANGING = OPERATORS | {"+"}


def is_set(value: Value) -> bool:
    return isinstance(value, Sequence) and value.type == SET


def made(items: list[Value]) -> Sequence:
    """A set of *items*, each of them once."""
    return Sequence(Cell(tuple(map(Cell, _once(items)))), SET)


def _with(cells: tuple[Cell, ...], more: Sequence | list[Value]) -> tuple[Cell, ...]:
    """The elements of a set, and those of *more* that are not in it."""
    items = more if isinstance(more, list) else [cell.value for cell in certain(more.content.value)]
    fresh = [item for item in items if not any(item is cell.value or _same(item, cell.value) for cell in cells)]
    return (*cells, *map(Cell, fresh))


def _same(one: Value, other: Value) -> bool:
    return isinstance(one, Known) and isinstance(other, Known) and same(one.value, other.value)


def _once(items: list[Value]) -> list[Value]:
    found: dict[object, Value] = {}
    for item in items:
        key = (
            (item.kind is str, item.value)
            if isinstance(item, Known) and not issubclass(item.kind, (list, dict))
            else id(item)
        )
        found.setdefault(key, item)
    return list(found.values())


def taken(walk: Walk, iterator: Sequence, default: Value | None) -> Value | None:
    """``next``: the first element of what an iterator still gives, which it does not give again; None if that is not known."""
    cells = iterator.content.value
    if not isinstance(cells, tuple):
        return None
    if not cells:
        return default
    walk.state.write(iterator.content, cells[1:])
    found: Value = cells[0].value
    return found


def combined(symbol: str, left: Value, right: Value) -> Sequence | None:
    """``a | b`` and its kin of two sets or views of keys; None if the result is not known."""
    if symbol not in OPERATORS or not all(isinstance(value, Sequence) or _is_list(value) for value in (left, right)):
        return None
    one, other = comprehensions.items(left), comprehensions.items(right)
    if one is None or other is None or len(one) + len(other) > LIST_LIMIT:
        return None
    return made([*one, *other]) if symbol == "|" else _chosen(symbol, one, other)


def _chosen(symbol: str, one: list[Value], other: list[Value]) -> Sequence | None:
    """The elements of two sets that an operator leaves; None if they are not known."""
    first, second = _data(one), _data(other)
    if first is None or second is None:
        return None
    if symbol == "&":
        return made([Known(item) for item in first if item in second])
    rest: list[Value] = [Known(item) for item in first if item not in second]
    return made(rest if symbol == "-" else [*rest, *(Known(item) for item in second if item not in first)])


def _is_list(value: Value) -> bool:
    return isinstance(value, Known) and issubclass(value.kind, list)


def _data(items: list[Value]) -> list[object] | None:
    found = [item.value for item in items if isinstance(item, Known) and not issubclass(item.kind, (list, dict))]
    return found if len(found) == len(items) else None


def method(walk: Walk, receiver: Sequence, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """A method of a set, or one that puts a list's elements elsewhere; None if its effect is not known."""
    cells = receiver.content.value
    if name == "clear":
        walk.state.write(receiver.content, ())
        return NONE
    if not isinstance(cells, tuple) or any(argument.keyword for argument in args):
        return None
    if name == "copy":
        return Sequence(Cell(tuple(Cell(cell.value) for cell in cells)), receiver.type)
    if name in METHODS and args:
        return _combining(walk, receiver, name, args)
    if name == "add" and len(args) == 1 and len(cells) < LIST_LIMIT:
        walk.state.write(receiver.content, _with(cells, [args[0].value]))
        return NONE
    if name in ("remove", "discard") and len(args) == 1:
        return _removed(walk, receiver, cells, args[0].value)
    return None if is_set(receiver) else _at_place(walk, receiver, cells, name, args)


def _combining(walk: Walk, receiver: Sequence, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """A method of a set that takes others: a new set, or the same with other elements."""
    found: Value | None = receiver
    for argument in args:
        found = combined(METHODS[name][0], found, argument.value) if found is not None else None
    if not isinstance(found, Sequence) or not METHODS[name].endswith("="):
        return found
    content = found.content.value
    walk.state.write(receiver.content, _with(certain(receiver.content.value), found) if name == "update" else content)
    return NONE


def _removed(walk: Walk, receiver: Sequence, cells: tuple[Cell, ...], expected: Value) -> Value | None:
    data = _data([cell.value for cell in cells])
    if data is None or not isinstance(expected, Known):
        return None
    if expected.value in data:
        place = data.index(expected.value)
        walk.state.write(receiver.content, (*cells[:place], *cells[place + 1 :]))
    return NONE


def _at_place(
    walk: Walk, receiver: Sequence, cells: tuple[Cell, ...], name: str, args: tuple[PassedArgument, ...]
) -> Value | None:
    """``insert`` and ``pop`` of a list at a place that is known."""
    place = args[0].value.value if args and isinstance(args[0].value, Known) else None
    if type(place) is not int:
        return None
    if name == "insert" and len(args) == 2 and len(cells) < LIST_LIMIT:
        place = min(max(place + len(cells) * (place < 0), 0), len(cells))
        walk.state.write(receiver.content, (*cells[:place], Cell(args[1].value), *cells[place:]))
        return NONE
    if name == "pop" and len(args) == 1 and -len(cells) <= place < len(cells):
        place %= len(cells)
        walk.state.write(receiver.content, (*cells[:place], *cells[place + 1 :]))
        return cells[place].value
    return None


def changed(walk: Walk, frame: Frame, held: Sequence, symbol: str, value: Value) -> Value:
    """``l += m``, ``s |= t``: the list or set itself has other elements."""
    cells = held.content.value
    items = comprehensions.items(value) if isinstance(value, Sequence) or _is_list(value) else None
    found: Elements | None = None
    if symbol != "+":
        whole = combined(symbol, held, value)
        found = whole.content.value if whole is not None else None
        if whole is not None and symbol == "|" and isinstance(cells, tuple):
            found = _with(cells, whole)
    elif items is not None and isinstance(cells, tuple) and len(cells) + len(items) <= LIST_LIMIT:
        found = (*cells, *map(Cell, items))
    walk.state.write(held.content, walk.opaque("a list that is changed", frame) if found is None else found)
    return held


def function(name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """``set``, and the functions of itertools that put lists together; None for another function, or where its arguments are not known."""
    if name not in ("set", "frozenset", "itertools.chain", "itertools.product") or any(a.keyword for a in args):
        return None
    every = [comprehensions.items(argument.value) for argument in args]
    lists = [items for items in every if items is not None]
    if len(lists) < len(every):
        return None
    if name in ("set", "frozenset"):
        return made(lists[0] if lists else []) if len(lists) < 2 else None
    return _chain(lists) if name == "itertools.chain" else _product(lists)


def _chain(lists: list[list[Value]]) -> Value | None:
    whole = [item for items in lists for item in items]
    return Sequence(Cell(tuple(map(Cell, whole)))) if len(whole) <= LIST_LIMIT else None


def _product(lists: list[list[Value]]) -> Value | None:
    if prod(map(len, lists)) * len(lists) > LIST_LIMIT:
        return None
    return Sequence(Cell(tuple(Cell(Sequence(Cell(tuple(map(Cell, row))))) for row in product(*lists))))


def repeated(left: Value, right: Value) -> Sequence | None:
    """``l * n`` of a list; None if that is not known."""
    if isinstance(right, Sequence):
        left, right = right, left
    cells = left.content.value if isinstance(left, Sequence) else None
    if not isinstance(cells, tuple) or not isinstance(right, Known) or type(right.value) is not int:
        return None
    if not 0 <= right.value * len(cells) <= LIST_LIMIT:
        return None
    return Sequence(Cell(tuple(Cell(cell.value) for _ in range(right.value) for cell in cells)))


def ordered(items: list[Value]) -> list[Value] | None:
    """The texts or numbers *items* in their order, or pairs in that of their first elements; None if they are not known."""
    keys = [_first(item) for item in items]
    data = [key.value for key in keys if isinstance(key, Known)]
    texts, numbers = _of_kind(data, str), _of_kind(data, int)
    if len(items) not in (len(texts), len(numbers)) or len({type(key) for key in data}) > 1:
        return None
    if any(key is not item for key, item in zip(keys, items, strict=True)) and len(set(data)) < len(data):
        return None  # the second ones decide
    places = _ranked(texts) if texts else _ranked(numbers)
    return [items[place] for place in places]


def _of_kind(data: list[object], kind: type[Kind]) -> list[Kind]:
    return [item for item in data if isinstance(item, kind)]


def _ranked(data: list[str] | list[int]) -> list[int]:
    """The places of *data* in the order of what stands there; of equal ones the first comes first."""
    return [place for _, place in sorted(zip(data, range(len(data)), strict=True))]


def _first(item: Value) -> Value:
    cells = item.content.value if isinstance(item, Sequence) else None
    return cells[0].value if isinstance(cells, tuple) and cells else item
