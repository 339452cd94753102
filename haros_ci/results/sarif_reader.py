# SPDX-License-Identifier: Apache-2.0
"""SARIF 2.1.0 logs of any tool, read as hostile input: for ``--baseline FILE.sarif`` and ``--import FILE.sarif``."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence

from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.results.fingerprint import message_template, restore_identity
from haros_ci.results.json_shape import boolean, items, mapping, natural, number, string, strings
from haros_ci.results.result import Identity, Notification, Related, Result, Run, Suppression, Tool
from haros_ci.results.rule import Level, Rule
from haros_ci.results.sarif_file import SarifError, parse
from haros_ci.results.sarif_graph_reader import ReadGraph, read_graphs, traversed
from haros_ci.results.sarif_uri import UriError, workspace_path

MAX_RUNS = 100
MAX_RESULTS = 250_000
_MAX_RULES = 25_000
_MAX_RELATED = 100
_MAX_LOGICAL = 1_001
_MAX_NOTIFICATIONS = 100
_LONGEST_TEXT = 8_000
_LONGEST_ID = 100
_LONGEST_NAME = 1_000  # a compact baseline, which names the tool of each result, reads no longer text than 4,000
_LINK = regex(r"\[((?:[^\[\]\\]|\\.){0,500})\]\(-?\d{1,9}\)")
_ESCAPE = regex(r"\\([\[\]\\])")
_PLACEHOLDER = regex(r"\{(\d{1,3})\}|(\{\{|\}\})")
#: §3.27.9: what these results say is not that something is wrong.
_NO_FINDING = frozenset({"pass", "notApplicable", "informational"})
_SECURITY_SEVERITY = regex(r"\d{1,2}(?:\.\d)?\Z")


def read_sarif(data: bytes, name: str, *, root: str = "") -> tuple[Run, ...]:
    """The runs of the log *data* of the file *name*, in its order, marked as imported.

    *root* is the workspace's absolute POSIX path, if results with absolute paths below it are to be kept. What is
    wrong with single results (a type, a place outside the workspace) leaves them out with one notification for each
    kind. Results that the log itself calls absent are left out; suppressed ones carry their suppressions.
    Raises SarifError.
    """
    log = parse(data, name)
    if log.get("version") != "2.1.0":
        raise SarifError(f"{name}: not a SARIF 2.1.0 log (its version is {str(log.get('version'))[:40]!r})")
    runs = log.get("runs")
    if not isinstance(runs, list):
        raise SarifError(f"{name}: not a SARIF log: 'runs' is not an array")
    if len(runs) > MAX_RUNS:
        raise SarifError(f"{name}: {len(runs)} runs; at most {MAX_RUNS} are read")
    total = sum(len(items(mapping(run), "results")) for run in runs)
    if total > MAX_RESULTS:
        raise SarifError(f"{name}: {total} results; at most {MAX_RESULTS} are read")
    return tuple(_run(mapping(run), f"{name}: runs[{index}]", name, root) for index, run in enumerate(runs))


@dataclass(slots=True)
class _Reading:
    """What the results of one run refer to, and what was wrong with them."""

    tool: str
    root: str
    artifacts: list[object]
    bases: dict[str, object]
    rules: list[list[object]]  # per component: the driver first, then the extensions
    known: dict[str, Rule]
    texts: dict[str, dict[str, str]]  # message strings by rule
    graphs: tuple[ReadGraph, ...] = ()
    problems: Counter[str] = field(default_factory=Counter)


def _run(run: dict[str, object], where: str, name: str, root: str) -> Run:
    tool = mapping(run, "tool")
    driver = mapping(tool, "driver")
    title = string(driver, "name")
    if not title:
        raise SarifError(f"{where}: tool.driver.name is missing")
    if len(title) > _LONGEST_NAME:
        raise SarifError(f"{where}: tool.driver.name has more than {_LONGEST_NAME} characters; shorten it")
    components = [driver, *(mapping(extension) for extension in items(tool, "extensions")[:MAX_RUNS])]
    reading = _Reading(
        tool=title,
        root=root,
        artifacts=items(run, "artifacts"),
        bases=mapping(run, "originalUriBaseIds"),
        rules=[items(component, "rules")[:_MAX_RULES] for component in components],
        known={},
        texts={},
    )
    reading.graphs = read_graphs(run, lambda place: _place(reading, place))
    for component in reading.rules:
        for entry in component:
            _learn(reading, mapping(entry))
    results = []
    for entry in items(run, "results"):
        try:
            result = _result(reading, entry)
        except UriError as err:
            reading.problems[f"stand outside the workspace or nowhere ({err.kind})"] += 1
        except ValueError as err:
            reading.problems[str(err)] += 1
        else:
            if result is not None:
                results.append(result)
    results.sort(key=lambda result: result.sort_key)
    invocations = [mapping(entry) for entry in items(run, "invocations")[:_MAX_NOTIFICATIONS]]
    return Run(
        tool=Tool(
            name=title,
            version=string(driver, "semanticVersion") or string(driver, "version"),
            information_uri=string(driver, "informationUri"),
            full_name=string(driver, "fullName"),
        ),
        rules=tuple(sorted(reading.known.values(), key=lambda rule: rule.id)),
        results=tuple(results),
        notifications=(*_left_out(reading, name), *_notifications(reading, invocations)),
        analysed=frozenset(result.location.path for result in results) | _targets(reading),
        successful=all(boolean(entry, "executionSuccessful", True) for entry in invocations),
        imported=True,
        graphs=tuple(entry.graph for entry in reading.graphs),
    )


def _learn(reading: _Reading, entry: dict[str, object]) -> None:
    """Take in one reportingDescriptor (§3.49)."""
    id = string(entry, "id")
    if not id or id in reading.known:
        return
    more = mapping(entry, "properties")
    summary = _text(mapping(entry, "shortDescription")) or _text(mapping(entry, "fullDescription"))
    help = mapping(entry, "help")
    severity = more.get("security-severity")
    reading.known[id] = Rule(
        id=id,
        summary=summary or string(entry, "name") or id,
        level=_level(mapping(entry, "defaultConfiguration").get("level")) or Level.WARNING,
        help=(string(help, "markdown") or _text(help))[:_LONGEST_TEXT],
        help_uri=string(entry, "helpUri") or None,
        precision=string(more, "precision") if string(more, "precision") in _PRECISIONS else "high",
        tags=strings(more, "tags")[:20],
        deprecated_ids=strings(entry, "deprecatedIds")[:20],
        catalogue=string(more, "catalogueId")[:_LONGEST_ID],
        security_severity=severity if isinstance(severity, str) and _SECURITY_SEVERITY.match(severity) else None,
    )
    messages = mapping(entry, "messageStrings")
    reading.texts[id] = {key: _text(mapping(messages, key)) for key in list(messages)[:100]}


_PRECISIONS = ("very-high", "high", "medium", "low")


def _result(reading: _Reading, value: object) -> Result | None:
    """One result; None if it is no finding of today. Raises ValueError for what it lacks."""
    if not isinstance(value, dict):
        raise ValueError("are not objects")  # noqa: TRY004 - the log's fault, not the caller's
    kind = string(value, "kind")
    if value.get("baselineState") == "absent" or kind in _NO_FINDING:
        return None
    rule = _rule_id(reading, value)
    if not rule:
        raise ValueError("name no rule")
    message = _message(reading, rule, mapping(value, "message"))
    if not message:
        raise ValueError("have no message")
    locations = items(value, "locations")
    if not locations:
        raise ValueError("have no location")
    place = _location(reading, mapping(locations[0]))
    level = _level(value.get("level")) or (
        reading.known[rule].level if value.get("level") is None and rule in reading.known else Level.WARNING
    )
    if value.get("level") == "none" or kind in ("open", "review"):
        level = Level.NOTE
    logical = [mapping(entry) for entry in items(mapping(locations[0]), "logicalLocations")[:_MAX_LOGICAL]]
    more = mapping(value, "properties")
    scope = string(logical[0], "fullyQualifiedName") if logical and logical[0].get("kind") != "rosName" else ""
    graph, edges = traversed(value, reading.graphs)
    names = (string(entry, "fullyQualifiedName") for entry in logical if entry.get("kind") == "rosName")
    return Result(
        tool=reading.tool,
        rule=rule,
        level=level,
        message=message,
        location=place,
        related=_related(reading, value),
        scope=scope,
        value=number(more, "value"),
        limit=number(more, "limit"),
        roles=strings(more, "roles")[:_MAX_LOGICAL],
        subject=tuple(name for name in names if name),
        flow=_flow(reading, value),
        graph=graph,
        edges=edges,
        also=strings(more, "also")[:20],
        identity=_identity(value, more, scope, message, place),
        suppressions=_suppressions(value),
    )


def _rule_id(reading: _Reading, result: dict[str, object]) -> str:
    """§3.27.5–3.27.7: by name, or by position among the rules of the driver or an extension."""
    reference = mapping(result, "rule")
    name = string(result, "ruleId") or string(reference, "id")
    index = natural(result, "ruleIndex")
    index = natural(reference, "index") if index is None else index
    component = natural(mapping(reference, "toolComponent"), "index")
    component = 0 if component is None else component + 1
    if index is not None and component < len(reading.rules) and index < len(reading.rules[component]):
        listed = string(mapping(reading.rules[component][index]), "id")
        if not name or name.startswith(f"{listed}/"):
            name = listed
    return name


def _message(reading: _Reading, rule: str, message: dict[str, object]) -> str:
    """§3.11: the text with its arguments, links replaced by their words."""
    text = _text(message) or reading.texts.get(rule, {}).get(string(message, "id"), "")
    arguments = [value if isinstance(value, str) else "" for value in items(message, "arguments")[:100]]

    def filled(match: re.Match[str]) -> str:
        if match[2]:
            return match[2][0]
        index = int(match[1])
        return arguments[index] if index < len(arguments) else match[0]

    if arguments:
        text = _PLACEHOLDER.sub(filled, text)
    return _ESCAPE.sub(r"\1", _LINK.sub(r"\1", text))[:_LONGEST_TEXT].strip()


def _location(reading: _Reading, location: dict[str, object]) -> Location:
    physical = mapping(location, "physicalLocation")
    path = workspace_path(mapping(physical, "artifactLocation"), reading.artifacts, reading.bases, reading.root)
    region = mapping(physical, "region")
    line = natural(region, "startLine") or None
    if line is None:
        return Location(path)
    column = natural(region, "startColumn") or None
    end = natural(region, "endLine") or None
    return Location(path, line, column, max(end, line) if end else None, natural(region, "endColumn") or None)


def _related(reading: _Reading, result: dict[str, object]) -> tuple[Related, ...]:
    return _places(reading, (*items(result, "locations")[1:_MAX_RELATED], *items(result, "relatedLocations")))


def _flow(reading: _Reading, result: dict[str, object]) -> tuple[Related, ...]:
    """§3.36: the first thread of the first flow."""
    first = mapping(next(iter(items(result, "codeFlows")), None))
    steps = items(mapping(next(iter(items(first, "threadFlows")), None)), "locations")
    return _places(reading, [mapping(step).get("location") for step in map(mapping, steps[:_MAX_RELATED])])


def _places(reading: _Reading, entries: Sequence[object]) -> tuple[Related, ...]:
    """Those of the locations that stand in the workspace, with their messages."""
    found = []
    for entry in map(mapping, entries[:_MAX_RELATED]):
        if (place := _place(reading, entry)) is not None:
            found.append(Related(place, _text(mapping(entry, "message"))))
    return tuple(found)


def _place(reading: _Reading, location: dict[str, object]) -> Location | None:
    try:
        return _location(reading, location)
    except UriError:
        return None


def _identity(
    result: dict[str, object], more: dict[str, object], scope: str, message: str, place: Location
) -> Identity | None:
    """That of a log of our own; None for a foreign one, whose identities come from the files."""
    values = {k: v for k, v in mapping(result, "partialFingerprints").items() if isinstance(v, str) and len(v) <= 100}
    region = mapping(mapping(mapping(next(iter(items(result, "locations")))), "physicalLocation"), "region")
    template = string(more, "template") or message_template(message, keep_names=place.line is None)
    return restore_identity(
        values, scope=scope, template=template.removesuffix("."), snippet=_text(mapping(region, "snippet"))
    )


def _suppressions(result: dict[str, object]) -> tuple[Suppression, ...]:
    """§3.35: those that count; ``underReview`` and ``rejected`` do not."""
    return tuple(
        Suppression(string(entry, "kind") or "external", string(entry, "justification")[:_LONGEST_TEXT])
        for entry in map(mapping, items(result, "suppressions")[:_MAX_RELATED])
        if entry and entry.get("status", "accepted") == "accepted"
    )


def _targets(reading: _Reading) -> frozenset[str]:
    """Artifacts that the log says were analysed (§3.24.6)."""
    found = set()
    for artifact in map(mapping, reading.artifacts[:MAX_RESULTS]):
        if "analysisTarget" in items(artifact, "roles"):
            try:
                found.add(workspace_path(mapping(artifact, "location"), [], reading.bases, reading.root))
            except UriError:
                continue
    return frozenset(found)


def _left_out(reading: _Reading, name: str) -> tuple[Notification, ...]:
    return tuple(
        Notification(
            Level.WARNING, f"{name}: {count} result{'s'[: count > 1]} left out: they {kind}.", tool=reading.tool
        )
        for kind, count in sorted(reading.problems.items())
    )


def _notifications(reading: _Reading, invocations: list[dict[str, object]]) -> tuple[Notification, ...]:
    """§3.20.21: what the tool itself had to say."""
    found: list[Notification] = []
    for invocation in invocations:
        for entry in map(mapping, items(invocation, "toolExecutionNotifications")):
            text = _text(mapping(entry, "message"))
            if text and len(found) < _MAX_NOTIFICATIONS:
                found.append(Notification(_level(entry.get("level")) or Level.WARNING, text, tool=reading.tool))
    return tuple(found)


def _text(message: dict[str, object]) -> str:
    return string(message, "text")[:_LONGEST_TEXT]


def _level(value: object) -> Level | None:
    return next((level for level in Level if level.value == value), None)
