# SPDX-License-Identifier: Apache-2.0
"""C++: the greatest, the least and the absolute value of numbers that are known, and of no others."""

from __future__ import annotations

import pytest
from follow_kit import cpp, ends, names

BEFORE = "using std::max;\nint f();\n"


def queue(number: str, before: str = "") -> int | None:
    (end,) = ends(cpp(f'int n = 7; int q; q = f(); ADV("a", {number});', BEFORE + before))
    return end.queue_size  # type: ignore[no-any-return]


@pytest.mark.parametrize(
    ("number", "expected"),
    [
        ("std::max(3, 2)", 3),
        ("std::min(3, n)", 3),
        ("std::max(n, 2)", 7),
        ("std::max<size_t>(n, 1)", 7),
        ("std::max<int>(3, 2.5)", 3),
        ("std::max({1, 5, 2})", 5),
        ("std::clamp(9, 1, 5)", 5),
        ("std::clamp(0, 1, 5)", 1),
        ("std::clamp(3, 1, 5)", 3),
        ("std::abs(-4)", 4),
        ("abs(n)", 7),
        ("max(4, 1)", 4),
        ("static_cast<int>(std::fabs(-2.5))", 2),
        ("std::min(std::max(n, 1), 5)", 5),
    ],
)
def test_of_numbers_that_are_known(number: str, expected: int) -> None:
    assert queue(number) == expected


@pytest.mark.parametrize(
    "number",
    [
        "std::max(q, 1)",
        "std::min(1, q)",
        "std::clamp(q, 1, 5)",
        "std::clamp(3, 5, 1)",
        "std::clamp(3, 1)",
        "std::abs(q)",
        "std::max(2, 2.5)",
        "std::max(1, 2, greater)",
        "std::max({1, q})",
        "std::other(3, 2)",
    ],
)
def test_of_others_nothing_is_known(number: str) -> None:
    assert queue(number) is None


def test_a_function_of_the_workspace_is_its_own() -> None:
    assert queue("own::max(3, 2)", "namespace own { int max(int a, int b) { return 11; } }\n") == 11


def test_a_loop_to_the_least_of_two() -> None:
    code = 'for (int i = 0; i < std::min(2, 5); i++) { ADV("a" + std::to_string(i), 1); }'
    assert names(cpp(code)) == ["/a0", "/a1"]
