# SPDX-License-Identifier: Apache-2.0
"""What HAROS's own plug-ins say of a workspace, as runs beside those of the linters (docs/haros-plugins.md)."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from haros_ci import PROJECT_URL
from haros_ci.analysis.architectures import Architectures
from haros_ci.config.selection import Selection
from haros_ci.config.settings import Settings
from haros_ci.model.location import Location
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.results.result import Notification, Related, Result, Run, Tool
from haros_ci.results.rule import Level
from haros_ci.timing import timed

if TYPE_CHECKING:  # loaded where there is a plug-in
    from haros_ci.haros_plugins.manifest import HarosPlugin
    from haros_ci.haros_plugins.run import ByScope, PluginOutput
    from haros_ci.query.queries import Scenes

Progress = Callable[[str], None]
#: Code points of one message.
LONGEST = 2_000


@dataclass(frozen=True, slots=True)
class PluginPlaces:
    """Where what a plug-in reports on stands, by its id, and the paths that there are."""

    scopes: Mapping[str, Location]
    paths: frozenset[str]


@timed("HAROS plug-ins")
def hosted(
    workspace: Workspace,
    selection: Selection,
    architectures: Architectures,
    results: Iterable[Result],
    progress: Progress | None = None,
) -> tuple[Run, ...]:
    """A run for each of HAROS's plug-ins that the settings name and trust; *results* are those of haros-ci, for their processing."""
    settings = architectures.settings
    if not settings.trust_config or not (settings.haros_plugins or settings.plugin_whitelist):
        return ()
    from haros_ci.haros_plugins.chosen import chosen
    from haros_ci.haros_plugins.run import Scene, run
    from haros_ci.query.queries import Scenes

    off = {name for name, linter in settings.linters if linter.enabled is False}
    every = chosen(settings.haros_plugins, settings.plugin_whitelist, settings.plugin_blacklist, settings.root)
    plugins = tuple(plugin for plugin in every if plugin.name not in off)
    if not plugins:
        return ()
    if progress is not None:
        progress("HAROS plug-ins")
    found = architectures.of(workspace).architecture
    scenes = Scenes(found, workspace.files, settings.project)
    files = tuple(file.path for file in workspace.files if file.package and workspace.reports_on(file.path))
    packages = {file.package: None for file in workspace.files if file.package and workspace.reports_on(file.path)}
    timeouts = {name: linter.timeout for name, linter in settings.linters if linter.timeout is not None}
    outputs = run(
        plugins,
        Scene(
            workspace.root, (found, workspace.files, settings.project), tuple(name for name in packages if name), files
        ),
        {plugin.name: timeouts.get(plugin.name, settings.linter_timeout) for plugin in plugins},
        _violations(results, selection, scenes),
        _metrics(workspace, architectures, scenes, plugins),
        Path(settings.plugin_export) if settings.plugin_export else None,
    )
    places = _places(scenes, workspace)
    runs = (_run(output, places, files) for output in outputs)
    return tuple(_asked(output, run, found, workspace, settings) for output, run in zip(outputs, runs, strict=True))


def _places(scenes: Scenes, workspace: Workspace) -> PluginPlaces:
    world = scenes.world
    entities: list[Any] = [*world.files.values(), *world.packages.values(), *scenes.systems]
    return PluginPlaces(
        {entity.id: entity.place for entity in entities if entity.place is not None},
        frozenset(file.path for file in workspace.files),
    )


def _run(output: PluginOutput, places: PluginPlaces, files: tuple[str, ...]) -> Run:
    """What a plug-in has said as a run. A failed one keeps its results, and has analysed nothing for certain."""
    plugin = output.plugin
    notes = [
        Notification(Level.ERROR if level == "error" else Level.WARNING, text, plugin.name)
        for level, text in output.logged
    ]
    notes += [Notification(Level.ERROR, f"the plug-in {text}", plugin.name) for text in output.failures]
    results, lost = [], 0
    for data in output.violations:
        result = _result(plugin, data, places)
        if result is None:
            lost += 1
        else:
            results.append(result)
    if lost:
        text = f"{lost} things that it reports stand nowhere in the workspace and are left out"
        notes.append(Notification(Level.WARNING, text, plugin.name))
    return Run(
        Tool(plugin.name, plugin.version, PROJECT_URL, f"{plugin.name} {plugin.version} (a plug-in of HAROS)"),
        results=tuple(sorted(dict.fromkeys(results), key=lambda result: result.sort_key)),
        notifications=tuple(dict.fromkeys(notes)),
        analysed=frozenset() if output.failures else frozenset(files),
        successful=not output.failures,
        architecture=not output.failures,
    )


