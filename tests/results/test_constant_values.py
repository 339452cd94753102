# SPDX-License-Identifier: Apache-2.0
"""What expressions of constants come to, and which are left alone."""

from __future__ import annotations

import ast

import pytest

from haros_ci.results.constant_values import UNKNOWN, value_of

GIVEN = {"SIZE": 3, "NAME": "left", "LOST": UNKNOWN}

KNOWN = (
    ("1 - 1", 0),
    ("SIZE * 2", 6),
    ("SIZE & 1", 1),
    ("-SIZE", -3),
    ("NAME + '_arm'", "left_arm"),
    ("len('')", 0),
    ("len([1, 2])", 2),
    ("max(1, SIZE)", 3),
    ("bool(dict())", False),
    ("any([])", False),
    ("'a' in ()", False),
    ("1 < 3 < 2", False),
    ("1 > 2 > lost", False),
    ("None is None", True),
    ("1 is None", False),
    ("[1] == [1]", True),
    ("(1,) == [1]", False),
    ("b''", b""),
    ("(found := 0)", 0),
    ("False and lost", False),
    ("1 if 0 else 2", 2),
    ("'abc'[0]", "a"),
    ("NAME.upper()", "LEFT"),
    ("{}.get('a')", None),
    ("{'a': 1}.get('a')", 1),
    ("isinstance(1, str)", False),
    ("isinstance(1, (str, int))", True),
)
LEFT_ALONE = (
    "lost",
    "LOST",
    "LOST + 1",
    "lost and False",
    "1 is 1",
    "() is ()",
    "1 / 0",
    "'a' + 1",
    "int('x')",
    "[][0]",
    "len == 1",
    "bool(len)",
    "NAME.format(1)",
    "NAME.join([])",
    "NAME.__class__",
    "{}.clear()",
    "isinstance(1)",
    "isinstance(*SIZE)",
    "isinstance(1, Real)",
    "isinstance(lost, str)",
    "print()",
    "open('a')",
    "len(obj='a')",
    "lambda: 1",
    "[one for one in (1, 2)]",
    "2 ** 3",
    "1 << 3",
    "...",
)
TOO_LARGE = (
    "'a' * 10 ** 9",
    "'a' * 1000000000",
    "b'a' * 1000000000",
    "[0] * 1000000000",
    "bytes(1000000000)",
    "'%0999999999d' % 1",
    "99999999 * 99999999",
    f"{'-' * 60}1",
    f"{'[' * 50}{']' * 50}",
    f"({'1,' * 900})",
)


@pytest.mark.parametrize(("text", "value"), KNOWN)
def test_constants_come_to(text: str, value: object) -> None:
    found = value_of(ast.parse(text, mode="eval").body, GIVEN)
    assert found == value and type(found) is type(value)


@pytest.mark.parametrize("text", [*LEFT_ALONE, *TOO_LARGE])
def test_what_is_not_known(text: str) -> None:
    assert value_of(ast.parse(text, mode="eval").body, GIVEN) is UNKNOWN
