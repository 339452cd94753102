# SPDX-License-Identifier: Apache-2.0
"""Types of messages that ROS 1 takes for one another, as their MD5 sums are the same."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import pytest

from haros_ci.interfaces.sums import SumsOfMessages
from haros_ci.model.package import Package

FILES = {
    "race/msg/Angle.msg": "# left is positive\nfloat32 value\n",
    "reach/msg/Angle.msg": "float32    value   # radians\n",
    "reach/msg/Other.msg": "float64 value\n",
    "reach/msg/Named.msg": "float32 angle\n",
    "race/msg/Path.msg": "Header header\nAngle[] angles\n",
    "reach/msg/Path.msg": "std_msgs/Header header\nreach/Angle[] angles\n",
    "reach/msg/Far.msg": "Header header\nOther[] angles\n",
    "race/msg/Lost.msg": "unseen_msgs/Thing thing\n",
    "reach/msg/Lost.msg": "unseen_msgs/Thing thing\n",
    "reach/msg/Constant.msg": "float32 LEFT=1\nfloat32 value\n",
    "reach/msg/Broken.msg": "float32\n",
    "reach/msg/Count.msg": "float32 data\n",
}
#: Pairs of types, and whether they are one.
CASES = [
    ("race/Angle", "reach/Angle", True),
    ("race/Path", "reach/Path", True),
    ("reach/Count", "std_msgs/Float32", True),
    ("race/Angle", "reach/Other", False),
    ("race/Angle", "reach/Named", False),
    ("race/Path", "reach/Far", False),
    ("race/Angle", "reach/Constant", False),
    ("race/Lost", "reach/Lost", False),  # a part of it is not known
    ("race/Angle", "reach/Broken", False),
    ("race/Angle", "reach/Gone", False),
    ("geometry_msgs/Point", "geometry_msgs/Vector3", True),
    ("unseen_msgs/A", "unseen_msgs/B", False),
]


@dataclass
class Texts:
    """As much of a workspace as is read."""

    names: frozenset[str]

    def text(self, path: str) -> str:
        return FILES[path]


def sums() -> SumsOfMessages:
    workspace: Any = Texts(frozenset(FILES))
    return SumsOfMessages(workspace, {name: Package(name, name, ros=1) for name in ("race", "reach")})


@pytest.mark.parametrize(("one", "other", "expected"), CASES)
def test_are_one(one: str, other: str, expected: bool) -> None:
    assert sums().are_one(one, other) is expected


def test_without_a_workspace() -> None:
    found = SumsOfMessages(None, {})
    assert found.are_one("geometry_msgs/Point", "geometry_msgs/Vector3")
    assert not found.are_one("race/Angle", "reach/Angle")
