# SPDX-License-Identifier: Apache-2.0
"""Edits are applied to a text all at once, in whatever order they are given."""

from __future__ import annotations

import pytest

from haros_ci.results.fix import Edit, applied


def edit(start: tuple[int, int], end: tuple[int, int], text: str) -> Edit:
    return Edit("x", start, end, text)


@pytest.mark.parametrize(
    ("edits", "after"),
    [
        ((), "one\ntwo\n"),
        ((edit((1, 1), (1, 4), "eins"),), "eins\ntwo\n"),
        ((edit((2, 1), (2, 1), "x\n"),), "one\nx\ntwo\n"),
        ((edit((2, 1), (3, 1), ""),), "one\n"),
        ((edit((3, 1), (3, 1), "three\n"),), "one\ntwo\nthree\n"),
        ((edit((2, 4), (2, 4), "!"), edit((1, 4), (1, 4), "?")), "one?\ntwo!\n"),
        ((edit((1, 4), (2, 1), " "),), "one two\n"),
    ],
)
def test_edits(edits: tuple[Edit, ...], after: str) -> None:
    assert applied("one\ntwo\n", edits) == after


@pytest.mark.parametrize(
    "edits",
    [
        (edit((1, 1), (1, 3), "a"), edit((1, 2), (1, 4), "b")),
        (edit((9, 1), (9, 1), "a"),),
        (edit((1, 0), (1, 1), "a"),),
        (edit((2, 1), (1, 1), "a"),),
        (edit((2, 99), (2, 99), "a"),),
    ],
)
def test_what_does_not_fit_is_refused(edits: tuple[Edit, ...]) -> None:
    with pytest.raises(ValueError, match="overlap|not in the text"):
        applied("one\ntwo\n", edits)
