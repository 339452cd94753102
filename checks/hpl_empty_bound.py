# SPDX-License-Identifier: Apache-2.0
"""Time bounds of 0, within which nothing can happen."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.api import Check, Finding, Level, of_properties

if TYPE_CHECKING:
    from haros_ci.api.hpl import Properties


def check(properties: Properties) -> Iterator[Finding]:
    from haros_ci.api.hpl import PatternKind, found

    for stated, property in properties.sound:
        bound = property.pattern.bound
        if bound is None or bound.seconds > 0:
            continue
        asks = property.pattern.kind in (PatternKind.SOME, PatternKind.CAUSES, PatternKind.REQUIRES)
        comes = "it can never be kept" if asks else "it can never be broken"
        yield found(
            stated, bound.at, f"The window of 'within {bound.written}' is empty, so that {comes}; write a time above 0"
        )


CHECK = Check(
    id="hpl-empty-bound",
    summary="Property within no time.",
    level=Level.WARNING,
    catalogue="H12",
    tags=("properties",),
    project=of_properties(check),
)
