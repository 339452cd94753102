# SPDX-License-Identifier: Apache-2.0
"""The coverage of call sites as a table, and what is missing in the model site by site."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from haros_ci.model.coverage import AREAS, OPEN, PRODUCTION, Coverage
from haros_ci.model.coverage import Counts as Counted
from haros_ci.report.escape import log_line

HEAD = ("package", "sites", "endpoints", "no API", "unreached", "missing", "accounted")
#: What an area is called behind the name of a package.
_AREAS = {"production": "", "test": " (tests)", "example": " (examples)"}
#: Sites that are listed.
LISTED = 200


def render(found: Coverage) -> str:
    """The whole text."""
    return "".join(f"{log_line(line)}\n" for line in _lines(found))


def percent(part: float | None) -> str:
    """A share with one decimal, rounded down: 100 % is said of all alone."""
    return "-" if part is None else f"{int(part * 1000) / 10:.1f}%"


def _lines(found: Coverage) -> Iterator[str]:
    rows: list[tuple[str, ...]] = [HEAD]
    for area in AREAS:
        for package in found.packages():
            counts = found.counts(area, package)
            if counts.sites:
                rows.append(_row((package or "(no package)") + _AREAS[area], counts))
    for area in AREAS:
        counts = found.counts(area)
        if counts.sites or area == PRODUCTION:
            rows.append(_row(f"all{_AREAS[area]}", counts))
    widths = [max(len(row[column]) for row in rows) for column in range(len(HEAD))]
    for row in rows:
        cells = [row[0].ljust(widths[0]), *(cell.rjust(width) for cell, width in zip(row[1:], widths[1:], strict=True))]
        yield "  ".join(cells).rstrip()
    for area in AREAS:
        yield from _reasons(found, area)
    yield from _listed(found)
    yield from _incomplete(found)


def _incomplete(found: Coverage) -> Iterator[str]:
    counts = sorted(found.incomplete().items(), key=lambda item: (-item[1], item[0]))
    if counts:
        yield ""
        yield "node types that are incomplete, and how many of these calls each may have:"
    for name, count in counts[:LISTED]:
        yield f"  {count:5d}  {name}"


def _row(name: str, counts: Counted) -> tuple[str, ...]:
    numbers = (counts.sites, counts.endpoint, counts.other, counts.unreached, counts.open)
    return (name, *map(str, numbers), percent(counts.share))


def _reasons(found: Coverage, area: str) -> Iterator[str]:
    reasons = Counter((s.state, s.reason) for s in found.sites if s.area == area and s.state != OPEN and s.reason)
    if reasons:
        yield ""
        yield f"accounted for without an endpoint at the call{_AREAS[area]}:"
        for (_, reason), number in sorted(reasons.items(), key=lambda item: (-item[1], item[0])):
            yield f"  {number:5d}  {reason}"


def _listed(found: Coverage) -> Iterator[str]:
    missing = [site for site in found.sites if site.state == OPEN and site.area == PRODUCTION]
    if missing:
        yield ""
        yield "missing in the model:"
    for site in missing[:LISTED]:
        why = f" ({site.reason}: {site.detail})" if site.reason else ""
        yield f"{site.path}:{site.line}:{site.column}: {site.call}{why}"
    if len(missing) > LISTED:
        yield f"and {len(missing) - LISTED} more; --format json has them all"
