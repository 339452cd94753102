# SPDX-License-Identifier: Apache-2.0
"""Callbacks that take plain data along are called back for each; one that makes an object finds it when it runs again."""

from __future__ import annotations

import pytest
from follow_kit import names, python, ros2_cpp

from haros_ci.model.architecture import Node

MEMBERS = (
    "std::vector<rclcpp::Subscription<String>::SharedPtr> s_; rclcpp::TimerBase::SharedPtr t_; rclcpp::Publisher<String>::SharedPtr p_;\n"
    "void cb(String::SharedPtr, std::string n) { create_publisher<String>(n, 1); }\n"
    'void plain(String::SharedPtr) { create_publisher<String>("one", 1); }'
)
LOOP = 'for (std::string n : {"a", "b"}) { s_.push_back(create_subscription<String>("in_" + n, 1, %s)); }'


def made(code: str) -> Node:
    (node,) = ros2_cpp(code, MEMBERS).nodes
    return node


#: The callback, and what it makes.
CALLBACKS = (
    ("[this, n](String::SharedPtr) { create_publisher<String>(n, 1); }", ["/a", "/b"]),
    ("[=](String::SharedPtr) { create_publisher<String>(n, 1); }", ["/a", "/b"]),
    ("std::bind(&N::cb, this, std::placeholders::_1, n)", ["/a", "/b"]),
    ("std::bind(&N::plain, this, std::placeholders::_1)", ["/one"]),
    ('[this, n](String::SharedPtr) { create_publisher<String>("one", 1); }', ["/one"]),
)


@pytest.mark.parametrize(("callback", "expected"), CALLBACKS)
def test_callbacks_with_data(callback: str, expected: list[str]) -> None:
    found = made(LOOP % callback)
    assert sorted({name for name in names(found) if name not in ("/rosout", "/parameter_events")}) == expected


def test_partials_of_python() -> None:
    code = (
        "import functools\ndef cb(m, n):\n    PUB(n)\nfor n in ['a', 'b']:\n"
        "    rospy.Subscriber('in_' + n, String, functools.partial(cb, n=n))\n"
    )
    assert names(python(code)) == ["/a", "/b"]


#: A callback makes an object; what it does in its next run is not ruled out.
AGAIN = (
    'if (!p_) { p_ = create_publisher<String>("a", 1); } else { create_publisher<String>("b", 1); }',
    'if (p_) { create_publisher<String>("b", 1); } p_ = create_publisher<String>("a", 1);',
)


@pytest.mark.parametrize("body", AGAIN)
def test_a_callback_finds_what_it_made(body: str) -> None:
    found = made(f"t_ = create_wall_timer(1s, [this]() {{ {body} }});")
    assert [end.name for end in found.endpoints if end.is_ruled_out] == []


def test_what_is_made_before_is_there() -> None:
    found = made(
        'p_ = create_publisher<String>("a", 1); t_ = create_wall_timer(1s, [this]() { if (!p_) create_publisher<String>("b", 1); });'
    )
    assert [end.name for end in found.endpoints if end.is_ruled_out] == ["/b"]
