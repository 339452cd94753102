# SPDX-License-Identifier: Apache-2.0
"""A switch in a loop over values that are known: each turn makes what its own case makes."""

from __future__ import annotations

import pytest
from ros2_cpp_kit import component, explicit

BEFORE = (
    "enum class Kind { NONE = 0, ONE = 1, TWO = 2 };\n"
    'Kind kind_of(const std::string & text) { if (text == "one") { return Kind::ONE; }\n'
    'if (text == "two") { return Kind::TWO; } return Kind::NONE; }\n'
)
MEMBERS = "rclcpp::PublisherBase::SharedPtr p_;"


def switch(*cases: str) -> str:
    return f"switch (kind) {{ {' '.join(cases)} }}"


def made(label: str, name: str, end: str = "break;") -> str:
    return f'{label}: {{ p_ = create_publisher<String>(text + "/{name}", 1); {end} }}'


ONE, TWO = made("case Kind::ONE", "x"), made("case Kind::TWO", "y")


@pytest.mark.parametrize(
    ("cases", "found"),
    (
        ((ONE, TWO), ["/one/x", "/two/y"]),
        ((ONE, TWO, made("default", "z")), ["/none/z", "/one/x", "/two/y"]),
        (("case Kind::ONE:", TWO), ["/one/y", "/two/y"]),
        (("case Kind::ONE: std::abs(1);", TWO), ["/one/y", "/two/y"]),
        ((made("case Kind::ONE", "x", ""), TWO), ["/one/x", "/one/y", "/two/y"]),
        ((ONE, made("case Kind::NONE: default", "z")), ["/none/z", "/one/x", "/two/z"]),
        ((made("case Kind::ONE", "x", "continue;"), TWO), ["/one/x", "/two/y"]),
    ),
)
def test_known_values(cases: tuple[str, ...], found: list[str]) -> None:
    turn = f"const Kind kind = kind_of(text); {switch(*cases)}"
    body = f'for (const std::string text : {{"one", "two", "none"}}) {{ {turn} }}'
    assert [end.name for end in explicit(component(body, MEMBERS, BEFORE))] == found


@pytest.mark.parametrize("kind", ("kind_of(std::getenv(text.c_str()))", "static_cast<Kind>(std::rand())"))
def test_unknown_values(kind: str) -> None:
    body = f'for (const std::string text : {{"one", "two"}}) {{ const Kind kind = {kind}; {switch(ONE, TWO)} }}'
    found = explicit(component(body, MEMBERS, BEFORE))
    assert [end.name for end in found] == ["/one/x", "/one/y", "/two/x", "/two/y"]


def test_outside_of_a_loop_the_other_cases_stay_under_the_switch() -> None:
    body = f'const std::string text = "one"; const Kind kind = kind_of(text); {switch(ONE, TWO)}'
    found = explicit(component(body, MEMBERS, BEFORE))
    assert [(end.name, [each.statement for each in end.conditions]) for end in found] == [
        ("/one/x", ["switch"]),
        ("/one/y", ["switch"]),
    ]


def test_what_is_returned_by_a_case_that_is_not_taken_does_not_count() -> None:
    body = f'const std::string text = "one"; const Kind kind = kind_of(text); {switch("case Kind::TWO: return;", ONE)}'
    found = explicit(component(body + ' p_ = create_publisher<String>("after", 1);', MEMBERS, BEFORE))
    assert [(end.name, end.unknowns) for end in found] == [("/after", ()), ("/one/x", ())]
