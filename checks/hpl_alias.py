# SPDX-License-Identifier: Apache-2.0
"""Aliases of events, and variables, that are used and not bound, bound twice, or bound and not used."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.api import Check, Finding, Level, of_properties

if TYPE_CHECKING:
    from haros_ci.api.hpl import Properties


def check(properties: Properties) -> Iterator[Finding]:
    from haros_ci.api.hpl import Slip, found, mistakes, unused_aliases

    for stated in properties.stated:
        if stated.parsed is None:
            continue
        wrong = mistakes(stated.parsed)
        for slip in wrong:
            if slip.slip in (Slip.UNBOUND, Slip.TWICE, Slip.VARIABLE):
                yield found(stated, slip.at, f"HAROS refuses this property: {slip.message}", slip.message)
        if wrong:
            continue
        for event in unused_aliases(stated.parsed):
            if event.alias_at is not None:
                message = f"No other event of this property uses the alias {event.alias} of {event.topic}; leave it out"
                yield found(stated, event.alias_at, message, f"@{event.alias}", level=Level.NOTE)


CHECK = Check(
    id="hpl-alias",
    summary="Alias or variable that is not bound, bound twice or not used.",
    level=Level.ERROR,
    catalogue="H03",
    tags=("properties",),
    project=of_properties(check),
)
