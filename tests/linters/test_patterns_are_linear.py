# SPDX-License-Identifier: Apache-2.0
"""Patterns of ours on long blanks: ``\\s*&?\\s*`` tries each way to divide them, which takes quadratic time on a hostile text."""

from __future__ import annotations

import re
from pathlib import Path

import haros_ci_checks

import haros_ci

DIVIDED = re.compile(r"\\s[*+](?:(?:\\[^s]|\[[^\]]*\]|[^\\()\[\]|*+?{}])\?\??)+\\s[*+]")


def test_the_search_sees_them() -> None:
    assert all(DIVIDED.search(text) for text in (r"a\s*&?\s*b", r"a\s*&?&?\s*b", r"\s+[&*]?\s*x", r"=\s*\(?\s*x"))
    assert not any(DIVIDED.search(text) for text in (r"a\s*(?:&\s*)?b", r"a\s*&\s*b", r"\s*(?://.*)?\s"))


def test_no_pattern_divides_blanks_in_two() -> None:
    roots = [Path(package.__path__[0]) for package in (haros_ci, haros_ci_checks)]
    found = [
        f"{path.name}:{number}"
        for root in roots
        for path in sorted(root.rglob("*.py"))
        for number, line in enumerate(path.read_text(encoding="utf-8").split("\n"), 1)
        if DIVIDED.search(line)
    ]
    assert found == [], "write `(?:&\\s*)?` in place of `&?\\s*`"
