# SPDX-License-Identifier: Apache-2.0
"""What predicates do with the values of messages, which are dicts (JSON) or instances of dataclasses (bags).

A value that is not there, or not of the kind that is needed, raises one of ``FAULTS``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Any

#: What reading a value or calculating with it can raise; the predicate is false then.
FAULTS = (LookupError, TypeError, ValueError, AttributeError, ArithmeticError, RecursionError)
#: Items of a range that a quantifier goes through.
MOST_ITEMS = 100_000
#: Whole numbers beyond are calculated with as floating point numbers.
GREATEST = 1 << 256
GREATEST_EXPONENT = 64
#: Where messages of geometry_msgs keep their quaternion.
_ROTATIONS = ("quaternion", "orientation", "rotation", "pose", "transform")
_DEEPEST = 4


#: The parts of times and durations of ROS 1, as they are called where bags are read.
_OF_TIMES = {"secs": "sec", "nsecs": "nanosec"}


def field(message: Any, name: str) -> Any:
    """The field or constant *name* of *message*."""
    if type(message) is dict:
        return message[name]
    if name[:1] == "_" or not hasattr(type(message), "__dataclass_fields__"):
        raise LookupError(name)
    try:
        return getattr(message, name)
    except AttributeError:
        return getattr(message, _OF_TIMES[name])


def item(array: Any, index: Any) -> Any:
    """``array[index]``, a plain number where it is one of numpy's; no index counts from the end."""
    if isinstance(array, (str, dict)) or index != (at := int(index)) or not 0 <= at < len(array):
        raise LookupError(f"no item {index}")
    found = array[at]
    plain = getattr(found, "item", None)
    return found if plain is None or isinstance(found, (dict, list)) else plain()


def members(compound: Any) -> Sequence[Any]:
    """The members of an array, a set or the whole numbers of a range."""
    if isinstance(compound, Interval):
        return compound.whole()
    if isinstance(compound, (str, dict)):
        raise TypeError("no array")
    plain = getattr(compound, "tolist", None)
    found = compound if plain is None else plain()
    if not isinstance(found, (list, tuple)):
        raise TypeError("no array")
    return found


class Interval:
    """``[low to high]``."""

    __slots__ = ("high", "low", "open_high", "open_low")

    def __init__(self, low: float, high: float, open_low: bool, open_high: bool) -> None:
        self.low, self.high = low, high
        self.open_low, self.open_high = open_low, open_high

    def has(self, value: Any) -> bool:
        """Whether *value* is in it."""
        above = self.low < value if self.open_low else self.low <= value
        return bool(above and (value < self.high if self.open_high else value <= self.high))

    def whole(self) -> range:
        """Its whole numbers; OverflowError if there are too many."""
        first, last = math.ceil(self.low), math.floor(self.high)
        first += self.open_low and first == self.low
        last -= self.open_high and last == self.high
        if last - first >= MOST_ITEMS:
            raise OverflowError("too many items")
        return range(first, last + 1)


def is_in(value: Any, compound: Any) -> bool:
    """``value in compound``."""
    return compound.has(value) if isinstance(compound, Interval) else bool(value in members(compound))


def tamed(number: Any) -> Any:
    """*number*, as a floating point number if it is a great whole one."""
    return float(number) if type(number) is int and not -GREATEST < number < GREATEST else number


def power(base: Any, exponent: Any) -> Any:
    """``base ** exponent``, never a complex number."""
    if type(base) is int and type(exponent) is int and 0 <= exponent <= GREATEST_EXPONENT:
        return tamed(tamed(base) ** exponent)
    return math.pow(base, exponent)


def number(value: Any) -> Any:
    """*value*, if it is a number; TypeError else (``+`` joins texts in Python, not in HPL)."""
    if isinstance(value, (int, float)):
        return value
    raise TypeError("no number")


def _sum(values: Iterable[Any]) -> Any:
    total: Any = 0
    for value in values:
        total = tamed(total + number(value))
    return total


def _product(values: Iterable[Any]) -> Any:
    total: Any = 1
    for value in values:
        total = tamed(total * number(value))
    return total


def _spread(function: Callable[[Sequence[Any]], Any]) -> Callable[..., Any]:
    """A function of the members of one compound, or of several numbers."""
    return lambda *values: function(members(values[0]) if len(values) == 1 else values)


def quaternion(message: Any) -> tuple[Any, Any, Any, Any]:
    """w, x, y, z of a quaternion, or of the message that holds one (hpl-rv-gen 0.2, ``predicates.python.jinja``)."""
    for _ in range(_DEEPEST):
        inner = next((found for name in _ROTATIONS if (found := _optional(message, name)) is not None), None)
        if inner is None:
            break
        message = inner
    return field(message, "w"), field(message, "x"), field(message, "y"), field(message, "z")


def _optional(message: Any, name: str) -> Any:
    try:
        return field(message, name)
    except FAULTS:
        return None


def _of_rotation(function: Callable[[Any, Any, Any, Any], float]) -> Callable[..., float]:
    return lambda *values: function(*(quaternion(values[0]) if len(values) == 1 else values))


def _roll(w: Any, x: Any, y: Any, z: Any) -> float:
    return math.atan2(2.0 * (z * y + w * x), 1.0 - 2.0 * (x * x + y * y))


def _pitch(w: Any, x: Any, y: Any, z: Any) -> float:
    return math.asin(max(-1.0, min(1.0, 2.0 * (y * w - z * x))))


def _yaw(w: Any, x: Any, y: Any, z: Any) -> float:
    return math.atan2(2.0 * (z * w + x * y), -1.0 + 2.0 * (w * w + x * x))


def _text(value: Any) -> str:
    if isinstance(value, (bool, int, float, str)):
        return str(value)
    raise TypeError("no text")


#: The functions of the language.
FUNCTIONS: dict[str, Callable[..., Any]] = {
    "abs": abs, "sqrt": math.sqrt, "ceil": math.ceil, "floor": math.floor, "log": math.log,
    "sin": math.sin, "cos": math.cos, "tan": math.tan, "asin": math.asin, "acos": math.acos, "atan": math.atan, "atan2": math.atan2,
    "deg": math.degrees, "rad": math.radians, "bool": bool, "int": int, "float": float, "str": _text,
    "len": lambda value: len(value if isinstance(value, str) else members(value)),
    "sum": lambda value: _sum(members(value)), "prod": lambda value: _product(members(value)),
    "max": _spread(max), "min": _spread(min), "gcd": _spread(lambda values: math.gcd(*map(int, values))),
    "roll": _of_rotation(_roll), "pitch": _of_rotation(_pitch), "yaw": _of_rotation(_yaw),
}  # fmt: skip
