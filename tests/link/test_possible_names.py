# SPDX-License-Identifier: Apache-2.0
"""ROS 2, C++: names that are one of several; two that are joined, of which the second may be empty, are the longer one."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import explicit, ros2_cpp

BEFORE = (
    "std::string asked();\nstd::string join(const std::string & space, const std::string & last) {\n"
    '  if (space.empty()) return "/" + last;\n  return last.empty() ? space : space + "/" + last;\n}\n'
)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ('join("arm", asked())', [("/arm/?", ["name"])]),
        ('rand() ? "a" : "a/" + asked()', [("/a/?", ["name"])]),
        ('join("arm", "t")', [("/arm/t", [])]),
        ('join("arm", "")', [("/arm", [])]),
        ('asked().empty() ? std::string("own") : "arm/" + asked()', [("/arm/?", ["name", "conditions"]), ("/own", ["conditions"])]),
        ('rand() ? "a" : "b"', [("/a", ["conditions"]), ("/b", ["conditions"])]),
        ('rand() ? "a" : "a/b"', [("/a", ["conditions"]), ("/a/b", ["conditions"])]),
        ('rand() ? "a" : "ab/" + asked()', [("/a", ["conditions"]), ("/ab/?", ["name", "conditions"])]),
        ("asked()", [("/?", ["name"])]),
    ],
)  # fmt: skip
def test_names(name: str, expected: list[tuple[str, list[str]]]) -> None:
    (node,) = ros2_cpp(f"std::string t = {name}; auto p = create_publisher<String>(t, 1);", "", BEFORE).nodes
    found = [(end.name, [unknown.field for unknown in end.unknowns]) for end in explicit(node)]
    assert sorted(found) == expected
