# SPDX-License-Identifier: Apache-2.0
"""Counts per rule and per tool, and how dense the findings are, for ``--statistics``."""

from __future__ import annotations

from collections import Counter
from typing import TypeVar

from haros_ci.report.escape import terminal
from haros_ci.results.result import Report

Key = TypeVar("Key", str, tuple[int, str, str])


def render(report: Report) -> str:
    """Tables of the open findings, the most frequent first; density is findings per 1000 lines looked at."""
    shown = report.shown()
    rules = Counter((r.level.rank, r.level.value, r.full_id) for r in shown)
    tools = Counter(r.tool for r in shown)
    every = {run.tool.name for run in report.runs} | set(tools)
    lines = [_row(n, report.coverage.lines, f"{level:<8}{terminal(rule)}") for (_, level, rule), n in _ranked(rules)]
    lines += [""] if lines else []
    lines += [_row(n, report.coverage.lines, terminal(t)) for t, n in _ranked(Counter({t: tools[t] for t in every}))]
    lines.append(_row(len(shown), report.coverage.lines, "in all"))
    return "\n".join(["   count  per 1000 lines", *lines, ""])


def _ranked(counter: Counter[Key]) -> list[tuple[Key, int]]:
    return sorted(counter.items(), key=lambda pair: (-pair[1], pair[0]))


def _row(count: int, lines: int, name: str) -> str:
    density = f"{1000 * count / lines:16.2f}" if lines else " " * 16
    return f"{count:>8}{density}  {name}"
