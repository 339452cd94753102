# SPDX-License-Identifier: Apache-2.0
"""What was measured: how the values of each metric lie, which are the largest, and how many are beyond a limit."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import isfinite
from typing import Any

from haros_ci.html_page.pool import Pool
from haros_ci.model.measurement import Measurement
from haros_ci.report.measurements import Limit, level
from haros_ci.report.message import number

#: Bars of a distribution, and the worst that are listed of each metric.
BARS, WORST = 24, 100


def metrics(pool: Pool, values: Iterable[Measurement], limits: Iterable[Limit]) -> list[dict[str, Any]]:
    """For each level and metric that has values: how many, the bars, the limits with how many are beyond them, the worst."""
    by_metric: dict[tuple[str, str], list[Measurement]] = {}
    for value in values:
        if isfinite(value.value) and level(value) in ("function", "class", "file"):
            by_metric.setdefault((level(value), value.metric), []).append(value)
    given: dict[tuple[str, str], list[Limit]] = {}
    for limit in limits:
        given.setdefault((limit.level, limit.metric), []).append(limit)
    return [
        _metric(pool, kind, metric, found, given.get((kind, metric), ()))
        for (kind, metric), found in sorted(by_metric.items())
    ]


def _metric(pool: Pool, kind: str, metric: str, found: list[Measurement], limits: Sequence[Limit]) -> dict[str, Any]:
    is_lowest = any(limit.is_lowest for limit in limits) or metric == "maintainability-index"
    worst = sorted(
        found,
        key=lambda measurement: (
            measurement.value if is_lowest else -measurement.value,
            measurement.path,
            measurement.line,
            measurement.function,
        ),
    )
    return {
        "level": kind,
        "metric": metric,
        "count": len(found),
        "bars": bars([measurement.value for measurement in found]),
        "limits": [
            (
                pool.text(limit.rule),
                number(limit.limit),
                int(limit.is_lowest),
                sum(limit.crossed(e.value) for e in found),
            )
            for limit in sorted(limits, key=lambda limit: (limit.limit, limit.rule))
        ],
        "worst": [
            (
                number(round(measurement.value, 2)),
                pool.row("places", (pool.text(measurement.path), measurement.line, 0)),
                pool.text("::".join(part for part in (measurement.class_name, measurement.function) if part)),
                pool.text(measurement.package),
            )
            for measurement in worst[:WORST]
        ],
    }


def bars(values: Sequence[float], most: int = BARS) -> list[tuple[float, float, int]]:
    """How many *values* lie in each of at most *most* ranges of the same width, as (from, to, how many); the last has its end."""
    least, largest = min(values), max(values)
    if least == largest:
        return [(least, largest, len(values))]
    whole = all(value == int(value) for value in values)
    width = (largest - least) / most
    if whole:
        width = max(1.0, float(-(-(int(largest) - int(least) + 1) // most)))
    made: dict[int, int] = {}
    for value in values:
        at = min(int((value - least) / width), most - 1)
        made[at] = made.get(at, 0) + 1
    last = max(made)
    return [(round(least + n * width, 4), round(least + (n + 1) * width, 4), made.get(n, 0)) for n in range(last + 1)]
