# SPDX-License-Identifier: Apache-2.0
"""The queries of a project file, each as a rule of its own.

Two places, as in HAROS: ``rules`` with a ``query`` (``data.py:HarosDatabase.register_rules``), and ``user_data`` of a
configuration under ``haros_plugin_pyflwor`` (that plug-in's ``plugin.py``). Keys that HAROS does not have: ``level`` in both,
``id`` and ``tags`` in the second.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from hashlib import sha256
from typing import Any

from haros_ci.query.fault import QueryError, short
from haros_ci.query.tokens import tokens
from haros_ci.records import dataclass
from haros_ci.results.rule import Level, Rule

PLUGIN = "haros_plugin_pyflwor"
#: What HAROS calls every query of a configuration.
PLUGIN_RULE = f"{PLUGIN}:query"
PLUGIN_TAGS = ("code-standards", "query", "pyflwor", "computation-graph")
SCOPES = ("global", "package", "configuration")
#: A user's own rules are on wherever the settings do not turn them off.
PROFILES = ("ros", "strict", "google", "bugs-only", "architecture")
MOST_QUERIES = 500
LONGEST_DETAILS = 1000


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclaredQuery:
    """One query: *configurations* are those that it is asked of, None for all; *place* is its key in the project file."""

    id: str
    title: str
    text: str
    scope: str
    place: str
    level: Level = Level.WARNING
    description: str = ""
    details: str = ""
    tags: tuple[str, ...] = ()
    aliases: tuple[str, ...] = ()
    configurations: tuple[str, ...] | None = None

    def rule(self) -> Rule:
        """The rule of its results."""
        return Rule(
            id=self.id,
            summary=self.title,
            level=self.level,
            help="\n\n".join(part for part in (self.description, self.text.strip()) if part),
            profiles=PROFILES,
            tags=tuple(dict.fromkeys(("query", *self.tags))),
            aliases=self.aliases,
        )


def declared(project: Mapping[str, Any]) -> tuple[tuple[DeclaredQuery, ...], tuple[str, ...]]:
    """The queries of a project file, in its order; and sentences on what cannot be one."""
    problems: list[str] = []
    found = [*_of_rules(project.get("rules"), problems), *_of_configurations(project.get("configurations"), problems)]
    if len(found) > MOST_QUERIES:
        problems.append(f"more than {MOST_QUERIES} queries; those after them are not asked")
    return tuple(_distinct(found[:MOST_QUERIES])), tuple(problems)


def rules(project: Mapping[str, Any]) -> dict[str, Rule]:
    """The rules of all queries of a project file, by id."""
    return {one.id: one.rule() for one in declared(project)[0]}


def _of_rules(entries: Any, problems: list[str]) -> Iterator[DeclaredQuery]:
    for key, entry in entries.items() if isinstance(entries, Mapping) else ():
        place = f"rules.{key}"
        if not isinstance(entry, Mapping) or entry.get("query") is None:
            continue
        text, scope = entry["query"], entry.get("scope") or "global"
        if not isinstance(text, str):
            problems.append(f"{place}: 'query' must be text")
        elif scope not in SCOPES:
            problems.append(f"{place}: 'scope' is {short(str(scope))}, and must be one of {', '.join(SCOPES)}")
        else:
            yield DeclaredQuery(
                id=f"user:{key}",
                title=_text(entry.get("name")) or str(key),
                text=text,
                scope=scope,
                place=place,
                level=_level(entry, place, problems),
                description=_text(entry.get("description")),
                details=_text(entry.get("details")),
                tags=_texts(entry.get("tags")),
            )


def _of_configurations(entries: Any, problems: list[str]) -> Iterator[DeclaredQuery]:
    for name, entry in entries.items() if isinstance(entries, Mapping) else ():
        data = entry.get("user_data") if isinstance(entry, Mapping) else None
        queries = data.get(PLUGIN) if isinstance(data, Mapping) else None
        if queries is None:
            continue
        at = f"configurations.{name}.user_data.{PLUGIN}"
        if not isinstance(queries, list):
            problems.append(f"{at} must be a list of maps with 'name' and 'query'")
            continue
        for number, query in enumerate(queries):
            place = f"{at}[{number}]"
            if not (isinstance(query, Mapping) and isinstance(query.get("query"), str)):
                problems.append(f"{place} needs a 'query': text in quotes")
                continue
            title = _text(query.get("name"))
            named = _text(query.get("id")) or slug(title)
            yield DeclaredQuery(
                id=f"user:{named or slug(str(name)) + '-' + digest(query['query'])}",
                title=title or f"Query {number + 1} of {name}",
                text=query["query"],
                scope="configuration",
                place=place,
                level=_level(query, place, problems),
                description=_text(query.get("description")),
                details=_text(query.get("details")),
                tags=(*PLUGIN_TAGS, *_texts(query.get("tags"))),
                aliases=(PLUGIN_RULE,),
                configurations=(str(name),),
            )


def _distinct(found: list[DeclaredQuery]) -> Iterator[DeclaredQuery]:
    """One for each id: what several configurations ask is asked of all of them; another query of that name gets a digest."""
    kept: dict[str, DeclaredQuery] = {}
    for one in found:
        before = kept.get(one.id)
        if before is not None and not _same(before, one):
            one = replace(one, id=f"{one.id}-{digest(one.text)}")
            before = kept.get(one.id)
        if before is None:
            kept[one.id] = one
        elif _same(before, one) and before.configurations and one.configurations:
            names = tuple(dict.fromkeys((*before.configurations, *one.configurations)))
            kept[one.id] = replace(before, configurations=names)
    yield from kept.values()


def _same(one: DeclaredQuery, other: DeclaredQuery) -> bool:
    return one.aliases == other.aliases and digest(one.text) == digest(other.text)


def digest(query: str) -> str:
    """Eight hex digits of the words of a query: spaces, lines and comments do not count."""
    try:
        words = "\0".join(token.text for token in tokens(query))
    except QueryError:
        words = " ".join(query.split())
    return sha256(words.encode("utf-8", "surrogatepass")).hexdigest()[:8]


def slug(text: str) -> str:
    """*text* as part of an id: small letters, digits, hyphens."""
    return re.sub(r"[^a-z0-9]+", "-", text.lower()).strip("-")[:80]


def _level(entry: Mapping[Any, Any], place: str, problems: list[str]) -> Level:
    word = entry.get("level", "warning")
    if word in ("error", "warning", "note"):
        return Level(word)
    problems.append(f"{place}: 'level' must be error, warning or note")
    return Level.WARNING


def _text(value: Any) -> str:
    return " ".join(value.split())[:LONGEST_DETAILS] if isinstance(value, str) else ""


def _texts(value: Any) -> tuple[str, ...]:
    return tuple(item for item in value if isinstance(item, str)) if isinstance(value, list) else ()
