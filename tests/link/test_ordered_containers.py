# SPDX-License-Identifier: Apache-2.0
"""C++: the elements of sets and maps come in the order of their values and keys, those of vectors as they were added."""

from __future__ import annotations

import pytest
from follow_kit import cpp_files, follow, main, node

COUNTED = "int i = 0; for (auto& x : c) ADV(%s + std::to_string(i++), 1);"
VALUE, KEY = COUNTED % "x", COUNTED % "x.first"
BY_ITERATOR = "int i = 0; for (auto it = c.begin(); it != c.end(); ++it) ADV(%s + std::to_string(i++), 1);"


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('std::set<std::string> c{"b", "a"}; ADV(*c.begin(), 1);', ["/a"]),
        ('std::set<std::string> c{"b", "a"};' + VALUE, ["/a0", "/b1"]),
        ('std::set<std::string> c; c.insert("b"); c.insert("a"); c.insert("b");' + VALUE, ["/a0", "/b1"]),
        ('std::set<int> c{10, 9, 9}; ADV("s" + std::to_string(c.size()), 1);', ["/s2"]),
        ('std::set<int> c{10, 9}; ADV("s" + std::to_string(*c.begin()), 1);', ["/s9"]),
        ('std::set<std::string, std::greater<std::string>> c{"a", "b"}; ADV(*c.begin(), 1);', ["/b"]),
        ('std::map<std::string, int> c{{"b", 1}, {"a", 2}};' + KEY, ["/a0", "/b1"]),
        ('std::map<std::string, int> c; c["b"] = 1; c["a"] = 2;' + KEY, ["/a0", "/b1"]),
        ('std::map<int, std::string> c{{10, "b"}, {9, "a"}};' + COUNTED % "x.second", ["/a0", "/b1"]),
        ('std::map<std::string, int> c{{"b", 1}, {"a", 2}};' + BY_ITERATOR % "it->first", ["/a0", "/b1"]),
        ('std::map<std::string, int> c{{"b", 1}, {"a", 2}}; ADV(c.begin()->first, 1);', ["/a"]),
        # all others, and what is in order
        ('std::vector<std::string> c{"b", "a"};' + VALUE, ["/a1", "/b0"]),
        ('std::vector<std::string> c{"b", "b"};' + VALUE, ["/b0", "/b1"]),
        ('std::list<std::string> c{"b", "a"}; ADV(c.front(), 1);', ["/b"]),
        ('std::array<std::string, 2> c = {"b", "a"};' + VALUE, ["/a1", "/b0"]),
        ('std::set<std::string> c{"a", "b"};' + VALUE, ["/a0", "/b1"]),
        ('std::map<std::string, int> c{{"a", 1}, {"b", 2}}; ADV("a" + std::to_string(c["a"]), 1);', ["/a1"]),
        ('std::set<std::string> c{"a"}; ADV(*c.begin(), 1);', ["/a"]),
    ],
)
def test_the_order_of_elements(body: str, expected: list[str]) -> None:
    found = node(follow(cpp_files(main(body))))
    assert sorted(end.name for end in found.endpoints if end.kind == "publishers" and not end.implicit) == expected
