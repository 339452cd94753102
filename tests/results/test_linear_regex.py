# SPDX-License-Identifier: Apache-2.0
"""Patterns in linear time find what Python's find, refuse what needs backtracking, and never take long."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from haros_ci.results.linear_regex import (
    MAX_PATTERN,
    MAX_STEPS,
    Budget,
    PatternError,
    TooMuchWork,
    compiled,
)


def search(pattern: str, text: str) -> dict[str, str | None] | None:
    return compiled(pattern).search(text, Budget())


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


PIECES = st.sampled_from(
    ["a", "b", ".", r"\d", "[ab]", "[^a]", "(?P<x>a|b.)", "(?:", "(", ")", "*", "+", "?", "|", "^", "$", r"\b"]
)


@given(st.lists(PIECES, max_size=9).map("".join), st.text("ab1 ", max_size=8))
def test_agrees_with_python_whether_there_is_a_match(pattern: str, text: str) -> None:
    try:
        theirs = re.search(pattern, text) is not None
    except re.error:
        return
    try:
        ours = search(pattern, text) is not None
    except PatternError as err:
        assert "repetition" in str(err)
        return
    assert ours == theirs


@pytest.mark.parametrize(
    ("pattern", "why"),
    [
        ("(", "a missing '\\)' at character 2"),
        (")", "an unmatched '\\)' at character 1"),
        ("[a", "a missing '\\]'"),
        ("*a", "nothing to repeat at character 1"),
        ("^*", "nothing to repeat"),
        ("a**", "a repetition of a repetition at character 3"),
        ("a{3,2}", "least is above its most"),
        ("[z-a]", "malformed"),
        ("\\", "a lone backslash"),
        (r"(a)\1", "a back reference, which cannot be matched in linear time, at character 4"),
        ("(?P<a>x)(?P=a)", "a back reference"),
        ("a(?=b)", "look-ahead"),
        ("(?!a)", "look-ahead"),
        ("(?<=a)b", "look-behind"),
        ("(?>a)", "an atomic group"),
        ("(?x)a", "an unknown kind of group"),
        ("(?P<a>x)(?P<a>y)", "a second group 'a'"),
        (r"\q", "an unknown escape"),
        ("a" * (MAX_PATTERN + 1), "more than 500 characters"),
        ("a{1001}", "more than 1000 steps"),
        ("((a{50}){50}){50}", "more than 1000 steps"),
        ("(" * 60 + ")" * 60, "groups"),
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
def test_bombs_take_steps_in_proportion(pattern: str) -> None:
    short, long = Budget(), Budget()
    compiled(pattern).search("a" * 200, short)
    compiled(pattern).search("a" * 2000, long)
    assert 0 < MAX_STEPS - long.left <= 12 * (MAX_STEPS - short.left) < 12_000_000


def test_a_budget_ends() -> None:
    budget = Budget(1_000)
    with pytest.raises(TooMuchWork, match="write the pattern simpler"):
        for _ in range(100):
            compiled("(?:a?){90}$").search("a" * 100, budget)


def test_text_without_the_literal_costs_nothing() -> None:
    budget = Budget()
    assert compiled(r".*(\w+) must have .*").search("x" * 5000, budget) is None
    assert budget.left == MAX_STEPS
