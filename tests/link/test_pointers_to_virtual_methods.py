# SPDX-License-Identifier: Apache-2.0
"""C++: which method is called by a pointer to a virtual one is decided by the object's class ([expr.mptr.oper], [class.virtual])."""

from __future__ import annotations

import pytest
from ros2_cpp_kit import explicit

from tests.link.follow_kit import ROS2_HEAD, cpp, follow, names, only, ros2_files

CLASSES = """
struct A { virtual ~A() {} virtual void go(const std_msgs::String& m) = 0; void plain(const std_msgs::String& m) { make("a"); }
  virtual void here(const std_msgs::String& m) { make("a"); }
  virtual void many(int i) { make("i"); } virtual void many(const std_msgs::String& m) { make("a"); }
  void make(const std::string& t) { p_ = nh_.advertise<std_msgs::String>(t, 1); }
  void start() { %s }
  ros::NodeHandle nh_; ros::Publisher p_; ros::Subscriber s_; };
struct B : A { void go(const std_msgs::String& m) override { make("b"); } void plain(const std_msgs::String& m) { make("b"); }
  void here(const std_msgs::String& m) override { make("b"); } void many(int i) override { make("b"); } };
struct C : B { };
struct D : C { void go(const std_msgs::String& m) { make("d"); } };
struct E : A { void go(const std_msgs::String& m) override {} };
"""
SUBSCRIBE = 's_ = nh_.subscribe("s", 1, &A::{}, this);'
BIND = 's_ = nh_.subscribe<std_msgs::String>("s", 1, boost::bind(&A::{}, this, _1));'


@pytest.mark.parametrize(
    ("start", "body", "expected"),
    [
        (SUBSCRIBE.format("go"), "B o; o.start();", ["/b"]),
        (BIND.format("go"), "B o; o.start();", ["/b"]),
        (SUBSCRIBE.format("here"), "B o; o.start();", ["/b"]),
        (SUBSCRIBE.format("go"), "C o; o.start();", ["/b"]),
        (SUBSCRIBE.format("go"), "D o; o.start();", ["/d"]),
        (SUBSCRIBE.format("go"), "A* o = new D(); o->start();", ["/d"]),
        (
            "void (A::*m)(const std_msgs::String&) = &A::go; std_msgs::String s; (this->*m)(s);",
            "B o; o.start();",
            ["/b"],
        ),
        (
            "auto f = std::bind(&A::go, this, std::placeholders::_1); std_msgs::String s; f(s);",
            "B o; o.start();",
            ["/b"],
        ),
        ("", 'B o; ros::Subscriber s = nh.subscribe("s", 1, &A::go, &o);', ["/b"]),
        ("", 'B o; ros::Subscriber s = nh.subscribe("s", 1, &A::here, (A*) &o);', ["/b"]),
    ],
)
def test_the_class_of_the_object_decides(start: str, body: str, expected: list[str]) -> None:
    assert names(cpp(body, CLASSES % start)) == expected


@pytest.mark.parametrize(
    ("start", "body", "expected"),
    [
        # not virtual: the class that is written decides
        (SUBSCRIBE.format("plain"), "B o; o.start();", ["/a"]),
        (BIND.format("plain"), "D o; o.start();", ["/a"]),
        ("", 'B o; ros::Subscriber s = nh.subscribe("s", 1, &B::plain, &o);', ["/b"]),
        # virtual, and not overridden, or to make nothing
        (SUBSCRIBE.format("here"), "E o; o.start();", ["/a"]),
        (SUBSCRIBE.format("here"), "A* o = new E(); o->start();", ["/a"]),
        (SUBSCRIBE.format("go"), "E o; o.start();", []),
        # a call by the whole name is not by a pointer
        ("std_msgs::String s; A::here(s);", "B o; o.start();", ["/a"]),
        # of overloads another one is overridden
        (
            "void (A::*m)(const std_msgs::String&) = &A::many; std_msgs::String s; (this->*m)(s);",
            "E o; o.start();",
            ["/a"],
        ),
        # nobody registers, or calls
        ("", "B o; o.start();", []),
        (SUBSCRIBE.format("go"), "B o;", []),
        ("void (A::*m)(const std_msgs::String&) = &A::go;", "B o; o.start();", []),
    ],
)
def test_as_written(start: str, body: str, expected: list[str]) -> None:
    assert names(cpp(body, CLASSES % start)) == expected


FILTER = """
#include <tf2_ros/message_filter.h>
#include <message_filters/subscriber.h>
class Base : public rclcpp::Node {
public:
  Base(const std::string & n, const rclcpp::NodeOptions & o) : Node(n, o) {
    sub_ = std::make_unique<message_filters::Subscriber<String>>(this, "scan", rmw_qos_profile_sensor_data);
    filter_ = std::make_unique<tf2_ros::MessageFilter<String>>(*sub_, *tf_, "odom", 10, get_node_logging_interface(),
      get_node_clock_interface(), tf2::durationFromSec(0.1));
    filter_->registerCallback(std::bind(&Base::taken, this, std::placeholders::_1));
  }
  virtual void taken(String::ConstSharedPtr m) = 0;
  std::unique_ptr<message_filters::Subscriber<String>> sub_;
  std::unique_ptr<tf2_ros::MessageFilter<String>> filter_;
  std::unique_ptr<tf2_ros::Buffer> tf_;
};
class N : public Base {
public:
  explicit N(const rclcpp::NodeOptions & o) : Base("n", o) { thread_ = std::make_unique<std::thread>(std::bind(&N::run, this)); }
  void run() { while (rclcpp::ok()) { if (!paused_) { use(); } } }
  void taken(String::ConstSharedPtr m) override { use(); }
  void use() { create_publisher<String>("made", 1); }
  bool paused_; std::unique_ptr<std::thread> thread_;
};
"""


@pytest.mark.parametrize(
    ("filtered", "conditions"),
    [
        (FILTER, 0),
        (FILTER.replace("filter_->registerCallback(std::bind(&Base::taken, this, std::placeholders::_1));", ""), 2),
        (FILTER.replace("use(); }\n  void use", "}\n  void use"), 2),
    ],
)
def test_a_filter_calls_it_back(filtered: str, conditions: int) -> None:
    """What a callback makes for every message, and a loop under conditions, has no condition."""
    (node,) = only(follow(ros2_files(ROS2_HEAD + filtered), 2)).nodes
    (end,) = explicit(node)
    assert (end.name, len(end.conditions)) == ("/made", conditions)
