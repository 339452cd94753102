# SPDX-License-Identifier: Apache-2.0
"""Evaluates all queries of a project file on an architecture: their rules, results and notifications."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from haros_ci.model.architecture import LIBRARY, Architecture
from haros_ci.model.location import Location
from haros_ci.model.package import SourceFile
from haros_ci.query.declared import DeclaredQuery, declared
from haros_ci.query.engine import Query
from haros_ci.query.fault import QueryError
from haros_ci.query.findings import Match, results
from haros_ci.query.machine import STEPS
from haros_ci.query.source import SourceModel
from haros_ci.query.system import QuerySystem
from haros_ci.query.values import QueryList, Value
from haros_ci.records import dataclass
from haros_ci.results.own import FAILED_QUERY, TOOL
from haros_ci.results.result import Notification, Result
from haros_ci.results.rule import Level, Rule

#: Steps that all queries of a run may take together.
ALL_STEPS = 50_000_000
#: Matches of one query that are reported.
MOST_MATCHES = 2_000

#: The variables of each scope; of ``configuration``, those after ``parameters`` are ours. ``c`` is ``config`` by the name that it has in
#: HAROS's own tutorials (``haros_tutorials/projects/queries.yaml``).
VARIABLES = {
    "global": ("files", "packages", "nodes", "configs"),
    "package": ("package", "files", "nodes"),
    "configuration": (
        "config", "c", "nodes", "topics", "services", "parameters", "actions", "files", "packages", "configs",
    ),
}  # fmt: skip
Variables = dict[str, Value]


@dataclass(frozen=True, slots=True)
class QueryOutcome:
    """What the queries gave. *failed* are the ids of those that could not be read or evaluated, of which the *results* say why.

    *matches* are what the *results* tell of.
    """

    rules: tuple[Rule, ...] = ()
    results: tuple[Result, ...] = ()
    notifications: tuple[Notification, ...] = ()
    failed: tuple[str, ...] = ()
    matches: tuple[Match, ...] = ()


def run(
    found: Architecture,
    project: Mapping[str, Any],
    where: str,
    files: Iterable[SourceFile] = (),
    *,
    is_selected: Callable[[Rule], bool] = lambda rule: True,
    scenes: Scenes | None = None,
) -> QueryOutcome:
    """Evaluate those queries of the *project* file (named *where*) whose rule *is_selected*, on the architecture *found*.

    A query that is wrong is a result of its own and stops no other; what is no query at all is an error notification. *scenes* are those of *found*, if they have been made.
    """
    every, problems = declared(project)
    chosen = [query for query in every if is_selected(query.rule())]
    notifications = [Notification(Level.ERROR, text, TOOL, where, configuration=True) for text in problems]
    matches: list[Match] = []
    failed = []
    faults: list[Result] = []
    scenes = scenes or (Scenes(found, files, project) if chosen else None)
    left = ALL_STEPS
    for query in chosen:
        assert scenes is not None
        own: list[Match] = []
        compiled: Query | None = None
        try:
            compiled = Query(query.text, VARIABLES[query.scope], min(STEPS, left))
            for configuration, variables in scenes.of(query.scope, query.configurations):
                own += (Match(query, value, configuration) for value in compiled.matches(variables))
        except QueryError as err:
            failed.append(query.id)
            faults.append(_fault(query, err, where))
        left -= compiled.taken if compiled is not None else 0
        if len(own) > MOST_MATCHES:
            text = f"{query.id} has {len(own)} matches; the first {MOST_MATCHES} are reported"
            notifications.append(Notification(Level.WARNING, text, TOOL, where, configuration=True))
        matches += own[:MOST_MATCHES]
        notifications += _notes(query, compiled, where)
    return QueryOutcome(
        rules=tuple(query.rule() for query in every),
        results=(*results(matches, Location(where)), *faults),
        notifications=tuple(notifications),
        failed=tuple(failed),
        matches=tuple(matches),
    )


class Scenes:
    """The variables of queries: everything of the workspace, each package, each configuration."""

    def __init__(self, found: Architecture, files: Iterable[SourceFile], project: Mapping[str, Any]) -> None:
        systems = [one for one in found.configurations if not all(node.kind == LIBRARY for node in one.nodes)]
        self.world = SourceModel(found.packages, files, systems)
        entries = project.get("configurations")
        self.systems = tuple(QuerySystem(one, self.world, _properties(entries, one.name)) for one in systems)
        self.world.systems = self.systems

    def of(self, scope: str, names: Iterable[str] | None = None) -> Iterator[tuple[str, Variables]]:
        """The name of a configuration ("" outside any) and the variables, one after the other; of *names*, if there are any."""
        world = self.world
        everything = {
            "files": QueryList.of(world.files.values(), True),
            "packages": QueryList.of(world.packages.values(), True),
            "nodes": QueryList.of(world.nodes.values(), True),
            "configs": QueryList.of(self.systems, True),
        }
        if scope == "global":
            yield "", everything
        elif scope == "package":
            for package in world.packages.values():
                yield "", {"package": package, "files": package.source_files, "nodes": package.nodes}
        else:
            chosen = None if names is None else set(names)
            for system in self.systems:
                if chosen is None or system.name in chosen:
                    own = ("nodes", "topics", "services", "parameters", "actions")
                    parts = {name: system.part(name) for name in own}
                    yield system.name, {**everything, "config": system, "c": system, **parts}


def _properties(entries: object, name: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The HPL properties and assumptions of a configuration, as text."""
    entry = entries.get(name) if isinstance(entries, Mapping) else None
    hpl = entry.get("hpl") if isinstance(entry, Mapping) else None
    found = []
    for key in ("properties", "assumptions"):
        items = hpl.get(key) if isinstance(hpl, Mapping) else None
        found.append(tuple(str(item)[:10_000] for item in items[:1000]) if isinstance(items, list) else ())
    return found[0], found[1]


def _fault(query: DeclaredQuery, err: QueryError, where: str) -> Result:
    text = f"The query {query.id} ({query.place}) has no result: {err.explained(query.text)}"
    return Result(TOOL, FAILED_QUERY.id, FAILED_QUERY.level, text, Location(where))


def _notes(query: DeclaredQuery, compiled: Query | None, where: str) -> Iterator[Notification]:
    for at, text in compiled.notes() if compiled is not None else ():
        message = QueryError(text, at).explained(query.text)
        yield Notification(Level.NOTE, f"the query {query.id}: {message}", TOOL, where, configuration=True)
