# SPDX-License-Identifier: Apache-2.0
"""All units of a run in portions that machines can take, with what each is expected to cost.

A portion is of one tool and one group, whose units share a process: so it is worth its start, and small against a machine's share.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import groupby

from haros_ci.linters import schedule
from haros_ci.linters.linter import Unit
from haros_ci.linters.work import Work
from haros_ci.records import dataclass

#: A portion is no more than this part of what each machine gets, so that the last ones can even the shares out.
PORTIONS_EACH = 8
#: The least that is reckoned for a unit, in microseconds.
LEAST = 500

#: What is remembered: CPU microseconds by tool and path.
Costs = Mapping[str, Mapping[str, int]]


@dataclass(frozen=True, slots=True)
class Portion:
    """Units of one tool by their cache keys; *cost* is in microseconds."""

    tool: str
    keys: tuple[str, ...]
    cost: int


def unique(sides: Iterable[Iterable[Work]]) -> Iterator[tuple[Work, Unit]]:
    """Each unit once, where it stands first: the base revision shares with the head what has not changed."""
    seen: set[tuple[str, str]] = set()
    for works in sides:
        for work in works:
            for unit in work.units:
                entry = (work.linter.NAME, work.keys[unit.file.path])
                if entry not in seen:
                    seen.add(entry)
                    yield work, unit


def portions(sides: Iterable[Iterable[Work]], costs: Costs, machines: int, besides: int = 0) -> list[Portion]:
    """The units of all *sides* for so many *machines*, which have to do something that costs *besides*, too."""
    by_tool: dict[str, list[tuple[Work, Unit]]] = {}
    for work, unit in unique(sides):
        by_tool.setdefault(work.linter.NAME, []).append((work, unit))
    priced = {tool: _priced(entries, costs.get(tool, {})) for tool, entries in sorted(by_tool.items())}
    total = besides + sum(cost for entries in priced.values() for _, _, cost in entries)
    largest = max(1, total // (machines * PORTIONS_EACH))
    return [portion for tool, entries in priced.items() for portion in _cut(tool, entries, largest)]


Priced = tuple[Work, Unit, int]


def _priced(entries: list[tuple[Work, Unit]], known: Mapping[str, int]) -> list[Priced]:
    """What was remembered, else an estimate that is as far off as estimates of the remembered ones would be."""
    guesses = [max(LEAST, int(unit.file.size * work.linter.COST)) for work, unit in entries]
    of_known = [(known[u.file.path], g) for (_, u), g in zip(entries, guesses, strict=True) if u.file.path in known]
    real, guessed = (sum(pair[i] for pair in of_known) for i in (0, 1))
    return [
        (work, unit, known.get(unit.file.path, guess * real // guessed if guessed else guess))
        for (work, unit), guess in zip(entries, guesses, strict=True)
    ]


def _cut(tool: str, entries: list[Priced], largest: int) -> Iterator[Portion]:
    """Neighbours of one group together, each portion at most *largest* or a single unit."""
    seconds = schedule.seconds_of(entries[0][0].linter, sum(cost for _, _, cost in entries) / 1e6)
    limit = min(largest, max(1, int(seconds * 1e6)))
    ordered = sorted(entries, key=lambda e: (e[1].group, e[1].file.path, e[0].keys[e[1].file.path]))
    for _, group in groupby(ordered, key=lambda entry: entry[1].group):
        members = list(group)
        keys: list[str] = []
        filled = 0
        for work, unit, cost in members:
            if keys and filled + cost > limit:
                yield Portion(tool, tuple(keys), filled)
                keys, filled = [], 0
            keys.append(work.keys[unit.file.path])
            filled += cost
        yield Portion(tool, tuple(keys), filled)
