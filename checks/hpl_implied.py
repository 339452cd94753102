# SPDX-License-Identifier: Apache-2.0
"""Properties that another one of the same owner says already."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.api import Check, Finding, Level, line_of, of_properties

if TYPE_CHECKING:
    from haros_ci.api.hpl import Properties, Stated


#: Properties of one owner that are compared, each with each.
MOST = 150


def check(properties: Properties) -> Iterator[Finding]:
    groups: dict[tuple[str, str, bool], list[Stated]] = {}
    for stated, _ in properties.matched:
        groups.setdefault((stated.owner.kind, stated.owner.name, stated.is_axiom), []).append(stated)
    for group in groups.values():
        yield from _implied(properties, group[:MOST])


def _implied(properties: Properties, group: list[Stated]) -> Iterator[Finding]:
    from haros_ci.api.hpl import follows, found

    compared = [(stated, properties.compared(stated)) for stated in group]
    for number, (stated, one) in enumerate(compared):
        for other_number, (other, second) in enumerate(compared):
            if number == other_number or not follows(one, second):
                continue
            if other_number > number and follows(second, one):
                continue  # they are the same; the later one is reported
            same = follows(second, one)
            how = "says the same as" if same else "follows from"
            message = (
                f"This property {how} the one at {line_of(other.location)}; leave {'one of them' if same else 'it'} out"
            )
            yield found(stated, one.stated.at, message, related=((other.location, other.identity),))
            break


CHECK = Check(
    id="hpl-implied",
    summary="Property that another one implies.",
    level=Level.NOTE,
    catalogue="H14",
    tags=("properties",),
    project=of_properties(check),
)
