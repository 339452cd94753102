# SPDX-License-Identifier: Apache-2.0
"""A format: one line for each open finding, its parts separated by tabs."""

from __future__ import annotations

from haros_ci.api.reports import Report, terminal


def render(report: Report) -> str:
    """Place, level, rule and message; ``terminal`` makes one line without control characters of each."""
    rows = ((str(r.location), r.level.value, r.full_id, r.message) for r in report.shown())
    return "".join("\t".join(map(terminal, row)) + "\n" for row in rows)
