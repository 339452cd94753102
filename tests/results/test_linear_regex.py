# SPDX-License-Identifier: Apache-2.0
"""Patterns in linear time find what Python's find, refuse what needs backtracking, and never take long."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from haros_ci.results.linear_regex import MAX_PATTERN, PatternError, compiled


def search(pattern: str, text: str) -> dict[str, str | None] | None:
    return compiled(pattern).search(text)


@pytest.mark.parametrize(
    ("pattern", "text"),
    [
        ("", ""),
        ("a", "xay"),
        ("^a$", "a"),
        ("a|b|", "c"),
        (r"(?P<x>a+?)(?P<y>a*)", "aaa"),
        (r"(?P<x>a|ab)(?P<y>c|bcd)", "abcd"),
        (r"(?P<x>.*)(?P<y>\d+)", "ab12"),
        (r"\bfoo\b.*?(?P<x>[^\s\]]+)\]", "x foo [bar]"),
        (r"(?P<path>[^:]+):(?P<line>\d{1,3}): (?P<m>.*?)(?: \[(?P<r>[\w-]+)\])?$", "a.c:12: what is [x] it [y-z]"),
        (r"(?:ab){2,3}(?P<x>b{0,2})", "abababb"),
        (r"(?i)MODULE '(?P<x>\w+)'", "no Module 'cv2'"),
        (r"[]a^-]+", "x]-^"),
        (r"[^]]+", "]x"),
        (r"a{2", "a{2"),
        (r"{", "{"),
        (r"\{\.\\\/", "{.\\/"),
        (r"[\]\\]", "\\"),
        (r"\Bb", "ab b"),
        (r".+é", "caféé"),
        ("(?P<x>a)|(?P<y>b)", "b"),
    ],
)
def test_finds_what_python_finds(pattern: str, text: str) -> None:
    theirs = re.search(pattern, text)
    assert search(pattern, text) == (None if theirs is None else theirs.groupdict())


@given(st.text(max_size=200))
def test_any_text_is_searched(text: str) -> None:
    assert search("^", text) == {} and search("(?P<x>[^\\x00-\\x{10FFFF}])", text) is None


@pytest.mark.parametrize(
    ("pattern", "why"),
    [
        ("(", "missing \\)"),
        (")", "unexpected \\)"),
        ("[a", "missing ]"),
        ("*a", "no argument for repetition"),
        ("a{3,2}", "invalid repetition size"),
        ("[z-a]", "invalid character class range"),
        ("\\", "trailing"),
        (r"(a)\1", "invalid escape sequence"),
        ("(?P<a>x)(?P=a)", "invalid"),
        ("a(?=b)", "invalid perl operator"),
        ("(?<=a)b", "invalid"),
        (r"\q", "invalid escape sequence"),
        ("a" * (MAX_PATTERN + 1), "more than 500 characters"),
        ("((a{50}){50}){50}", "invalid repetition size"),
        ("()" * 30, "more than 20 groups"),
    ],
)
def test_refused(pattern: str, why: str) -> None:
    with pytest.raises(PatternError, match=why):
        compiled(pattern)


@pytest.mark.parametrize(
    "pattern",
    ["(a*)*[b]", "(?:a|a)*[b]", "(?:a+)+[b]", "(.*)(.*)(.*)(.*)(.*)[=]", "(?:a?){30}[a]{30}[b]", "(x+x+)+y|a*[b]"],
)
def test_bombs_end(pattern: str) -> None:
    """With backtracking none of these would end in a lifetime."""
    assert compiled(pattern).search("a" * 20_000) is None
