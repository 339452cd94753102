# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from haros_ci.model.condition import evaluate

ENVIRONMENT = {"ROS_VERSION": "2", "ROS_DISTRO": "jazzy", "EMPTY": ""}


@pytest.mark.parametrize(
    ("condition", "expected"),
    [
        ("$ROS_VERSION == 2", True),
        ("$ROS_VERSION==2", True),
        ("2 == $ROS_VERSION", True),
        ("$ROS_VERSION == 1", False),
        ("$ROS_VERSION != 1", True),
        ("$ROS_DISTRO >= humble", True),
        ("$ROS_DISTRO < iron", False),
        ("$ROS_DISTRO <= 'jazzy'", True),
        ('$ROS_DISTRO > "jazzy"', False),
        ("$EMPTY == ''", True),
        ("$ROS_VERSION == 1 or $ROS_VERSION == 2", True),
        ("$ROS_VERSION == 1 and $ROS_VERSION == 2", False),
        ("a == a or a == a and a == b", True),  # and binds closer
        ("(a == a or a == a) and a == b", False),
        ("((a == a))", True),
        ("and == and", True),
        # decided whatever the unknown variable is
        ("$UNKNOWN == 1 or a == a", True),
        ("$UNKNOWN == 1 and a == b", False),
        # not decided
        ("$UNKNOWN == 1", None),
        ("$UNKNOWN == $UNKNOWN", None),
        ("$UNKNOWN == 1 or a == b", None),
        ("$UNKNOWN == 1 and a == a", None),
        # malformed
        ("", None),
        ("$ROS_VERSION", None),
        ("$ROS_VERSION == ", None),
        ("$ROS_VERSION = 2", None),
        ("$ROS_VERSION == 2 extra", None),
        ("($ROS_VERSION == 2", None),
        ("$ROS_VERSION == 2)", None),
        ("'open == 2", None),
        ("not $ROS_VERSION == 2", None),
        ("$ == 2", None),
        ("(" * 400 + "a == a" + ")" * 400, None),
        ("a == a or " * 200 + "a == a", None),  # too long
    ],
)
def test_evaluate(condition: str, expected: bool | None) -> None:
    assert evaluate(condition, ENVIRONMENT) is expected
