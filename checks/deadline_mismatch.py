# SPDX-License-Identifier: Apache-2.0
"""Subscribers with a deadline that the publisher does not promise to keep."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System, incompatible

ADVICE = {
    "publishers": "set the publisher's deadline to at most the subscriber's",
    "subscribers": "set the subscriber's deadline to at least the publisher's, or remove it",
}


def check(system: System) -> Iterator[Finding]:
    yield from incompatible(system, "deadline", "giver", ADVICE)


CHECK = Check(
    id="deadline-mismatch",
    summary="Publisher with a longer deadline than its subscriber requests.",
    level=Level.ERROR,
    catalogue="Q03",
    tags=("topics", "qos"),
    run=check,
)
