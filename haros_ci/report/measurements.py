# SPDX-License-Identifier: Apache-2.0
"""The values of metrics as text, JSON and CSV, each with the limits on it."""

from __future__ import annotations

import csv
import io
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from haros_ci import __version__
from haros_ci.model.measurement import Measurement
from haros_ci.records import dataclass
from haros_ci.report.csv_table import cell
from haros_ci.report.escape import json_document, log_line
from haros_ci.report.message import number
from haros_ci.results.result import Notification

LEVELS = ("package", "file", "class", "function")
#: In this order; new ones are added at the end.
COLUMNS = ("level", "package", "path", "line", "class", "function", "metric", "value", "limits", "crossed")
VERSION = 1
_PLURALS = {"package": "packages", "file": "files", "class": "classes", "function": "functions"}


@dataclass(frozen=True, slots=True)
class Limit:
    """A rule of the tool ``metrics``: crossed when *metric* of a *level* is above *limit*, or where *is_lowest* below it."""

    rule: str
    level: str
    metric: str
    limit: float
    is_lowest: bool = False

    def crossed(self, value: float) -> bool:
        return value < self.limit if self.is_lowest else value > self.limit


#: The limits by level and metric.
Limits = Mapping[tuple[str, str], tuple[Limit, ...]]
#: Of what values are: level, package, path, line, class, function.
Entity = tuple[str, str, str, int, str, str]


def level(measurement: Measurement) -> str:
    """One of LEVELS."""
    if measurement.function:
        return "function"
    return "class" if measurement.class_name else "file" if measurement.path else "package"


def as_json(values: Iterable[Measurement], limits: Iterable[Limit], notes: Iterable[Notification] = ()) -> str:
    """An object with a list for each level; ``crossed`` are the rules whose limits a value crosses."""
    provided = tuple(limits)
    listed: dict[str, list[object]] = {_PLURALS[item]: [] for item in LEVELS}
    by_metric = _by_metric(provided)
    for entity, found in _entities(values):
        crossed = [
            limit.rule for metric, value in found.items() for limit in _crossed(by_metric, entity[0], metric, value)
        ]
        listed[_PLURALS[entity[0]]].append(
            {
                **_named(entity),
                "metrics": {metric: number(value) for metric, value in found.items()},
                "crossed": crossed,
            }
        )
    document = {
        "version": VERSION,
        "tool": {"name": "haros-ci", "version": __version__},
        "limits": [
            {
                "rule": limit.rule,
                "level": limit.level,
                "metric": limit.metric,
                "min" if limit.is_lowest else "max": number(limit.limit),
            }
            for limit in provided
        ],
        **listed,
        "notifications": [
            {"level": n.level.value, "tool": n.tool, "path": n.path, "line": n.line, "message": n.message}
            for n in notes
        ],
    }
    return json_document(document, 1) + "\n"


def as_csv(values: Iterable[Measurement], limits: Iterable[Limit]) -> str:
    """A row for each value; several limits and rules in a cell have blanks between them."""
    table = io.StringIO()
    rows = csv.writer(table, lineterminator="\n")
    rows.writerow(COLUMNS)
    by_metric = _by_metric(limits)
    for value in values:
        here = level(value)
        crossed = " ".join(limit.rule for limit in _crossed(by_metric, here, value.metric, value.value))
        names = (
            cell(value.package),
            cell(value.path),
            value.line or None,
            cell(value.class_name),
            cell(value.function),
        )
        beside = " ".join(_written(limit) for limit in by_metric.get((here, value.metric), ()))
        rows.writerow((here, *names, value.metric, number(value.value), beside, crossed))
    return table.getvalue()


def as_text(values: Iterable[Measurement], limits: Iterable[Limit]) -> str:
    """A line for each package, file, class and function; what crosses a limit says which, the worst alone."""
    by_metric = _by_metric(limits)
    lines = []
    for entity, found in _entities(values):
        here, package, path, line, class_name, function = entity
        names = {"package": package, "file": path, "class": class_name, "function": _full(class_name, function)}
        at = f"{path}:{line}: " if line else ""
        message = ", ".join(_described(by_metric, here, metric, value) for metric, value in found.items())
        lines.append(log_line(f"{at}{here} {names[here]}: {message}") + "\n")
    return "".join(lines)


def _full(class_name: str, function: str) -> str:
    return f"{class_name} {function}" if class_name else function


def _described(limits: Limits, here: str, metric: str, value: float) -> str:
    text = f"{metric} {_short(value)}"
    crossed = _crossed(limits, here, metric, value)
    if not crossed:
        return text
    worst = (
        min(crossed, key=lambda limit: limit.limit)
        if crossed[0].is_lowest
        else max(crossed, key=lambda limit: limit.limit)
    )
    return f"{text} ({'under' if worst.is_lowest else 'over'} {_short(worst.limit)})"


def _short(value: float) -> str:
    return f"{value:.0f}" if value == int(value) else f"{value:.2f}"


def _written(limit: Limit) -> str:
    return f"{'>=' if limit.is_lowest else '<='}{_short(limit.limit)}"


def _by_metric(limits: Iterable[Limit]) -> Limits:
    found: dict[tuple[str, str], tuple[Limit, ...]] = {}
    for limit in limits:
        key = (limit.level, limit.metric)
        found[key] = (*found.get(key, ()), limit)
    return found


def _crossed(limits: Limits, here: str, metric: str, value: float) -> list[Limit]:
    return [limit for limit in limits.get((here, metric), ()) if limit.crossed(value)]


def _entities(values: Iterable[Measurement]) -> Iterator[tuple[Entity, dict[str, float]]]:
    """The values of each package, file, class and function, in their order."""
    found: dict[Entity, dict[str, float]] = defaultdict(dict)
    for value in values:
        key = (level(value), value.package, value.path, value.line, value.class_name, value.function)
        found[key][value.metric] = value.value
    return iter(found.items())


def _named(entity: Entity) -> dict[str, Any]:
    here, package, path, line, class_name, function = entity
    names: dict[str, Any] = {"package": package}
    if here != "package":
        names["path"] = path
    if here in ("class", "function"):
        names |= {"line": line, "class": class_name}
    if here == "function":
        names["function"] = function
    return names
