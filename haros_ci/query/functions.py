# SPDX-License-Identifier: Apache-2.0
"""The functions that every query can call, as HAROS gives them, and the methods of texts, lists and maps."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import isfinite
from typing import Any

from haros_ci.query.fault import QueryError
from haros_ci.query.operators import NUMBERS, narrow, ordered, power, quotient, text
from haros_ci.query.values import LONGEST, QueryEntity, QueryList, QueryRecord, Value, items_of, kind_of


class Builtin:
    """A function of the language: it takes from *least* to *most* arguments."""

    __slots__ = ("function", "least", "most", "name")

    def __init__(self, name: str, least: int, most: int, function: Callable[..., Value]) -> None:
        self.name = name
        self.least = least
        self.most = most
        self.function = function

    def apply(self, arguments: Sequence[Value]) -> Value:
        if not self.least <= len(arguments) <= self.most:
            expected = str(self.least) if self.least == self.most else f"{self.least} to {self.most}"
            raise QueryError(f"{self.name} takes {expected} arguments, not {len(arguments)}")
        return self.function(*arguments)


def is_rosglobal(name: Value) -> bool:
    """Whether a name begins with ``/`` (HAROS ``QueryEngine.is_rosglobal``)."""
    plain = getattr(name, "full", None) if isinstance(name, QueryEntity) else name
    return isinstance(plain, str) and plain.startswith("/")


def length(value: Value) -> int:
    found = items_of(value)
    if found is None:
        raise QueryError(f"a {kind_of(value)} has no length")
    return len(found)  # type: ignore[arg-type]  # a query may ask it of anything: a TypeError is the answer


def number(value: Value) -> int | float:
    if not isinstance(value, NUMBERS):
        raise QueryError(f"a number is needed, not a {kind_of(value)}")
    return value


def whole(value: Value, base: Value = None) -> int:
    """``int``; of a text, only in decimal or with its own prefix."""
    try:
        if isinstance(value, str) and len(value) < 1000:
            return int(value, base) if isinstance(base, int) else int(value)
        if base is None and isinstance(value, NUMBERS):
            return int(value)
    except (ValueError, OverflowError):
        pass
    raise QueryError(
        f"{kind_of(value)} {str(value)[:40]!r} is no whole number" if isinstance(value, str) else _no(value)
    )


def real(value: Value) -> float:
    try:
        if isinstance(value, NUMBERS) or (isinstance(value, str) and len(value) < 1000):
            return float(value)
    except (ValueError, OverflowError):
        pass
    raise QueryError(_no(value))


def _no(value: Value) -> str:
    return f"this {kind_of(value)} is no number"


def extreme(sign: str) -> Callable[..., Value]:
    """``max`` and ``min``: of several arguments, or of the elements of one."""
    better = ordered(sign)

    def of(*arguments: Value) -> Value:
        found = items_of(arguments[0]) if len(arguments) == 1 else arguments
        if found is None:
            raise QueryError(f"a {kind_of(arguments[0])} has no elements to choose from")
        best: Value = None
        for item in found:
            if best is None or better(item, best):
                best = item
        return best

    return of


def total(value: Value, start: Value = 0) -> Value:
    found = items_of(value)
    if found is None or isinstance(value, str):
        raise QueryError(f"sum adds the numbers of a list, not of a {kind_of(value)}")
    result = number(start)
    for item in found:
        result = narrow(result + number(item))
    return result


def rounded(value: Value, digits: Value = None) -> Value:
    if digits is not None and not (isinstance(digits, int) and abs(digits) < 400):
        raise QueryError("round takes a whole number of digits")
    plain = number(value)
    if isinstance(plain, float) and not isfinite(plain):
        raise QueryError("the number cannot be rounded")
    return round(plain, digits) if digits is not None else round(plain)


def both(left: Value, right: Value) -> QueryList:
    """``divmod``."""
    a, b = number(left), number(right)
    if b == 0:
        raise QueryError("division by zero")
    if isinstance(a, float) or isinstance(b, float):
        quotient(a, b)  # raises where the result is too large
    return QueryList.of(divmod(a, b), True)


def compared(left: Value, right: Value) -> int:
    """``cmp``: -1, 0 or 1."""
    return ordered(">")(left, right) - ordered("<")(left, right)


def is_instance(value: Value, kind: Value) -> bool:
    """``isinstance``: *kind* is ``bool``, ``int``, ``long`` or ``float``, the name of an entity's kind, or a list of these."""
    if kind.__class__ is QueryList:
        return any(is_instance(value, item) for item in kind)
    if isinstance(kind, str):
        return kind_of(value) == kind or (kind == "str" and isinstance(value, str))
    python = {"bool": bool, "int": int, "long": int, "float": float}.get(getattr(kind, "name", ""))
    if python is None:
        raise QueryError("isinstance takes int, float, bool or the name of a kind, as 'Topic'")
    return isinstance(value, python)


