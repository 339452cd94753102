# SPDX-License-Identifier: Apache-2.0
"""The properties in HPL that a project file states: what each says, where it stands, and which names of the system its topics are."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from haros_ci.behaviour.declared import Stated
from haros_ci.behaviour.text import canonical
from haros_ci.behaviour.tree import Place
from haros_ci.checking.properties import Properties
from haros_ci.html_page.pool import NONE, Pool
from haros_ci.records import dataclass

#: Properties that are shown, and of one the topics, and the configurations that it is about.
MOST, MOST_TOPICS, MOST_SYSTEMS = 2_000, 40, 100


@dataclass(frozen=True, slots=True)
class Held:
    """A property with the names that each of its *topics* has in a system, and the *configurations* that it is about."""

    stated: Stated
    topics: tuple[tuple[str, tuple[str, ...]], ...] = ()
    configurations: tuple[str, ...] = ()


def held(properties: Properties | None) -> tuple[Held, ...]:
    """Every property that is stated, in the order in which they stand."""
    if properties is None:
        return ()
    found = []
    for stated in properties.stated[:MOST]:
        names = dict.fromkeys(event.topic for event in stated.parsed.events) if stated.parsed is not None else {}
        topics = tuple(
            (topic, tuple(sorted({end.name for end in properties.ends(stated.owner, topic)})[:MOST_TOPICS]))
            for topic in list(names)[:MOST_TOPICS]
        )
        systems = tuple(system.name for system in properties.systems(stated.owner)[:MOST_SYSTEMS])
        found.append(Held(stated, topics, systems))
    return tuple(found)


def properties(pool: Pool, every: Sequence[Held]) -> list[dict[str, Any]]:
    """A row for each: whom it is about, whether it is taken for granted, its text (as it stands if it is none), its place, and why it is none."""
    return [_row(pool, one) for one in every]


def _last_line(stated: Stated) -> int:
    """The last line of the property: the text of a block of YAML ends on the line after it."""
    place, text = stated.location, stated.source.text
    if stated.parsed is None or place.end_line is None:
        return place.end_line or place.line or 0
    end = min(stated.parsed.at.end, len(text))
    return max(place.line or 0, stated.at(Place(1, 1, 0, len(text[:end].rstrip()))).end_line or 0)


def _row(pool: Pool, one: Held) -> dict[str, Any]:
    stated = one.stated
    parsed, fault, place = stated.parsed, stated.fault, stated.location
    metadata = {key: parsed.metadata_of(key) if parsed is not None else None for key in ("id", "title", "description")}
    return {
        "kind": stated.owner.kind,
        "owner": pool.text(stated.owner.name),
        "granted": int(stated.is_axiom),
        **{key: pool.text(metadata.value if metadata is not None else None) for key, metadata in metadata.items()},
        "text": pool.text(canonical(parsed) if parsed is not None else " ".join(stated.source.text.split())),
        "place": pool.place(place),
        "until": _last_line(stated),
        "fault": NONE if fault is None else pool.text(fault.message),
        "topics": tuple((pool.text(topic), pool.texts(names)) for topic, names in one.topics),
        "configurations": pool.texts(one.configurations),
    }
