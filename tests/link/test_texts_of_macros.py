# SPDX-License-Identifier: Apache-2.0
"""Macros of C++ that make a text of what they are given (``#define NAME(V) (#V)``), used by other macros and as arguments of them."""

from __future__ import annotations

import pytest
from follow_kit import cpp, names

from haros_ci.analysis.header_macros import calling
from haros_ci.extract.cpp.read import read_cpp

MACROS = """#define NAME(V) (#V)
#define STR(x) #x
#define XSTR(x) STR(x)
#define BELOW(x) "robot/" #x
#define STEPS(h, n, v) if (!h.getParam(n, v)) { exit(-1); }
#define SETUP(h, v) STEPS(h, NAME(v), v)
#define OUTER(h, v) SETUP(h, v)
#define GET(h, n, v) h.getParam(n, v)
#define READ(h, v) GET(h, NAME(v), v)
#define PLAIN(h, v) if (!h.getParam(NAME(v), v)) { v = 0; }
#define MAKE(h, n) h.advertise<std_msgs::String>(n, 1)
#define DECLARE(h, n) MAKE(h, STR(n))
"""
PLACES = pytest.mark.parametrize("place", ["file", "header"])


def _names(place: str, code: str, kind: str) -> list[str]:
    if place == "file":
        found = cpp(code, before=MACROS)
    else:
        found = cpp(code, before='#include "macros.h"\n', macros__h=f"#pragma once\n{MACROS}")
    return [name for name in names(found, kind) if name != "/rosout"]


READ = (
    "SETUP(nh, rate);",
    "OUTER(nh, rate);",
    "bool ok = READ(nh, rate);",
    "PLAIN(nh, rate);",
    "nh.getParam(NAME(rate), rate);",
    "GET(nh, NAME(rate), rate);",
    "GET(nh, STR(rate), rate);",
    "STEPS(nh, NAME(rate), rate);",
    "std::string name = NAME(rate); nh.getParam(name, rate);",
)


@PLACES
@pytest.mark.parametrize("code", READ)
def test_the_name_of_a_variable_is_that_of_a_parameter(place: str, code: str) -> None:
    assert _names(place, f"int rate = 1;\n{code}", "getters") == ["/rate"]


#: Code, and the topic.
PUBLISHED = (
    ("auto p = MAKE(nh, NAME(chat));", "/chat"),
    ("auto p = MAKE(nh, STR(chat));", "/chat"),
    ("auto p = MAKE(nh, BELOW(chat));", "/robot/chat"),
    ("auto p = MAKE(nh, STR(CHAT));", "/CHAT"),
    ("auto p = MAKE(nh, XSTR(chat));", "/chat"),
    ("auto p = DECLARE(nh, chat);", "/chat"),
    ('auto p = MAKE(nh, "chat");', "/chat"),
    ("#define WORD chat\nauto p = MAKE(nh, STR(WORD));", "/WORD"),
    ("auto p = MAKE(nh, std::string(STR(NAME(chat))).substr(0, 4));", "/NAME"),
)


@PLACES
@pytest.mark.parametrize(("code", "expected"), PUBLISHED)
def test_topics(place: str, code: str, expected: str) -> None:
    assert _names(place, code, "publishers") == [expected]


#: What is made a text of is, or may be, another macro, which counts as what it stands for.
NOT_KNOWN = (
    "#define WORD chat\nauto p = MAKE(nh, XSTR(WORD));",
    "#define word chat\nauto p = MAKE(nh, XSTR(word));",
    "auto p = MAKE(nh, XSTR(BY_THE_BUILD));",
    "auto p = DECLARE(nh, BY_THE_BUILD);",
    "std::string s = XSTR(BY_THE_BUILD);\nauto p = nh.advertise<std_msgs::String>(s, 1);",
    "auto p = MAKE(nh, OTHER(chat));",
)


@PLACES
@pytest.mark.parametrize("code", NOT_KNOWN)
def test_what_a_macro_may_stand_for_is_not_known(place: str, code: str) -> None:
    assert _names(place, code, "publishers") == ["/?"]


@pytest.mark.parametrize("count", [30, 3000])
def test_macros_in_macros_have_an_end(count: int) -> None:
    code = f"auto p = MAKE(nh, {'NAME(' * count}chat{')' * count});"
    assert len(_names("file", code, "publishers")) <= 1


@pytest.mark.parametrize(
    ("text", "given"),
    [
        ("#define NAME(V) (#V)\n", ["NAME"]),
        ("#define STR(x) #x\n#define XSTR(x) STR(x)\n", ["STR", "XSTR"]),
        ('#define BELOW(x) "a/" #x "/b"\n', ["BELOW"]),
        ("#define JOIN(a, b) a##b\n", []),
        ("#define TWICE(x) (2 * (x))\n", []),
        ('#define TEXT(x) "x"\n', []),
        ("#define LOG(x) log(#x, x)\n", []),
        ("#define XLOG(x) LOG(x)\n", []),
        ("#define NAME(V) (#V)\n#undef NAME\n#define NAME(V) V\n", []),
    ],
)
def test_macros_that_are_given_to_other_files(text: str, given: list[str]) -> None:
    assert list(calling({"a.h": read_cpp(text)})) == given
