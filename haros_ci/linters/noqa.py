# SPDX-License-Identifier: Apache-2.0
"""Comments ``# noqa: CODE`` (flake8, ruff) on lines of which pylint says the same by another name."""

from __future__ import annotations

import re
from functools import cache, lru_cache

from haros_ci.linters import columns
from haros_ci.linters.catalogue.same_defect import SAME_DEFECT
from haros_ci.regex import regex
from haros_ci.results.comments import comments

_NOQA = regex(r"#\s{0,9}noqa\s{0,9}:\s{0,9}((?:[A-Z]+[0-9]+[,\s]{0,9})+)", re.IGNORECASE)
_OF_CODES = ("ruff:", "flake8:")


def is_silenced(rule: str, text: str, line: int) -> bool:
    """Whether the author of *text* has silenced on *line* what pylint says by *rule*, under a code of flake8 or ruff for the same defect.

    A comment without codes does not count: it is seldom meant for all tools. Words in quotes are none: nobody would see that they silence something.
    """
    if _NOQA.search(columns.line_of(text, line)) is None:
        return False
    found = _NOQA.search(_comments(text).get(line, ""))
    return found is not None and not _codes(rule).isdisjoint(re.findall(r"[A-Z]+[0-9]+", found[1].upper()))


@lru_cache(maxsize=1)
def _comments(text: str) -> dict[int, str]:
    """The comments of *text* by their lines."""
    return {comment.line: comment.text for comment in comments(text, "python")}


@cache
def _codes(rule: str) -> frozenset[str]:
    """The codes of flake8 and ruff that stand for the defect of pylint's *rule*."""
    groups = (group for group in SAME_DEFECT if f"pylint:{rule}" in group)
    return frozenset(name.partition(":")[2] for group in groups for name in group if name.startswith(_OF_CODES))
