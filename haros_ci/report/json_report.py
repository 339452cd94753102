# SPDX-License-Identifier: Apache-2.0
"""The report as one JSON document for scripts: schema version 1, to which keys are added but never renamed.

Top level: ``schemaVersion``, ``tool`` {name, version}, ``failOn`` (level or null), ``counts`` {open, errors, warnings,
notes, failing, unchanged, updated, absent, suppressed, counted (metrics that are not listed), copies (open ones that text counts
with what stands for them)}, ``baseline`` {kind, source, available, message} or null, ``silenced`` by the change
{findings, comments [{path, line, comment}]},
``coverage`` {packages, files, lines, targets, unseen, sandbox}, ``provenance`` {repositoryUri, revision, branch} or null,
``runs`` [{tool, version, successful, imported, analysed, results}] (the last two are counts), ``notifications``
[{level, message, tool, path, line, configuration}], and ``results``, one a line, in the order of every output:
{tool, rule, level, message, path, line, column, endLine, endColumn, open, state, reason, scope, value, limit,
subject, roles, also, occurrence, snippet, related [{path, line, column, message}], flow (as related, in order), graph,
edges [[id, id]], fixes [{description, edits [{path, start [line, column], end, text} or {path, executable}]}],
suppressions [{kind, justification}], copyOf {path, line} where the same finding in another copy of the text stands for it in what
people read, shownAs: the sentence that they read where it is the result that stands for others}. ``subject`` are the ROS names that it is about, ``roles`` what
they are; ``graph`` names the configuration through which the ``edges`` go, from id to id (``node:/talker``).
A key without a value is null; lines and columns count as SARIF's do.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from haros_ci import __version__
from haros_ci.model.location import Location
from haros_ci.report import summary
from haros_ci.report.escape import terminal
from haros_ci.report.message import label, number, plain
from haros_ci.report.source_lines import quoted
from haros_ci.results.fix import Fix
from haros_ci.results.result import Notification, Related, Report, Result, Run, is_open

SCHEMA_VERSION = 1


def render(
    report: Report,
    copy_of: Mapping[int, Location] = MappingProxyType({}),
    shown: Mapping[tuple[str, Location], Result] = MappingProxyType({}),
) -> str:
    """The document; ASCII, with a final newline. *copy_of* has the place of what stands for a result, by its identity; *shown*
    what people read of those that do, by rule and place.
    """
    counts = summary.count(report)
    head: dict[str, Any] = {
        "schemaVersion": SCHEMA_VERSION,
        "tool": {"name": "haros-ci", "version": __version__},
        "failOn": report.fail_on.value if report.fail_on else None,
        "counts": {
            "open": counts.open,
            "errors": counts.errors,
            "warnings": counts.warnings,
            "notes": counts.notes,
            "failing": counts.failing,
            "unchanged": counts.unchanged,
            "updated": counts.updated,
            "absent": counts.absent,
            "suppressed": counts.suppressed,
            "counted": counts.counted,
            "copies": sum(is_open(result) and id(result) in copy_of for result in report.results),
        },
        "baseline": _baseline(report),
        "silenced": {
            "findings": report.silenced.findings,
            "comments": [
                {"path": place.path, "line": place.line, "comment": name} for place, name in report.silenced.comments
            ],
            "more": [{"path": place.path, "line": place.line, "what": name} for place, name in report.silenced.more],
        },
        "coverage": _coverage(report),
        "provenance": _provenance(report),
        "runs": [_run(run) for run in sorted(report.runs, key=lambda run: (run.imported, run.tool.name))],
        "notifications": [_notification(note) for note in summary.notifications(report)],
    }
    results = ",\n".join(
        _dumps(_result(result, copy_of.get(id(result)), shown.get((result.full_id, result.location))))
        for result in report.results
    )
    return f'{_dumps(head)[:-1]},"results":[\n{results}\n]}}\n' if results else f'{_dumps(head)[:-1]},"results":[]}}\n'


def _dumps(value: object) -> str:
    return json.dumps(value, ensure_ascii=True, allow_nan=False)


def _result(result: Result, original: Location | None, shown: Result | None) -> dict[str, Any]:
    place, identity = result.location, result.identity
    return {
        "tool": result.tool,
        "rule": result.rule,
        "level": result.level.value,
        "message": plain(result),
        "path": place.path,
        "line": place.line,
        "column": place.column,
        "endLine": place.end_line,
        "endColumn": place.end_column,
        "open": is_open(result),
        "state": result.state.value if result.state else None,
        "reason": result.reason or None,
        "scope": result.scope or (identity.scope if identity else "") or None,
        "value": number(result.value),
        "limit": number(result.limit),
        "subject": list(result.subject),
        "roles": list(result.roles),
        "also": list(result.also),
        "occurrence": identity.occurrence if identity else None,
        "snippet": (quoted(identity.snippet) if identity else "") or None,
        "related": [_related(near) for near in result.related],
        "flow": [_related(step) for step in result.flow],
        "graph": result.graph or None,
        "edges": [list(edge) for edge in result.edges],
        "fixes": [_fix(fix) for fix in result.fixes],
        "suppressions": [{"kind": s.kind, "justification": s.justification or None} for s in result.suppressions],
        "copyOf": {"path": original.path, "line": original.line} if original is not None else None,
        "shownAs": plain(shown) if shown is not None and original is None else None,
    }


def _related(near: Related) -> dict[str, Any]:
    place = near.location
    return {"path": place.path, "line": place.line, "column": place.column, "message": label(near)}


def _fix(fix: Fix) -> dict[str, Any]:
    """*start* and *end* are [line, column]; what lies between them becomes *text*."""
    edits = [
        {"path": edit.path, "executable": True}
        if edit.is_executable
        else {"path": edit.path, "start": list(edit.start), "end": list(edit.end), "text": edit.text}
        for edit in fix.edits
    ]
    return {"description": fix.description, "edits": edits}


def _run(run: Run) -> dict[str, Any]:
    return {
        "tool": run.tool.name,
        "version": run.tool.version or None,
        "successful": run.successful,
        "imported": run.imported,
        "analysed": len(run.analysed),
        "results": len(run.results),
    }


def _notification(note: Notification) -> dict[str, Any]:
    return {
        "level": note.level.value,
        "message": terminal(note.message),
        "tool": note.tool,
        "path": note.path,
        "line": note.line,
        "configuration": note.configuration,
    }


def _baseline(report: Report) -> dict[str, Any] | None:
    baseline = report.baseline
    if baseline is None:
        return None
    return {
        "kind": baseline.kind,
        "source": baseline.source,
        "available": baseline.available,
        "message": baseline.message or None,
    }


def _coverage(report: Report) -> dict[str, Any]:
    coverage = report.coverage
    return {
        "packages": coverage.packages,
        "files": coverage.files,
        "lines": coverage.lines,
        "targets": coverage.targets,
        "unseen": list(coverage.unseen),
        "sandbox": coverage.sandbox or None,
    }


def _provenance(report: Report) -> dict[str, Any] | None:
    provenance = report.provenance
    if provenance is None:
        return None
    return {
        "repositoryUri": provenance.repository_uri or None,
        "revision": provenance.revision or None,
        "branch": provenance.branch or None,
    }