def _result(plugin: HarosPlugin, data: Mapping[str, Any], places: PluginPlaces) -> Result | None:
    """One violation as a result; None for what stands nowhere."""
    scope = places.scopes.get(str(data.get("scope")))
    if scope is None:
        return None
    resources = [item for item in data.get("resources") or () if isinstance(item, Mapping)]
    where = [
        (place, str(resource.get("words")))
        for resource in resources
        if (place := _location(resource, places)) is not None
    ]
    line = data.get("line")
    at = where[0][0] if where else replace(scope, line=line if type(line) is int and line >= 1 else scope.line)
    configuration = str(data["scope"]).partition("configuration:")[2]
    named = {name for resource in resources for name in resource.get("names") or () if isinstance(name, str)}
    names = tuple(sorted(named)) or ((configuration,) if configuration else ())
    message = " ".join(re.sub(r"<br\s*/?>", " ", str(data.get("message"))).split())[:LONGEST].rstrip(". ")
    message = message or f"the rule {data['rule']} is broken"
    return Result(
        tool=plugin.name,
        rule=str(data["rule"]),
        level=Level.WARNING,
        message=message + (f"; in {configuration}" if configuration else ""),
        location=at,
        related=tuple(Related(place, text) for place, text in dict.fromkeys(where[1:]) if place != at),
        scope="::".join(part for part in (str(data.get("class") or ""), str(data.get("function") or "")) if part),
        subject=names,
    )


def _location(resource: Mapping[str, Any], places: PluginPlaces) -> Location | None:
    path, line, column = (resource.get(key) for key in ("path", "line", "column"))
    numbers = [number if type(number) is int and number >= 1 else None for number in (line, column)]
    return Location(path, *numbers) if isinstance(path, str) and path in places.paths else None


def _asked(output: PluginOutput, run: Run, found: Any, workspace: Workspace, settings: Settings) -> Run:
    """*run* with the matches of those rules of the plug-in that are queries, as HAROS asks them."""
    if not output.plugin.queries:
        return run
    from haros_ci.query import queries

    declared = {"rules": dict(output.plugin.queries)}
    answers = queries.run(found, declared, f"plugin.yaml of {output.plugin.name}", workspace.files)
    results = (
        replace(result, tool=run.tool.name, rule=result.rule.removeprefix("user:")) for result in answers.results
    )
    return replace(
        run,
        results=tuple(sorted((*run.results, *results), key=lambda result: result.sort_key)),
        notifications=(
            *run.notifications,
            *(replace(note, tool=run.tool.name, path=None) for note in answers.notifications),
        ),
        successful=run.successful and not answers.failed,
    )


# -- what haros-ci itself has found, for the hooks of processing --------------------------------------------------


def _violations(results: Iterable[Result], selection: Selection, scenes: Scenes) -> ByScope:
    """Results by the id of the file that they stand in, with HAROS's id of the rule where it has one."""
    found: dict[str, list[dict[str, Any]]] = {}
    for result in results:
        file = scenes.world.files.get(result.location.path)
        if file is None:
            continue
        rule = selection.rule(result.tool, result.rule)
        data = {"rule": next((alias for alias in rule.aliases if "_" in alias), result.full_id), "name": rule.summary}
        data |= {"description": rule.help, "message": result.message, "function": result.scope, "class": ""}
        found.setdefault(file.id, []).append({**data, "tags": list(rule.tags), "line": result.location.line})
    return found


def _metrics(
    workspace: Workspace, architectures: Architectures, scenes: Scenes, plugins: Iterable[HarosPlugin]
) -> ByScope:
    """The values of all metrics by the id of file or package, if a plug-in wants any."""
    if not any(
        hook in ("*", "process_file_metric", "process_package_metric") for plugin in plugins for hook in plugin.hooks
    ):
        return {}
    from haros_ci.measuring.measures import measured

    found: dict[str, list[dict[str, Any]]] = {}
    for value in measured(workspace, architectures.settings, architectures.store):
        place = scenes.world.files.get(value.path) if value.path else scenes.world.packages.get(value.package)
        if place is not None:
            data = {"metric": value.metric.replace("-", "_"), "value": value.value, "line": value.line or None}
            found.setdefault(place.id, []).append({**data, "function": value.function, "class": value.class_name})
    return found
