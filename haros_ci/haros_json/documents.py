# SPDX-License-Identifier: Apache-2.0
"""All files of the folder that HAROS's visualizer reads: what it asks for by name, made of one run."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from typing import Any

from haros_ci.haros_json.issues import Asking, Issues, asking, is_there, issues
from haros_ci.haros_json.names import safe, unique
from haros_ci.haros_json.packages import measurement_json, needed, package_json
from haros_ci.haros_json.places import JsonPlaces
from haros_ci.haros_json.rules import Named, RuleTable, metrics_json
from haros_ci.haros_json.summary import HISTORY, MOST_POINTS, nodes_of, points_of, summary_json, with_history
from haros_ci.haros_json.systems import Shown
from haros_ci.haros_json.texts import name
from haros_ci.model.architecture import Architecture
from haros_ci.model.build import Build
from haros_ci.model.location import Location
from haros_ci.model.manifest import Manifest
from haros_ci.model.measurement import Measurement
from haros_ci.model.package import Package, SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.query.findings import Match, grouped
from haros_ci.query.queries import Scenes
from haros_ci.query.queries import run as ask
from haros_ci.query.system import QuerySystem
from haros_ci.records import dataclass, field
from haros_ci.results.copied import together
from haros_ci.results.result import Report, Result
from haros_ci.results.rule import Rule

#: Where the projects of a folder are listed.
PROJECTS = "projects.json"
#: What a project's directory says of the project as a whole.
SUMMARY = "summary.json"
DEFAULT = "default"


@dataclass(frozen=True, slots=True, kw_only=True)
class Input:
    """The data that the folder is made from.

    *project* is the project file as plain data and *where* its name; *rules_on* how many rules are on, of them *user_rules* the
    project's own; *scopes* are those of rules by ``tool:id``; *timestamp* is the revision's, None where there is none.
    """

    report: Report
    workspace: Workspace
    architecture: Architecture
    builds: Mapping[str, Build] = field(default_factory=dict)
    manifests: Mapping[str, Manifest] = field(default_factory=dict)
    measurements: Sequence[Measurement] = ()
    documented: Iterable[Named] = ()
    scopes: Mapping[str, str] = field(default_factory=dict)
    queries: Mapping[str, str] = field(default_factory=dict)
    rules_on: int = 0
    user_rules: int = 0
    project: Mapping[str, Any] = field(default_factory=dict)
    where: str = "the project file"
    timestamp: str | None = None


def documents(inputs: Input) -> dict[str, str]:
    """The files by their path in the folder, ``projects.json`` last: the text of each is the same for the same input."""
    workspace = inputs.workspace
    places = JsonPlaces(workspace.packages)
    project = project_id(inputs.project)
    results = [result for result in inputs.report.results if is_there(result)]
    shown = _packages(workspace, places, results)
    files = _files(workspace, places, shown)

    @cache
    def sloc(path: str) -> int:
        return sum(not line.isspace() for line in workspace.text(path).splitlines() if line)

    rules = RuleTable(_rules(inputs.report, results), inputs.documented, inputs.scopes, inputs.queries)
    scenes = Scenes(inputs.architecture, workspace.files, inputs.project)
    systems = _systems(inputs.architecture, scenes, places)
    found = issues(results, systems, _matches(inputs, scenes, results), places, rules)
    environment = _environment(inputs.project)
    configurations = [
        system.json(found.queries.get(system.id, ()), environment.get(system.system.made.name, ()), sloc)
        for system in systems
    ]
    measured = _measured(inputs.measurements, places, shown)
    texts = {
        "packages.json": _text(
            package_json(
                package,
                inputs.manifests.get(package.path, Manifest()),
                files[package.path],
                found.source.get(places.ids[package.path], ()),
                measured[package.path],
                places,
                sloc,
            )
            for package in shown
        ),
        "rules.json": _text(rules.json()),
        "metrics.json": _text(metrics_json()),
        "configurations.json": _text(configurations),
        **_compliance(found, [places.ids[one.path] for one in shown], [system.id for system in systems]),
        **{
            f"metrics/{places.ids[path]}.json": _text(measurement_json(one, places) for one in every)
            for path, every in measured.items()
        },
        SUMMARY: _indented(_summary(inputs, places, results, shown, files, rules, configurations, measured)),
    }
    entry = _entry(inputs.project, project, [places.ids[one.path] for one in shown])
    return {**{f"{project}/{path}": text for path, text in sorted(texts.items())}, PROJECTS: _text([entry])}


def _files(workspace: Workspace, places: JsonPlaces, shown: Sequence[Package]) -> dict[str, list[SourceFile]]:
    """The files of each package, by its path."""
    files: dict[str, list[SourceFile]] = {one.path: [] for one in shown}
    for file in workspace.files:
        home = places.home(file.path)
        if home is not None and home in files:
            files[home].append(file)
    return files


def _measured(
    measurements: Iterable[Measurement], places: JsonPlaces, shown: Sequence[Package]
) -> dict[str, list[Measurement]]:
    """The measurements of each package, by its path."""
    measured: dict[str, list[Measurement]] = {one.path: [] for one in shown}
    paths = {one.name: one.path for one in reversed(shown)}
    for one in sorted(measurements):
        home = places.home(one.path) if one.path else paths.get(one.package or "")
        if home in measured:
            measured[home].append(one)
    return measured


def _summary(
    inputs: Input,
    places: JsonPlaces,
    results: Sequence[Result],
    shown: Sequence[Package],
    files: Mapping[str, Sequence[SourceFile]],
    rules: RuleTable,
    configurations: Sequence[Mapping[str, Any]],
    measured: Mapping[str, Sequence[Measurement]],
) -> Mapping[str, Any]:
    names = {one.name for one in shown}
    return summary_json(
        packages=len(shown),
        files=[(places.split(file.path)[1], file) for every in files.values() for file in every],
        dependencies=len(frozenset().union(*map(needed, shown)) - {one.name for one in inputs.workspace.packages}),
        nodes=nodes_of(build for key, build in inputs.builds.items() if key in names),
        systems=configurations,
        tags=[rules.tags(result.full_id) for result in _joined(inputs)],
        violated=len({result.full_id for result in results}),
        tools=len(inputs.report.runs),
        rules=inputs.rules_on,
        user_rules=inputs.user_rules,
        measurements=[one for every in measured.values() for one in every],
        timestamp=inputs.timestamp,
    )


def _joined(inputs: Input) -> list[Result]:
    """The findings as every report that a person reads counts them: the same in copies of one text is one."""
    package = inputs.workspace.package_finder()
    report = together(inputs.report, inputs.workspace.text, lambda path: package(path) or "")
    return [result for result in report.results if is_there(result)]


def _entry(project: Mapping[str, Any], id: str, packages: Sequence[str]) -> dict[str, Any]:
    """The project's entry in the list of projects."""
    repositories = project.get("repositories")
    return {
        "id": id,
        "packages": packages,
        "repositories": sorted(name(str(one)) for one in repositories) if isinstance(repositories, Mapping) else [],
    }


