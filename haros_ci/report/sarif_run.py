# SPDX-License-Identifier: Apache-2.0
"""A tower of pure functions that build one SARIF run: invocation, artifacts, results, locations, regions."""

from __future__ import annotations

import hashlib
import re
import uuid
from collections.abc import Callable
from dataclasses import replace
from typing import Any
from urllib.parse import quote

from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.report.escape import REPLACEMENT, terminal
from haros_ci.report.message import label, linked, literal, number, sentence
from haros_ci.report.sarif_fixes import build_fixes
from haros_ci.report.sarif_graphs import Drawn, build_flow, build_graphs, build_traversals, drawn
from haros_ci.report.sarif_objects import dumps, om, properties, write
from haros_ci.report.sarif_rules import GUIDS, all_rules, build_taxonomy, build_tool, trouble, troubles, weaknesses
from haros_ci.report.source_lines import Reader, lines_of, quoted
from haros_ci.results.fingerprint import partial_fingerprints
from haros_ci.results.result import Artifact, BaselineState, Notification, Provenance, Report, Result, Run, Suppression
from haros_ci.results.rule import Level

ROOT = "SRCROOT"
CONTEXT_LINES = 3
#: SARIF §3.24.10 and appendix names for the kinds of file that have one.
LANGUAGES = {"cpp": "cplusplus", "python": "python", "setup": "python", "launch": "xml", "package": "xml", "xml": "xml"}
#: Surrogates that stand for no byte of a file name.
_STRAY = regex("[\ud800-\udc7f\udd00-\udfff]")


@dataclass(frozen=True, slots=True)
class Setting:
    """What every result of one run shares."""

    archive: bool
    rules: dict[str, int]
    artifacts: dict[str, int]
    with_states: bool
    with_suppressions: bool
    lines: Callable[[str], list[str]]
    graphs: Drawn
    places: dict[str, dict[str, Any]] = field(default_factory=dict)


def write_log(runs: tuple[Run, ...], report: Report, audience: str, source: Reader | None) -> str:
    """The whole log as text; *runs* are what is to be in it, *report* tells of artifacts, provenance and baseline."""
    lines = lines_of(source or (lambda path: ""))
    ids: set[str] = set()
    return write([build_run(run, report, audience == "archive", lines, _automation_id(run, ids)) for run in runs])


def build_run(
    run: Run, report: Report, archive: bool, lines: Callable[[str], list[str]], automation_id: str
) -> tuple[dict[str, Any], list[str]]:
    """One run without its results, and each result as JSON, built and let go one by one.

    ``automationDetails.guid`` is derived from all that both say, as no two different runs may share it (§3.17.4).
    """
    run = _with_reason_of_failure(run)
    rules = all_rules(run)
    artifacts = _artifacts(run, report.artifacts) if archive else ()
    cwe = weaknesses(rules)
    setting = Setting(
        archive=archive,
        rules={terminal(rule.id): i for i, rule in enumerate(rules)},
        artifacts={artifact.path: i for i, artifact in enumerate(artifacts)},
        with_states=any(result.state for result in run.results),
        with_suppressions=any(result.suppressions for result in run.results),
        lines=lines,
        graphs=drawn(run) if archive else Drawn(),
    )
    details = om.RunAutomationDetails(id=automation_id)
    built = om.Run(
        tool=build_tool(run, rules),
        automation_details=details,
        baseline_guid=_baseline_guid(report, automation_id),
        column_kind="unicodeCodePoints",
        default_encoding="utf-8",
        invocations=[build_invocation(run, setting)],
        original_uri_base_ids={ROOT: om.ArtifactLocation(description=om.Message(text="The root of the workspace."))},
        version_control_provenance=_provenance(report.provenance),
        artifacts=[build_artifact(artifact, run) for artifact in artifacts] or None,
        taxonomies=[build_taxonomy(cwe)] if cwe else None,
        graphs=build_graphs(setting.graphs, lambda place, text: build_location(place, setting, message=text)) or None,
    )
    results = [dumps(build_result(result, setting)) for result in run.results]
    digest = hashlib.sha256("\n".join([dumps(built), *results]).encode("ascii")).hexdigest()
    details.guid = str(uuid.uuid5(GUIDS, digest))
    return properties(built), results


def build_invocation(run: Run, setting: Setting) -> om.Invocation:
    """§3.20: whether the tool did its work, and all trouble; never account, machine or environment."""
    kinds = {kind: i for i, kind in enumerate(troubles(run))}
    built = [(note.configuration, build_notification(note, kinds, setting)) for note in run.notifications]
    return om.Invocation(
        execution_successful=run.successful,
        tool_configuration_notifications=[note for configuration, note in built if configuration] or None,
        tool_execution_notifications=[note for configuration, note in built if not configuration] or None,
    )


