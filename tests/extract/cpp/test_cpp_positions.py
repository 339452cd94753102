# SPDX-License-Identifier: Apache-2.0
"""Positions are those of the original text, in code points."""

from __future__ import annotations

import pytest
from syntax_kit import read_cpp


def calls(text: str) -> list[tuple[str, int, int]]:
    """Name and position of the calls that are statements of the first function."""
    body = read_cpp(text).functions[0].body or ()
    return [(each[1][1][1], each[1][4], each[1][5]) for each in body if each[0] == "do"]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("void f() { g(); }", [("g", 1, 12)]),
        ("\ufeffvoid f() { g(); }", [("g", 1, 12)]),
        ("void f() {\n\tg();\n\t\th();\n}", [("g", 2, 2), ("h", 3, 3)]),
        ("void f() {\r\n  g();\r\n  h();\r\n}\r\n", [("g", 2, 3), ("h", 3, 3)]),
        ('void f() { x("äö€😀"); g(); }', [("x", 1, 12), ("g", 1, 23)]),
        ("void f() { /* äö\n😀 */ g(); }", [("g", 2, 6)]),
        ("// ä\nvoid f() { // 😀\n  g(); }", [("g", 3, 3)]),
        ("void f() {\n  é(); g(); }", [("é", 2, 3), ("g", 2, 8)]),
        ("void f() { g(); \\\n h(); }", [("g", 1, 12), ("h", 2, 2)]),
        ("class X_EXPORT A {}; void f() { g(); }", [("g", 1, 33)]),
        ("void f() { [[a]] g(); }", [("g", 1, 18)]),
        ('void f() { g(R"(\n\n)"); h(); }', [("g", 1, 12), ("h", 3, 6)]),
        ("void f() { g(1'000); h('\"'); i(); }", [("g", 1, 12), ("h", 1, 22), ("i", 1, 30)]),
        ("void f() {\f g();\v h(); }", [("g", 1, 13), ("h", 1, 19)]),
    ],
)
def test_positions(text: str, expected: list[tuple[str, int, int]]) -> None:
    assert calls(text) == expected


def test_positions_in_what_is_parsed_again() -> None:
    (variable,) = read_cpp('void f() {\n  A ä(b(c), d("ö") + e());\n}').functions[0].body or ()
    given = variable[3][1]
    assert variable[4:] == (2, 5)
    assert (given[0][4:], given[1][2][1][4:]) == ((2, 7), (2, 22))
    (variable,) = read_cpp("void f() {\n  A v(b(c),\n    d());\n}").functions[0].body or ()
    assert [each[4:] for each in variable[3][1]] == [(2, 7), (3, 5)]


def test_strings_keep_their_characters() -> None:
    text = 'void f() { g("// äö /* 😀", " emit x ", "class A_EXPORT B {", "[[x]]"); }'
    (statement,) = read_cpp(text).functions[0].body or ()
    assert [each[1] for each in statement[1][2]] == ["// äö /* 😀", " emit x ", "class A_EXPORT B {", "[[x]]"]
