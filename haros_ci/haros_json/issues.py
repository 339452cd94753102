# SPDX-License-Identifier: Apache-2.0
"""``compliance/``: each finding with its package, with its configuration, or with neither; and what it is about."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from haros_ci.haros_json.places import JsonPlaces
from haros_ci.haros_json.rules import RuleTable
from haros_ci.haros_json.systems import Object, Shown
from haros_ci.haros_json.texts import paragraphs, words
from haros_ci.model.location import Location
from haros_ci.query.engine import entities_of
from haros_ci.query.findings import Match
from haros_ci.query.links import QueryLink
from haros_ci.query.resources import Resource
from haros_ci.records import dataclass, field
from haros_ci.report.message import plain
from haros_ci.results.counted import is_set_aside
from haros_ci.results.result import BaselineState, Result

#: The kinds of the ids of a graph's vertices, in the order in which a bare name is looked for.
KINDS = ("node", "topic", "service", "action", "param")


@dataclass(frozen=True, slots=True)
class Issues:
    """The findings in HAROS's places: by the id of a package, by that of a configuration, and the others.

    *queries* are, by configuration, those that are about something in it, with what that is.
    """

    source: dict[str, list[dict[str, Any]]] = field(default_factory=dict)
    runtime: dict[str, list[dict[str, Any]]] = field(default_factory=dict)
    other: list[dict[str, Any]] = field(default_factory=list)
    queries: dict[str, list[dict[str, Any]]] = field(default_factory=dict)


#: What tells the finding of a query in a report: its rule, message and place.
Asking = tuple[str, str, Location]


def asking(result: Result) -> Asking:
    return (result.rule, result.message, result.location)


def is_there(result: Result) -> bool:
    """Whether *result* is there now: not suppressed, not gone since the baseline. What the baseline knows is there, too."""
    return not is_set_aside(result) and result.state is not BaselineState.ABSENT


def issues(
    results: Iterable[Result],
    systems: Sequence[Shown],
    matches: Mapping[Asking, Sequence[Match]],
    places: JsonPlaces,
    rules: RuleTable,
) -> Issues:
    """*results* in HAROS's places. Those of *matches* are in every configuration that their query has found them in."""
    made = Issues()
    shown = {system.system.made.name: system for system in systems}
    for result in results:
        found = list(_in_configurations(result, shown, matches))
        for system, objects in found:
            issue = _issue(result, places, rules)
            issue["location"] = {"configuration": system.id, **issue["location"]}
            issue["resources"] = [object_.of_issue() for object_ in objects]
            made.runtime.setdefault(system.id, []).append(issue)
            if objects:
                queries = made.queries.setdefault(system.id, [])
                queries.append(
                    {
                        "qid": len(queries),
                        "rule": issue["rule"],
                        "name": words(result.full_id if not result.rule.startswith("user:") else result.rule),
                        "objects": [object_.of_query() for object_ in objects],
                    }
                )
        if not found:
            issue = _issue(result, places, rules)
            package = issue["location"]["package"]
            (made.other if package is None else made.source.setdefault(package, [])).append(issue)
    return made


def _issue(result: Result, places: JsonPlaces, rules: RuleTable) -> dict[str, Any]:
    scope = result.scope or (result.identity.scope if result.identity is not None else "")
    return {
        "rule": rules.id(result.full_id),
        "comment": paragraphs(plain(result), f"Also: {', '.join(result.also)}" if result.also else ""),
        "location": places.location(result.location, function=scope or None),
        "resources": [],
    }


def _in_configurations(
    result: Result, shown: Mapping[str, Shown], matches: Mapping[Asking, Sequence[Match]]
) -> Iterator[tuple[Shown, list[Object]]]:
    """The configurations in which *result* has been found, with what it is about there."""
    by_name: dict[str, dict[Object, None]] = {}
    for match in matches.get(asking(result), ()):
        if match.configuration in shown:
            objects = by_name.setdefault(match.configuration, {})
            for entity in entities_of(match.value):
                if isinstance(entity, (Resource, QueryLink)):
                    objects.update(_known(shown[match.configuration].object(entity)))
    if not by_name and result.graph in shown:
        by_name[result.graph] = _of_check(result, shown[result.graph])
    for name, objects in by_name.items():
        yield shown[name], list(objects)


def _of_check(result: Result, shown: Shown) -> dict[Object, None]:
    """What a check's finding is about: the ends of its edges, the edges, and what else it names."""
    found: dict[Object, None] = {}
    links: dict[Object, None] = {}
    named = set()
    for edge in result.edges:
        ends = [shown.by_name.get((kind, name)) for kind, _, name in (id.partition(":") for id in edge)]
        named |= {id.partition(":")[2] for id in edge}
        for end in ends:
            found.update(_known(shown.object(end)) if end is not None else ())
        first, second = ends
        if first is None or second is None:
            continue
        node, resource = (first, second) if first.TYPE == "node" else (second, first)
        link = next((link for link in resource.all_links() if link.node is node), None)
        links.update(_known(shown.object(link)) if link is not None else ())
    for name in result.subject:
        one = next((shown.by_name[kind, name] for kind in KINDS if (kind, name) in shown.by_name), None)
        if one is not None and name not in named:
            found.update(_known(shown.object(one)))
    return {**found, **links}


def _known(one: Object | None) -> dict[Object, None]:
    return {} if one is None else {one: None}
