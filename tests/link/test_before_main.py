# SPDX-License-Identifier: Apache-2.0
"""C++: variables at namespace scope begin before ``main``: they register what they are given, and objects are made."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import CPP_HEAD, cpp, names

REGISTER = (
    "struct B { virtual void go(ros::NodeHandle & nh) = 0; };\n"
    "using F = std::function<std::unique_ptr<B>()>;\n"
    "struct Reg { static std::map<std::string, F> & all() { static std::map<std::string, F> x; return x; }\n"
    "static bool add(const std::string & n, F f) { all()[n] = f; return true; } };\n"
)
D = 'struct D : B { void go(ros::NodeHandle & nh) override { ADV(std::string("t"), 1); } };\n'
ADD = 'Reg::add("d", [] { return std::make_unique<D>(); })'
OBJECT = 'struct R { R() { Reg::add("d", [] { return std::make_unique<D>(); }); } };\n'
TEMPLATE = (
    "template <class T> struct R { R(const std::string & n) { Reg::add(n, [] { return std::make_unique<T>(); }); } };\n"
)
ALL = "for (auto & one : Reg::all()) one.second()->go(nh);"
W = 'struct W { std::string n = "t"; void go(ros::NodeHandle & nh) { ADV(n, 1); } void set(std::string s) { n = s; } };\n'
FIRES = [
    (ALL, REGISTER + D + f"static bool added = {ADD};"),
    ('Reg::all().at("d")()->go(nh);', REGISTER + D + f"namespace {{ const bool added = {ADD}; }}"),
    (ALL, REGISTER + D + f"struct S {{ static bool added; }}; bool S::added = {ADD};"),
    (ALL, REGISTER + D + OBJECT + "static R r;"),
    (ALL, REGISTER + D + OBJECT + "namespace a { R r; }"),
    (ALL, REGISTER + D + TEMPLATE + 'static R<D> r("d");'),
    ("", 'bool go() { ros::NodeHandle nh; ADV(std::string("t"), 1); return true; } static bool gone = go();'),
]
QUIET = [
    (ALL, REGISTER + D),
    (ALL, REGISTER + D + OBJECT),
    (ALL, REGISTER + D + OBJECT + "extern R r;"),
    (ALL, REGISTER + D + OBJECT + "R * r;"),
    (ALL, REGISTER + D + OBJECT + "std::unique_ptr<R> r;"),
    (ALL, REGISTER + D + f"bool add() {{ return {ADD}; }}"),
    (ALL, REGISTER + D + f"void add() {{ static bool added = {ADD}; }}"),
    ("", REGISTER + D + f"static bool added = {ADD};"),
    ("", W + "W g;"),
    ("Reg::all();", REGISTER + D + OBJECT + "static R r;"),
    ("", "int number() { return 1; } static int n = number(); static std::string s = std::to_string(n);"),
    ("", "struct P { P() : n(1) {} int n; }; static P p; static std::vector<P> all;"),
]


@pytest.mark.parametrize(("body", "before"), FIRES)
def test_what_is_made(body: str, before: str) -> None:
    assert names(cpp(body, before)) == ["/t"]


@pytest.mark.parametrize(("body", "before"), QUIET)
def test_what_makes_nothing(body: str, before: str) -> None:
    assert names(cpp(body, before)) == []


def test_another_file_of_the_program_registers() -> None:
    head = f"#pragma once\n{CPP_HEAD}#include <map>\n{REGISTER}"
    body = 'void go(ros::NodeHandle & nh) override { nh.advertise<std_msgs::String>("t", 1); }'
    other = f'#include "reg.h"\nstruct D : B {{ {body} }};\nstatic bool added = {ADD};\n'
    assert names(cpp(ALL, '#include "reg.h"', reg__h=head, d__cpp=other)) == ["/t"]
