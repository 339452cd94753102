# SPDX-License-Identifier: Apache-2.0
"""ROS 2: a switch that a callback reads again may be set while the node runs: what stands behind it is not ruled out."""

from __future__ import annotations

import pytest
from follow_kit import explicit, follow, ros2_cpp

HEAD = "import rclpy\nfrom rclpy.node import Node\nfrom rcl_interfaces.msg import ParameterDescriptor\nfrom std_msgs.msg import String\n"
PROGRAM = """
class N(Node):
    def __init__(self):
        super().__init__("n")
        self.declare_parameter("b", False)
        self.declare_parameter("c", False, ParameterDescriptor(read_only=True))
        self.declare_parameter("on", True)
        self.declare_parameter("i", 0)
        self.declare_parameter("s", "")
        self.flag = self.get_parameter("b").value
        self.create_timer(1.0, self.tick)
        self.create_subscription(String, "in", self.heard, 1)
        self.create_service(Empty, "do", self.do)
%s
    def make(self):
        self.create_publisher(String, "out", 1)
    def tick(self):
        %s
    def heard(self, message):
        %s
    def do(self, request, response):
        %s
def main():
    rclpy.init()
    rclpy.spin(N())
"""


def is_ruled_out(tick: str = "pass", heard: str = "pass", do: str = "pass", first: str = "pass") -> bool:
    setup = "from setuptools import setup\nsetup(name='p', packages=['p'],\n"
    files = {
        "p/setup.py": setup + "    entry_points={'console_scripts': ['n = p.n:main']})\n",
        "p/p/__init__.py": "",
        "p/p/n.py": HEAD
        + "from std_srvs.srv import Empty\n"
        + PROGRAM % (f"        {first}", *(body.replace("\n", "\n        ") for body in (tick, heard, do))),
    }
    (end,) = explicit(follow(files, 2).configurations[0].nodes[0])
    assert end.name == "/out"
    return end.is_ruled_out


SWITCH = (
    "if self.get_parameter('b').value:\n    self.make()",
    "if self.get_parameter('b').get_parameter_value().bool_value:\n    self.make()",
    "if self.get_parameter('b').value == True:\n    self.make()",
    "flag = self.get_parameter('b').value\nif not flag:\n    return\nself.make()",
    "self.flag = self.get_parameter('b').value\nif self.flag and self.get_parameter('s').value == '':\n    self.make()",
)


@pytest.mark.parametrize("body", SWITCH)
def test_a_switch_that_a_callback_reads(body: str) -> None:
    assert not is_ruled_out(tick=body)
    assert not is_ruled_out(heard=body)
    assert not is_ruled_out(do=body)


def test_what_is_switched_on_is_there_whoever_switches_it_off() -> None:
    assert not is_ruled_out(tick="if self.get_parameter('on').value:\n    self.make()")


def test_a_switch_that_another_callback_reads() -> None:
    assert not is_ruled_out("self.flag = self.get_parameter('b').value", "if self.flag:\n    self.make()")


@pytest.mark.parametrize(
    "body",
    [
        "if self.flag:\n    self.make()",
        "if self.get_parameter('c').value:\n    self.make()",
        "if not self.get_parameter('on').value:\n    self.make()",
        "if self.get_parameter('i').value > 1:\n    self.make()",
        "if self.get_parameter('s').value == 'x':\n    self.make()",
        "if self.get_parameter('use_sim_time').value:\n    self.make()",
        "if False:\n    self.make()",
    ],
)
def test_what_no_callback_reads_and_what_is_no_switch(body: str) -> None:
    assert is_ruled_out(tick=body)


@pytest.mark.parametrize("body", ["if self.get_parameter('b').value: self.make()", "if self.flag: self.make()"])
def test_what_the_constructor_reads(body: str) -> None:
    assert is_ruled_out(first=body)


CPP = 'declare_parameter("b", false); timer_ = create_wall_timer(1s, [this]() { tick(); });'
MAKE = 'create_publisher<String>("out", 1);'


@pytest.mark.parametrize(
    ("tick", "expected"),
    [
        (f'if (get_parameter("b").as_bool()) {{ {MAKE} }}', False),
        (f'bool b = false; get_parameter("b", b); if (b) {{ {MAKE} }}', False),
        (f'if (!get_parameter("b").as_bool()) return; {MAKE}', False),
        (f"if (flag_) {{ {MAKE} }}", True),
    ],
)
def test_in_cpp(tick: str, expected: bool) -> None:
    members = f"void tick() {{ {tick} }}\nbool flag_ = false;\nrclcpp::TimerBase::SharedPtr timer_;"
    (node,) = ros2_cpp(CPP, members).nodes
    assert [(end.name, end.is_ruled_out) for end in explicit(node)] == [("/out", expected)]
