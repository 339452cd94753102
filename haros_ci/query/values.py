# SPDX-License-Identifier: Apache-2.0
"""The values of a query: None, booleans, numbers, text, lists, maps, entities and functions; all of them immutable.

Every value knows its weight, so that nothing too big or too deep is ever made, compared or printed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, ClassVar

from haros_ci.query.fault import QueryError

Value = Any

#: Elements in a list or map, those of its elements included.
HEAVIEST = 200_000
#: Lists and maps within each other.
DEEPEST = 40
#: Characters of one text, and bits of one number.
LONGEST = 100_000
WIDEST = 4096


class UnknownText(str):
    """A type or text that is not known, shown as ``?``: it equals nothing but the text ``?``, and differs from nothing."""

    __slots__ = ()


#: What HAROS shows for a type that it does not know.
UNKNOWN = UnknownText("?")


class QueryList(tuple[Value, ...]):
    """A list, tuple or set of values, in order. ``flatten`` replaces *flat* ones (tuples and sets) by their elements."""

    weight: int
    depth: int
    flat: bool
    _members: frozenset[Value] | None

    @staticmethod
    def of(items: Iterable[Value], flat: bool = False) -> QueryList:
        """A list of *items*; QueryError if it is too big or too deep."""
        made = QueryList(items)
        made.weight, made.depth = measured(made)
        made.flat = flat
        made._members = None
        return made

    @property
    def members(self) -> frozenset[Value]:
        """The items as a set."""
        if self._members is None:
            self._members = frozenset(self)
        return self._members


class QueryRecord(Mapping[Value, Value]):
    """An immutable map; a path sees it as pairs with ``key`` and ``value``."""

    __slots__ = ("_data", "_hash", "_pairs", "depth", "weight")

    def __init__(self, data: Mapping[Value, Value]) -> None:
        self._data = dict(data)
        self._pairs: tuple[QueryPair, ...] | None = None
        self.weight, self.depth = measured((*self._data, *self._data.values()))
        self._hash: int | None = None

    def __getitem__(self, key: Value) -> Value:
        return self._data[key]

    def __iter__(self) -> Iterator[Value]:
        return iter(self._data)

    def __len__(self) -> int:
        return len(self._data)

    def __hash__(self) -> int:
        if self._hash is None:
            self._hash = hash(frozenset(self._data.items()))
        return self._hash

    def __eq__(self, other: object) -> bool:
        return self._data == other._data if isinstance(other, QueryRecord) else NotImplemented

    @property
    def pairs(self) -> tuple[QueryPair, ...]:
        if self._pairs is None:
            self._pairs = tuple(QueryPair(key, value) for key, value in self._data.items())
        return self._pairs


class QueryPair:
    """An entry of a map, as paths see it; each is equal to itself only (pyflwor ``KeyValuePair``)."""

    __slots__ = ("key", "value")

    def __init__(self, key: Value, value: Value) -> None:
        self.key = key
        self.value = value


class QueryEntity:
    """A thing of the model: queries read what ``ATTRIBUTES`` and ``METHODS`` of its class list, nothing else."""

    __slots__ = ()
    #: What HAROS calls it.
    KIND: ClassVar[str] = ""
    ATTRIBUTES: ClassVar[Mapping[str, Callable[[Any], Value]]] = {}
    #: Least and most arguments, and what is called with the entity first.
    METHODS: ClassVar[Mapping[str, tuple[int, int, Callable[..., Value]]]] = {}

    def words(self) -> str:
        """The entity in HAROS's words, for messages."""
        return self.KIND

    @property
    def items(self) -> QueryList | None:
        """What a path, ``for`` and ``len`` go through, if it is a collection."""
        return None


def measured(items: Iterable[Value]) -> tuple[int, int]:
    """Weight and depth of a list of *items*; QueryError if it is too big or too deep."""
    weight, depth = 1, 0
    for item in items:
        weight += 1
        if item.__class__ is QueryList or item.__class__ is QueryRecord:
            weight += item.weight
            depth = max(depth, item.depth)
    if weight > HEAVIEST:
        raise QueryError(f"a list or map has more than {HEAVIEST} elements")
    if depth >= DEEPEST:
        raise QueryError(f"lists or maps are more than {DEEPEST} deep")
    return weight, depth + 1


def weight_of(value: Value) -> int:
    """What it costs to compare or copy *value*, in steps."""
    if value.__class__ is QueryList or value.__class__ is QueryRecord:
        return int(value.weight)
    return len(value) >> 6 if isinstance(value, str) else 1


def elements(value: Value) -> Iterable[Value]:
    """What a path goes through: the items of a list or collection, the pairs of a map; None is nothing, any other value alone."""
    if isinstance(value, QueryList):
        return value
    if isinstance(value, QueryRecord):
        return value.pairs
    if isinstance(value, QueryEntity) and value.items is not None:
        return value.items
    return () if value is None else (value,)


def items_of(value: Value) -> Iterable[Value] | None:
    """What ``for`` goes through, as Python does: the items, the keys of a map, the characters of a text; else None."""
    if isinstance(value, (QueryList, QueryRecord, str)):
        return value
    return value.items if isinstance(value, QueryEntity) else None


def kind_of(value: Value) -> str:
    """What a value is called in messages."""
    if isinstance(value, QueryEntity):
        return value.KIND
    names = {
        QueryList: "list",
        QueryRecord: "map",
        QueryPair: "pair",
        str: "text",
        UnknownText: "text",
        type(None): "None",
    }
    return names.get(value.__class__) or {bool: "boolean", int: "number", float: "number"}.get(
        value.__class__, "function"
    )


def words(value: Value, room: int = 2000) -> str:
    """A value as text, cut where it gets too long."""
    if isinstance(value, str):
        text = repr(str(value))
    elif isinstance(value, QueryEntity):
        text = value.words()
    elif value.__class__ is QueryList:
        text = _joined("[]", (words(item, room) for item in value), room)
    elif value.__class__ is QueryRecord:
        text = _joined("{}", (f"{words(k, room)}: {words(v, room)}" for k, v in value.items()), room)
    elif value.__class__ is QueryPair:
        text = f"{words(value.key, room)}: {words(value.value, room)}"
    elif value is None or isinstance(value, (bool, int, float)):
        text = str(value)
    else:
        text = "function"
    return text if len(text) <= room else f"{text[: room - 1]}…"


def _joined(brackets: str, parts: Iterator[str], room: int) -> str:
    found, length = [], 0
    for part in parts:
        found.append(part)
        length += len(part) + 2
        if length > room:
            break
    return brackets[0] + ", ".join(found) + brackets[1]


#: The list without elements.
NOTHING = QueryList.of(())
