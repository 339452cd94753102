# SPDX-License-Identifier: Apache-2.0
"""Known findings kept up to date with today's results."""

from __future__ import annotations

from collections.abc import Sequence

from haros_ci.results.counted import is_set_aside
from haros_ci.results.known import ComparedFiles, KnownFinding, known_from, known_from_results
from haros_ci.results.pairing import pair
from haros_ci.results.result import Result


def update(
    known: Sequence[KnownFinding], new: Sequence[Result], sides: ComparedFiles, *, accept_new: bool = False
) -> tuple[KnownFinding, ...]:
    """*known* with matched entries refreshed (their reasons kept) and absent or now suppressed ones dropped; metrics that are counted only stay known.

    New findings join only if *accept_new*. Entries of files that this run did not look at stay as they are.
    """
    pairs = pair(new, known, sides)
    news = {found.old: found.new for found in pairs}
    kept: list[KnownFinding] = []
    for index, entry in enumerate(known):
        if index in news:
            if not is_set_aside(new[news[index]]):
                kept.append(known_from(new[news[index]], entry.reason))
        elif not sides.answered(entry):
            kept.append(entry)
    if accept_new:
        taken = set(news.values())
        kept.extend(known_from_results(result for index, result in enumerate(new) if index not in taken))
    return tuple(sorted(kept, key=lambda entry: entry.sort_key))


def prune(known: Sequence[KnownFinding], new: Sequence[Result], sides: ComparedFiles) -> tuple[KnownFinding, ...]:
    """*known* without the absent entries; the others are not touched."""
    paired = {found.old for found in pair(new, known, sides)}
    return tuple(k for i, k in enumerate(known) if i in paired or not sides.answered(k))