def added(files: Mapping[str, str], before: Callable[[str], str | None]) -> dict[str, str]:
    """*files* with what a folder is to keep of the same files *before*: other projects, and the history of this one.

    ValueError if the file is not a list of projects.
    """
    (mine,) = json.loads(files[PROJECTS])
    summary = f"{mine['id']}/{SUMMARY}"
    return {
        **files,
        summary: _with_history(files[summary], before(summary)),
        PROJECTS: _with_others(mine, before(PROJECTS)),
    }


def project_id(project: Mapping[str, Any]) -> str:
    """The name of a project's directory in the folder, by its project file."""
    return safe(str(project.get("project") or DEFAULT))


def history_of(project: Mapping[str, Any], read: Callable[[str], str | None]) -> tuple[tuple[str | float, ...], ...]:
    """The history that a folder has of a project, by time, each point in the order of ``HISTORY``; () for none, or what is none.

    *read* gives the text of a file of the folder, None if there is none.
    """
    try:
        points = points_of(json.loads(read(f"{project_id(project)}/{SUMMARY}") or "null"))
    except (ValueError, RecursionError):
        return ()
    rows = {tuple(point[key] for key in HISTORY) for point in points}
    return tuple(sorted(rows)[-MOST_POINTS:])


def _with_history(own: str, before: str | None) -> str:
    try:
        past = json.loads(before or "null")
    except (ValueError, RecursionError):
        return own
    return _indented(with_history(json.loads(own), past))


