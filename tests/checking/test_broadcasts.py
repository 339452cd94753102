# SPDX-License-Identifier: Apache-2.0
"""Transforms that code sends: frames from literals, constants and parameters; nothing that may not be sent."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.broadcasts import BroadcastFrame, sent
from haros_ci.checking.page import Example
from haros_ci.extract.cpp.read import read_cpp
from haros_ci.extract.python.read import read_python
from haros_ci.registry import checks


def frames(program: object) -> list[tuple[object, object]]:
    return [(each.child, each.parent) for each in sent(program)]  # type: ignore[arg-type]


CPP = """
class Odom : public rclcpp::Node {
public:
  Odom() : Node("odom") {
    declare_parameter("base_frame", "base_link");
    get_parameter("base_frame", base_frame_);
  }
  void tick() {
    geometry_msgs::msg::TransformStamped t;
    t.header.frame_id = "odom";
    t.child_frame_id = CHILD;
    SEND
  }
  std::string base_frame_;
  const std::string fixed_{"fixed"};
  std::string name_ = "named";
  std::unique_ptr<tf2_ros::TransformBroadcaster> br_;
};
"""


@pytest.mark.parametrize(
    ("child", "send", "expected"),
    [
        ('"base_link"', "br_->sendTransform(t);", [(BroadcastFrame("base_link"), BroadcastFrame("odom"))]),
        ("base_frame_", "br_->sendTransform(t);", [(BroadcastFrame(parameter="base_frame"), BroadcastFrame("odom"))]),
        ("name_", "br_->sendTransform(t);", [(BroadcastFrame("named"), BroadcastFrame("odom"))]),
        ("msg->child", "br_->sendTransform(t);", [(None, BroadcastFrame("odom"))]),
        ('"a"', "while (ok()) { br_->sendTransform(t); }", [(BroadcastFrame("a"), BroadcastFrame("odom"))]),
        ('"a"', "if (!msg) { return; } br_->sendTransform(t);", [(BroadcastFrame("a"), BroadcastFrame("odom"))]),
        ('"a"', "if (publish_tf_) { br_->sendTransform(t); }", []),
        ('"a"', "if (!publish_tf_) { return; } br_->sendTransform(t);", []),
        ('"a"', 't.child_frame_id = "b"; br_->sendTransform(t);', [(None, BroadcastFrame("odom"))]),
        ('"a"', "t.header = msg->header; br_->sendTransform(t);", [(BroadcastFrame("a"), None)]),
        ('"a"', "br_->sendTransform(all_);", [(None, None)]),
        (
            '"a"',
            'br_->sendTransform(tf::StampedTransform(x, now, "p", "c"));',
            [(BroadcastFrame("c"), BroadcastFrame("p"))],
        ),
    ],
)
def test_cpp(child: str, send: str, expected: object) -> None:
    assert frames(read_cpp(CPP.replace("CHILD", child).replace("SEND", send))) == expected


PYTHON = """
import rclpy
class Odom(Node):
    def __init__(self):
        self.frame = self.declare_parameter("base_frame", "base_link").value
        self.other = self.get_parameter("other").get_parameter_value().string_value
        self.br = TransformBroadcaster(self)
        CALL
    def send(self):
        t = TransformStamped()
        t.header.frame_id = "odom"
        t.child_frame_id = CHILD
        self.br.sendTransform(t)
"""


@pytest.mark.parametrize(
    ("child", "call", "expected"),
    [
        ("'a'", "self.send()", [(BroadcastFrame("a"), BroadcastFrame("odom"))]),
        ("self.frame", "self.send()", [(BroadcastFrame(parameter="base_frame"), BroadcastFrame("odom"))]),
        ("self.other", "self.send()", [(BroadcastFrame(parameter="other"), BroadcastFrame("odom"))]),
        ("name", "self.send()", [(None, BroadcastFrame("odom"))]),
        ("'a' + x", "self.send()", [(None, BroadcastFrame("odom"))]),
        ("'a'", "if self.publish_tf: self.send()", []),
    ],
)
def test_python(child: str, call: str, expected: object) -> None:
    assert frames(read_python(PYTHON.replace("CHILD", child).replace("CALL", call))) == expected


def test_tf_of_ros_1() -> None:
    program = read_python('br = tf.TransformBroadcaster()\nbr.sendTransform(a, b, now(), "c", "p")\n')
    assert frames(program) == [(BroadcastFrame("c"), BroadcastFrame("p"))]


PAIR = (
    '<launch><group ns="x"><node pkg="tf2_ros" type="static_transform_publisher" name="a" args="0 0 0 0 0 0 map laser"/></group>\n'
    '<node pkg="tf2_ros" type="static_transform_publisher" name="b" args="0 0 0 0 0 0 base laser"/></launch>\n'
)


def test_a_conflict_names_file_and_command_and_no_place_twice(tmp_path: Path) -> None:
    manifest = '<package format="2"><name>demo</name><buildtool_depend>catkin</buildtool_depend></package>'
    files = {"package.xml": manifest, "launch/robot.launch": PAIR}
    check = next(check for check in checks() if check.id == "conflicting-transforms")
    (result,) = said(check, Example("", True, files), tmp_path)
    assert result.message.endswith("; in demo/launch/robot.launch (`roslaunch demo robot.launch`)")
    places = [result.location, *(each.location for each in result.related)]
    assert len(places) == len(set(places)) == 2
