# SPDX-License-Identifier: Apache-2.0
"""Values in predicates that do not fit: a number where a text is needed."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

from haros_ci.api import Check, Finding, Level, of_properties

if TYPE_CHECKING:
    from haros_ci.api.hpl import Expression, Properties, Scene, Stated


def check(properties: Properties) -> Iterator[Finding]:
    from haros_ci.api.hpl import Slip, found, mistakes

    for stated in properties.stated:
        if stated.parsed is None:
            continue
        wrong = mistakes(stated.parsed)
        for slip in wrong:
            if slip.slip is Slip.KIND:
                yield found(stated, slip.at, f"HAROS refuses this predicate: {slip.message}", slip.message)
        if not wrong:
            yield from _of_fields(properties, stated)


def _of_fields(properties: Properties, stated: Stated) -> Iterator[Finding]:
    """What does not fit the types of the fields."""
    from haros_ci.api.hpl import found, mistyped

    for event, scene in properties.scenes(stated):
        for slip in mistyped(event, partial(_kind, scene)):
            of = f" ({event.topic} has {scene.own.name})" if scene.own is not None else ""
            yield found(
                stated,
                slip.at,
                f"The predicate does not fit the message: {slip.message}{of}",
                event.topic,
                slip.message,
            )


def _kind(scene: Scene, expression: Expression) -> int | None:
    from haros_ci.api.hpl import kind_of

    return kind_of(scene.typed(expression))


CHECK = Check(
    id="hpl-wrong-type",
    summary="Value of a kind that does not fit in a predicate.",
    level=Level.ERROR,
    catalogue="H02",
    tags=("properties",),
    project=of_properties(check),
)
