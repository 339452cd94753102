# SPDX-License-Identifier: Apache-2.0
"""Loops that go on as long as the program does: between their turns callbacks are called, in threads or by what is in the loop."""

from __future__ import annotations

import pytest
from follow_kit import cpp, ends, python

FLAG = (
    "from std_msgs.msg import Bool\nclass C:\n    %s\n    def __init__(self):\n        %s\n        rospy.Subscriber('/b', Bool, self.cb)\n"
    "    def cb(self, m):\n        self.on = m.data\n    def run(self):\n        rate = rospy.Rate(10)\n        %s\nC().run()\n"
)
GLOBAL = "from std_msgs.msg import Bool\non = False\ndef cb(m):\n    global on\n    on = m.data\nrospy.Subscriber('/b', Bool, cb)\nrate = rospy.Rate(1)\n%s"
TURN = "if self.on:\n                PUB('x')\n            %s"
OVER = {
    "is_shutdown and sleep of a rate": "while not rospy.is_shutdown():\n            " + TURN % "rate.sleep()",
    "no sleep": "while not rospy.is_shutdown():\n            " + TURN % "pass",
    "true": "while True:\n            " + TURN % "rate.sleep()",
    "a flag": "while self.goes:\n            " + TURN % "rate.sleep()",
}


@pytest.mark.parametrize("name", OVER)
@pytest.mark.parametrize("places", [("on = False", "self.goes = True"), ("goes = True", "self.on = False")])
def test_a_flag_that_a_callback_of_rospy_sets(name: str, places: tuple[str, str]) -> None:
    (end,) = ends(python(FLAG % (*places, OVER[name])))
    assert (end.name, end.is_ruled_out) == ("/x", False)


def test_a_global_that_a_callback_of_rospy_sets() -> None:
    (end,) = ends(python(GLOBAL % "while not rospy.is_shutdown():\n    if on:\n        PUB('x')\n    rate.sleep()\n"))
    assert not end.is_ruled_out


CPP = "bool on = false;\nvoid cb(const std_msgs::String&) { on = true; }\n"
CPP_BODY = (
    'ros::Subscriber s = nh.subscribe("b", 1, cb); ros::AsyncSpinner spinner(1); spinner.start(); ros::Rate rate(1); %s'
)


@pytest.mark.parametrize(
    "loop",
    [
        'while (ros::ok()) { if (on) { ADV("x", 1); } rate.sleep(); }',
        'while (nh.ok()) { if (on) { ADV("x", 1); } rate.sleep(); }',
        'for (;;) { if (on) { ADV("x", 1); } rate.sleep(); }',
        'while (!ros::isShuttingDown() && true) { if (on) { ADV("x", 1); } }',
    ],
)
def test_a_flag_that_a_callback_of_roscpp_sets(loop: str) -> None:
    (end,) = ends(cpp(CPP_BODY % loop, before=CPP))
    assert (end.name, end.is_ruled_out) == ("/x", False)


@pytest.mark.parametrize(
    "code",
    [
        FLAG % ("on = False", "pass", "if self.on:\n            PUB('x')"),
        FLAG % ("on = False", "pass", "for i in range(3):\n            if self.on:\n                PUB('x')"),
        FLAG % ("no = False", "self.on = True", "while not rospy.is_shutdown():\n            if self.no:\n                PUB('x')"),
    ],
)  # fmt: skip
def test_what_no_callback_has_set_by_then(code: str) -> None:
    (end,) = ends(python(code))
    assert end.is_ruled_out


def test_before_the_loop_in_cpp() -> None:
    (end,) = ends(cpp('ros::Subscriber s = nh.subscribe("b", 1, cb); if (on) { ADV("x", 1); }', before=CPP))
    assert end.is_ruled_out


COUNTED = (
    "class C:\n    n = 0\n    def run(self):\n        while not rospy.is_shutdown():\n            %s\n            if self.n > 20:\n                PUB('x')\n"
    "C().run()\n"
)


@pytest.mark.parametrize(
    ("step", "ruled_out"),
    [
        ("self.n = self.n + 1", False),
        ("self.n += 1", False),
        ("self.n = 1", True),
        ("n = self.n + 1", True),
        ("d = D()\n            d.n += 1", True),
    ],
)
def test_an_attribute_of_the_class_that_a_loop_counts(step: str, ruled_out: bool) -> None:
    (end,) = ends(python("class D:\n    n = 0\n" + COUNTED % step))
    assert end.is_ruled_out is ruled_out
