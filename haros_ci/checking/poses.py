# SPDX-License-Identifier: Apache-2.0
"""Where static transforms put a frame, as numbers, from the forms in which launch files and robot descriptions write it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import cos, isfinite, sin, sqrt

#: Metres, and parts of a unit quaternion, that make no difference.
NEAR = 1e-4
#: A place, and a quaternion of length 1 (x, y, z, w).
Pose = tuple[float, ...]


def of_words(words: Sequence[str]) -> Pose | None:
    """``x y z yaw pitch roll`` or ``x y z qx qy qz qw``; None if a word is no number."""
    numbers = _numbers(words)
    if numbers is None or len(numbers) not in (6, 7):
        return None
    if len(numbers) == 6:
        yaw, pitch, roll = numbers[3:]
        return (*numbers[:3], *_quaternion(roll, pitch, yaw))
    return _unit(numbers)


def of_options(named: Mapping[str, str]) -> Pose | None:
    """``--x 1 --yaw 3.14``, or ``--qx 0 …``, what is not given as the program has it (tf2_ros, ``static_transform_broadcaster_program.cpp``)."""
    place = _numbers([named.get(f"--{axis}", "0") for axis in "xyz"])
    quaternion = [named.get(f"--q{axis}", "1" if axis == "w" else "0") for axis in "xyzw"]
    angles = _numbers([named.get(f"--{angle}", "0") for angle in ("roll", "pitch", "yaw")])
    turn = _numbers(quaternion)
    if place is None or angles is None or turn is None:
        return None
    if any(f"--q{axis}" in named for axis in "xyzw"):
        return _unit((*place, *turn))
    return (*place, *_quaternion(*angles))


def of_origin(xyz: str | None, rpy: str | None) -> Pose | None:
    """An ``<origin>`` of URDF, of which either may be left out (""); None if one is not known."""
    if xyz is None or rpy is None:
        return None
    place, angles = _numbers(xyz.split() or ["0"] * 3), _numbers(rpy.split() or ["0"] * 3)
    if place is None or angles is None or len(place) != 3 or len(angles) != 3:
        return None
    return (*place, *_quaternion(*angles))


def are_same(one: Pose | None, other: Pose | None) -> bool:
    """Whether two poses are known and put a frame to one place: a quaternion and its negative turn it alike."""
    if one is None or other is None:
        return False
    away = [abs(here - there) for here, there in zip(one[:3], other[:3], strict=True)]
    turns = [(sign * here - there) for sign in (1.0, -1.0) for here, there in zip(one[3:], other[3:], strict=True)]
    return max(away) < NEAR and (max(map(abs, turns[:4])) < NEAR or max(map(abs, turns[4:])) < NEAR)


def _numbers(words: Sequence[str]) -> tuple[float, ...] | None:
    try:
        found = tuple(float(word) for word in words)
    except ValueError:
        return None
    return found if all(map(isfinite, found)) else None


def _unit(pose: Sequence[float]) -> Pose | None:
    length = sqrt(sum(part * part for part in pose[3:]))
    return (*pose[:3], *(part / length for part in pose[3:])) if isfinite(length) and length > NEAR else None


def _quaternion(roll: float, pitch: float, yaw: float) -> Pose:
    """Turns about the fixed axes x, y and z, one after the other (REP 103)."""
    (a, b, c), (d, e, f) = ([function(angle / 2) for angle in (roll, pitch, yaw)] for function in (sin, cos))
    return (a * e * f - d * b * c, d * b * f + a * e * c, d * e * c - a * b * f, d * e * f + a * b * c)
