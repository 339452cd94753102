# SPDX-License-Identifier: Apache-2.0
"""What a callback finds of its own when it runs again: plain values, and numbers that it counts."""

from __future__ import annotations

from haros_ci.values.abstract import NONE, Choice, Known, Opaque, Text

#: Why a number is not known that a callback changes whenever it runs.
COUNTS = "a callback gives it another number each time"


def has_other_number(held: object, value: object) -> bool:
    """Whether a number is another one after a callback than before it."""
    if held is value:
        return False
    before, then = _numbers(held), _numbers(value)
    return bool(before and then - before)


def goes_on(held: object, first: object, second: object) -> bool:
    """Whether a number that became *first* becomes yet another one."""
    if is_counted(first):
        return True
    before, then, now = _numbers(held), _numbers(first), _numbers(second)
    return bool(before and then) and (isinstance(second, Opaque) or bool(now - before - then))


def _numbers(value: object) -> frozenset[object]:
    options = value.options if isinstance(value, Choice) else (value,)
    return frozenset(option.value for option in options if isinstance(option, Known) and option.kind in (int, float))


def is_counted(value: object) -> bool:
    """Whether a value is not known as a callback counts it."""
    return isinstance(value, Opaque) and value.reason == COUNTS


def is_seen_again(held: object, value: object) -> bool:
    """Whether a callback finds what it left behind when it ran before: plain values, and flags and texts that are not known then."""
    if isinstance(value, Opaque):
        return is_counted(value) or (_is_plain(held) and held != NONE)
    return _is_plain(value)


def _is_plain(value: object) -> bool:
    options = value.options if isinstance(value, Choice) else (value,)
    return all(isinstance(option, (Known, Text)) for option in options)
