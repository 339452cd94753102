# SPDX-License-Identifier: Apache-2.0
"""The findings of a report as the page has them, with the rules that they are of."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

from haros_ci.html_page.frames import Frames
from haros_ci.html_page.pool import NONE, Pool
from haros_ci.report.escape import multiline
from haros_ci.report.message import label, number, plain
from haros_ci.results.counted import is_counted
from haros_ci.results.result import BaselineState, Related, Report, Result, is_open
from haros_ci.results.stable_id import stable_ids

#: What a finding is: an open one is shown first, and the others are a filter away.
OPEN, KNOWN, ABSENT, SUPPRESSED, COUNTED = "open", "known", "gone", "suppressed", "counted"
#: The most findings, worst first, and the most places of one.
MOST, MOST_PLACES = 20_000, 30
#: Characters of a rule's page.
LONGEST_HELP = 20_000


def standing(result: Result) -> str:
    """One of ``OPEN``, ``KNOWN``, ``ABSENT``, ``SUPPRESSED``, ``COUNTED``: a metric that is only counted."""
    if result.state is BaselineState.ABSENT:
        return ABSENT
    if is_counted(result):
        return COUNTED
    if result.suppressions:
        return SUPPRESSED
    return OPEN if is_open(result) else KNOWN


def chosen(report: Report, most: int = MOST) -> tuple[list[tuple[str, Result]], int]:
    """The findings with their ids, in order of place, and how many are left out: those that are not open first, then notes."""
    every = list(stable_ids(report.results))
    if len(every) <= most:
        return every, 0
    ranked = sorted(range(len(every)), key=lambda n: (not is_open(every[n][1]), every[n][1].level.rank, n))
    kept = sorted(ranked[:most])
    return [every[n] for n in kept], len(every) - most


def findings(
    pool: Pool, found: Sequence[tuple[str, Result]], package: Callable[[str], str | None], frames: Frames
) -> list[tuple[Any, ...]]:
    """A row for each of *found*; the lines around each are kept in *frames*, those of open ones first."""
    for _, result in sorted(found, key=lambda pair: standing(pair[1]) != OPEN):
        frames.keep([result.location])
        near = [*result.related[:MOST_PLACES], *result.flow[:MOST_PLACES]]
        frames.keep((related.location for related in near), around=1)
    return [_row(pool, id, result, package) for id, result in found]


def _row(pool: Pool, id: str, result: Result, package: Callable[[str], str | None]) -> tuple[Any, ...]:
    place = result.location
    return (
        id,
        pool.row("rule names", (pool.text(result.tool), pool.text(result.rule))),
        result.level.rank,
        standing(result),
        pool.text(plain(result)),
        pool.place(place),
        place.end_line or 0,
        place.end_column or 0,
        pool.text(package(place.path) or ""),
        pool.text(result.scope or (result.identity.scope if result.identity else "")),
        pool.text(result.reason),
        number(result.value),
        number(result.limit),
        pool.texts(result.subject),
        pool.texts(result.also),
        _near(pool, result.related),
        _near(pool, result.flow),
        pool.text(result.graph or None),
        tuple((pool.text(a), pool.text(b)) for a, b in result.edges[:200]),
        tuple(pool.text(suppression.justification or suppression.kind) for suppression in result.suppressions),
        pool.texts(tuple(fix.description for fix in result.fixes)),
        _near(pool, [Related(copy.location, "") for copy in result.copies]),
    )


def _near(pool: Pool, places: Iterable[Related]) -> tuple[tuple[int, int], ...]:
    shown = tuple(places)[:MOST_PLACES]
    return tuple(
        (pool.place(related.location), pool.text(label(related)) if related.message else NONE) for related in shown
    )


def rules(pool: Pool, report: Report, found: Iterable[tuple[str, Result]]) -> list[dict[str, Any]]:
    """The rules of *found*, by tool and id: summary, page, tags, profiles, other names."""
    named = {(result.tool, result.rule) for _, result in found}
    known = {(run.tool.name, rule.id): rule for run in report.runs for rule in run.rules}
    return [
        {
            "tool": pool.text(tool),
            "id": pool.text(id),
            "summary": pool.text(rule.summary),
            "help": multiline(rule.help[:LONGEST_HELP]),
            "tags": pool.texts(rule.tags),
            "aliases": pool.texts(rule.aliases),
            "address": pool.text(rule.help_uri),
        }
        for (tool, id), rule in sorted(known.items())
        if (tool, id) in named
    ]
