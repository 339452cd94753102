# SPDX-License-Identifier: Apache-2.0
"""The functions that expressions of xacro may call (xacro's create_global_symbols), each bounded; others are known by name only."""

from __future__ import annotations

import builtins
import math
import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any

MAX_SIZE = 20_000
MAX_DIGITS = 400
#: The weight of all that a value holds, each time that it holds it, at most.
MAX_WEIGHT = 60_000


class TooMuch(Exception):
    """A value or a computation grows beyond what a description needs."""


class Function:
    """Something that an expression may call."""

    __slots__ = ("call", "name")

    def __init__(self, name: str, call: Callable[..., Any]) -> None:
        self.name = name
        self.call = call


class Module(dict[str, Any]):
    """``math``, ``python`` and ``xacro``, whose names are had with a dot."""


def bounded(value: Any) -> Any:
    """*value*, if it is of a size that a description may have."""
    if isinstance(value, (str, list, tuple, dict, set, frozenset, range)) and len(value) > MAX_SIZE:
        raise TooMuch
    if isinstance(value, int) and not isinstance(value, bool) and value.bit_length() > 4 * MAX_DIGITS:
        raise TooMuch
    return value


def weight(value: Any) -> int:
    """How much is in *value*, however deep, counting what it holds twice twice; TooMuch over ``MAX_WEIGHT``."""
    found = 0
    pending = [value]
    while pending:
        each = pending.pop()
        found += 1
        if isinstance(each, str):
            found += len(each) // 16
        elif isinstance(each, dict) and not isinstance(each, Module):
            pending += each.values()
        elif isinstance(each, (list, tuple, set, frozenset)):
            pending += each
        if found + len(pending) > MAX_WEIGHT:
            raise TooMuch
    return found


def _sum(values: Iterable[Any], start: Any = 0) -> Any:
    """The sum of numbers; that of lists is no use to a description, and grows with the square of their number."""
    found = _items(values)
    if not all(isinstance(each, (int, float)) for each in (start, *found)):
        raise NotKnown
    return sum(found, start)


def _items(value: Iterable[Any]) -> list[Any]:
    found = []
    for each in value:
        found.append(each)
        if len(found) > MAX_SIZE:
            raise TooMuch
    return found


def _round(value: float, digits: int | None = None) -> Any:
    return round(value) if digits is None else round(value, max(-MAX_DIGITS, min(digits, MAX_DIGITS)))


def tokenize(text: str, sep: str = ",; ", skip_empty: bool = True) -> list[str]:
    """The parts of *text* between the characters *sep*."""
    parts = re.split(f"[{re.escape(sep)}]", text) if sep else [text]
    return [part for part in parts if part] if skip_empty else parts


_TYPES = {"bool": bool, "dict": dict, "float": float, "int": int, "list": list, "set": set, "str": str, "tuple": tuple}


def _is_a(value: Any, kinds: Any) -> bool:
    """``isinstance``, whose types are the functions of that name here."""
    wanted = kinds if isinstance(kinds, tuple) else (kinds,)
    return isinstance(value, tuple(_TYPES[each.name] for each in wanted))


#: What expressions can call by its bare name in Python; those without a value here are known, their result is not.
PYTHON: Mapping[str, Callable[..., Any]] = {
    "abs": abs,
    "all": lambda values: all(_items(values)),
    "any": lambda values: any(_items(values)),
    "bool": bool,
    "dict": lambda *given, **more: dict(*given, **more),
    "divmod": divmod,
    "enumerate": lambda values, start=0: [(start + at, each) for at, each in enumerate(_items(values))],
    "float": float,
    "int": int,
    "isinstance": _is_a,
    "len": len,
    "list": lambda values=(): _items(values),
    "max": max,
    "min": min,
    "range": lambda *bounds: bounded(range(*bounds)),
    "reversed": lambda values: _items(values)[::-1],
    "round": _round,
    "set": lambda values=(): set(_items(values)),
    "sorted": lambda values: sorted(_items(values)),
    "str": lambda value="": str(bounded(value)),
    "sum": _sum,
    "tuple": lambda values=(): tuple(_items(values)),
    "zip": lambda *values: [tuple(each) for each in zip(*(_items(value) for value in values))],
}
#: Functions of math whose work or result grows with their arguments.
_GROWING = ("comb", "factorial", "perm", "prod", "lcm", "pow", "ldexp", "fsum", "dist", "sumprod")


def _math() -> Module:
    found = Module()
    for name in dir(math):
        value = getattr(math, name)
        if name.startswith("_"):
            continue
        if isinstance(value, float):
            found[name] = value
        else:
            found[name] = Function(name, _pow if name == "pow" else _unknown if name in _GROWING else value)
    return found


class NotKnown(Exception):
    """A computation that is not followed."""


def _unknown(*_: object, **__: object) -> Any:
    raise NotKnown


def _pow(base: float, exponent: float) -> float:
    return math.pow(base, exponent)


MATH = _math()
#: Built-ins of Python that are known by name, whatever they give.
BUILTINS = frozenset(name for name in dir(builtins) if not name.startswith("_"))
PYTHON_MODULE = Module({name: Function(name, call) for name, call in PYTHON.items()})

#: The methods of values that expressions may call.
METHODS: Mapping[type, frozenset[str]] = {
    str: frozenset(
        "capitalize count endswith find index isdigit join lower lstrip partition removeprefix removesuffix replace rfind rpartition"
        " rsplit rstrip split splitlines startswith strip title upper".split()
    ),
    list: frozenset(("count", "index", "copy")),
    tuple: frozenset(("count", "index")),
    dict: frozenset(("copy", "get", "items", "keys", "values")),
    set: frozenset(("difference", "intersection", "union", "issubset", "issuperset")),
    int: frozenset(("bit_length",)),
    float: frozenset(("is_integer",)),
}


def method(value: object, name: str) -> Function | None:
    """The method *name* of *value*, if it is one that can do no harm; its result is bounded by its arguments."""
    kind = next((kind for kind, names in METHODS.items() if isinstance(value, kind) and name in names), None)
    if kind is None:
        return None
    call = getattr(kind, name)
    if kind is dict and name in ("items", "keys", "values"):
        return Function(name, lambda: list(call(value)))
    if name in ("replace", "join"):
        return Function(name, lambda *given: _grown(call, value, given))
    return Function(name, lambda *given, **more: call(value, *given, **more))


def _grown(call: Callable[..., Any], value: Any, given: tuple[Any, ...]) -> Any:
    """``replace`` and ``join``, whose results may be longer than all that they are given."""
    if call is str.join:
        parts = _items(given[0])
        if sum(len(part) + len(value) for part in parts) > MAX_SIZE:
            raise TooMuch
        return value.join(parts)
    if len(value) * max(len(given[1]), 1) > MAX_SIZE * 10:
        raise TooMuch
    return call(value, *given)
