# SPDX-License-Identifier: Apache-2.0
"""From what a query has found to results: where they stand, what they say, what they are about."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from haros_ci.model.location import Location
from haros_ci.query.calls import RosCall
from haros_ci.query.declared import DeclaredQuery
from haros_ci.query.engine import entities_of
from haros_ci.query.links import QueryLink
from haros_ci.query.resources import NodeInstance, QueryParameter, Resource
from haros_ci.query.source import SourceEntity
from haros_ci.query.system import QuerySystem
from haros_ci.query.values import QueryEntity, Value, words
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.results.own import TOOL
from haros_ci.results.result import Related, Result

#: Further places that one result names.
MOST_RELATED = 20
_FIELD = regex(r"\{\{|\}\}|\{(entities|value|n)\}")


@dataclass(frozen=True, slots=True)
class Match:
    """*value* is what the *query* has found in *configuration*; "" outside any."""

    query: DeclaredQuery
    value: Value
    configuration: str = ""


def results(matches: Iterable[Match], elsewhere: Location) -> tuple[Result, ...]:
    """One result for each match; the same one in several configurations is one. What has no place stands *elsewhere*."""
    return tuple(sorted((result for result, _ in grouped(matches, elsewhere)), key=lambda result: result.sort_key))


def grouped(matches: Iterable[Match], elsewhere: Location) -> Iterator[tuple[Result, tuple[Match, ...]]]:
    """Each result with the matches that it tells."""
    found: dict[tuple[object, ...], list[Match]] = {}
    for match in matches:
        entities = entities_of(match.value)
        key = (match.query.id, _message(match), *(place.sort_key for place in places(entities)))
        found.setdefault(key, []).append(match)
    for same in found.values():
        names = list(dict.fromkeys(match.configuration for match in same if match.configuration))
        yield _result(same[0], names, elsewhere), tuple(same)


def _result(match: Match, configurations: list[str], elsewhere: Location) -> Result:
    entities = entities_of(match.value)
    where = places(entities) or (elsewhere,)
    sources = dict.fromkeys(source for entity in entities for source in provenance(entity))
    about = [f"learned from: {', '.join(sources)}"] if sources else []
    if configurations:
        more = f" and {len(configurations) - 1} more" if len(configurations) > 1 else ""
        about.append(f"in {configurations[0]}{more}")
    message = _message(match)
    return Result(
        tool=TOOL,
        rule=match.query.id,
        level=match.query.level,
        message=f"{message} ({'; '.join(about)})" if about else message,
        location=where[0],
        related=_related(entities, where[0]),
        subject=tuple(sorted({name for entity in entities for name in names_of(entity)})),
        roles=tuple(sorted({role(entity) for entity in entities})),
    )


def _message(match: Match) -> str:
    """The user's ``details`` with their fields filled, or what was found, in HAROS's words."""
    entities = entities_of(match.value)
    shown = f"[{', '.join(entity.words() for entity in entities)}]"
    if not match.query.details:
        title = match.query.title if match.query.aliases else "Query"
        return f"{title} found: {words(match.value)}"
    fields = {
        "entities": shown,
        "value": words(match.value) if not entities else "None",
        "n": str(len(entities) or 1),
    }
    return filled(match.query.details, fields)


def filled(details: str, fields: Mapping[str, str]) -> str:
    """*details* with ``{entities}``, ``{value}`` and ``{n}`` replaced; no other field of a format means anything here."""
    return _FIELD.sub(lambda found: fields[found[1]] if found[1] else found[0][0], details)


def places(entities: Iterable[QueryEntity]) -> tuple[Location, ...]:
    """The places of *entities*, the main one of each first."""
    every = [places_of(entity) for entity in entities]
    first = [one[0] for one in every if one]
    return tuple(dict.fromkeys((*first, *(place for one in every for place in one[1:]))))


def places_of(entity: QueryEntity) -> tuple[Location, ...]:
    """Where *entity* stands, the main place first."""
    if isinstance(entity, Resource):
        return entity.places()
    if isinstance(entity, (QueryLink, RosCall, SourceEntity, QuerySystem)):
        return (entity.place,) if entity.place is not None else ()
    place = getattr(entity, "place", None)
    return (place,) if isinstance(place, Location) else ()


def _related(entities: Iterable[QueryEntity], at: Location) -> tuple[Related, ...]:
    """The other entities, and the other ends of a topic, service, action or parameter."""
    found: dict[Location, str] = {}
    for entity in entities:
        own = places_of(entity)
        for place in own[:1]:
            found.setdefault(place, entity.words())
        for link in entity.all_links() if isinstance(entity, Resource) and not isinstance(entity, NodeInstance) else ():
            if link.place is not None:
                found.setdefault(link.place, link.words())
    found.pop(at, None)
    return tuple(Related(place, text) for place, text in list(found.items())[:MOST_RELATED])


def provenance(entity: QueryEntity) -> tuple[str, ...]:
    """Where *entity* was learned: source, launch, hint, known-node, exact-tier."""
    if isinstance(entity, (QueryLink, RosCall)):
        return (entity.end.source,)
    if isinstance(entity, NodeInstance):
        return (entity.made.source,)
    if isinstance(entity, Resource):
        own = (entity.made.source,) if isinstance(entity, QueryParameter) and entity.made is not None else ()
        return tuple(dict.fromkeys((*own, *(link.end.source for link in entity.all_links()))))
    return ()


def names_of(entity: QueryEntity) -> tuple[str, ...]:
    """The names that a result about *entity* is about."""
    if isinstance(entity, QueryLink):
        return (entity.node.full, entity.resource.full)
    if isinstance(entity, Resource):
        return (entity.full,)
    if isinstance(entity, RosCall):
        return (f"{entity.node.package}/{entity.node.type}", entity.name)
    if isinstance(entity, (SourceEntity, QuerySystem)):
        return (entity.id,)
    return (entity.words(),)


def role(entity: QueryEntity) -> str:
    """What *entity* is, apart from names that a user gives."""
    if isinstance(entity, QueryLink):
        return f"{entity.KIND} of {entity.node.type}"
    if isinstance(entity, RosCall):
        return f"{entity.kind} of {entity.node.package}/{entity.node.type}"
    return f"{entity.KIND} {entity.type}" if isinstance(entity, NodeInstance) else entity.KIND
