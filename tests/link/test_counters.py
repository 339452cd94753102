# SPDX-License-Identifier: Apache-2.0
"""Numbers that a callback changes whenever it runs: a condition on them is not decided by the value from before."""

from __future__ import annotations

import pytest
from follow_kit import cpp, ends
from ros2_cpp_kit import component, explicit
from test_ros2_python import node

#: A method ``cb`` of Python, and whether what it makes is ruled out.
PYTHON = {
    "counted up": ("self.k = self.k + 1\nif self.k == 50: {}", False),
    "counted up in place": ("self.k += 1\nif self.k > 9: {}", False),
    "counted and then asked in another branch": ("self.k += 1\nif self.k == 1: pass\nelif self.k == 5: {}", False),
    "set to a number": ("self.k = 2\nif self.k == 50: {}", True),
    "not changed": ("if self.k == 50: {}", True),
    "a text that is set": ("self.t = 'b'\nif self.t == 'c': {}", True),
    "a flag that is set": ("self.f = True\nif not self.f: {}", True),
}
CPP = {
    "counted up": ("k_++; if (k_ == 50) { {} }", False),
    "counted up, asked before": ("if (k_ > 3) { {} } k_ += 1;", False),
    "set to a number": ("k_ = 2; if (k_ == 50) { {} }", True),
    "not changed": ("if (k_ == 50) { {} }", True),
}


@pytest.mark.parametrize(("code", "expected"), PYTHON.values(), ids=PYTHON)
def test_in_python(code: str, expected: bool) -> None:
    made = "self.create_publisher(String, 'late', 1)"
    lines = "".join(f"    {line}\n" for line in code.replace("{}", made).splitlines())
    found = node("self.k, self.t, self.f = 0, 'a', False\nself.create_timer(1.0, self.cb)", f"def cb(self):\n{lines}")
    assert [end.is_ruled_out for end in explicit(found)] == [expected]


@pytest.mark.parametrize(("code", "expected"), CPP.values(), ids=CPP)
def test_in_cpp(code: str, expected: bool) -> None:
    made = code.replace("{ {} }", '{ create_publisher<String>("late", 1); }')
    found = component(
        "timer_ = create_wall_timer(std::chrono::seconds(1), [this]() { tick(); });",
        f"int k_ = 0; rclcpp::TimerBase::SharedPtr timer_; void tick() {{ {made} }}",
    )
    assert [end.is_ruled_out for end in explicit(found)] == [expected]


def test_another_callback_does_not_know_the_number() -> None:
    methods = "def cb(self):\n    self.k += 1\ndef other(self, message):\n    if self.k == 50: self.create_publisher(String, 'late', 1)"
    body = "self.k = 0\nself.create_timer(1.0, self.cb)\nself.create_subscription(String, 'a', self.other, 1)"
    assert [end.is_ruled_out for end in explicit(node(body, methods))] == [False]


def test_a_number_is_counted_in_a_large_node() -> None:
    """Where rehearsals take too long to see what callbacks do to each other."""
    large = "".join(f"    self.z{i} = f(self.z{i + 1})\n" for i in range(2500))
    methods = "def cb(self):\n    self.k += 1\n    if self.k == 50: self.create_publisher(String, 'late', 1)\n"
    methods += f"def large(self):\n    self.create_publisher(String, 'early', 1)\n{large}"
    found = node("self.k = 0\nself.create_timer(1.0, self.cb)\nself.create_timer(1.0, self.large)", methods)
    assert {end.name: end.is_ruled_out for end in explicit(found)} == {"/s/early": False, "/s/late": False}


#: The body of ``main`` with what stands before it, in ROS 1, and whether what it makes is ruled out.
CALLED_BETWEEN = (
    'ros::Subscriber s = nh.subscribe("x", 1, cb); while (ros::ok()) {{ ros::spinOnce(); if ({}) ADV("late", 1); }}'
)
CALLBACK = "void cb(const std_msgs::String& m) {{ {} }}"
LOOP = "while (ros::ok()) {{ {} }}"
MAIN = {
    "a callback counts between turns": (
        CALLED_BETWEEN.format("k == 50"),
        "int k = 0; " + CALLBACK.format("k++;"),
        False,
    ),
    "a loop counts a global variable": (LOOP.format('k++; if (k == 50) ADV("late", 1);'), "int k = 0;", False),
    "a loop sets a global variable": (LOOP.format('k = 3; if (k == 50) ADV("late", 1);'), "int k = 0;", True),
    "a loop counts a static variable": (LOOP.format('static int k = 0; if (++k == 50) ADV("late", 1);'), "", False),
    "a loop counts one that begins with nothing": (
        LOOP.format('static int k; if (++k == 50) ADV("late", 1);'),
        "",
        False,
    ),
    "a static constant": (LOOP.format('static const int k = 3; if (k == 50) ADV("late", 1);'), "", True),
    "a static flag of a loop": (
        LOOP.format('static bool first = true; if (!first) ADV("late", 1); first = false;'),
        "",
        False,
    ),
}
STATICS = {
    "counted": ("static int k = 0; k++; if (k == 50) {}", False),
    "set to a number": ("static int k = 0; k = 2; if (k == 50) {}", True),
    "a flag": ("static bool first = true; if (!first) {} first = false;", False),
}


@pytest.mark.parametrize(("body", "before", "expected"), MAIN.values(), ids=MAIN)
def test_in_main(body: str, before: str, expected: bool) -> None:
    (end,) = ends(cpp(body, before))
    assert end.is_ruled_out == expected


@pytest.mark.parametrize(("code", "expected"), STATICS.values(), ids=STATICS)
def test_static_variables_of_a_callback(code: str, expected: bool) -> None:
    made = code.replace("{}", '{ ros::NodeHandle nh; ADV("late", 1); }')
    (end,) = ends(cpp('ros::Subscriber s = nh.subscribe("x", 1, cb); ros::spin();', CALLBACK.format(made)))
    assert end.is_ruled_out == expected


def test_a_static_object_that_a_rehearsal_comes_to_first_is_made() -> None:
    before = "struct C { C(const char* t) { ros::NodeHandle nh; ADV(t, 1); } };\n" + CALLBACK.format(
        'static C c("lamp");'
    )
    (end,) = ends(cpp('ros::Subscriber s = nh.subscribe("x", 1, cb); ros::spin();', before))
    assert end.name == "/lamp" and not end.is_ruled_out
