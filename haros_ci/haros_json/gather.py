# SPDX-License-Identifier: Apache-2.0
"""What the folder needs besides the report: the architecture, the manifests, the metrics, the revision's date."""

from __future__ import annotations

from datetime import datetime, timezone

from haros_ci.analysis.architectures import Architectures
from haros_ci.analysis.inspection import asks
from haros_ci.config.selection import Selection
from haros_ci.haros_json.documents import Input, documents
from haros_ci.linters import catalogue
from haros_ci.linting import with_queries
from haros_ci.measuring.measures import measure
from haros_ci.model.workspace import Workspace
from haros_ci.results import own
from haros_ci.results.result import Report
from haros_ci.workspace.commit_time import commit_time
from haros_ci.workspace.manifest import read_manifest

#: How HAROS writes times, and its visualizer reads them.
TIME = "%Y-%m-%d-%H-%M"


def gathered(
    report: Report, workspace: Workspace, architectures: Architectures
) -> tuple[dict[str, str], tuple[str, ...]]:
    """The files of the folder by path; and the tools that failed to measure, so that values are missing."""
    settings, known = architectures.settings, architectures.registry
    made = architectures.of(workspace)
    measures = measure(workspace, settings, architectures.store, sources=made.sources)
    selection = Selection(settings, with_queries(settings, known), unlisted=catalogue.rule)
    scopes = {f"{own.TOOL}:{one.id}": "configuration" if one.run else "package" for one in known.checks}
    queries: dict[str, str] = {}
    if asks(settings):
        from haros_ci.query.declared import declared

        for query in declared(settings.project)[0]:
            scopes[f"{own.TOOL}:{query.id}"] = query.scope
            queries[f"{own.TOOL}:{query.id}"] = query.text
    tools = {run.tool.name for run in report.runs}
    on = {
        rule.id
        for tool in tools
        for rule in with_queries(settings, known)(tool).values()
        if selection.wants(tool, rule, "")
    }
    seconds = commit_time(workspace.root)
    files = documents(
        Input(
            report=report,
            workspace=workspace,
            architecture=made.architecture,
            builds=made.builds,
            manifests={
                package.path: read_manifest(
                    workspace.text(_inside(package.path, "package.xml")).encode("utf-8", "replace")
                )
                for package in workspace.packages
            },
            measurements=measures.values,
            documented=tuple(known.documented_rules()),
            scopes=scopes,
            queries=queries,
            rules_on=len(on),
            user_rules=sum(id.startswith("user:") for id in on),
            project=settings.project,
            where=settings.project_file or "the project file",
            timestamp=_written(seconds),
        )
    )
    return files, measures.failed


def _inside(directory: str, name: str) -> str:
    return name if directory == "." else f"{directory}/{name}"


def _written(seconds: int | None) -> str | None:
    """A time as HAROS writes it, in UTC; None for one before 1970, or beyond what a calendar holds."""
    if seconds is None or seconds < 0:
        return None
    try:
        return datetime.fromtimestamp(seconds, timezone.utc).strftime(TIME)
    except (OverflowError, OSError, ValueError):
        return None
