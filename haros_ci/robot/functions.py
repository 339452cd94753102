# SPDX-License-Identifier: Apache-2.0
"""The functions that expressions of xacro may call (xacro's create_global_symbols), each bounded; others are known by name only."""

from __future__ import annotations

import builtins
import math
import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from haros_ci.bounded_python.functions import FUNCTIONS, MAX_SIZE, Function, items
from haros_ci.bounded_python.limits import Limits, Module, NotFollowed, TooMuch, check_text_method

__all__ = [
    "BUILTINS",
    "CHANGING",
    "LIMITS",
    "MATH",
    "METHODS",
    "PYTHON",
    "PYTHON_MODULE",
    "Function",
    "Module",
    "NotFollowed",
    "TooMuch",
    "change",
    "method",
    "tokenize",
]

#: How much a description needs.
LIMITS = Limits(characters=4_000, depth=40, size=MAX_SIZE, bits=1_600)


def tokenize(text: str, sep: str = ",; ", skip_empty: bool = True) -> list[str]:
    """The parts of *text* between the characters *sep*."""
    parts = re.split(f"[{re.escape(sep)}]", text) if sep else [text]
    return [part for part in parts if part] if skip_empty else parts


def _sum(values: Iterable[Any], start: Any = 0) -> Any:
    """The sum of numbers; that of others is no use to a description."""
    found = items(values)
    if not all(isinstance(item, (int, float)) for item in (start, *found)):
        raise NotFollowed
    return sum(found, start)


_TYPES = {"bool": bool, "dict": dict, "float": float, "int": int, "list": list, "set": set, "str": str, "tuple": tuple}


def _is_a(value: Any, kinds: Any) -> bool:
    """``isinstance``, whose types are the functions of that name here."""
    kinds_ = kinds if isinstance(kinds, tuple) else (kinds,)
    return isinstance(value, tuple(_TYPES[item.name] for item in kinds_))


#: What expressions can call by its bare name in Python; those without a value here are known, their result is not.
PYTHON: Mapping[str, Callable[..., Any]] = {**FUNCTIONS, "isinstance": _is_a, "sum": _sum}
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


def _unknown(*_: object, **__: object) -> Any:
    raise NotFollowed


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


#: The methods that change a list where it is.
CHANGING = frozenset(("append", "clear", "extend", "insert", "pop", "remove", "reverse"))


def change(values: list[Any], name: str, received: tuple[Any, ...]) -> Any:
    """What a method of CHANGING does to a list. It may get no lists itself, which might hold it, and no more than a value may hold."""
    added = items(received[0]) if name == "extend" and len(received) == 1 else received
    if any(isinstance(item, (list, tuple, dict, set)) for item in added):
        raise NotFollowed
    if len(values) + len(added) > LIMITS.size:
        raise TooMuch
    return getattr(list, name)(values, *received)


def method(value: object, name: str) -> Function | None:
    """The method *name* of *value*, if it is one that can do no harm; its result is bounded by its arguments."""
    kind = next((kind for kind, names in METHODS.items() if isinstance(value, kind) and name in names), None)
    if kind is None:
        return None
    call = getattr(kind, name)
    if kind is dict and name in ("items", "keys", "values"):
        return Function(name, lambda: list(call(value)))
    if name in ("replace", "join"):
        return Function(name, lambda *arguments: _grown(name, value, arguments))
    return Function(name, lambda *arguments, **more: call(value, *arguments, **more))


def _grown(name: str, value: Any, received: tuple[Any, ...]) -> Any:
    """``replace`` and ``join``, whose results may be longer than all that they are given."""
    arguments = [items(received[0])] if name == "join" else [*received]
    check_text_method(name, value, arguments, LIMITS)
    return getattr(str, name)(value, *arguments)
