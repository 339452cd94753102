# SPDX-License-Identifier: Apache-2.0
"""All data of the page, of one run."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from haros_ci import __version__
from haros_ci.checking.transforms import Broadcast
from haros_ci.html_page.changed import changed
from haros_ci.html_page.elements import WELL_KNOWN
from haros_ci.html_page.findings import chosen, findings, rules
from haros_ci.html_page.frames import Frames
from haros_ci.html_page.measured import metrics
from haros_ci.html_page.packages import LANGUAGES, interfaces, packages, picture
from haros_ci.html_page.pool import NONE, Pool
from haros_ci.html_page.properties import Held, properties
from haros_ci.html_page.systems import configurations
from haros_ci.html_page.verdicts import Recorded, verdicts
from haros_ci.model.architecture import KINDS, PROVENANCES, Configuration
from haros_ci.model.build import Build
from haros_ci.model.measurement import Measurement
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass, field
from haros_ci.report import summary
from haros_ci.report.measurements import Limit
from haros_ci.results.result import Report

SCHEMA_VERSION = 1
#: Notifications that are shown.
MOST_NOTES = 500


#: Points by time: year-month-day-hour-minute in UTC, and lines, lines of comments, findings, those against coding standards, metrics beyond a limit, the mean
#: complexity and length of functions.
History = tuple[tuple[str | float, ...], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Input:
    """All that the page is made of; *broadcasts* are the transforms by configuration, *date* is the commit's time, "" without git; *processes* lay out pictures."""

    report: Report
    workspace: Workspace
    configurations: Sequence[Configuration] = ()
    broadcasts: Mapping[str, Sequence[Broadcast]] = field(default_factory=dict)
    properties: Sequence[Held] = ()
    verdicts: Sequence[Recorded] = ()
    builds: Mapping[str, Build] = field(default_factory=dict)
    measurements: Sequence[Measurement] = ()
    limits: Iterable[Limit] = ()
    name: str = ""
    date: str = ""
    more_than_shown: int = 0
    history: History = ()
    processes: int = 1


def data_of(given: Input) -> dict[str, Any]:
    """The document that the script reads (``html-schema.json``). The same input gives the same."""
    pool, report, workspace = Pool(), given.report, given.workspace
    frames = Frames(workspace.text)
    shown, left_out = chosen(report)
    package = workspace.package_finder()
    rows = findings(pool, shown, package, frames)
    frames.keep([one.stated.location for one in given.properties])
    made: dict[str, Any] = {
        "version": SCHEMA_VERSION,
        "only": "",
        "tool": __version__,
        "name": pool.text(given.name),
        "kinds": KINDS,
        "sources": PROVENANCES,
        "languages": LANGUAGES,
        "switches": [switch for switch, _ in WELL_KNOWN],
        "well_known": {name: switch for switch, names in WELL_KNOWN for name in names},
        "summary": _summary(pool, report, given),
        "findings": rows,
        "rules": rules(pool, report, shown),
        "configurations": configurations(pool, given.configurations, given.broadcasts, given.processes),
        "packages": packages(pool, workspace),
        "package_picture": picture(workspace),
        "properties": properties(pool, given.properties),
        "verdicts": verdicts(pool, given.verdicts),
        "interfaces": interfaces(pool, given.builds),
        "metrics": metrics(pool, given.measurements, given.limits),
        "changes": changed(pool, report.changes) if report.changes is not None else None,
        "history": given.history,
        "launch_files": _launch_files(workspace),
    }
    made["frames"] = frames.document(pool)
    made["left_out"] = [pool.text(sentence) for sentence in _left_out(frames, left_out, given)]
    made["tables"] = pool.document()
    return made


def _left_out(frames: Frames, findings: int, given: Input) -> list[str]:
    """What the page does not have for its size."""
    sentences = []
    if findings:
        sentences.append(f"{summary.plural(findings, 'finding')} left out: those known before, then notes.")
    if frames.is_full:
        sentences.append("Source lines left out: the page has them for the first findings only.")
    if given.more_than_shown:
        sentences.append(f"{summary.plural(given.more_than_shown, 'configuration')} left out by --configuration.")
    return sentences


def _summary(pool: Pool, report: Report, given: Input) -> dict[str, Any]:
    counts = summary.count(report)
    provenance = report.provenance
    notes = summary.notifications(report)
    return {
        "headline": pool.text(summary.headline(report, counts)),
        "known": pool.text(summary.known(counts)),
        "covered": pool.text(summary.covered(report)),
        "compared": pool.text(report.baseline.source) if report.baseline and summary.compared(report) else NONE,
        "no_baseline": pool.text(summary.no_baseline(report) or None),
        "revision": pool.text(provenance.revision[:12] if provenance else None),
        "branch": pool.text(provenance.branch if provenance else None),
        "date": pool.text(given.date or None),
        "files": len(given.workspace.files),
        "tools": [
            (pool.text(run.tool.name), pool.text(run.tool.version), int(run.successful), len(run.analysed))
            for run in sorted(report.runs, key=lambda run: run.tool.name)
        ],
        "notes": [
            (note.level.rank, pool.text(note.message), pool.text(note.tool), pool.text(note.path), note.line or 0)
            for note in notes[:MOST_NOTES]
        ],
        "more_notes": max(0, len(notes) - MOST_NOTES),
    }


def _launch_files(workspace: Workspace) -> int:
    """How many launch files there are: those of XML, and Python files that are named so."""
    return sum(
        file.language == "launch" or file.path.endswith((".launch.py", "_launch.py")) for file in workspace.files
    )
