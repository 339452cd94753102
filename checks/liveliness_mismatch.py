# SPDX-License-Identifier: Apache-2.0
"""Subscribers that want stricter signs of life than the publisher gives."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System, incompatible

ADVICE = {
    "publishers": "publish with the liveliness kind of the subscriber and at most its lease duration",
    "subscribers": "subscribe with automatic liveliness and at least the publisher's lease duration",
}


def check(system: System) -> Iterator[Finding]:
    yield from incompatible(system, "liveliness", "giver", ADVICE)


CHECK = Check(
    id="liveliness-mismatch",
    summary="Publisher with a weaker liveliness than its subscriber requests.",
    level=Level.ERROR,
    catalogue="Q04",
    tags=("topics", "qos"),
    run=check,
)
