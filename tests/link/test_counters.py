# SPDX-License-Identifier: Apache-2.0
"""Numbers that a callback changes whenever it runs: a condition on them is not decided by the value from before."""

from __future__ import annotations

import pytest
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
