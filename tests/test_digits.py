# SPDX-License-Identifier: Apache-2.0
"""Texts that are numbers to Python's str methods and no numbers to int, wherever a reader asks."""

from __future__ import annotations

import pytest

from haros_ci.model.digits import whole_number
from haros_ci.workspace.cmake_regex import replace

#: isdigit() or isdecimal() holds for each; int() refuses all but the third, which CMake, YAML and Python's format do not read.
NO_NUMBERS = ("²", "①", "٣", "9" * 5000, "", "-1", "+1", " 1", "1_0", "1.0")


@pytest.mark.parametrize("text", NO_NUMBERS)
def test_no_number(text: str) -> None:
    assert whole_number(text) is None


@pytest.mark.parametrize(("text", "expected"), [("0", 0), ("007", 7), ("999999999", 999_999_999)])
def test_a_number(text: str, expected: int) -> None:
    assert whole_number(text) == expected


def test_digits_that_are_allowed() -> None:
    assert whole_number("1234567890") is None
    assert whole_number("1234567890", digits=10) == 1_234_567_890


@pytest.mark.parametrize("reference", ["²", "①", "٣"])
def test_a_reference_that_is_no_group(reference: str) -> None:
    """CMake's references have one ASCII digit; another sign stands for itself."""
    assert replace("(a)", f"[\\{reference}]", "a") == f"[{reference}]"
