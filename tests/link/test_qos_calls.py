# SPDX-License-Identifier: Apache-2.0
"""The quality of service of calls with other arguments than rclcpp and rclpy have: right, or not known."""

from __future__ import annotations

import pytest
from follow_kit import Endpoint, explicit, follow, only, ros2_cpp

from haros_ci.follow.ros import qos_calls

BEFORE = "rclcpp::QoS made();\nbool flag();\n"
PYTHON = """import rclpy
from rclpy.node import Node
from rclpy.qos import *
from std_msgs.msg import String
class N(Node):
    def __init__(self):
        super().__init__('n')
        {}
    def cb(self, m):
        pass
def main():
    rclpy.init()
    rclpy.spin(N())
"""
SETUP = "from setuptools import setup\nsetup(name='p', packages=['p'], entry_points={'console_scripts': ['n = p.n:main']})\n"


def cpp(code: str) -> Endpoint:
    (end,) = _ends(ros2_cpp(code, "", BEFORE).nodes[0])
    return end


def python(code: str) -> list[Endpoint]:
    text = PYTHON.format(code.replace("\n", "\n        "))
    return _ends(only(follow({"p/setup.py": SETUP, "p/p/__init__.py": "", "p/p/n.py": text}, 2)).nodes[0])


def _ends(node: object) -> list[Endpoint]:
    return [*explicit(node), *explicit(node, "subscribers")]  # type: ignore[arg-type]


CALLBACK = "[](String::SharedPtr) {}"
#: Calls that no overload has: a latch of ROS 1, a profile or number in the place of options.
OTHER = (
    'create_publisher<String>("a", 1, true);',
    'create_publisher<String>("a", rclcpp::QoS(1), false);',
    'create_publisher<String>("a", 1, rmw_qos_profile_default);',
    'create_publisher<String>("a", 1, rclcpp::SensorDataQoS());',
    'create_publisher<String>("a", 1, 5);',
    'rclcpp::create_publisher<String>(*this, "a", 1, true);',
    'create_generic_publisher("a", "std_msgs/msg/String", 1, true);',
    f'create_subscription<String>("a", 10, {CALLBACK}, true);',
    f'create_subscription<String>("a", 10, {CALLBACK}, nullptr, true);',
    f'create_subscription<String>("a", 10, {CALLBACK}, rmw_qos_profile_default);',
)


@pytest.mark.parametrize("code", OTHER)
def test_of_no_overload_nothing_is_known(code: str) -> None:
    end = cpp(code)
    assert end.qos is not None and (end.qos.depth, end.qos.durability) == ("?", "?")
    assert (end.name, [unknown.reason for unknown in end.unknowns]) == ("/a", [qos_calls.NO_OPTIONS])


#: Calls of an overload, their depth and durability.
KNOWN = (
    ('create_publisher<String>("a", 1);', 1, "volatile"),
    ('create_publisher<String>("a", 1, rclcpp::PublisherOptions());', 1, "volatile"),
    ('rclcpp::PublisherOptions o; create_publisher<String>("a", 1, o);', 1, "volatile"),
    ('create_publisher<String>("a", 1, {});', 1, "volatile"),
    ('create_publisher<String>("a", 1, elsewhere());', 1, "volatile"),
    ('create_publisher<String>("a", rclcpp::QoS(rclcpp::KeepLast(3)).transient_local());', 3, "transient_local"),
    ('create_publisher<String>("a", rmw_qos_profile_default);', 10, "volatile"),
    ('rclcpp::QoS q(2); q.transient_local(); create_publisher<String>("a", q);', 2, "transient_local"),
    ('create_publisher<String>("a", rclcpp::QoS{rclcpp::KeepLast{1}}.transient_local());', 1, "transient_local"),
    (f'create_subscription<String>("a", 10, {CALLBACK});', 10, "volatile"),
    (f'create_subscription<String>("a", 10, {CALLBACK}, rclcpp::SubscriptionOptions());', 10, "volatile"),
    (f'rclcpp::SubscriptionOptions o; create_subscription<String>("a", 10, {CALLBACK}, o);', 10, "volatile"),
    ('rclcpp::create_publisher<String>(this, "a", rclcpp::QoS(1).transient_local());', 1, "transient_local"),
)


@pytest.mark.parametrize(("code", "depth", "durability"), KNOWN)
def test_of_an_overload_it_is_known(code: str, depth: int, durability: str) -> None:
    end = cpp(code)
    assert end.qos is not None and (end.qos.depth, end.qos.durability) == (depth, durability)
    assert end.unknowns == ()


#: The same of rclpy, where all but the first arguments are keywords, and profiles are objects that everybody shares.
OTHER_PYTHON = (
    ('self.create_publisher(String, "a", 1, True)', qos_calls.TOO_MANY),
    ('self.create_subscription(String, "a", self.cb, 1, True)', qos_calls.TOO_MANY),
    ('self.create_publisher(String, "a", queue_size=10)', qos_calls.NOT_GIVEN),
    ('self.create_subscription(String, "a", self.cb)', qos_calls.NOT_GIVEN),
    ('q = qos_profile_sensor_data\nq.depth = 1\nself.create_publisher(String, "a", q)', qos_calls.CHANGED),
    (
        'qos_profile_sensor_data.depth = 1\nself.create_publisher(String, "a", qos_profile_sensor_data)',
        qos_calls.CHANGED,
    ),
    (
        "q = QoSPresetProfiles.SENSOR_DATA.value\nq.depth = 1\n"
        'self.create_publisher(String, "a", QoSPresetProfiles.SENSOR_DATA.value)',
        qos_calls.CHANGED,
    ),
)


@pytest.mark.parametrize(("code", "why"), OTHER_PYTHON)
def test_of_no_function_of_rclpy_nothing_is_known(code: str, why: str) -> None:
    (end,) = python(code)
    assert end.qos is not None and end.qos.depth == "?"
    assert [unknown.reason for unknown in end.unknowns] == [why]


KNOWN_PYTHON = (
    ('self.create_publisher(String, "a", 1)', 1, "volatile"),
    ('self.create_publisher(String, "a", 1, callback_group=None)', 1, "volatile"),
    ('self.create_publisher(msg_type=String, topic="a", qos_profile=7)', 7, "volatile"),
    ('self.create_subscription(String, "a", self.cb, 10, raw=True)', 10, "volatile"),
    ('self.create_subscription(String, "a", callback=self.cb, qos_profile=QoSProfile(depth=9))', 9, "volatile"),
    ('self.create_publisher(String, "a", QoSProfile(depth=1, durability=1, history=1))', 1, "transient_local"),
    (
        'q = QoSProfile(depth=3)\nq.durability = DurabilityPolicy.TRANSIENT_LOCAL\nself.create_publisher(String, "a", q)',
        3,
        "transient_local",
    ),
    ('self.create_publisher(String, "a", qos_profile_sensor_data)', 5, "volatile"),
    (
        'q = qos_profile_system_default\nq.depth = 1\nself.create_publisher(String, "a", qos_profile_sensor_data)',
        5,
        "volatile",
    ),
    ('self.create_publisher(String, "a", QoSPresetProfiles.SENSOR_DATA.value)', 5, "volatile"),
    ('self.create_publisher(String, "a", QoSProfile(**{"depth": 4}))', 4, "volatile"),
)


@pytest.mark.parametrize(("code", "depth", "durability"), KNOWN_PYTHON)
def test_of_a_function_of_rclpy_it_is_known(code: str, depth: int, durability: str) -> None:
    (end,) = python(code)
    assert end.qos is not None and (end.qos.depth, end.qos.durability) == (depth, durability)
    assert end.unknowns == ()
