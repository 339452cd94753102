# SPDX-License-Identifier: Apache-2.0
"""Turns of a loop that are gone through one by one: what is rehearsed in them, and the bounds that reasons name."""

from __future__ import annotations

import pytest
from follow_kit import cpp, ends, names, python

from haros_ci.follow.loops import CHANGING, LONG, TOO_LONG, TOO_MANY, TOO_MANY_ITEMS, TURNS, UNORDERED
from haros_ci.model.architecture import Node

#: A function that is given away and does not end: it takes hundreds of steps for a turn of its own.
ENDLESS = "struct W { bool running_ = true; int n_ = 0; void watch() { while (running_ == true) { %s } } };\n" % (
    "n_ = get(n_); " * 150
)
TEXTS = 'std::vector<std::string> t{"a", "b", "c"}; '
LOOP = TEXTS + "for (size_t i = 0; i < t.size(); ++i) { %s ADV(t[i], 1); }"
HEAVY = "int k = 0; " + "k = get(k); " * (LONG + 50)


def why(found: Node) -> list[str]:
    return [unknown.reason for end in ends(found) for unknown in end.unknowns if unknown.field == "name"]


@pytest.mark.parametrize(
    "code",
    ["boost::asio::post(pool, [&]() { w.watch(); });", "run([&w]() { w.watch(); });", ""],
    ids=["posted", "given to a function that is not known", "nothing"],
)
def test_what_is_rehearsed_in_a_loop_takes_nothing_of_its_turns(code: str) -> None:
    found = cpp(LOOP % f"W w; {code}", ENDLESS)
    assert names(found) == ["/a", "/b", "/c"]


def test_steps_of_a_loop_are_bounded() -> None:
    found = cpp(LOOP.replace("t[i]", '"t" + std::to_string(i)') % HEAVY)
    assert "/t0" in names(found) and why(found) == [TOO_LONG]


def test_an_element_at_is_not_known_for_the_same_reason() -> None:
    assert why(cpp(LOOP.replace("t[i]", "t.at(i)") % HEAVY)) == [TOO_LONG]


def test_turns_are_bounded() -> None:
    found = cpp(f'for (int i = 0; i < {TURNS + 9}; ++i) ADV("t" + std::to_string(i), 1);')
    assert len(names(found)) == TURNS + 1 and why(found) == [TOO_MANY]


def test_elements_are_bounded() -> None:
    found = python(f"for t in {[f't{i}' for i in range(TURNS * 4 + 1)]}:\n    PUB(t)")
    assert names(found) == ["/?"] and why(found) == [TOO_MANY_ITEMS]


@pytest.mark.parametrize("test", ["true", "get()"])
def test_what_has_no_bound_names_none(test: str) -> None:
    reasons = why(cpp(f'int k = 0; while ({test}) {{ k++; ADV("t" + std::to_string(k), 1); }}'))
    assert reasons and not any(reason.startswith("the bound of") for reason in reasons)


#: Loops in loops whose inner one changes elements by its variable, and what the list then has for its only element "a".
CHANGED_INSIDE = (
    ('for (auto& w : v) w += "_y";', "/a_y"),
    ('for (int i = 0; i < 1; i++) for (auto& w : v) w += "_y";', "/?"),
    ('for (int i = 0; i < 1; i++) for (std::string& w : v) { w = w + "_y"; }', "/?"),
    ('int n = 0; while (true) { if (n >= 1) break; n++; for (auto& w : v) w += "_y"; }', "/?"),
    ('for (int i = 0; i < 1; i++) for (const auto& w : v) { s = w + "_y"; }', "/a"),
    ('for (int i = 0; i < 1; i++) for (auto w : v) { w += "_y"; }', "/a"),
    ("for (int i = 0; i < 1; i++) for (auto& w : v) { s = w; }", "/a"),
)


@pytest.mark.parametrize(("loop", "expected"), CHANGED_INSIDE)
def test_elements_that_a_loop_in_a_loop_changes(loop: str, expected: str) -> None:
    found = cpp(f'std::vector<std::string> v{{"a"}}; std::string s; {loop} ADV(v[0], 1);')
    assert names(found) == [expected]


#: The same in Python, where objects and lists are changed, and texts are not.
CHANGED_INSIDE_PYTHON = (
    ("for o in objects:\n        o.name = 'b'", "/b"),
    ("for i in range(2):\n        for o in objects:\n            o.name = 'b'", "/b"),
    ("while input():\n        for o in objects:\n            o.name = 'b'", "/?"),
    ("while input():\n        while input():\n            for o in objects:\n                o.set('b')", "/?"),
    ("for i in range(2):\n        for o in objects:\n            o.set('b')", "/b"),
    ("for i in range(2):\n        for o in objects:\n            o = 'b'", "/a"),
    ("for i in range(2):\n        for o in objects:\n            print(o.name)", "/a"),
)


#: Many objects, of which the last ones are not gone through: what they had is not known, where the body changes them.
MANY = (
    ("while input():\n        for o in objects:\n            o.set('b')", "/?"),
    ("while input():\n        for o in objects:\n            print(o.name)", "/a"),
)


@pytest.mark.parametrize(("loop", "expected"), MANY)
def test_many_objects_that_a_loop_in_a_loop_changes(loop: str, expected: str) -> None:
    before = "class C:\n    def __init__(self):\n        self.name = 'a'\n    def set(self, name):\n        self.name = name\n"
    objects = ", ".join(["C()"] * (CHANGING + 2))
    body = (
        f"objects = [{objects}]\ndef go():\n    {loop}\ngo()\nrospy.Publisher(objects[-1].name, String, queue_size=1)"
    )
    assert names(python(before + body)) == [expected]


@pytest.mark.parametrize(("loop", "expected"), CHANGED_INSIDE_PYTHON)
def test_objects_that_a_loop_in_a_loop_changes(loop: str, expected: str) -> None:
    before = "class C:\n    def __init__(self):\n        self.name = 'a'\n    def set(self, name):\n        self.name = name\n"
    body = f"objects = [C()]\ndef go():\n    {loop}\ngo()\nrospy.Publisher(objects[0].name, String, queue_size=1)"
    assert names(python(before + body)) == [expected]


#: A list that is sorted by a function, so that its order is not known, and what a loop makes of it that ends at the first, second or no element.
SORTED = (
    ("for (const auto& w : v) { ADV(w, 1); }", ["/a", "/b", "/c"], True),
    ("for (const auto& w : v) { ADV(w, 1); break; }", ["/a", "/b", "/c"], False),
    ("for (const auto& w : v) { ADV(w, 1); if (1 > 0) throw 1; }", ["/a", "/b", "/c"], False),
    ('for (const auto& w : v) { if (w == "b") break; } ADV("z", 1);', ["/z"], True),
    ('std::string s; for (const auto& w : v) { if (w == "b") { s = w; break; } } ADV(s, 1);', ["/?"], True),
)


@pytest.mark.parametrize(("loop", "expected", "is_certain"), SORTED)
def test_loops_over_a_list_of_an_order_that_is_not_known(loop: str, expected: list[str], is_certain: bool) -> None:
    less = "[](const std::string& a, const std::string& b) { return a.size() < b.size(); }"
    found = cpp(f'std::vector<std::string> v{{"c", "a", "b"}}; std::sort(v.begin(), v.end(), {less}); {loop}')
    assert sorted(names(found)) == expected
    doubts = [item.reason for end in ends(found) for item in end.unknowns if item.field == "conditions"]
    assert (UNORDERED not in doubts) is is_certain
