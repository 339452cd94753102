# SPDX-License-Identifier: Apache-2.0
"""Which publishers send again for those who come late."""

from __future__ import annotations

import pytest

from haros_ci.checking.republishing import publishes_again

_ONCE = "self.pub = self.create_publisher(String, 'a', qos)\n"


@pytest.mark.parametrize(
    "text",
    [
        _ONCE + "if self.pub.get_subscription_count() > 1:\n    self.pub.publish(String())\n",
        _ONCE + "self.create_timer(1.0, lambda: self.pub.publish(String()))\n",
        _ONCE + "self.create_timer(1.0, self.send)\ndef send(self):\n    self.pub.publish(String())\n",
        _ONCE + "def main():\n    while True:\n        self.pub.publish(String())\n        time.sleep(1)\n",
        "pub = node.create_publisher(String, 'a', qos)\nwhile rclpy.ok():\n    pub.publish(String())\n    rate.sleep()\n",
        "self.pubs[key] = self.create_publisher(String, 'a', qos)\nself.create_timer(1.0, self.send)\n"
        "def send(self):\n    self.pubs[key].publish(String())\n",
    ],
)
def test_it_sends_again(text: str) -> None:
    assert publishes_again(text, 1, is_python=True)


@pytest.mark.parametrize(
    "text",
    [
        _ONCE + "self.pub.publish(String())\n",
        _ONCE + "self.pub.publish(String())\nself.create_timer(1.0, lambda: self.other.publish(String()))\n",
        _ONCE
        + "self.create_timer(1.0, self.look)\ndef look(self):\n    pass\ndef send(self):\n    self.pub.publish(String())\n",
        _ONCE + "def main():\n    self.pub.publish(String())\n    while True:\n        time.sleep(1)\n",
        _ONCE
        + "self.create_subscription(String, 'b', self.send, 1)\ndef send(self):\n    self.pub.publish(String())\n",
        "",
    ],
)
def test_it_does_not(text: str) -> None:
    assert not publishes_again(text, 1, is_python=True)


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (
            "timer_ = create_wall_timer(1s, std::bind(&Maps::send, this)); } void Maps::send() { pub_->publish(map_); }",
            True,
        ),
        ("timer_ = create_wall_timer(1s, [this]() { pub_->publish(map_); }); }", True),
        ("pub_->publish(map_); }", False),
        (
            "timer_ = create_wall_timer(1s, std::bind(&Maps::look, this)); } void Maps::look() { other_->publish(map_); }",
            False,
        ),
    ],
)
def test_cpp(body: str, expected: bool) -> None:
    text = 'Maps::Maps() : Node("maps") { pub_ = create_publisher<Map>("map", qos);\n' + body
    assert publishes_again(text, 1, is_python=False) is expected


@pytest.mark.parametrize("sign", ["a", "a(", "a()", "while (", "def f(\n", "create_timer(", "((((", "{ a() {"])
def test_a_long_file_takes_no_long_time(sign: str) -> None:
    assert not publishes_again(sign * 50_000, 1, is_python=False)
    assert not publishes_again(sign * 50_000, 1, is_python=True)
