# SPDX-License-Identifier: Apache-2.0
"""Who does what: balanced, the same for every shard, and independent of the order in which jobs come."""

from __future__ import annotations

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from haros_ci.shards.division import ShardJob, divide, parse_shard, plan_digest


def jobs(costs: list[int]) -> list[ShardJob]:
    return [ShardJob(("tool", f"{number:04d}"), cost) for number, cost in enumerate(costs)]


@given(st.lists(st.integers(0, 1000), max_size=60), st.integers(1, 9))
def test_every_job_has_a_shard_and_none_has_more_than_its_share_and_one_job(costs: list[int], shards: int) -> None:
    who = divide(jobs(costs), shards)
    assert len(who) == len(costs)
    assert set(who) <= set(range(1, shards + 1))
    loads = [sum(cost for cost, owner in zip(costs, who, strict=True) if owner == n) for n in range(1, shards + 1)]
    assert max(loads) <= sum(costs) / shards + max(costs, default=0)


def test_the_longest_come_first() -> None:
    assert divide(jobs([1, 1, 1, 3]), 2) == (2, 2, 2, 1)


@given(st.lists(st.integers(0, 50), min_size=1, max_size=30), st.integers(1, 5), st.integers(0, 99))
def test_the_order_of_jobs_does_not_count(costs: list[int], shards: int, seed: int) -> None:
    given_ones = jobs(costs)
    shuffled = random.Random(seed).sample(given_ones, len(given_ones))
    one = dict(zip(given_ones, divide(given_ones, shards), strict=True))
    other = dict(zip(shuffled, divide(shuffled, shards), strict=True))
    assert one == other
    digests = {plan_digest(some, divide(some, shards), shards) for some in (given_ones, shuffled)}
    assert len(digests) == 1


def test_another_division_has_another_digest() -> None:
    some = jobs([5, 4, 3])
    digest = plan_digest(some, (1, 2, 2), 2)
    assert digest != plan_digest(some, (1, 2, 1), 2)
    assert digest != plan_digest(some, (1, 2, 2), 3)
    assert digest != plan_digest([*some[:2], ShardJob(("tool", "x"), 3)], (1, 2, 2), 2)


@pytest.mark.parametrize(("text", "parsed"), [("1/1", (1, 1)), ("2/4", (2, 4)), ("256/256", (256, 256))])
def test_a_shard_is_read(text: str, parsed: tuple[int, int]) -> None:
    assert parse_shard(text) == parsed


@pytest.mark.parametrize(
    "text",
    [
        "",
        "1",
        "0/4",
        "5/4",
        "1/0",
        "1/257",
        "-1/4",
        "1/4/5",
        " 1/4",
        "1/4\n",
        "01/4",
        "1/+4",
        "¹/4",
        "one/four",
        "9" * 5000,
    ],
)
def test_anything_else_is_none(text: str) -> None:
    assert parse_shard(text) is None
