# SPDX-License-Identifier: Apache-2.0
"""The test over a table: it fires where a row fails, names all that do, and stays quiet otherwise."""

from __future__ import annotations

import inspect

import pytest
from every import SHOWN, every


def is_small(number: int) -> None:
    assert number < 3


def test_rows_that_fail_are_all_named() -> None:
    with pytest.raises(AssertionError) as caught:
        every("number", (1, 5, 2, 7), ids="row {}".format)(is_small)()
    first, *rows = [line for line in str(caught.value).splitlines() if line.startswith(("2 of", "row"))]
    assert (first, [row.partition(":")[0] for row in rows]) == ("2 of 4 fail", ["row 5", "row 7"])
    assert isinstance(caught.value.__cause__, AssertionError)


def test_an_error_is_a_failure() -> None:
    with pytest.raises(AssertionError, match="1 of 2 fail\nx: TypeError"):
        every("number", (1, "x"))(is_small)()


def test_a_long_list_is_cut() -> None:
    with pytest.raises(AssertionError, match="500 of 500 fail") as caught:
        every("number", range(3, 503))(is_small)()
    assert str(caught.value).count(": AssertionError") == SHOWN


def test_no_row_is_a_failure() -> None:
    with pytest.raises(AssertionError, match="nothing to look at"):
        every("number", ())(is_small)()


@every(("number", "word"), ((1, "a"), (2, "b")))
def test_several_names_and_a_fixture(number: int, word: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert "ab"[number - 1] == word and capsys.readouterr().out == ""


def test_pytest_sees_the_fixtures_alone() -> None:
    assert list(inspect.signature(test_several_names_and_a_fixture).parameters) == ["capsys"]


def test_rows_that_hold_are_quiet() -> None:
    every("number", (0, 1, 2))(is_small)()
    every("number", (number for number in (1, 2)))(is_small)()
