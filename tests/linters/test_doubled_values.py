# SPDX-License-Identifier: Apache-2.0
"""Python whose texts or lists double line by line is not given to pylint; other long files are."""

from __future__ import annotations

import pytest

from haros_ci.linters.doubled_values import doubles

MANY = range(1, 25)


@pytest.mark.parametrize(
    "line", ["A{} = [*A{}, *A{}]", "A{} = A{} + A{}", "A{} = (*A{}, *A{})", "A{} = f'{{A{}}}{{A{}}}'"]
)
def test_values_that_double(line: str) -> None:
    assert doubles("A0 = 'ab'\n" + "".join(line.format(n, n - 1, n - 1) + "\n" for n in MANY))


def test_a_value_that_is_added_to_itself() -> None:
    assert doubles("a = 'ab'\n" + "a += a\n" * 25)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "a = 'ab'\n" + "a += a\n" * 8,
        "a = 'ab'\n" + "a = a + 'line'\n" * 500,
        "a = []\n" + "a += [1, 2]\n" * 500,
        "A = [0] * 10_000_000\n",
        "".join(f"A{n} = x * x + y * y\n" for n in range(300)),
        "".join(f"a = f(a, a, {n})\n" for n in range(300)),
        "".join(f"A{n} = [B, B, B]\n" for n in range(300)),
        "a = 1\n" + "a = a if a else a\n" * 300,
        "a = 'ab'\n" + "a += a\n" * 25 + "def (\n",
    ],
)
def test_other_values(text: str) -> None:
    assert not doubles(text)
