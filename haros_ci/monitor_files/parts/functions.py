# SPDX-License-Identifier: Apache-2.0
"""The functions of HPL."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from haros_ci.monitor_files.parts.values import DEEPEST, FAULTS, ROTATIONS, get, members, num, tame


def hpl_abs(value: Any) -> Any:
    return tame(abs(value))


def hpl_sqrt(value: Any) -> float:
    return math.sqrt(value)


def hpl_ceil(value: Any) -> Any:
    return tame(math.ceil(value))


def hpl_floor(value: Any) -> Any:
    return tame(math.floor(value))


def hpl_log(*values: Any) -> float:
    return math.log(*values)


def hpl_sin(value: Any) -> float:
    return math.sin(value)


def hpl_cos(value: Any) -> float:
    return math.cos(value)


def hpl_tan(value: Any) -> float:
    return math.tan(value)


def hpl_asin(value: Any) -> float:
    return math.asin(value)


def hpl_acos(value: Any) -> float:
    return math.acos(value)


def hpl_atan(value: Any) -> float:
    return math.atan(value)


def hpl_atan2(y: Any, x: Any) -> float:
    return math.atan2(y, x)


def hpl_deg(value: Any) -> float:
    return math.degrees(value)


def hpl_rad(value: Any) -> float:
    return math.radians(value)


def hpl_bool(value: Any) -> bool:
    return bool(value)


def hpl_int(value: Any) -> Any:
    return tame(int(value))


def hpl_float(value: Any) -> float:
    return float(value)


def hpl_str(value: Any) -> str:
    if isinstance(value, (bool, int, float, str)):
        return str(value)
    raise TypeError("no text")


def hpl_len(value: Any) -> int:
    return len(value if isinstance(value, str) else members(value))


def hpl_sum(values: Any) -> Any:
    total: Any = 0
    for value in members(values):
        total = tame(total + num(value))
    return total


def hpl_prod(values: Any) -> Any:
    total: Any = 1
    for value in members(values):
        total = tame(total * num(value))
    return total


def spread(values: Sequence[Any]) -> Sequence[Any]:
    """The members of one compound, or several numbers."""
    return members(values[0]) if len(values) == 1 else values


def hpl_max(*values: Any) -> Any:
    return tame(max(spread(values)))


def hpl_min(*values: Any) -> Any:
    return tame(min(spread(values)))


def hpl_gcd(*values: Any) -> Any:
    found = 0
    for value in spread(values):
        found = math.gcd(found, int(value))
    return tame(found)


def optional(message: Any, name: str) -> Any:
    """A field, None if the message does not have it."""
    try:
        return get(message, name)
    except FAULTS:
        return None


def quaternion(values: Sequence[Any]) -> Sequence[Any]:
    """w, x, y, z of a quaternion, or of the message that holds one."""
    if len(values) > 1:
        return values
    message = values[0]
    for _ in range(DEEPEST):
        inner = next((found for name in ROTATIONS if (found := optional(message, name)) is not None), None)
        if inner is None:
            break
        message = inner
    return get(message, "w"), get(message, "x"), get(message, "y"), get(message, "z")


def hpl_roll(*values: Any) -> float:
    w, x, y, z = quaternion(values)
    return math.atan2(2.0 * (z * y + w * x), 1.0 - 2.0 * (x * x + y * y))


def hpl_pitch(*values: Any) -> float:
    w, x, y, z = quaternion(values)
    return math.asin(max(-1.0, min(1.0, 2.0 * (y * w - z * x))))


def hpl_yaw(*values: Any) -> float:
    w, x, y, z = quaternion(values)
    return math.atan2(2.0 * (z * w + x * y), -1.0 + 2.0 * (w * w + x * x))
