# SPDX-License-Identifier: Apache-2.0
"""Lines of a file and their places in its later version."""

from __future__ import annotations

import random

import pytest

from haros_ci.results.assignment import assign
from haros_ci.results.line_map import line_mapper

OLD = "alpha one\nbeta two\n\ngamma three\ndelta four\n}\n"

CASES = [
    ("same", OLD, [1, 2, 3, 4, 5, 6]),
    ("inserted above", "new\nnew\n" + OLD, [3, 4, 5, 6, 7, 8]),
    ("deleted", OLD.replace("beta two\n", ""), [1, None, 2, 3, 4, 5]),
    ("indented", OLD.replace("beta", "    beta").replace("gamma", "\tgamma"), [1, 2, 3, 4, 5, 6]),
    ("CRLF and mark", "\ufeff" + OLD.replace("\n", "\r\n"), [1, 2, 3, 4, 5, 6]),
    ("edited", OLD.replace("two", "2"), [1, 2, 3, 4, 5, 6]),
    ("replaced", OLD.replace("beta two", "quite different"), [1, None, 3, 4, 5, 6]),
    ("edited below an insertion", OLD.replace("gamma three", "a\nb\nc\nd\ngamma 3"), [1, 2, 3, 8, 9, 10]),
    ("spread", OLD.replace("gamma three", "gamma\nthree"), [1, 2, 3, 4, 6, 7]),
    ("duplicated", OLD.replace("beta two", "beta two\nbeta two"), [1, 2, 4, 5, 6, 7]),
    ("emptied", "", [None, None, None, None, None, None]),
]  # fmt: skip


@pytest.mark.parametrize(("name", "new", "expected"), CASES, ids=[case[0] for case in CASES])
def test_lines_map(name: str, new: str, expected: list[int | None]) -> None:
    mapped = line_mapper(OLD, new)
    assert [mapped(line) for line in range(1, 7)] == expected
    assert (mapped(0), mapped(99)) == (None, None)


@pytest.mark.parametrize("seed", range(40))
def test_kept_lines_map_to_equal_lines_in_order(seed: int) -> None:
    chance = random.Random(seed)
    old = [chance.choice("abcdef{}") * chance.choice([1, 1, 9]) for _ in range(chance.randrange(80))]
    new = [line for line in old if chance.random() > 0.2]
    for _ in range(chance.randrange(8)):
        new.insert(chance.randrange(len(new) + 1), f"fresh {chance.random()}")
    mapped = line_mapper("\n".join(old), "\n".join(new))
    places = [(line, place) for line in range(1, len(old) + 1) if (place := mapped(line)) is not None]
    assert [place for _, place in places] == sorted({place for _, place in places})
    equal = sum(old[line - 1] == new[place - 1] for line, place in places)
    assert equal >= 0.6 * len([line for line in new if not line.startswith("fresh")])


def test_large_rewrites_end() -> None:
    old = "\n".join("{" if n % 2 else "}" for n in range(4000))
    mapped = line_mapper(old, "start\n" + old[::-1] + "\nend")
    assert mapped(1) is None or isinstance(mapped(1), int)


@pytest.mark.parametrize(
    ("here", "there", "limit", "expected"),
    [
        ([5], [5], None, {(5, 5)}),
        ([5, 9], [9], None, {(9, 9)}),
        ([5], [1, 6, 20], None, {(5, 6)}),
        ([1, 10, 20], [10, 21], None, {(10, 10), (20, 21)}),
        ([1, 2, 3], [1, 2, 3], None, {(1, 1), (2, 2), (3, 3)}),
        ([10, 20, 30, 40], [19, 41], None, {(20, 19), (40, 41)}),
        ([5], [9], 3, set()),
        ([5, 8], [8], 3, {(8, 8)}),
        ([5, 6, 30], [7, 33], 3, {(6, 7), (30, 33)}),
        ([], [1], None, set()),
        ([], [1], 3, set()),
    ],
)
def test_assign(here: list[int], there: list[int], limit: int | None, expected: set[tuple[int, int]]) -> None:
    pairs = assign([(line, n) for n, line in enumerate(here)], [(line, n) for n, line in enumerate(there)], limit)
    assert {(here[a], there[b]) for a, b in pairs} == expected


@pytest.mark.parametrize("seed", range(30))
def test_assign_is_the_cheapest(seed: int) -> None:
    from itertools import permutations

    chance = random.Random(seed)
    here = sorted(chance.sample(range(40), 3))
    there = sorted(chance.sample(range(40), 6))
    pairs = assign([(line, 0) for line in here], [(line, 0) for line in there])
    cost = sum(abs(here[a] - there[b]) for a, b in pairs)
    assert cost == min(sum(abs(a - b) for a, b in zip(here, some)) for some in permutations(there, 3))
    assert len(pairs) == 3
