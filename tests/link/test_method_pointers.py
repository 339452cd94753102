# SPDX-License-Identifier: Apache-2.0
"""C++: variables and members that point to functions and methods, and calls by them."""

from __future__ import annotations

import pytest
from follow_kit import cpp, names

CLASS = (
    'class C { public: C() : p_(0) { s_ = &C::go; }\nvoid go() { ros::NodeHandle n; n.advertise<std_msgs::String>("c", 1); }\n'
    'void arg(int i) { ros::NodeHandle n; n.advertise<std_msgs::String>("a" + std::to_string(i), 1); }\nvoid quiet() {}\nvoid run() { %s }\n'
    "typedef void (C::*State)(); void (C::*m_)() = &C::go; void (C::*n_)(); State s_; int p_; };\n"
    'void make(ros::NodeHandle& n) { n.advertise<std_msgs::String>("f", 1); }\n'
)


@pytest.mark.parametrize(
    ("body", "run", "expected"),
    [
        ("C c; void (C::*m)() = &C::go; (c.*m)();", "", ["/c"]),
        ("C c; void (C::*m)(); m = &C::go; (c.*m)();", "", ["/c"]),
        ("C c; void (C::*m)(int) = &C::arg; (c.*m)(3);", "", ["/a3"]),
        ("C* c = new C(); void (C::*m)() = &C::go; (c->*m)();", "", ["/c"]),
        ("C c; C::State s = &C::go; (c.*s)();", "", ["/c"]),
        ("C c; c.run();", "(this->*m_)();", ["/c"]),
        ("C c; c.run();", "(this->*s_)();", ["/c"]),
        ("C c; c.run();", "n_ = &C::go; (this->*n_)();", ["/c"]),
        ("C c; c.run();", "((*this).*m_)();", ["/c"]),
        ("void (*f)(ros::NodeHandle&) = make; f(nh);", "", ["/f"]),
        ("void (*f)(ros::NodeHandle&); f = &make; (*f)(nh);", "", ["/f"]),
    ],
)
def test_what_they_point_to_is_called(body: str, run: str, expected: list[str]) -> None:
    assert names(cpp(body, CLASS % run)) == expected


@pytest.mark.parametrize(
    ("body", "run"),
    [
        ("C c; void (C::*m)() = &C::go;", ""),
        ("C c; void (C::*m)() = &C::quiet; (c.*m)();", ""),
        ("C c; void (C::*m)() = &C::go; m = &C::quiet; (c.*m)();", ""),
        ("C c; c.run();", "m_ = &C::quiet; (this->*m_)();"),
        ("C c;", "(this->*m_)();"),
        ("void (*f)(ros::NodeHandle&) = make;", ""),
        ("int p = 1; f(*&p)();", ""),
    ],
)
def test_what_nothing_calls(body: str, run: str) -> None:
    assert names(cpp(body, CLASS % run)) == []
