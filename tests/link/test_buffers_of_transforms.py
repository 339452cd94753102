# SPDX-License-Identifier: Apache-2.0
"""C++ of ROS 1: a buffer of transforms offers its frames where it is constructed with debug (tf2_ros/src/buffer.cpp)."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import conditions, cpp, ends, types

INCLUDES = "#include <tf2_ros/buffer.h>\n#include <tf2_ros/transform_listener.h>\n"
FRAMES = [("/n/tf2_frames", "tf2_msgs/FrameGraph")]


@pytest.mark.parametrize(
    ("body", "before"),
    [
        ("tf2_ros::Buffer b(ros::Duration(2.0), true);", ""),
        ("tf2_ros::Buffer b{ros::Duration(2.0), true};", ""),
        ("tf2_ros::Buffer b(ros::Duration(2.0), 1);", ""),
        ("bool debug = true; tf2_ros::Buffer b(ros::Duration(2.0), debug);", ""),
        ("std::unique_ptr<tf2_ros::Buffer> b; b.reset(new tf2_ros::Buffer(ros::Duration(2.0), true));", ""),
        ("std::shared_ptr<tf2_ros::Buffer> b = std::make_shared<tf2_ros::Buffer>(ros::Duration(2.0), true);", ""),
        ("tf2_ros::Buffer* b = new tf2_ros::Buffer(ros::Duration(2.0), true);", ""),
        (
            "C c;",
            "struct C { C() : b(ros::Duration(2.0), true), l(b) {} tf2_ros::Buffer b; tf2_ros::TransformListener l; };",
        ),
        ("C c;", "struct C { tf2_ros::Buffer b{ros::Duration(2.0), true}; };"),
        (
            "C c;",
            "struct C { C() { b.reset(new tf2_ros::Buffer(ros::Duration(2.0), true)); } boost::scoped_ptr<tf2_ros::Buffer> b; };",
        ),
    ],
)
def test_with_debug(body: str, before: str) -> None:
    node = cpp(body, INCLUDES + before)
    assert types(node, "servers") == FRAMES
    (end,) = ends(node, "servers")
    assert not end.unknowns


@pytest.mark.parametrize(
    ("body", "before"),
    [
        ("tf2_ros::Buffer b;", ""),
        ("tf2_ros::Buffer b(ros::Duration(2.0));", ""),
        ("tf2_ros::Buffer b(ros::Duration(2.0), false);", ""),
        ("tf2_ros::Buffer b(ros::Duration(2.0), 0);", ""),
        ("bool debug = false; tf2_ros::Buffer b(ros::Duration(2.0), debug);", ""),
        ("std::unique_ptr<tf2_ros::Buffer> b; b.reset(new tf2_ros::Buffer(ros::Duration(2.0)));", ""),
        ("std::unique_ptr<tf2_ros::Buffer> b; b.reset();", ""),
        ("auto b = std::make_shared<tf2_ros::Buffer>();", ""),
        ("tf2_ros::Buffer* b = nullptr;", ""),
        ("tf2::BufferCore b(ros::Duration(2.0), true);", ""),
        ("other::Buffer b(ros::Duration(2.0), true);", ""),
        ('tf2_ros::Buffer b; b.canTransform("a", "b", ros::Time(0), ros::Duration(1.0));', ""),
        ("C c;", "struct C { C() : l(b) {} tf2_ros::Buffer b; tf2_ros::TransformListener l; };"),
        ("", "struct C { tf2_ros::Buffer b{ros::Duration(2.0), true}; };"),
    ],
)
def test_without(body: str, before: str) -> None:
    assert types(cpp(body, INCLUDES + before), "servers") == []


def test_debug_is_not_known() -> None:
    node = cpp("tf2_ros::Buffer b(ros::Duration(2.0), argc > 1 ? x() : y());", INCLUDES)
    (end,) = ends(node, "servers")
    assert end.name == "/n/tf2_frames"
    assert [unknown.field for unknown in end.unknowns] == ["conditions"]


def test_under_a_condition() -> None:
    (end,) = ends(cpp("if (x()) { tf2_ros::Buffer b(ros::Duration(2.0), true); }", INCLUDES), "servers")
    assert [condition[:2] for condition in conditions(end)] == [("if", "x()")]
