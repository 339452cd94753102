# SPDX-License-Identifier: Apache-2.0
"""Predicates about fields and constants that the message of the topic does not have."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.api import Check, Finding, Level, alternatives, equally_near, listed, of_properties

if TYPE_CHECKING:
    from haros_ci.api.hpl import Properties


def check(properties: Properties) -> Iterator[Finding]:
    from haros_ci.api.hpl import Field, Missing, found, parts

    for stated, _ in properties.sound:
        for event, scene in properties.scenes(stated):
            for part in parts(event.predicate):
                lacking = scene.typed(part) if isinstance(part, Field) else None
                if isinstance(lacking, Missing) and lacking.field is part:
                    name, message = part.name, lacking.message
                    text = f"{message.name} has no field or constant {name}: the property cannot be checked, and HAROS leaves it out{_meant(name, message.names)}"
                    yield found(stated, part.name_at, text, event.topic, message.name, name)


def _meant(name: str, names: tuple[str, ...]) -> str:
    near = alternatives(equally_near(name, names, 0.6))
    if near:
        return f"; did you mean {near}?"
    return f"; it has {listed(names)}" if names else "; it has none"


CHECK = Check(
    id="hpl-unknown-field",
    summary="Predicate about a field or constant that the message does not have.",
    level=Level.ERROR,
    catalogue="H08",
    tags=("properties",),
    project=of_properties(check),
)
