# SPDX-License-Identifier: Apache-2.0
"""Packages that newer distributions of ROS 2 do not have."""

from __future__ import annotations

import pytest

from haros_ci.checking.gone_packages import said_gone

RENAMED = " (nav2_recoveries is called nav2_behaviors since Humble: rename it where it is named, too)"


@pytest.mark.parametrize(
    ("names", "ros", "expected"),
    [
        (("nav2_recoveries",), 2, RENAMED),
        (("nav2_core", "nav2_recoveries"), 2, RENAMED),
        (("nav2_dynamic_params",), 2, " (nav2_dynamic_params is in no distribution after Dashing)"),
        (("joint_state_controller",), 1, ""),
        (("nav2_behaviors", "gazebo_ros", "ros_ign_gazebo"), 2, ""),
        (("nav2_recoveries",), 1, ""),
        (("nav2_recoveries",), None, ""),
        (("acme_robot", "python3-numpy", ""), 2, ""),
        ((), 2, ""),
    ],
)
def test_what_is_said(names: tuple[str, ...], ros: int | None, expected: str) -> None:
    assert said_gone(names, ros) == expected
