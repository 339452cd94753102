# SPDX-License-Identifier: Apache-2.0
"""Handlers of exceptions that give up: what holds afterwards is what holds where nothing is thrown."""

from __future__ import annotations

import pytest
from follow_kit import explicit, ros2_cpp

LISTS = "std::vector<std::string> names_;\n"


@pytest.mark.parametrize("given_up", ("return false;", 'RCLCPP_ERROR(get_logger(), "x"); return false;'))
def test_a_list_is_known_where_the_handler_gives_up(given_up: str) -> None:
    members = (
        'bool read() { try { names_ = declare_parameter<std::vector<std::string>>("n", {"a", "b"}); }'
        f" catch (const std::exception & e) {{ {given_up} }} return true; }}\n{LISTS}"
    )
    body = "if (!read()) { return; } for (const auto & n : names_) { create_publisher<String>(n, 1); }"
    (node,) = ros2_cpp(body, members).nodes
    assert sorted(end.name for end in explicit(node)) == ["/a", "/b"]


@pytest.mark.parametrize(
    ("handler", "rest"),
    (('return "b";', 'return std::string("a");'), ('t = "b";', "return t;"), ('t = "b"; throw;', "return t;")),
)
def test_what_a_handler_puts_in_its_place_counts(handler: str, rest: str) -> None:
    """A handler that goes on, or returns another value, may have been taken; one that throws goes on nowhere."""
    members = f'std::string name() {{ std::string t = "a"; try {{ t = outside(); t = "a"; }} catch (...) {{ {handler} }} {rest} }}\n'
    (node,) = ros2_cpp("create_publisher<String>(name(), 1);", members).nodes
    names = [end.name for end in explicit(node)]
    assert names == (["/a"] if "throw" in handler else ["/a", "/b"])
    unsure = [[unknown.field for unknown in end.unknowns] for end in explicit(node)]
    assert unsure == ([[]] if "throw" in handler else [["conditions"], ["conditions"]])


def test_what_a_handler_makes_is_told() -> None:
    members = 'bool read() { try { go(); } catch (...) { create_publisher<String>("failed", 1); return false; } return true; }\nvoid go();\n'
    (node,) = ros2_cpp('if (read()) { create_publisher<String>("done", 1); }', members).nodes
    assert sorted(end.name for end in explicit(node)) == ["/done", "/failed"]


@pytest.mark.parametrize(
    ("code", "fields"),
    (
        ("if (t.size() == 1) { return; } ADD", ["conditions"]),
        ("if (t.size() == 1) { return; } add();", ["conditions"]),
        ("if (t.size() == 2) { return; } ADD", []),
        ("if (outside()) { return; } ADD", []),
        ("add(); if (t.size() == 1) { return; }", []),
    ),
)
def test_what_stands_behind_a_return_that_is_taken_may_not_be_made(code: str, fields: list[str]) -> None:
    add = 'create_publisher<String>("a", 1);'
    body = f'auto t = declare_parameter("topics", std::vector<std::string>{{""}}); {code.replace("ADD", add)}'
    (node,) = ros2_cpp(body, f"void add() {{ {add} }}\n").nodes
    (end,) = explicit(node)
    assert [why.field for why in end.unknowns] == fields
