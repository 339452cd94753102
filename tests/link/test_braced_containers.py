# SPDX-License-Identifier: Apache-2.0
"""Containers of C++ made with braces hold what stands in them; with parentheses so many elements ([dcl.init.list], [sequence.reqmts])."""

from __future__ import annotations

from typing import Any

import pytest
from follow_kit import explicit, ros2_cpp


def default(value: str) -> Any:
    """The default of a parameter that is declared with *value*, beside a vector ``other`` of one element."""
    (found,) = ros2_cpp(f'std::vector<double> other{{3}}; declare_parameter("a", {value});').nodes
    (parameter,) = explicit(found, "parameters")
    return parameter.value


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ("std::vector<double>{1, 2}", [1.0, 2.0]),
        ("std::vector<double>{ 1, 2, 1, 2, 4 }", [1.0, 2.0, 1.0, 2.0, 4.0]),
        ("std::vector<double>{3}", [3.0]),
        ("std::vector<int64_t>{3, 4}", [3, 4]),
        ("std::vector<int64_t>{0}", [0]),
        ("std::vector<bool>{true, false}", [True, False]),
        ('std::vector<std::string>{"a", "b"}', ["a", "b"]),
        ("std::array<double, 2>{1, 2}", [1.0, 2.0]),
        ("std::vector<double>({1, 2})", [1.0, 2.0]),
        ("std::vector<double>{}", []),
        ("std::vector<double>()", []),
        ("std::vector<double>(2, 1.5)", [1.5, 1.5]),
        ("std::vector<int64_t>(3, 4)", [4, 4, 4]),
        ('std::vector<std::string>(2, "b")', ["b", "b"]),
        ("std::vector<double>{other}", [3.0]),
        ("std::vector<double>(other)", [3.0]),
    ],
)
def test_what_a_container_holds(value: str, expected: list[Any]) -> None:
    assert default(value) == expected


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ("Doubles{1, 2}", None),
        ("Doubles(2, 1)", None),
        ("Doubles{3}", None),
        ("Doubles{1, 2, 3}", [1.0, 2.0, 3.0]),
        ("Doubles{}", []),
        ("Doubles({1, 2})", [1.0, 2.0]),
        ("Doubles{Doubles({3})}", [3.0]),
        ('Texts{"a", "b"}', ["a", "b"]),
        ('Texts{"a"}', ["a"]),
    ],
)
def test_an_alias_of_a_container(value: str, expected: list[object] | None) -> None:
    (found,) = ros2_cpp(
        f'declare_parameter("a", {value});',
        before="using Doubles = std::vector<double>;\nusing Texts = std::vector<std::string>;\n",
    ).nodes
    (parameter,) = explicit(found, "parameters")
    assert parameter.value == expected
