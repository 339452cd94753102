# SPDX-License-Identifier: Apache-2.0
"""C++: containers construct their elements from what emplace and the like are given, and convert to them."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp, names

W = 'struct W { W(ros::NodeHandle & nh, std::string n = "t") { ADV(n, 1); } W(const W &) = default; };\n'
PLAIN = "struct P { std::string n; int q; };\nstruct O { O(int) {} };\n"
FIRES = [
    ("std::vector<W> v; v.emplace_back(nh);", ["/t"]),
    ('std::vector<W> v; v.emplace_back(nh, "u");', ["/u"]),
    ("std::vector<W> v; v.push_back(nh);", ["/t"]),
    ("std::vector<W> v; v.push_back(W(nh));", ["/t"]),
    ("std::list<W> v; v.emplace_front(nh);", ["/t"]),
    ("std::deque<W> v; v.emplace(v.end(), nh);", ["/t"]),
    ("std::set<W> v; v.emplace(nh);", ["/t"]),
    ('std::map<std::string, W> v; v.emplace("a", nh);', ["/t"]),
    ('std::map<std::string, W> v; v.try_emplace("a", nh, "u");', ["/u"]),
    ("std::map<int, W> v; v.emplace(std::piecewise_construct, std::make_tuple(1), std::forward_as_tuple(nh));", ["/t"]),
    (
        'std::vector<ros::NodeHandle> v; v.emplace_back("x"); auto p = v[0].advertise<std_msgs::String>("t", 1);',
        ["/x/t"],
    ),
    ('std::vector<std::thread> v; v.emplace_back([&] { ADV(std::string("t"), 1); });', ["/t"]),
    ('std::vector<W> v; for (auto n : {"a", "b"}) v.emplace_back(nh, n);', ["/a", "/b"]),
    (
        'std::vector<P> v; v.push_back({"a", 1}); v.emplace_back(P{"b", 2}); for (auto & e : v) ADV(e.n, e.q);',
        ["/a", "/b"],
    ),
    ('std::vector<std::string> v; v.emplace_back("a"); v.push_back("b"); for (auto & n : v) ADV(n, 1);', ["/a", "/b"]),
    ("std::vector<std::unique_ptr<W>> v; v.emplace_back(new W(nh));", ["/t"]),
]
QUIET = [
    "std::vector<W> v;",
    "std::vector<W> v; v.reserve(2);",
    "std::map<std::string, W> v;",
    "std::vector<W *> v; v.push_back(nullptr);",
    "std::vector<std::shared_ptr<W>> v; v.emplace_back();",
    "std::vector<O> v; v.emplace_back(1); v.push_back(2);",
    "std::vector<P> v; v.emplace_back(); v.push_back({});",
    "std::vector<int> v; v.emplace_back(1); v.emplace(v.begin(), 2);",
    'std::map<std::string, int> v; v.emplace("a", 1); v.try_emplace("b");',
    'std::map<std::string, O> v; v.emplace("a", 1); v.insert({"b", O(2)});',
    "Own<W> v; v.emplace_back(nh);",
    "std::vector<Unseen> v; v.emplace_back(nh);",
    "std::vector<std::function<void()>> v; v.emplace_back([] {});",
    'std::vector<ros::NodeHandle> v; v.emplace_back("x"); v.push_back(nh);',
    "std::vector<std::pair<int, int>> v; v.emplace_back(1, 2);",
    "std::vector<std::string> v; v.emplace_back(3, 'a'); v.emplace_back();",
    'std::set<std::string> v; v.emplace("a"); v.insert("b");',
]


@pytest.mark.parametrize(("body", "expected"), FIRES)
def test_what_elements_make(body: str, expected: list[str]) -> None:
    assert names(cpp(body, W + PLAIN)) == expected


@pytest.mark.parametrize("body", QUIET)
def test_what_makes_nothing(body: str) -> None:
    assert (
        names(cpp(body, W + PLAIN + "template <class T> struct Own { void emplace_back(ros::NodeHandle &) {} };\n"))
        == []
    )


@pytest.mark.parametrize("call", ["push_back(w)", "emplace_back(w)", "insert(v.end(), w)", "push_back(asked(w))"])
def test_a_copy_is_not_made_again(call: str) -> None:
    assert names(cpp(f"W w(nh); std::vector<W> v; v.{call};", W + "W asked(W & w);\n")) == ["/t"]
