# SPDX-License-Identifier: Apache-2.0
"""What predicates do with the values of messages: dicts, or objects of rospy and rclpy."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

#: What reading a value or calculating with it can raise; the predicate is false then.
FAULTS = (LookupError, TypeError, ValueError, AttributeError, ArithmeticError, RecursionError)
#: Items of a range that a quantifier goes through.
MOST_ITEMS = 100_000
#: Whole numbers beyond are calculated with as floating point numbers.
GREATEST = 1 << 256
GREATEST_EXPONENT = 64
#: The parts of times, which ROS 1 and ROS 2 call by different names.
TIMES = {"secs": "sec", "nsecs": "nanosec", "sec": "secs", "nanosec": "nsecs"}
#: Where messages of geometry_msgs keep their quaternion.
ROTATIONS = ("quaternion", "orientation", "rotation", "pose", "transform")
DEEPEST = 4
#: The types of the fields of each class of messages, "" where it does not say them.
FIELDS: dict[type, Mapping[str, str]] = {}


class Missing:
    """A value that a message does not have."""


MISSING = Missing()


def get(message: Any, *names: str) -> Any:
    """The field of *message* to which *names* lead."""
    for name in names:
        message = message[name] if type(message) is dict else attribute(message, name)
    return message


def attribute(message: Any, name: str) -> Any:
    """The field or constant *name* of a message of rospy or rclpy."""
    kind = type(message)
    fields = FIELDS.get(kind)
    if fields is None:
        of_ros2 = getattr(message, "get_fields_and_field_types", None)
        fields = dict(of_ros2()) if of_ros2 is not None else dict.fromkeys(getattr(kind, "__slots__", ()), "")
        FIELDS[kind] = fields
    if name not in fields and TIMES.get(name) in fields:
        name = TIMES[name]
    if name in fields and name[:1] != "_":
        value = getattr(message, name)
        return value[0] if fields[name] == "octet" else value
    constant = getattr(kind, name, None)
    if name[:1] == "_" or not isinstance(constant, (bool, int, float, str)):
        raise LookupError(name)
    return constant


def of(known: Mapping[str, Any], alias: str, key: str) -> Any:
    """The value that was kept of the message called *alias*."""
    return there(known[alias], key)


def there(kept: Mapping[str, Any], key: str) -> Any:
    """A kept value."""
    value = kept[key]
    if value is MISSING:
        raise LookupError("no such value")
    return value


def item(array: Any, index: Any) -> Any:
    """``array[index]``, a plain number where it is one of numpy's; no index counts from the end."""
    if isinstance(array, (str, dict)) or index != int(index) or not 0 <= int(index) < len(array):
        raise LookupError("no such item")
    found = array[int(index)]
    if type(found).__module__ == "numpy":
        found = found.item()
    return found[0] if isinstance(found, bytes) else found


def members(compound: Any) -> Sequence[Any]:
    """The members of an array, a set or the whole numbers of a range."""
    if isinstance(compound, Interval):
        return compound.whole()
    if type(compound).__module__ in ("array", "numpy"):
        compound = compound.tolist()
    if isinstance(compound, bytes):  # uint8[] of rospy
        return list(compound)
    if not isinstance(compound, (list, tuple)):
        raise TypeError("no array")
    return [value[0] if isinstance(value, bytes) else value for value in compound]


def indices(array: Any) -> range:
    """The indices of an array."""
    return range(len(members(array)))


class Interval:
    """``[low to high]``."""

    def __init__(self, low: Any, high: Any, open_low: bool = False, open_high: bool = False) -> None:
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


def tame(number: Any) -> Any:
    """*number*, as a floating point number if it is a great whole one."""
    return float(number) if type(number) is int and not -GREATEST < number < GREATEST else number


def num(value: Any) -> Any:
    """*value*, if it is a number; TypeError else (``+`` joins texts in Python, not in HPL)."""
    if isinstance(value, (int, float)):
        return value
    raise TypeError("no number")


def add(a: Any, b: Any) -> Any:
    """``a + b``."""
    return tame(num(a) + num(b))


def subtract(a: Any, b: Any) -> Any:
    """``a - b``."""
    return tame(num(a) - num(b))


def multiply(a: Any, b: Any) -> Any:
    """``a * b``."""
    return tame(num(a) * num(b))


def divide(a: Any, b: Any) -> Any:
    """``a / b``."""
    return num(a) / num(b)


def power(base: Any, exponent: Any) -> Any:
    """``base ** exponent``, never a complex number."""
    base, exponent = num(base), num(exponent)
    if type(base) is int and type(exponent) is int and 0 <= exponent <= GREATEST_EXPONENT:
        return tame(tame(base) ** exponent)
    return math.pow(base, exponent)
