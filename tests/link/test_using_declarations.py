# SPDX-License-Identifier: Apache-2.0
"""C++: functions and variables that a using-declaration brings, and namespaces under another name in a function."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp, names, types

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


ACTIONS = "#include <actionlib/server/simple_action_server.h>\n#include <g/GraspAction.h>\n"
BROUGHT = ACTIONS + "using actionlib::SimpleActionServer;\n"
MADE = '(nh, "a", [](auto&& goal) {}, false);'
OWN = (
    'namespace w { template <class T> struct Wrap { Wrap(ros::NodeHandle& nh) : s(nh, "a", false) {} actionlib::SimpleActionServer<T> s; };\n'
    "template <class T> struct Deep { using Inner = Wrap<T>; }; }\n"
)


@pytest.mark.parametrize(
    ("body", "before"),
    [
        ("SimpleActionServer<g::GraspAction> s" + MADE, BROUGHT),
        ("SimpleActionServer<GraspAction> s" + MADE, BROUGHT + "using g::GraspAction;"),
        ("using actionlib::SimpleActionServer; SimpleActionServer<g::GraspAction> s" + MADE, ACTIONS),
        ("auto s = std::make_unique<SimpleActionServer<g::GraspAction>>" + MADE, BROUGHT),
        (
            "std::unique_ptr<SimpleActionServer<g::GraspAction>> s; s.reset(new SimpleActionServer<g::GraspAction>"
            + MADE[:-1]
            + ");",
            BROUGHT,
        ),
        (
            "b::SimpleActionServer<g::GraspAction> s" + MADE,
            ACTIONS + "namespace b { using actionlib::SimpleActionServer; }",
        ),
        ("Server s" + MADE, BROUGHT + "using Server = SimpleActionServer<g::GraspAction>;"),
        ("Server<g::GraspAction> s" + MADE, BROUGHT + "template <class T> using Server = SimpleActionServer<T>;"),
        ("Wrap<g::GraspAction> s(nh);", ACTIONS + OWN + "using w::Wrap;"),
        ("w::Deep<g::GraspAction>::Inner s(nh);", ACTIONS + OWN),
    ],
)
def test_a_template_is_brought_with_its_arguments(body: str, before: str) -> None:
    assert types(cpp(body, before), "action_servers") == [("/a", "g/Grasp")]


@pytest.mark.parametrize(
    ("body", "before"),
    [
        # another template of that name, one that nothing tells of, and one whose parameter is not known
        ("SimpleActionServer<g::GraspAction> s" + MADE, "using other::SimpleActionServer;"),
        ("SimpleActionServer<g::GraspAction> s" + MADE, "namespace x { using actionlib::SimpleActionServer; }"),
        ("void* s = nullptr; SimpleActionServer<g::GraspAction>* t = nullptr;", BROUGHT),
        ("SimpleActionServer<g::GraspAction>::GoalHandle s;", BROUGHT),
        ("std::vector<SimpleActionServer<g::GraspAction>> s;", BROUGHT),
        ("", BROUGHT + "using g::GraspAction;"),
        ("struct L { SimpleActionServer<g::GraspAction>* s; }; L l;", BROUGHT),
        ("std::function<void(SimpleActionServer<g::GraspAction>&)> f;", BROUGHT),
        ("typedef SimpleActionServer<g::GraspAction> Server;", BROUGHT),
        ("using actionlib::SimpleActionClient;", BROUGHT),
        ("Wrap<g::GraspAction>* s = nullptr;", ACTIONS + OWN + "using w::Wrap;"),
    ],
)
def test_no_server(body: str, before: str) -> None:
    assert types(cpp(body, before), "action_servers") == []
