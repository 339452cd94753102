# SPDX-License-Identifier: Apache-2.0
"""Properties that are no HPL, or that stand where none can be read."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.api import Check, Finding, Level, of_properties

if TYPE_CHECKING:
    from haros_ci.api.hpl import Properties


def check(properties: Properties) -> Iterator[Finding]:
    from haros_ci.api.hpl import Slip, found, mistakes

    for stated in properties.stated:
        if stated.fault is not None:
            yield found(stated, stated.fault.at, f"This property cannot be read: {stated.fault.whole}")
        elif stated.parsed is not None:
            for mistake in mistakes(stated.parsed):
                if mistake.slip is Slip.EVENTS:
                    yield found(stated, mistake.at, f"HAROS refuses this property: {mistake.message}")


CHECK = Check(
    id="hpl-syntax",
    summary="Property that is not HPL.",
    level=Level.ERROR,
    catalogue="H01",
    tags=("properties",),
    project=of_properties(check),
)
