# SPDX-License-Identifier: Apache-2.0
"""GitHub's line hash, against a slow reading of its description."""

from __future__ import annotations

import random

import pytest

from haros_ci.results.line_hash import github_line_hashes


def slow(text: str) -> dict[int, str]:
    """Character by character, as the description goes."""
    units = list(memoryview(text.encode("utf-16-le", "surrogatepass")).cast("H"))
    kept: list[int] = []
    starts: list[int] = []
    fresh, after_return = True, False
    for unit in (*units, 65535):
        if unit in (32, 9) or (after_return and unit == 10):
            after_return = False
            continue
        after_return = unit == 13
        if fresh:
            starts.append(len(kept))
        kept.append(10 if unit == 13 else unit)
        fresh = kept[-1] == 10
    kept += [0] * 100
    counts: dict[int, int] = {}
    found = {}
    for line, start in enumerate(starts, 1):
        value = sum(unit * 37 ** (99 - i) for i, unit in enumerate(kept[start : start + 100])) % 2**64
        counts[value] = counts.get(value, 0) + 1
        found[line] = f"{value:x}:{counts[value]}"
    return found


def test_the_empty_file() -> None:
    assert github_line_hashes("", {1}) == {1: "c129715d7a2bc9a3:1"}


@pytest.mark.parametrize("seed", range(60))
def test_like_the_description(seed: int) -> None:
    chance = random.Random(seed)
    alphabet = chance.choice(["ab \n", "a\r\n\t ", "xyz{}();\n", "é€😀\U0010ffff\ud800\n a", "\n"])
    text = "".join(chance.choice(alphabet) for _ in range(chance.choice([0, 1, 5, 99, 100, 101, 700])))
    expected = slow(text)
    assert github_line_hashes(text, range(1, len(expected) + 9)) == expected
    some = set(chance.sample(sorted(expected), k=min(3, len(expected))))
    assert github_line_hashes(text, some) == {line: expected[line] for line in some}


def test_only_lines_that_are_there() -> None:
    assert github_line_hashes("a\nb", {7}) == {}
    assert github_line_hashes("a\nb", ()) == {}


def test_moves_with_the_code_and_counts_copies() -> None:
    block = "".join(f"  some_function({n});\n" for n in range(12))
    first = github_line_hashes(block, {1})[1]
    assert github_line_hashes("\n// above\n" + block.replace("  ", "\t\t"), {3})[3] == first
    assert github_line_hashes(block + block, {13})[13].partition(":")[2] in ("1", "2")
    assert github_line_hashes("x\n" * 300, {1, 2, 200}) == {
        line: f"{github_line_hashes('x' + chr(10) + ('x' + chr(10)) * 99, {1})[1][:-2]}:{line}" for line in (1, 2, 200)
    }
