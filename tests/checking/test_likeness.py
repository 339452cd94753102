# SPDX-License-Identifier: Apache-2.0
"""Names that are nearly the same, and names that only look so."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from haros_ci.checking.likeness import is_moved, is_slip, may_be, nearest

NAMES = st.text("abcde_1", max_size=9)


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("velocity_comand", "velocity_command"),
        ("velocity", "velocty"),
        ("velocity", "velocoty"),
        ("velocity", "veolcity"),
        ("cmd_vel", "cmdvel"),
        ("CmdVel", "cmd_vel"),
        ("trajectories", "trajectorie"),
    ],
)
def test_a_slip(first: str, second: str) -> None:
    assert is_slip(first, second)
    assert is_slip(second, first)


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("velocity", "velocity"),
        ("odom", "odon"),
        ("camera1", "camera2"),
        ("camera", "camera2"),
        ("front_left", "front_right"),
        ("joint_x", "joint_y"),
        ("image_raw", "image_rect"),
        ("scan_low", "scan_high"),
        ("planning", "perception"),
        ("velocity", "velocityyy"),
        ("", ""),
    ],
)
def test_no_slip(first: str, second: str) -> None:
    assert not is_slip(first, second)
    assert not is_slip(second, first)


@pytest.mark.parametrize(
    ("first", "second"),
    [("/scan", "/robot/scan"), ("/node/grid", "/node/layer/grid"), ("/a/b/scan", "/scan"), ("/a/scan", "/a/b/scan")],
)
def test_moved(first: str, second: str) -> None:
    assert is_moved(first, second)
    assert is_moved(second, first)


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("/scan", "/scan"),
        ("/a/scan", "/b/scan"),
        ("/a/scan", "/b/c/scan"),
        ("/scan", "/scan/raw"),
        ("/scan", "/robot/scans"),
    ],
)
def test_not_moved(first: str, second: str) -> None:
    assert not is_moved(first, second)
    assert not is_moved(second, first)


@given(NAMES, NAMES)
def test_likeness_is_mutual(first: str, second: str) -> None:
    assert is_slip(first, second) == is_slip(second, first)
    assert not is_slip(first, first)


@pytest.mark.parametrize(
    ("pattern", "name"),
    [
        ("/a", "/a"),
        ("/?", "/a"),
        ("/?/a", "/a"),
        ("/?/a", "/b/c/a"),
        ("/?a", "/ba"),
        ("/a/?/b", "/a/b"),
        ("?", "/a/b"),
        ("/a?", "/a"),
    ],
)
def test_may_be(pattern: str, name: str) -> None:
    assert may_be(pattern, name)


@pytest.mark.parametrize(
    ("pattern", "name"), [("/a", "/b"), ("/?/a", "/b"), ("/?/a", "/ba"), ("/a?", "/b"), ("/a.b?", "/acb")]
)
def test_may_not_be(pattern: str, name: str) -> None:
    assert not may_be(pattern, name)


@pytest.mark.parametrize(
    ("name", "names", "expected"),
    [
        ("image_widht", ("image_width", "image_height"), "image_width"),
        ("P4_RX_PREFIX", ("PX4_RX_PREFIX",), "PX4_RX_PREFIX"),
        ("scan_pub", ("scan_pub_", "scan_sub"), "scan_pub_"),
        ("cmd_pub", ("cmd_vel_pub",), "cmd_vel_pub"),
        ("headlss", ("headless", "debug"), "headless"),
        ("gz_arg", ("gz_args", "ign_args"), "gz_args"),
        ("poses_left", ("pose_left", "pose_right"), "pose_left"),
        ("config", ("configs",), "configs"),
        # of another thing
        ("image_x", ("image_id", "image_width"), None),
        ("scan_pub", ("scan_sub",), None),
        ("pose_publisher", ("pose_subscriber",), None),
        ("wheel_1", ("wheel_2",), None),
        ("joint_x", ("joint_y",), None),
        ("arm_left", ("arm_right",), None),
        ("goal_reached", ("goal_position",), None),
        ("speed", ("colour",), None),
        ("speed", (), None),
        ("", ("a",), None),
    ],
)
def test_the_name_that_is_meant(name: str, names: tuple[str, ...], expected: str | None) -> None:
    assert nearest(name, names) == expected
