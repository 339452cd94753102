# SPDX-License-Identifier: Apache-2.0
"""Statistics count what is open, per rule and per tool."""

from __future__ import annotations

import pytest
from report_samples import COMPARED, EMPTY, HOSTILE, PLAIN, hostile

from haros_ci.report import statistics


def test_table() -> None:
    assert statistics.render(PLAIN) == (
        "   count  per 1000 lines\n"
        "       1            0.67  error   cppcheck:nullPointer\n"
        "       1            0.67  error   pylint:undefined-variable\n"
        "       1            0.67  note    cppcheck:variableScope\n"
        "       1            0.67  note    pylint:missing-module-docstring\n"
        "\n"
        "       2            1.33  cppcheck\n"
        "       2            1.33  pylint\n"
        "       4            2.67  in all\n"
    )


def test_known_findings_do_not_count() -> None:
    assert "variableScope" not in statistics.render(COMPARED)


def test_without_lines_there_is_no_density() -> None:
    assert statistics.render(EMPTY) == "   count  per 1000 lines\n       0                  in all\n"


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_texts(text: str) -> None:
    assert statistics.render(hostile(text)).replace("\n", "").isprintable()
