# SPDX-License-Identifier: Apache-2.0
"""Names that are nearly the same, and names that only look so."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from haros_ci.checking.likeness import is_moved, is_slip, may_be

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
