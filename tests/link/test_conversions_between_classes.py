# SPDX-License-Identifier: Apache-2.0
"""Implicit conversions of C++: constructors with one parameter and conversion functions, where a variable, an argument or a result wants another class."""

from __future__ import annotations

import pytest
from follow_kit import cpp_files, follow, main, node

TALKER = 'struct Talker { ros::Publisher p; Talker(ros::NodeHandle nh%s) { p = ADV("%s", 1); } };\n'
TAKES = TALKER % ("", "t")
HOLDER = "struct Holder { ros::NodeHandle nh; operator %s { %s } };\n"
NAMED = HOLDER % ("std::string() const", 'return "a";')


@pytest.mark.parametrize(
    ("before", "body", "expected"),
    [
        (TAKES, "Talker t = nh;", ["/t"]),
        (TAKES, "const Talker& t = nh;", ["/t"]),
        (TALKER % (", int n = 1", "t"), "Talker t = nh;", ["/t"]),
        (TAKES + "Talker make(ros::NodeHandle nh) { return nh; }\n", "auto t = make(nh);", ["/t"]),
        (TAKES + 'void f(Talker t, ros::NodeHandle nh) { ADV("f", 1); }\n', "f(nh, nh);", ["/f", "/t"]),
        (HOLDER % ("ros::NodeHandle()", 'ADV("o", 1); return nh;'), "Holder h; ros::NodeHandle other = h;", ["/o"]),
        (NAMED, "Holder h; std::string s = h; ADV(s, 1);", ["/a"]),
        (
            HOLDER % ("const std::string&() const", 'static std::string s = "a"; return s;'),
            "Holder h; std::string s = h; ADV(s, 1);",
            ["/a"],
        ),
        (HOLDER % ("int() const", "return 7;"), 'Holder h; int n = h; ADV("n" + std::to_string(n), 1);', ["/n7"]),
        # no conversion: the same class, a base of it, references, pointers, and what is constructed by itself
        (TAKES, "Talker t(nh);", ["/t"]),
        (
            TAKES + "struct Own : Talker { Own(ros::NodeHandle n) : Talker(n) {} };\n",
            "Own o(nh); Talker t = o; const Talker& u = o;",
            ["/t"],
        ),
        (TAKES, "ros::NodeHandle other = nh; ros::NodeHandle& same = nh;", []),
        (TAKES, "Talker* t = nullptr; std::shared_ptr<Talker> u;", []),
        (TALKER % (", int n", "t"), "Talker t = nh;", []),
        (TAKES + "struct Other {};\n", "Other o; Talker t = o;", []),
        (HOLDER % ("ros::NodeHandle()", 'ADV("o", 1); return nh;'), "Holder h; Holder g = h; auto i = h;", []),
        (NAMED, "Holder h; Holder* p = &h;", []),
    ],
)
def test_what_is_converted(before: str, body: str, expected: list[str]) -> None:
    found = node(follow(cpp_files(main(body, before))))
    assert sorted({end.name for end in found.endpoints if end.kind == "publishers" and not end.implicit}) == expected


def test_a_type_that_no_function_gives() -> None:
    (end,) = (
        end
        for end in node(
            follow(cpp_files(main('Holder h; int n = h; nh.advertise<std_msgs::String>("x", n);', NAMED)))
        ).endpoints
        if end.kind == "publishers" and not end.implicit
    )
    assert [unknown.field for unknown in end.unknowns] == ["queue_size"]
