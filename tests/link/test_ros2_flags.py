# SPDX-License-Identifier: Apache-2.0
"""ROS 2: flags that callbacks set, in functions of their own or elsewhere, before which a callback returns."""

from __future__ import annotations

import pytest
from ros2_cpp_kit import component, explicit

BEHIND = "as things are, the code returns before it comes to this"
MEMBERS = (
    "rclcpp::TimerBase::SharedPtr t_; rclcpp::Subscription<String>::SharedPtr s_; rclcpp::Publisher<String>::SharedPtr p_;\n"
    "bool ready_{false}; int n_{0};\n"
)
TIMER = "t_ = create_wall_timer(1s, [this]() { tick(); });"
BOUND = "t_ = create_wall_timer(1s, std::bind(&N::tick, this));"
THREAD = "th_ = std::thread(&N::tick, this);"
SUBSCRIBED = 's_ = create_subscription<String>("s", 1, [this](String::SharedPtr m) { got(m); });'
GOT = 'void got(String::SharedPtr m) { if (!ready_) return; p_ = create_publisher<String>("x", 1); }\n'


def reasons(body: str, members: str) -> list[str]:
    (end,) = explicit(component(body, MEMBERS + members))
    assert not end.is_ruled_out
    return [unknown.reason for unknown in end.unknowns]


@pytest.mark.parametrize(
    ("body", "tick"),
    [
        (TIMER + SUBSCRIBED, "void tick() { ready_ = true; }"),
        (SUBSCRIBED + TIMER, "void tick() { ready_ = true; }"),
        (TIMER + SUBSCRIBED, "void tick() { if (n_ > 3) ready_ = true; n_++; }"),
        (BOUND + SUBSCRIBED, "void tick() { ready_ = true; t_->cancel(); }"),
        (THREAD + SUBSCRIBED, "std::thread th_; void tick() { ready_ = true; }"),
        (TIMER + SUBSCRIBED, "void tick() { set(true); } void set(bool b) { ready_ = b; }"),
        ("t_ = create_wall_timer(1s, [this]() { ready_ = true; });" + SUBSCRIBED, ""),
    ],
)
def test_a_flag_that_another_callback_sets(body: str, tick: str) -> None:
    assert reasons(body, f"{GOT}{tick}\n") == []


@pytest.mark.parametrize(
    "tick",
    [
        'void tick() { if (!ready_) { set(); return; } p_ = create_publisher<String>("x", 1); } void set() { ready_ = true; }',
        'void tick() { if (!ready_) { ready_ = true; return; } p_ = create_publisher<String>("x", 1); }',
        'void tick() { if (n_++ < 3) return; p_ = create_publisher<String>("x", 1); }',
    ],
)
def test_a_flag_that_the_callback_sets_itself(tick: str) -> None:
    assert reasons(TIMER, f"{tick}\n") == []


@pytest.mark.parametrize(
    ("body", "members"),
    [
        (SUBSCRIBED, GOT),
        (TIMER + SUBSCRIBED, GOT + "void tick() { n_ = 3; }\n"),
        (TIMER + 'if (!ready_) return; p_ = create_publisher<String>("x", 1);', "void tick() { ready_ = true; }\n"),
    ],
)
def test_a_flag_that_nobody_sets_in_time(body: str, members: str) -> None:
    assert reasons(body, members) == [BEHIND]


@pytest.mark.parametrize("order", [TIMER + SUBSCRIBED, SUBSCRIBED + TIMER])
def test_what_one_of_two_ways_comes_to(order: str) -> None:
    """A function that begins once, called by a callback that waits for another and by one that never gets there."""
    members = (
        "void got(String::SharedPtr m) { if (!ready_) return; begin(); }\n"
        "void tick() { ready_ = true; if (n_ == 0) return; begin(); }\n"
        'bool begun_{false}; void begin() { if (begun_) return; begun_ = true; p_ = create_publisher<String>("x", 1); }\n'
    )
    assert BEHIND not in reasons(order, members)
