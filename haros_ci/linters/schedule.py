# SPDX-License-Identifier: Apache-2.0
"""Which units share a process: the same for any number of jobs, so that the output is, too."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import groupby

from haros_ci.linters.linter import Linter, Unit

#: Estimated seconds of one process: long against a tool's start, short against a run, so that no core idles at its end.
BATCH_SECONDS = 4.0
#: Files in one process at most: keeps command lines far below the kernel's limit.
BATCH_FILES = 400


#: So many processes at least, where they get longer than they have to be: cores beyond that would idle.
LEAST_PROCESSES = 4


def seconds_of(linter: Linter, total: float) -> float:
    """The length of one process of *linter* in seconds, where all of its work is estimated at *total* seconds.

    An adapter's ``BATCH_SECONDS`` is that length, or the least and the most: longer processes read fewer modules twice.
    """
    of_adapter = getattr(linter, "BATCH_SECONDS", BATCH_SECONDS)
    least, most = of_adapter if isinstance(of_adapter, tuple) else (of_adapter, of_adapter)
    return float(min(most, max(least, total / LEAST_PROCESSES)))


def batches(units: Iterable[Unit], cost: float, seconds: float = BATCH_SECONDS) -> list[tuple[Unit, ...]]:
    """*units* in batches of one group, neighbours together and about equally long; *cost* is in seconds per MB."""
    ordered = sorted(units, key=lambda u: (u.group, u.file.path))
    groups = (tuple(group) for _, group in groupby(ordered, key=lambda u: u.group))
    return [part for group in groups for part in _parts(group, cost, seconds)]


def estimate(units: Iterable[Unit], cost: float) -> float:
    """Seconds that the analysis of *units* will take, roughly."""
    return sum(unit.file.size for unit in units) * cost / 1e6


def _parts(units: tuple[Unit, ...], cost: float, seconds: float) -> Iterable[tuple[Unit, ...]]:
    total = sum(unit.file.size for unit in units)
    share = total / max(1, round(total * cost / 1e6 / seconds))
    part: list[Unit] = []
    filled = 0
    for unit in units:
        part.append(unit)
        filled += unit.file.size
        if filled >= share > 0 or len(part) == BATCH_FILES:
            yield tuple(part)
            part, filled = [], 0
    if part:
        yield tuple(part)
