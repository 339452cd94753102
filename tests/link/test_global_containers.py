# SPDX-License-Identifier: Apache-2.0
"""Containers outside of functions begin without an element, as the language says, and are not known where something not followed fills them."""

from __future__ import annotations

import pytest
from follow_kit import cpp, cpp_files, ends, follow, main, names, node

BEFORE = "struct T { std::string name; int port; }; std::vector<std::string> v; std::vector<T> ts; std::map<std::string, std::string> m;\n"
#: What ``main`` does with them, and the names of its publishers.
FILLED = (
    ('v.push_back("a"); ADV(v[0], 1);', ["/a"]),
    ('T t = {.name = "a", .port = 1}; ts.emplace_back(t); ADV(ts[0].name, 1);', ["/a"]),
    ('for (int i = 0; i < 2; ++i) v.push_back("a" + std::to_string(i)); for (auto& n : v) ADV(n, 1);', ["/a0", "/a1"]),
    ('m["k"] = "a"; ADV(m["k"], 1);', ["/a"]),
    ('fill(); ADV(v[0], 1);', ["/a"]),
    ('read(); ADV(v[0], 1);', ["/?"]),
    ('other::fill(v); ADV(v[0], 1);', ["/?"]),
    ('for (auto& n : v) ADV(n, 1);', []),
    ('read(); for (auto& n : v) ADV(n, 1);', ["/?"]),
    ('nh.subscribe("s", 1, cb); ros::spin(); for (auto& n : v) ADV(n, 1);', ["/?"]),
    ('ADV(far[0], 1);', ["/?"]),
    ('ADV(S::s[0], 1);', ["/?"]),
)  # fmt: skip


@pytest.mark.parametrize(("body", "expected"), FILLED)
def test_a_container_outside_of_functions(body: str, expected: list[str]) -> None:
    before = BEFORE + "extern std::vector<std::string> far; struct S { static std::vector<std::string> s; };\n"
    before += 'void fill() { v.push_back("a"); }\n'
    before += "void cb(const std_msgs::String& s) { v.push_back(s.data); }\n"
    before += 'void read() { std::ifstream f("x"); std::string l; while (std::getline(f, l)) { v.push_back(l); } }\n'
    assert names(cpp(body, before)) == expected


def test_a_container_of_another_file() -> None:
    files = cpp_files(
        main("fill(); for (auto& n : v) ADV(n, 1);", "extern std::vector<std::string> v; void fill();\n"),
        v__cpp='#include <vector>\nstd::vector<std::string> v;\nvoid fill() { v.push_back("a"); }\n',
    )
    assert [end.name for end in ends(node(follow(files)))] == ["/a"]
