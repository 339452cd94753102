# SPDX-License-Identifier: Apache-2.0
"""C++: functions and variables that a using-declaration brings, and namespaces under another name in a function."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp, names

X = 'namespace x { void go(ros::NodeHandle & nh) { ADV(std::string("t"), 1); } const std::string NAME = "t"; }\n'
DEEP = f"namespace a {{ {X} }}\n"
FIRES = [
    ("using x::go; go(nh);", X),
    ("go(nh);", X + "using x::go;"),
    ("y::go(nh);", X + "namespace y { using x::go; }"),
    ("using ::x::go; go(nh);", X),
    ("using a::x::go; go(nh);", DEEP),
    ("namespace b = a::x; b::go(nh);", DEEP),
    ("b::go(nh);", DEEP + "namespace b = a::x;"),
    ("using x::NAME; ADV(NAME, 1);", X),
    ("ADV(NAME, 1);", X + "using x::NAME;"),
    ("namespace b = a::x; ADV(b::NAME, 1);", DEEP),
]
QUIET = [
    ("using x::other; other(nh);", X),
    ("using x::go;", X),
    ("using y::go; go(nh);", X + "namespace y { void go(ros::NodeHandle &) {} }"),
    ("go(nh);", X),
    ("using x::go; y::go(nh);", X),
    ("namespace b = x; b::other(nh);", X),
    ("namespace b = y; b::go(nh);", X + "namespace y { void go(ros::NodeHandle &) {} }"),
    ("run(); go(nh);", X + "void run() { using x::go; } void go(ros::NodeHandle &) {}"),
    ("auto go = [](ros::NodeHandle &) {}; go(nh);", X + "using x::go;"),
    ("using std::swap; int a = 1, b = 2; swap(a, b);", X),
    ("using y::go; go(nh);", X),
]


@pytest.mark.parametrize(("body", "before"), FIRES)
def test_what_the_name_means(body: str, before: str) -> None:
    assert names(cpp(body, before)) == ["/t"]


@pytest.mark.parametrize(("body", "before"), QUIET)
def test_what_makes_nothing(body: str, before: str) -> None:
    assert names(cpp(body, before)) == []
