# SPDX-License-Identifier: Apache-2.0
"""Who does what: the longest job first, each to the shard that has least so far. Every shard comes to the same answer by itself."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from heapq import heapify, heapreplace

from haros_ci.records import dataclass
from haros_ci.regex import regex

#: As many jobs as a matrix may have.
MOST_SHARDS = 256
_SHARD = regex(r"([1-9][0-9]{0,3})/([1-9][0-9]{0,3})")


@dataclass(frozen=True, slots=True)
class ShardJob:
    """Work that is not divided further; *names* tell it from all others, *cost* is in CPU microseconds."""

    names: tuple[str, ...]
    cost: int


def divide(jobs: Sequence[ShardJob], shards: int) -> tuple[int, ...]:
    """For each job the number of its shard, from 1 on."""
    loads = [(0, number) for number in range(1, shards + 1)]
    heapify(loads)
    shard_of = [0] * len(jobs)
    for index in sorted(range(len(jobs)), key=lambda i: (-jobs[i].cost, jobs[i].names)):
        load, number = loads[0]
        shard_of[index] = number
        heapreplace(loads, (load + jobs[index].cost, number))
    return tuple(shard_of)


def plan_digest(jobs: Sequence[ShardJob], shard_of: Sequence[int], shards: int) -> str:
    """SHA-256 of the whole division: equal for shards that have divided the same work in the same way."""
    rows = sorted([number, *job.names] for job, number in zip(jobs, shard_of, strict=True))
    return hashlib.sha256(json.dumps([shards, rows]).encode()).hexdigest()


def parse_shard(text: str) -> tuple[int, int] | None:
    """``2/4`` as (2, 4), None if it is no shard."""
    match = _SHARD.fullmatch(text)
    if match is None:
        return None
    number, of = int(match[1]), int(match[2])
    return (number, of) if number <= of <= MOST_SHARDS else None