def build_notification(notification: Notification, kinds: dict[str, int], setting: Setting) -> om.Notification:
    kind = trouble(notification)
    place = Location(notification.path, notification.line) if notification.path else None
    return om.Notification(
        message=om.Message(text=literal(sentence(notification.message))),
        level=notification.level.value,
        descriptor=om.ReportingDescriptorReference(id=kind, index=kinds[kind]),
        locations=[build_location(place, setting)] if place else None,
    )


def build_artifact(artifact: Artifact, run: Run) -> om.Artifact:
    """§3.24; the hash lets a matcher see renames without git."""
    return om.Artifact(
        location=om.ArtifactLocation(uri=uri(artifact.path), uri_base_id=ROOT),
        hashes={"sha-256": artifact.digest},
        length=artifact.size,
        roles=["analysisTarget"] if artifact.path in run.analysed else None,
        source_language=LANGUAGES.get(artifact.language),
    )


def build_result(result: Result, setting: Setting) -> om.Result:
    """§3.27; states and suppressions stand on all results of a run or on none."""
    place = result.location
    removed = result.state is BaselineState.ABSENT  # its line is the baseline's, not today's
    text = ("" if removed else _line(place, setting)) or (result.identity.snippet if result.identity else "")
    region = build_region(place, text)
    context = build_context(region, place.path, text, setting) if setting.archive and not removed else None
    return om.Result(
        rule_id=terminal(result.rule),
        rule_index=setting.rules[terminal(result.rule)],
        level=result.level.value,
        message=om.Message(text=linked(result)),
        locations=[
            om.Location(
                physical_location=om.PhysicalLocation(
                    artifact_location=_artifact_location(place.path, setting),
                    region=region,
                    context_region=context,
                ),
                logical_locations=_logical(result) or None,
            )
        ],
        related_locations=[
            build_location(near.location, setting, id=i, message=label(near) + ".")
            for i, near in enumerate(result.related, start=1)
        ]
        or None,
        code_flows=[build_flow(result.flow, lambda place, text: build_location(place, setting, message=text))]
        if result.flow
        else None,
        fixes=list(build_fixes(result.fixes, lambda path: _artifact_location(path, setting))) or None,
        graph_traversals=build_traversals(result, setting.graphs) or None,
        partial_fingerprints=dict(sorted(partial_fingerprints(result).items())) or None,
        baseline_state=(result.state.value if result.state else "new") if setting.with_states else None,
        suppressions=[build_suppression(s, setting) for s in result.suppressions]
        if setting.with_suppressions
        else None,
        properties=_properties(result) or None if setting.archive else None,
    )


def build_suppression(suppression: Suppression, setting: Setting) -> om.Suppression:
    """§3.35; ``status`` stays absent, which reads as accepted (the object model's ``state`` is not a SARIF property)."""
    return om.Suppression(
        kind=suppression.kind,
        justification=literal(sentence(suppression.justification)) if suppression.justification else None,
        location=build_location(suppression.location, setting) if suppression.location else None,
    )


def build_location(place: Location, setting: Setting, *, id: int = -1, message: str | None = None) -> om.Location:
    """A location beside the main one: its region is as exact as *place*, and absent if the file is meant."""
    region = None
    if place.line is not None:
        region = om.Region(start_line=place.line, start_column=place.column)
        if place.column is not None and place.end_column is not None and place.end_line in (None, place.line):
            region.end_column = max(place.end_column, place.column)
    return om.Location(
        id=id,
        message=om.Message(text=literal(message)) if message else None,
        physical_location=om.PhysicalLocation(artifact_location=_artifact_location(place.path, setting), region=region),
    )


def build_region(place: Location, line: str) -> om.Region:
    """One line, tight: an alert shows on a pull request only if all lines of its region are in the diff.

    *line* is the text of the region's line, "" if it is not known. A region without an end reaches to the end of
    the line; one without a column starts at the first character that is not blank.
    """
    start = place.column or 1 + len(line) - len(line.lstrip())
    if place.column and place.end_column and place.end_line in (None, place.line):
        end = place.end_column
    else:
        end = len(line.rstrip()) + 1
    end = max(end, start + 1 if start <= len(line) or not line else start)
    shown = quoted(line)[start - 1 : end - 1]
    return om.Region(
        start_line=place.line or 1,
        start_column=start,
        end_line=place.line or 1,
        end_column=end,
        snippet=om.ArtifactContent(text=shown) if shown else None,
    )


