# SPDX-License-Identifier: Apache-2.0
"""Which released package is meant by a name that no package has."""

from __future__ import annotations

import pytest

from haros_ci.checking.package_names import meant_released


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("tf2_rs", "tf2_ros"),
        ("tf2_orss", None),
        ("rvz2", "rviz2"),
        ("rvizz", "rviz"),
        ("xarco", "xacro"),
        ("gaebo_ros", "gazebo_ros"),
        ("nodelt", "nodelet"),
        ("robot_state_pulisher", "robot_state_publisher"),
        # names of their own, or too short
        ("tf2_ros", None),
        ("rviz3", None),
        ("tf3_ros", None),
        ("joy2", None),
        ("jy", None),
        ("tf", None),
        ("rcp", None),
        ("acme", None),
        ("dviz", None),
        ("mapping", None),
        ("my_robot", None),
        ("", None),
    ],
)
def test_the_released_package_that_is_meant(name: str, expected: str | None) -> None:
    assert meant_released(name) == expected
