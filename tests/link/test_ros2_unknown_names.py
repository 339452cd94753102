# SPDX-License-Identifier: Apache-2.0
"""A name whose beginning is not known may be absolute: it is below no namespace. Texts that are put together keep what is known."""

from __future__ import annotations

import pytest
from follow_kit import explicit, ros2_main

GIVEN = (
    'std::string given = std::getenv("T");\nstd::string one = std::rand() > 1 ? "a" : "b";\n'
    'std::string two = std::rand() > 1 ? "a" : "/b";\nauto node = std::make_shared<rclcpp::Node>("n", "s");\n'
)


@pytest.mark.parametrize(("name", "found"), (("one", ["/s/a", "/s/b"]), ("two", ["/b", "/s/a"])))
def test_one_of_several(name: str, found: list[str]) -> None:
    (node,) = ros2_main(f"{GIVEN}auto p = node->create_publisher<String>({name}, 1);\n").nodes
    assert sorted(end.name for end in explicit(node)) == found
    assert [[unknown.field for unknown in end.unknowns] for end in explicit(node)] == [["conditions"]] * 2


@pytest.mark.parametrize(
    ("name", "found"),
    (
        ("given", "/?"),
        ('given + "_raw"', "/?_raw"),
        ('given + "/raw"', "/?/raw"),
        ('"a/" + given', "/s/a/?"),
        ('"~/" + given', "/s/n/?"),
        ('"/" + given', "/?"),
        ('"/x/" + given', "/x/?"),
        ('"a"', "/s/a"),
        ('std::string("a").append("_b").append("c")', "/s/a_bc"),
        ('std::string("a/").append(given)', "/s/a/?"),
        ("std::string(given).append(one)", "/?"),
    ),
)
def test_unknown_beginning(name: str, found: str) -> None:
    (node,) = ros2_main(f"{GIVEN}auto p = node->create_publisher<String>({name}, 1);\n").nodes
    (end,) = explicit(node)
    assert (node.name, end.name) == ("/s/n", found)
    assert [unknown.field for unknown in end.unknowns] == ["name"] * ("?" in found)
