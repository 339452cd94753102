# SPDX-License-Identifier: Apache-2.0
"""``haros-ci query``: what one query finds in the architecture, match by match."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import click

from haros_ci.analysis.architecture import architecture
from haros_ci.analysis.requested import chosen
from haros_ci.baselines import read_input
from haros_ci.commands.common import cores, settings_from, store_for
from haros_ci.commands.model import assignment, selected, tell
from haros_ci.errors import UserError
from haros_ci.query.engine import Query, entities_of
from haros_ci.query.fault import QueryError, place
from haros_ci.query.findings import names_of, places_of, provenance
from haros_ci.query.queries import VARIABLES, Scenes
from haros_ci.query.values import QueryEntity, QueryList, QueryPair, QueryRecord, Value, words
from haros_ci.report.escape import json_document, log_line, terminal
from haros_ci.workspace.discover import discover


def query(flags: Mapping[str, Any]) -> int:
    """Extract, link, ask, print; exit code 1 if there are matches and ``--fail-on-match`` is given, 2 for a wrong query, else 0."""
    text, paths = asked_text(flags)
    names = VARIABLES[flags["scope"]]
    try:
        question = Query(text, names)  # before the work, so that a mistake is reported at once
    except QueryError as err:
        raise wrong(text, err) from None
    settings = settings_from({**flags, "paths": paths, "no_baseline": True})
    workspace = discover(settings.root, settings.paths, exclude=settings.exclude, max_file_size=settings.max_file_size)
    store = store_for(settings)
    arguments = dict(assignment(item, "--arg", ":=") for item in flags["arg"])
    launches = chosen(workspace, flags["launch"], arguments, "command line") if flags["launch"] else None
    if arguments and launches is None:
        raise UserError("--arg is for the launch files of --launch", help="name them: --launch package/launch/x.launch")
    found = architecture(workspace, settings, store, requested=launches, processes=cores())
    if problem := store.flush():
        click.echo(f"warning: {problem}", err=True)
    found = selected(found, flags["configuration"])
    tell(tuple(dict.fromkeys((*workspace.problems, *workspace.faults, *found.problems))))
    scenes = Scenes(found, workspace.files, settings.project)
    matches = list(matches_of(question, scenes, flags["scope"]))
    for at, message in question.notes():
        click.echo(f"note: {terminal(QueryError(message, at).explained(text))}", err=True)
    show(matches, flags["format"])
    return 1 if matches and flags["fail_on_match"] else 0


def asked_text(flags: Mapping[str, Any]) -> tuple[str, tuple[str, ...]]:
    """The query, and the paths: with ``--file`` all arguments are paths."""
    paths = tuple(flags["paths"])
    if flags["file"] is None:
        if flags["text"] is None:
            raise UserError("no query", help="write it in quotes, as 'topics[self.is_disconnected]', or in a --file")
        return flags["text"], paths
    data = read_input(Path(flags["file"]), flags["file"])
    text = data.decode("utf-8", "replace") if isinstance(data, bytes) else data
    return text, (flags["text"], *paths) if flags["text"] is not None else paths


def matches_of(question: Query, scenes: Scenes, scope: str) -> Iterator[tuple[str, Value]]:
    """The matches, each with the name of its configuration; UserError if the query is wrong."""
    try:
        for configuration, variables in scenes.of(scope):
            for match in question.matches(variables):
                yield configuration, match
    except QueryError as err:
        raise wrong(question.text, err) from None


def wrong(text: str, err: QueryError) -> UserError:
    """The error, after the line of the query that it is in, with a mark below the place."""
    line, column = place(text, err.at)
    shown = (text.splitlines() or [""])[min(line, len(text.splitlines()) or 1) - 1]
    start = max(0, column - 60)
    part = shown[start : start + 100].replace("\t", " ")
    click.echo(f"  {terminal(part)}", err=True)
    click.echo(f"  {' ' * (column - 1 - start)}^", err=True)
    return UserError(f"query, line {line}, column {column}: {err.message}", help=err.help or None)


def show(matches: list[tuple[str, Value]], format: str) -> None:
    """Print *matches*, one a line, or as JSON."""
    if format == "json":
        found = [
            {"configuration": name, "match": as_json(match)} if name else {"match": as_json(match)}
            for name, match in matches
        ]
        click.echo(json_document(found, 2))
        return
    for name, match in matches:
        spots = [spot for entity in entities_of(match) for spot in places_of(entity)[:1]]
        at = f"{spots[0]}: " if spots else ""
        click.echo(log_line(f"{at}{words(match)}{f' [{name}]' if name else ''}"))


def as_json(value: Value) -> Any:
    """A value as JSON; an entity with its kind, its words, its names, where it stands and where it was learned."""
    if isinstance(value, QueryEntity):
        data: dict[str, Any] = {"kind": value.KIND, "text": value.words(), "names": list(names_of(value))}
        spots = places_of(value)
        if spots:
            data["location"] = {"path": spots[0].path, "line": spots[0].line, "column": spots[0].column}
        if learned := provenance(value):
            data["source"] = list(learned)
        return data
    if value.__class__ is QueryList:
        return [as_json(item) for item in value]
    if value.__class__ is QueryRecord:
        return {key if isinstance(key, str) else words(key): as_json(item) for key, item in value.items()}
    if value.__class__ is QueryPair:
        return {"key": as_json(value.key), "value": as_json(value.value)}
    if isinstance(value, float) and value - value != 0:
        return None  # neither infinity nor NaN is JSON
    if value is None or isinstance(value, (bool, int, float)):
        return value
    return str(value) if isinstance(value, str) else words(value)
