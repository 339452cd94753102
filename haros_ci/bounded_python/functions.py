# SPDX-License-Identifier: Apache-2.0
"""The functions of Python that expressions may call, each bounded by what it is given."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from haros_ci.bounded_python.limits import NotFollowed, TooMuch
from haros_ci.records import dataclass

#: The longest collection that a function takes or makes; what a language allows besides is in its limits.
MAX_SIZE = 20_000
MAX_DIGITS = 400


@dataclass(frozen=True, slots=True, eq=False)
class Function:
    """Something that an expression may call; *is_truth* if it gives True or False, whatever it is given."""

    name: str
    call: Callable[..., Any]
    is_truth: bool = False


def items(values: Iterable[Any]) -> list[Any]:
    """What is in *values*, in order; TooMuch if that is more than a collection may hold."""
    found = []
    for value in values:
        found.append(value)
        if len(found) > MAX_SIZE:
            raise TooMuch
    return found


def _sum(values: Iterable[Any], start: Any = 0) -> Any:
    """The sum; that of lists grows with the square of their number."""
    found = items(values)
    if any(isinstance(item, (list, tuple)) for item in (start, *found)):
        raise NotFollowed(description="adds up lists, which is not interpreted")
    return sum(found, start)


def _sorted(*values: Any, key: object = None, reverse: Any = False) -> Any:
    if key is not None:
        raise NotFollowed(description="sorts by a key, which is not interpreted")
    return sorted(*values, reverse=reverse)


def _round(value: float, digits: int | None = None) -> Any:
    return round(value) if digits is None else round(value, max(-MAX_DIGITS, min(digits, MAX_DIGITS)))


def _range(*bounds: int) -> range:
    found = range(*bounds)
    if len(found) > MAX_SIZE:
        raise TooMuch
    return found


def _text(value: Any = "") -> str:
    if isinstance(value, (str, list, tuple, dict, set, frozenset, range)) and len(value) > MAX_SIZE:
        raise TooMuch
    return str(value)


#: What they are in Python by their bare names.
FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    "abs": abs,
    "all": all,
    "any": any,
    "bool": bool,
    "dict": lambda *arguments, **more: dict(*arguments, **more),
    "divmod": divmod,
    "enumerate": lambda values, start=0: [(start + at, item) for at, item in enumerate(items(values))],
    "float": float,
    "int": int,
    "len": len,
    "list": lambda values=(): items(values),
    "max": max,
    "min": min,
    "range": _range,
    "reversed": lambda values: items(values)[::-1],
    "round": _round,
    "set": lambda values=(): set(items(values)),
    "sorted": _sorted,
    "str": _text,
    "sum": _sum,
    "tuple": lambda values=(): tuple(items(values)),
    "zip": lambda *values: [tuple(item) for item in zip(*(items(value) for value in values))],
}
