# SPDX-License-Identifier: Apache-2.0
"""Subscribers with a deadline that the publisher does not promise to keep."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System, incompatible

ADVICE = {
    "publishers": "publish with a deadline that is not longer than the subscriber's",
    "subscribers": "subscribe with a deadline that is not shorter than the publisher's, or with none",
}


def check(system: System) -> Iterator[Finding]:
    yield from incompatible(system, "deadline", "giver", ADVICE)


CHECK = Check(
    id="deadline-mismatch",
    summary="A publisher's deadline is not longer than those of its subscribers.",
    level=Level.ERROR,
    catalogue="Q03",
    tags=("topics", "qos"),
    run=check,
)
