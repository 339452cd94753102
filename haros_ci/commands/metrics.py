# SPDX-License-Identifier: Apache-2.0
"""``haros-ci metrics``: every value beside HAROS's limits, as text, JSON or CSV."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import click

from haros_ci.commands.common import Progress, settings_from, under_cache
from haros_ci.commands.limits import LIMITS
from haros_ci.commands.timings import with_timings
from haros_ci.config.suggestion import suggestion
from haros_ci.errors import EXIT_TOOL_TROUBLE, UserError
from haros_ci.measuring.measures import Measures, measure
from haros_ci.measuring.totals import METRICS
from haros_ci.model.measurement import Measurement
from haros_ci.model.workspace import Store
from haros_ci.report import measurements
from haros_ci.report.escape import terminal
from haros_ci.report.worst_measurements import table
from haros_ci.results.result import Notification
from haros_ci.results.rule import Level
from haros_ci.workspace.discover import discover
from haros_ci.writing import write

#: The most notes that are printed one by one.
SHOWN = 20


@with_timings
def metrics(flags: Mapping[str, Any]) -> int:
    """Measure and print; exit code 3 if a tool that measures failed, else 0."""
    requested = frozenset(metric_named(name) for name in flags["metric"])
    levels = frozenset(flags["level"]) or frozenset(measurements.LEVELS)
    settings = settings_from({**flags, "no_baseline": True})

    def work(store: Store, progress: Progress) -> Measures:
        workspace = discover(
            settings.root, settings.paths, exclude=settings.exclude, max_file_size=settings.max_file_size
        )
        notes = [Notification(Level.WARNING, p.message, path=p.path, line=p.line) for p in workspace.problems]
        made = measure(workspace, settings, store, progress)
        return Measures(made.values, (*notes, *made.notifications), made.failed)

    made = under_cache(work, settings, flags)
    chosen = tuple(
        value
        for value in made.values
        if measurements.level(value) in levels and (not requested or value.metric in requested)
    )
    tell(made.notifications)
    path = Path(flags["output"]) if flags["output"] else None
    head = table(chosen, LIMITS, flags["worst"]) if flags["format"] == "text" and flags["worst"] else ""
    if flags["quiet"] and flags["format"] == "text":
        write(head, path)
    else:
        write(head + rendered(chosen, flags["format"], made.notifications), path)
    return EXIT_TOOL_TROUBLE if made.failed else 0


def metric_named(name: str) -> str:
    """The metric of that name, HAROS's spelling with underscores too; UserError if there is none."""
    found = name.replace("_", "-")
    if found not in METRICS:
        raise UserError(f"there is no metric {name!r}", help=suggestion(found, sorted(METRICS)))
    return found


def rendered(chosen: Iterable[Measurement], format: str, notes: Iterable[Notification]) -> str:
    """The values in one of the formats of the command."""
    if format == "json":
        return measurements.as_json(chosen, LIMITS, notes)
    return measurements.as_csv(chosen, LIMITS) if format == "csv" else measurements.as_text(chosen, LIMITS)


def tell(notes: tuple[Notification, ...]) -> None:
    """What could not be measured, the first of it one by one."""
    for note in notes[:SHOWN]:
        at = f"{note.path}:{note.line}: " if note.line else f"{note.path}: " if note.path else ""
        click.echo(f"{note.level.value}: {terminal(at + note.message)}", err=True)
    if len(notes) > SHOWN:
        click.echo(f"and {len(notes) - SHOWN} more; --format json has them all", err=True)