def build_context(region: om.Region, path: str, line: str, setting: Setting) -> om.Region | None:
    """The lines around *region*, or its own line where the source is not at hand; None if that adds nothing."""
    lines, at = setting.lines(path), region.start_line
    if line and lines[at - 1 : at] == [line]:
        first, last = max(1, at - CONTEXT_LINES), min(len(lines), at + CONTEXT_LINES)
        while last > at and not lines[last - 1].strip():
            last -= 1
        quotes = [quoted(text) for text in lines[first - 1 : last]]
    else:
        first = last = at
        quotes = [quoted(line)]
    if first == last and (not line or (region.start_column == 1 and region.end_column > len(line))):
        return None
    end = len(lines[last - 1] if first != last else line) + 1
    snippet = om.ArtifactContent(text="\n".join(quotes))
    return om.Region(start_line=first, start_column=1, end_line=last, end_column=end, snippet=snippet)


def uri(path: str) -> str:
    """A relative URI reference (RFC 3986), percent-encoded; bytes that are no UTF-8 come back as they were."""
    return quote(_STRAY.sub(REPLACEMENT, path).encode("utf-8", "surrogateescape"), safe="/")


def _automation_id(run: Run, taken: set[str]) -> str:
    """``haros_ci/<tool>/``, unlike any in *taken*: GitHub refuses two runs of one category."""
    name = re.sub(r"[^A-Za-z0-9._-]+", "-", run.tool.name).strip("-.") or "unnamed"
    stem = f"haros_ci/import-{name}" if run.imported else f"haros_ci/{name}"
    id, n = f"{stem}/", 1
    while id in taken:
        n += 1
        id = f"{stem}-{n}/"
    taken.add(id)
    return id


def _baseline_guid(report: Report, automation_id: str) -> str | None:
    """Names the baseline by its kind and source, as a revision or a compact baseline has no GUID of its own (§3.14.5)."""
    if report.baseline is None or not report.baseline.available:
        return None
    return str(uuid.uuid5(GUIDS, f"{automation_id}\n{report.baseline.kind}\n{terminal(report.baseline.source)}"))


def _with_reason_of_failure(run: Run) -> Run:
    if run.successful or any(note.level is Level.ERROR for note in run.notifications):
        return run
    note = Notification(Level.ERROR, f"{run.tool.name} did not finish; its results are incomplete.", tool=run.tool.name)
    return replace(run, notifications=(*run.notifications, note))


def _artifacts(run: Run, artifacts: tuple[Artifact, ...]) -> tuple[Artifact, ...]:
    """The known files that this run analysed or names."""
    named = {result.location.path for result in run.results}
    named.update(near.location.path for result in run.results for near in (*result.related, *result.flow))
    named.update(note.path for note in run.notifications if note.path)
    return tuple(sorted((a for a in artifacts if a.path in named or a.path in run.analysed), key=lambda a: a.path))


def _artifact_location(path: str, setting: Setting) -> dict[str, Any]:
    """The properties of an artifact location, made once for each file."""
    known = setting.places.get(path)
    if known is None:
        location = om.ArtifactLocation(uri=uri(path), uri_base_id=ROOT, index=setting.artifacts.get(path, -1))
        known = setting.places[path] = properties(location)
    return known


def _provenance(provenance: Provenance | None) -> list[om.VersionControlDetails] | None:
    """§3.14.9; only with an absolute address that carries no user or password."""
    if provenance is None or not re.fullmatch(r"[a-z][a-z0-9+.-]*://[^\s@\"<>\\^`{|}]+", provenance.repository_uri):
        return None
    return [
        om.VersionControlDetails(
            repository_uri=quote(provenance.repository_uri, safe="%/:?#[]!$&'()*+,;=~"),
            revision_id=provenance.revision or None,
            branch=terminal(provenance.branch) or None,
            mapped_to=om.ArtifactLocation(uri_base_id=ROOT),
        )
    ]


def _logical(result: Result) -> list[om.LogicalLocation]:
    """The enclosing function as fingerprints know it, and the ROS names that a finding is about (§3.33)."""
    scope = result.identity.scope if result.identity else result.scope
    names = [(scope, "function")] if scope else []
    names += [(name, "rosName") for name in result.subject]
    return [om.LogicalLocation(fully_qualified_name=terminal(name), kind=kind) for name, kind in names]


def _properties(result: Result) -> dict[str, object]:
    """What SARIF has no place for; ``template`` restores the identity, as the message's text gets links and a period."""
    properties: dict[str, object] = {
        "also": [terminal(rule) for rule in result.also] or None,
        "limit": number(result.limit),
        "reason": terminal(result.reason) or None,
        "roles": [terminal(role) for role in result.roles] or None,
        "template": (terminal(result.identity.template) if result.identity else "") or None,
        "value": number(result.value),
    }
    return {name: value for name, value in properties.items() if value is not None}


def _line(place: Location, setting: Setting) -> str:
    """The text of the line of *place*, "" without source."""
    lines = setting.lines(place.path)
    at = place.line or 1
    return lines[at - 1] if at <= len(lines) else ""
