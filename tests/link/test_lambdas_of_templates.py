# SPDX-License-Identifier: Apache-2.0
"""C++: a lambda knows what the template parameters around it stand for."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp, names, types

W = 'struct W { explicit W(ros::NodeHandle & nh) { ADV(std::string("t"), 1); } };\nstruct O { O(ros::NodeHandle &) {} };\n'
MADE = "template <class T> std::function<void(ros::NodeHandle &)> made() { return [](ros::NodeHandle & nh) { T t(nh); }; }\n"
CALLED = "template <class T> void made(ros::NodeHandle & nh) { [&] { T t(nh); }(); }\n"
KEPT = "template <class T> struct R { std::function<void(ros::NodeHandle &)> f; R() { f = [](ros::NodeHandle & nh) { T t(nh); }; } };\n"
TIMER = "template <class T> struct R { ros::Timer t; R(ros::NodeHandle & nh) { t = nh.createTimer(ros::Duration(1), [&](auto &) { T x(nh); }); } };\n"
FIRES = [
    ("made<W>()(nh);", MADE),
    ("made<W>(nh);", CALLED),
    ("R<W> r; r.f(nh);", KEPT),
    ("R<W> r(nh);", TIMER),
    ("auto f = made<W>(); f(nh);", MADE),
    ("made<O>()(nh); made<W>()(nh);", MADE),
]
QUIET = [
    ("made<O>()(nh);", MADE),
    ("made<O>(nh);", CALLED),
    ("R<O> r; r.f(nh);", KEPT),
    ("R<O> r(nh);", TIMER),
    ("made<Unseen>()(nh);", MADE),
    ("made<int>(nh);", CALLED),
    ("R<Unseen> r(nh);", TIMER),
    ("W * w = nullptr; made<O>(nh);", CALLED),
]


@pytest.mark.parametrize(("body", "before"), FIRES)
def test_what_it_makes(body: str, before: str) -> None:
    assert names(cpp(body, W + before)) == ["/t"]


@pytest.mark.parametrize(("body", "before"), QUIET)
def test_what_makes_nothing(body: str, before: str) -> None:
    assert names(cpp(body, W + before)) == []


def test_the_type_of_a_message() -> None:
    before = 'template <class T> void made(ros::NodeHandle & nh) { [&] { auto p = nh.advertise<T>("t", 1); }(); }\n'
    assert types(cpp("made<std_msgs::String>(nh);", before)) == [("/t", "std_msgs/String")]
