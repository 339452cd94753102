# SPDX-License-Identifier: Apache-2.0
"""C++: macros of the file that take arguments are what they stand for in expressions, too."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp, names

MAKE = "#define MAKE(h, n) h.advertise<std_msgs::String>(n, 1)\n"
FIRES = [
    ('auto p = MAKE(nh, "t");', MAKE),
    ('ros::Publisher p; p = MAKE(nh, "t");', MAKE),
    ('auto f = [&] { return MAKE(nh, "t"); }; f();', MAKE),
    ('if (MAKE(nh, "t")) {}', MAKE),
    ("ADV(PRE(t), 1);", "#define PRE(n) std::string(#n)\n"),
    ('ADV(ALSO("t"), 1);', "#define ALSO(n) PRE(n)\n#define PRE(n) std::string(n)\n"),
    ('ADV(AT("a", "t"), 1);', "#define AT(a, b) std::string((1 > 2) ? a : b)\n"),
]
QUIET = [
    ("int k = MAX(1, 2);", "#define MAX(a, b) (((a) > (b)) ? (a) : (b))\n"),
    ("auto n = PRE(t);", "#define PRE(n) std::string(#n)\n"),
    ('auto p = OTHER(nh, "t");', MAKE),
    ('auto n = "MAKE(nh)";', MAKE),
    ("int k = LOOP(1);", "#define LOOP(n) (LOOP(n) + 1)\n"),
    ("int k = TWO(1);", "#define TWO(n) f(n), f(n)\n"),
    ("int k = OPEN(1);", "#define OPEN(n) (n + (\n"),
    ("auto p = MAKE(nh);", MAKE),
    ("", MAKE),
]


@pytest.mark.parametrize(("body", "before"), FIRES)
def test_what_it_stands_for(body: str, before: str) -> None:
    assert names(cpp(body, before)) == ["/t"]


@pytest.mark.parametrize(("body", "before"), QUIET)
def test_what_makes_nothing(body: str, before: str) -> None:
    assert names(cpp(body, before)) == []
