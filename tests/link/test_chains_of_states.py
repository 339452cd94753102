# SPDX-License-Identifier: Apache-2.0
"""States that callbacks reach one after another: what stands under a late one is not ruled out, and under one that is never reached it is."""

from __future__ import annotations

import pytest
from follow_kit import cpp, ends
from ros2_cpp_kit import component, explicit
from test_ros2_python import node

#: A method ``cb`` of Python, called back with ``self.s`` as 'S0' and flags that are false at first; whether what it makes in place of ``{}`` is ruled out.
PYTHON = {
    "the third state": (
        "if self.s == 'S0': self.s = 'S1'\nelif self.s == 'S1': self.s = 'S2'\nelif self.s == 'S2': {}",
        False,
    ),
    "the fifth state, asked first": (
        "if self.s == 'S4': {}\nelif self.s == 'S3': self.s = 'S4'\nelif self.s == 'S2': self.s = 'S3'\n"
        "elif self.s == 'S1': self.s = 'S2'\nelse: self.s = 'S1'",
        False,
    ),
    "a state that only a helper sets": (
        "if self.s == 'S3': {}\nif self.s == 'S2': self.go('S3')\nif self.s == 'S1': self.go('S2')\nif self.s == 'S0': self.go('S1')",
        False,
    ),
    "more states than a value may have": (
        "if self.s == 'S11': {}\n" + "".join(f"if self.s == 'S{n}': self.s = 'S{n + 1}'\n" for n in range(10, -1, -1)),
        False,
    ),
    "flags, one after another": (
        "if self.d: {}\nif self.c: self.d = True\nif self.b: self.c = True\nif self.a: self.b = True\nself.a = True",
        False,
    ),
    "more flags than rehearsals": (
        "".join(f"if self.f{n}: self.f{n + 1} = True\n" for n in range(13, -1, -1)) + "self.f0 = True\nif self.f14: {}",
        False,
    ),
    "numbers as states": (
        "if self.k == 3: {}\nelif self.k == 2: self.k = 3\nelif self.k == 1: self.k = 2\nelse: self.k = 1",
        False,
    ),
    "a state that nothing sets": (
        "if self.s == 'S0': self.s = 'S1'\nelif self.s == 'S1': self.s = 'S0'\nif self.s == 'S2': {}",
        True,
    ),
    "a state that is set in one which is never reached": (
        "if self.s == 'S0': self.s = 'S1'\nif self.s == 'S7': self.s = 'S8'\nif self.s == 'S8': {}",
        True,
    ),
    "a flag that a flag allows which nothing sets": ("if self.a: self.b = True\nif self.b: {}", True),
    "a state that another method sets, which is never called": ("if self.s == 'late': {}", True),
    "a circle of states": (
        "self.s = {{'S0': 'S1', 'S1': 'S0'}}[self.s] if False else 'S1'\nif self.s == 'S5': {}",
        True,
    ),
}
CPP = {
    "the fourth state": ("if (s_ == 3) { {} } else if (s_ == 2) s_ = 3; else if (s_ == 1) s_ = 2; else s_ = 1;", False),
    "texts": (
        'if (t_ == "c") { {} } else if (t_ == "b") t_ = "c"; else if (t_ == "a") t_ = "b"; else t_ = "a";',
        False,
    ),
    "flags": ("if (d_) { {} } if (c_) d_ = true; if (b_) c_ = true; if (a_) b_ = true; a_ = true;", False),
    "a text that nothing sets": ('if (t_ == "c") { {} } else if (t_ == "b") t_ = "a"; else t_ = "b";', True),
    "a flag that nothing sets": ("if (d_) { {} } if (b_) c_ = true; a_ = true;", True),
}
FLAGS = "".join(f"self.f{n} = False\n" for n in range(15))
STATES = f"self.s, self.k, self.a, self.b, self.c, self.d = 'S0', 0, False, False, False, False\n{FLAGS}"
METHODS = "def go(self, state):\n    self.s = state\ndef nobody(self):\n    self.s = 'late'\n"
MADE = "self.create_publisher(String, 'late', 1)"
#: What makes rehearsals take long.
LARGE = "".join(f"    self.z{n} = f(self.z{n + 1})\n" for n in range(2500))


def indented(code: str) -> str:
    return "".join(f"    {line}\n" for line in code.replace("{{", "{").replace("}}", "}").splitlines())


@pytest.mark.parametrize(("code", "expected"), PYTHON.values(), ids=PYTHON)
def test_in_python(code: str, expected: bool) -> None:
    methods = f"{METHODS}def cb(self):\n{indented(code.replace('{}', MADE))}"
    found = node(f"{STATES}self.create_timer(1.0, self.cb)", methods)
    assert [end.is_ruled_out for end in explicit(found)] == [expected]


@pytest.mark.parametrize(("code", "expected"), PYTHON.values(), ids=PYTHON)
def test_in_a_large_node(code: str, expected: bool) -> None:
    methods = f"{METHODS}def cb(self):\n{indented(code.replace('{}', MADE))}def large(self):\n    self.create_publisher(String, 'early', 1)\n{LARGE}"
    found = node(f"{STATES}self.create_timer(1.0, self.cb)\nself.create_timer(1.0, self.large)", methods)
    assert {end.name: end.is_ruled_out for end in explicit(found)} == {"/s/early": False, "/s/late": expected}


@pytest.mark.parametrize(("code", "expected"), CPP.values(), ids=CPP)
def test_in_cpp(code: str, expected: bool) -> None:
    made = code.replace("{ {} }", '{ create_publisher<String>("late", 1); }')
    members = f'int s_ = 0; std::string t_ = ""; bool a_ = false, b_ = false, c_ = false, d_ = false; void tick() {{ {made} }}'
    timer = "timer_ = create_wall_timer(std::chrono::seconds(1), [this]() { tick(); });"
    found = component(timer, f"rclcpp::TimerBase::SharedPtr timer_; {members}")
    assert [end.is_ruled_out for end in explicit(found)] == [expected]


@pytest.mark.parametrize("is_last", [False, True])
def test_callbacks_that_wait_for_one_another(is_last: bool) -> None:
    steps = ["if self.s == 'S0': self.s = 'S1'", "if self.s == 'S1': self.s = 'S2'", f"if self.s == 'S2': {MADE}"]
    methods = "".join(f"def cb{n}(self):\n    {step}\n" for n, step in enumerate(reversed(steps) if is_last else steps))
    timers = "".join(f"self.create_timer(1.0, self.cb{n})\n" for n in range(3))
    assert [end.is_ruled_out for end in explicit(node(f"{STATES}{timers}", methods))] == [False]


def test_variables_of_the_file() -> None:
    callback = 'void cb(const std_msgs::String& m) { if (s == 2) late = h->advertise<std_msgs::String>("late", 1); else if (s == 1) s = 2; else s = 1; }\n'
    before = f"int s = 0; ros::NodeHandle* h; ros::Publisher late;\n{callback}"
    found = cpp('h = &nh; ros::Subscriber sub = nh.subscribe("in", 1, cb);', before)
    assert [(end.name, end.is_ruled_out) for end in ends(found, "publishers")] == [("/late", False)]


def test_names_that_callbacks_change_are_known_as_before() -> None:
    """A name that stands in a member which a callback sets to one other value is one of both."""
    methods = "def cb(self):\n    self.create_publisher(String, self.s, 1)\n    self.s = 'S1'"
    found = node("self.s = 'S0'\nself.create_timer(1.0, self.cb)", methods)
    assert {end.name for end in explicit(found)} == {"/s/S0", "/s/S1"}
