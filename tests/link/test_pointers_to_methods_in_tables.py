# SPDX-License-Identifier: Apache-2.0
"""C++: ``this->*table[key]`` calls what the table holds ([expr.mptr.oper]), and ``ready && go(x);`` is no declaration."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp, names

CLASS = (
    "struct W { ros::NodeHandle nh; typedef void (W::*F)(); %s\n"
    'void go() { ADV(std::string("t"), 1); } void stop() {} void run() { %s } };\n'
)
FIRES = [
    ("std::map<std::string, F> m;", 'm["a"] = &W::go; (this->*m["a"])();'),
    ("std::map<int, F> m{{1, &W::go}};", "(this->*m[1])();"),
    ("F m[2] = {&W::stop, &W::go};", "(this->*m[1])();"),
    ("void (W::*m[2])() = {&W::go, &W::stop};", "(this->*m[0])();"),
    ("std::map<int, F> m{{1, &W::go}};", "for (auto & p : m) (this->*p.second)();"),
    ("std::map<int, F> m{{1, &W::go}};", "(this->*m.at(1))();"),
    ("std::map<int, F> m{{1, &W::go}};", "(this->*(m.at(1)))();"),
    ("F m = &W::go;", "(this->*m)();"),
    ("bool ready = true;", "ready && other(nh);"),
    ("bool ready = true;", "ready && free();"),
]
QUIET = [
    ("std::map<int, F> m{{1, &W::stop}};", "(this->*m[1])();"),
    ("F m[2] = {&W::stop, &W::go};", "(this->*m[0])();"),
    ("F m = &W::stop;", "(this->*m)();"),
    ("std::map<int, F> m{{1, &W::go}};", "auto f = m[1];"),
    ("std::map<int, F> m{{1, &W::stop}};", "for (auto & p : m) (this->*p.second)();"),
    ("int m[2] = {1, 2};", "int k = (m[0]) + (nh.ok());"),
    ("struct T { int * n; } t;", "int k = (*t.n);"),
    ("bool ready = true;", "auto && other = nh;"),
    ("bool ready = true;", "std::string && s(std::string()); W && w(W());"),
    ("bool ready = true;", "bool b = ready && (nh.ok());"),
    ("bool ready = true;", "ready && stop();"),
]
FREE = 'bool other(ros::NodeHandle & nh) { ADV(std::string("t"), 1); return true; }\nbool free() { ros::NodeHandle nh; return other(nh); }\n'


@pytest.mark.parametrize(("members", "body"), FIRES)
def test_what_is_called(members: str, body: str) -> None:
    assert names(cpp("W w; w.run();", FREE + CLASS % (members, body))) == ["/t"]


@pytest.mark.parametrize(("members", "body"), QUIET)
def test_what_makes_nothing(members: str, body: str) -> None:
    assert names(cpp("W w; w.run();", FREE + CLASS % (members, body))) == []