def _with_others(mine: Mapping[str, Any], before: str | None) -> str:
    try:
        others = json.loads(before or "[]")
    except RecursionError as err:
        raise ValueError("too deep") from err
    if not isinstance(others, list) or not all(isinstance(one, dict) for one in others):
        raise ValueError("not a list of projects")
    at = next((n for n, one in enumerate(others) if one.get("id") == mine["id"]), None)
    return _text([*others, mine] if at is None else [*others[:at], mine, *others[at + 1 :]])


def _packages(workspace: Workspace, places: JsonPlaces, results: Iterable[Result]) -> list[Package]:
    """The packages that the run is about: all, or those with a file that it reports on."""
    if workspace.targets is None:
        return list(places.packages)
    homes = {places.home(path) for path in workspace.targets} | {places.home(one.location.path) for one in results}
    return [one for one in places.packages if one.path in homes]


def _rules(report: Report, results: Iterable[Result]) -> dict[str, Named]:
    """The rules of *results* by ``tool:id``."""
    known = {f"{run.tool.name}:{rule.id}": (run.tool.name, rule) for run in report.runs for rule in run.rules}
    return {one.full_id: known.get(one.full_id, (one.tool, Rule(one.rule, ""))) for one in results}


def _systems(architecture: Architecture, scenes: Scenes, places: JsonPlaces) -> list[Shown]:
    empty = (
        QuerySystem(one, scenes.world) for one in architecture.configurations if not one.nodes
    )  # no query sees them
    named = sorted((*scenes.systems, *empty), key=lambda system: (system.made.name, system.made.launch))
    keys = [(system.made.name, str(number)) for number, system in enumerate(named)]
    ids = unique(keys)
    return [Shown(system, ids[key], places) for system, key in zip(named, keys, strict=True)]


def _matches(inputs: Input, scenes: Scenes, results: Sequence[Result]) -> dict[Asking, tuple[Match, ...]]:
    """What the queries of *results* have found, by finding."""
    rules = {result.rule for result in results if result.full_id in inputs.queries}
    if not rules:
        return {}
    answers = ask(
        inputs.architecture,
        inputs.project,
        inputs.where,
        inputs.workspace.files,
        is_selected=lambda rule: rule.id in rules,
        scenes=scenes,
    )
    return {asking(result): matches for result, matches in grouped(answers.matches, Location(inputs.where))}


def _environment(project: Mapping[str, Any]) -> dict[str, list[str]]:
    """The names of the environment variables that the project file sets, by configuration."""
    declared = project.get("configurations")
    found = {}
    for key, entry in declared.items() if isinstance(declared, Mapping) else ():
        environment = entry.get("environment") if isinstance(entry, Mapping) else None
        found[str(key)] = sorted(map(str, environment)) if isinstance(environment, Mapping) else []
    return found


def _compliance(found: Issues, packages: Iterable[str], systems: Iterable[str]) -> dict[str, str]:
    return {
        "compliance/unknown.json": _text(found.other),
        **{f"compliance/source/{id}.json": _text(found.source.get(id, ())) for id in packages},
        **{f"compliance/runtime/{id}.json": _text(found.runtime.get(id, ())) for id in systems},
    }


def _text(items: Iterable[Any]) -> str:
    """A list, one item a line."""
    lines = [json.dumps(item, allow_nan=False, separators=(",", ":")) for item in items]
    return "[\n" + ",\n".join(lines) + "\n]\n" if lines else "[]\n"


def _indented(value: Any) -> str:
    return json.dumps(value, allow_nan=False, indent=1) + "\n"
