# SPDX-License-Identifier: Apache-2.0
"""C++: a static method of a class template knows what the template parameters of its class stand for."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp, names

FACTORY = "template <class T> struct F { static void make(ros::NodeHandle & nh) { T t(nh); } };\n"
CALLER = "template <class T> struct F { static void make(ros::NodeHandle & nh) { T::go(nh); } };\n"
OUTSIDE = (
    "template <class T> struct F { static T & get(); };\ntemplate <class T> T & F<T>::get() { static T t; return t; }\n"
)
INSIDE = "template <class T> struct F { static T & get() { static T t; return t; } };\n"
POINTER = "template <class T> struct F { static T * get() { static T * t = new T; return t; } };\n"
W = (
    'struct W { ros::NodeHandle n; W() {} W(ros::NodeHandle & nh) { ADV(std::string("t"), 1); }\n'
    'static void go(ros::NodeHandle & nh) { ADV(std::string("t"), 1); } void run() { go(n); } };\n'
)
FIRES = [
    ("F<W>::make(nh);", FACTORY + W),
    ("F<W>::make(nh);", CALLER + W),
    ("x::F<W>::make(nh);", "namespace x { " + FACTORY + "}\n" + W),
    ("using G = F<W>; G::make(nh);", FACTORY + W),
    ("G::make(nh);", FACTORY + W + "using G = F<W>;"),
    ("F<W>::get().run();", INSIDE + W),
    ("F<W>::get().run();", OUTSIDE + W),
    ("F<W>::get()->run();", POINTER + W),
    ("D::get().run();", INSIDE + "struct D : F<D> { ros::NodeHandle n; void run() { W w(n); } };\n" + W),
    ("H<W>::make(nh);", FACTORY + "template <class T> struct H : F<T> {};\n" + W),
    ("go<W>(nh);", FACTORY + "template <class T> void go(ros::NodeHandle & nh) { F<T>::make(nh); }\n" + W),
]
QUIET = [
    ("F<W>::make(nh);", FACTORY + "struct W { W(ros::NodeHandle &) {} };"),
    ("F<int>::make(nh);", CALLER + W),
    ("F<Unseen>::make(nh);", FACTORY + W),
    ("F<Unseen>::make(nh);", CALLER + W),
    ("F<W>::get();", INSIDE + W),
    ("F<W> f;", FACTORY + W),
    ("Unseen<W>::make(nh);", FACTORY + W),
    ("F<W>::other(nh);", FACTORY + W),
    ("std::numeric_limits<int>::max(); F<W>::get();", OUTSIDE + W),
    ("using G = F<int>; G::make(nh);", CALLER + W),
    (
        "F<W>::make<int>(nh);",
        "template <class T> struct F { template <class U> static void make(ros::NodeHandle &) { U u; } };\n" + W,
    ),
    (
        "F<int>::make(nh, w());",
        "template <class T> struct F { template <class U> static void make(ros::NodeHandle &, U) { T::go(); } };\nW w();\n"
        + W,
    ),
]


@pytest.mark.parametrize(("body", "before"), FIRES)
def test_what_it_makes(body: str, before: str) -> None:
    assert names(cpp(body, before)) == ["/t"]


@pytest.mark.parametrize(("body", "before"), QUIET)
def test_what_makes_nothing(body: str, before: str) -> None:
    assert names(cpp(body, before)) == []


def test_two_of_one_template() -> None:
    others = 'struct V { V(ros::NodeHandle & nh) { ADV(std::string("v"), 1); } };\n'
    assert names(cpp("F<W>::make(nh); F<V>::make(nh);", FACTORY + W + others)) == ["/t", "/v"]