BUILTINS: dict[str, Value] = {
    "True": True,
    "False": False,
    "None": None,
    **{
        name: Builtin(name, least, most, function)
        for name, least, most, function in (
            ("abs", 1, 1, lambda value: abs(number(value))),
            ("bool", 1, 1, lambda value: truth(value)),
            ("cmp", 2, 2, compared),
            ("divmod", 2, 2, both),
            ("float", 1, 1, real),
            ("int", 1, 2, whole),
            ("isinstance", 2, 2, is_instance),
            ("is_rosglobal", 1, 1, is_rosglobal),
            ("len", 1, 1, length),
            ("long", 1, 2, whole),
            ("max", 1, 1000, extreme(">")),
            ("min", 1, 1000, extreme("<")),
            ("pow", 2, 3, power),
            ("round", 1, 2, rounded),
            ("sum", 1, 2, total),
        )
    },
}


def truth(value: Value) -> bool:
    """Whether *value* counts as true: not None, False, 0 or empty."""
    if isinstance(value, QueryEntity):
        return value.items is None or bool(value.items)
    return bool(value)


def _texts(*items: Value) -> None:
    for item in items:
        if not isinstance(item, str):
            raise QueryError(f"a text is needed, not a {kind_of(item)}")


def _plain(method: Callable[..., Any]) -> Callable[..., Value]:
    """A method of str whose arguments are texts, and whose result is hardly longer than the text."""

    def call(value: str, *arguments: Value) -> Value:
        _texts(*arguments)
        return method(str(value), *map(str, arguments))

    return call


def _edge(method: Callable[..., bool]) -> Callable[..., Value]:
    """``startswith`` and ``endswith``: of one text, or of any of a list."""

    def call(value: str, edge: Value) -> bool:
        edges = edge if edge.__class__ is QueryList else (edge,)
        _texts(*edges)
        return any(method(str(value), str(item)) for item in edges)

    return call


def _replace(value: str, old: Value, new: Value) -> Value:
    _texts(old, new)
    count = str(value).count(str(old))
    if len(value) + count * (len(new) - len(old)) > LONGEST:
        raise QueryError(f"a text has more than {LONGEST} characters")
    return str(value).replace(str(old), str(new))


def _split(method: Callable[..., list[str]]) -> Callable[..., Value]:
    def call(value: str, separator: Value = None, most: Value = -1) -> Value:
        if separator is not None:
            _texts(separator)
        if separator == "":
            raise QueryError("an empty text cannot separate")
        return QueryList.of(method(str(value), separator, int(number(most))))

    return call


def _join(value: str, items: Value) -> Value:
    found = items_of(items)
    if found is None:
        raise QueryError("join needs a list of texts")
    parts = [str(item) for item in found]
    _texts(*found)
    if sum(map(len, parts)) + len(value) * len(parts) > LONGEST:
        raise QueryError(f"a text has more than {LONGEST} characters")
    return text(str(value).join(parts))


def _get(value: QueryRecord, key: Value, default: Value = None) -> Value:
    return value[key] if key in value else default


def _position(value: QueryList, item: Value) -> int:
    if item not in value.members:
        raise QueryError("the list does not have this element")
    return value.index(item)


#: Methods by class of the value: least and most arguments (without the value), and what is called with the value first.
METHODS: dict[type, dict[str, tuple[int, int, Callable[..., Value]]]] = {
    str: {
        "startswith": (1, 1, _edge(str.startswith)),
        "endswith": (1, 1, _edge(str.endswith)),
        "find": (1, 1, _plain(str.find)),
        "rfind": (1, 1, _plain(str.rfind)),
        "count": (1, 1, _plain(str.count)),
        "lower": (0, 0, _plain(str.lower)),
        "upper": (0, 0, _plain(str.upper)),
        "strip": (0, 1, _plain(str.strip)),
        "lstrip": (0, 1, _plain(str.lstrip)),
        "rstrip": (0, 1, _plain(str.rstrip)),
        "isdigit": (0, 0, _plain(str.isdigit)),
        "isalpha": (0, 0, _plain(str.isalpha)),
        "isupper": (0, 0, _plain(str.isupper)),
        "islower": (0, 0, _plain(str.islower)),
        "replace": (2, 2, _replace),
        "split": (0, 2, _split(str.split)),
        "rsplit": (0, 2, _split(str.rsplit)),
        "join": (1, 1, _join),
    },
    QueryList: {
        "count": (1, 1, lambda value, item: value.count(item)),
        "index": (1, 1, _position),
    },
    QueryRecord: {
        "get": (1, 2, _get),
        "keys": (0, 0, lambda value: QueryList.of(value, True)),
        "values": (0, 0, lambda value: QueryList.of(value.values(), True)),
        "items": (0, 0, lambda value: QueryList.of((QueryList.of(pair, True) for pair in value.items()), True)),
    },
}
