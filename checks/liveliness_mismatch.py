# SPDX-License-Identifier: Apache-2.0
"""Subscribers that want stricter signs of life than the publisher gives."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System, incompatible

ADVICE = {
    "publishers": "publish with the liveliness of the subscriber, and a lease that is not longer than its",
    "subscribers": "subscribe with automatic liveliness, and a lease that is not shorter than the publisher's",
}


def check(system: System) -> Iterator[Finding]:
    yield from incompatible(system, "liveliness", "giver", ADVICE)


CHECK = Check(
    id="liveliness-mismatch",
    summary="A publisher gives the signs of life that its subscribers ask for, as often as they do.",
    level=Level.ERROR,
    catalogue="Q04",
    tags=("topics", "qos"),
    run=check,
)
