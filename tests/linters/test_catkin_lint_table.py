# SPDX-License-Identifier: Apache-2.0
"""docs/catkin-lint.md says of each message of catkin_lint what becomes of it."""

from __future__ import annotations

import re
from pathlib import Path

from haros_ci.linters.catalogue.catkin_lint import GROUPS

TEXT = (Path(__file__).resolve().parents[2] / "docs" / "catkin-lint.md").read_text(encoding="utf-8")
TABLE = TEXT.partition("|---|---|---|\n")[2].partition("\n\n")[0]
ROWS = [tuple(cell.strip() for cell in line.strip("|").split("|")) for line in TABLE.splitlines()]


def test_each_message_has_one_row() -> None:
    names = [name for name, _, _ in ROWS]
    assert len(names) == len(set(names)) == 96
    assert {row[0] for group in GROUPS for row in group.rows} <= set(names)


def test_what_is_covered_says_how_and_the_rest_says_why() -> None:
    for name, checks, why in ROWS:
        if checks.startswith("`"):
            assert why.startswith(("covered", "better", "partly")), name
        else:
            assert checks == "–" and why.startswith(("no:", "the ")), name


def test_the_counts_are_those_of_the_table() -> None:
    sentence = r"(\d+) are covered: (\d+) alike, (\d+) better, (\d+) partly"
    told = [int(number) for number in re.findall(sentence, TEXT)[0]]
    found = [re.match(r"\w+", why)[0] for _, checks, why in ROWS if checks.startswith("`")]  # type: ignore[index]
    assert told == [len(found), *(found.count(word) for word in ("covered", "better", "partly"))]
