# SPDX-License-Identifier: Apache-2.0
"""Functions that rewrite a text as a whole, and calls of them that leave it unknown."""

from __future__ import annotations

import pytest
from follow_kit import cpp, names

OUTSIDE = (
    "#include <string>\n#include <algorithm>\n#include <boost/algorithm/string.hpp>\nstd::string text(); bool cond();\n"
)

TOLD = (
    ("std::replace(s.begin(), s.end(), 'B', '_');", "/a_ c/"),
    ("std::replace(s.begin(), s.end(), ' ', '/');", "/aB/c"),
    ("std::transform(s.begin(), s.end(), s.begin(), ::tolower);", "/ab c/"),
    ("std::transform(s.begin(), s.end(), s.begin(), std::toupper);", "/AB C/"),
    ("boost::to_lower(s);", "/ab c/"),
    ('boost::replace_all(s, "B c", "d");', "/ad"),
    ('boost::algorithm::erase_all(s, " ");', "/aBc"),
    ("s = boost::algorithm::to_lower_copy(s);", "/ab c/"),
    ("boost::to_lower_copy(s);", "/aB c/"),
    ('s = boost::trim_copy(" x "); ', "/x"),
    ('s = "Q/" + text(); boost::to_lower(s);', "/q/?"),
)

UNKNOWN = (
    "std::replace(s.begin() + 1, s.end(), 'B', '_');",
    "std::replace(s.begin(), s.end(), text()[0], '_');",
    "std::transform(s.begin(), s.end(), s.begin(), text);",
    "std::transform(s.begin(), s.end(), t.begin(), ::tolower); s = t;",
    'boost::replace_all(s, text(), "d");',
    "boost::trim_if(s, boost::is_any_of(text()));",
    "s = text(); boost::to_lower(s);",
)


@pytest.mark.parametrize(("code", "expected"), TOLD)
def test_what_a_text_becomes(code: str, expected: str) -> None:
    found = cpp(f'std::string s = "aB c"; {code} ADV(s, 1);', OUTSIDE)
    assert " ".join(names(found)).rstrip("/") == expected.rstrip("/")


@pytest.mark.parametrize("code", UNKNOWN)
def test_what_is_not_told(code: str) -> None:
    found = cpp(f'std::string s = "aB c", t = "T"; {code} ADV(s, 1);', OUTSIDE)
    assert names(found) == ["/?"]


#: What an algorithm's function makes for elements that are not known, where it is called, and what of that is certain.
APPLIED = (
    (
        'std::vector<std::string> v{"a", "b"}; for (auto& s : v) std::for_each(u.begin(), u.end(), [&](int i) { ADV(s, 1); });',
        [("/a", False), ("/b", False)],
    ),
    (
        'std::string s = "a"; std::any_of(u.begin(), u.end(), [&](int i) { ADV(s, 1); return true; }); s = "b";',
        [("/a", False)],
    ),
    ("std::transform(u.begin(), u.end(), w.begin(), [&](int i) { ADV(text(), 1); return i; });", [("/?", False)]),
    (
        'int n = 0; std::for_each(u.begin(), u.end(), [&](int i) { ADV("a" + std::to_string(n++), 1); });',
        [("/a?", False)],
    ),
    (
        'std::string s = "a"; std::sort(u.begin(), u.end(), [&](int i, int j) { return i < j; }); ADV(s, 1);',
        [("/a", True)],
    ),
    ('std::string s = "a"; std::for_each(u.begin(), u.end(), [&](int i) { s = "b"; }); ADV(s, 1);', [("/?", True)]),
    ('std::vector<int> v; std::for_each(v.begin(), v.end(), [&](int i) { ADV("a", 1); });', []),
    ('std::vector<int> v{1}; std::for_each(v.begin(), v.end(), [&](int i) { ADV("a", 1); });', [("/a", True)]),
)


@pytest.mark.parametrize(("code", "expected"), APPLIED)
def test_what_an_algorithm_calls(code: str, expected: list[tuple[str, bool]]) -> None:
    found = cpp(f"std::vector<int> u = numbers(), w = numbers(); {code}", OUTSIDE + "std::vector<int> numbers();\n")
    ends = [end for end in found.endpoints if not end.implicit]
    assert (
        sorted((end.name, not any("goes through" in item.reason for item in end.unknowns)) for end in ends) == expected
    )


N = (
    'void make_one(int i) { ros::NodeHandle nh; nh.advertise<std_msgs::String>("d", 1); }\n'
    'std::vector<int> numbers();\nstruct N { ros::NodeHandle nh; int n_ = 0; std::string name_ = "a";\n'
    'void make(int i) { nh.advertise<std_msgs::String>("b" + std::to_string(n_++), 1); }\n'
    'void set(int i) { name_ = "c"; }\nbool less(int i, int j) { return i < j; }\n'
    "void go() { std::vector<int> u = numbers(); %s } };\n"
)
BOUND = "std::for_each(u.begin(), u.end(), std::bind(&N::%s, this, std::placeholders::_1));"
#: The same with methods that are bound: they may be called several times, too.
METHODS = (
    (BOUND % "make", ["/b?"]),
    (BOUND % "set" + " nh.advertise<std_msgs::String>(name_, 1);", ["/?"]),
    ("std::sort(u.begin(), u.end(), std::bind(&N::less, this)); nh.advertise<std_msgs::String>(name_, 1);", ["/a"]),
    ("auto f = std::bind(&N::set, this, 1); nh.advertise<std_msgs::String>(name_, 1);", ["/a"]),
)


@pytest.mark.parametrize(("code", "expected"), METHODS)
def test_methods_that_an_algorithm_calls(code: str, expected: list[str]) -> None:
    assert names(cpp("N n; n.go();", OUTSIDE + N % code)) == expected


#: Methods of which a function only takes the address, to give it away, and whether what they make is in the model.
ADDRESSES = (
    ("std::thread t(&N::make, this, 1); t.join();", ["/b?"]),
    ("outside::call(std::bind(&N::make, this, 1));", ["/b?"]),
    ("outside::call(&make_one);", ["/d"]),
    ("outside::call(std::bind(&N::set, this, 1));", []),
    ("int i = 1; outside::call(&i);", []),
)


@pytest.mark.parametrize(("code", "expected"), ADDRESSES)
def test_methods_that_are_given_away(code: str, expected: list[str]) -> None:
    assert names(cpp("N n; n.go();", OUTSIDE + N % code)) == expected
