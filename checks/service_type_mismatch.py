# SPDX-License-Identifier: Apache-2.0
"""Servers and clients of one service that disagree on its type."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System, type_mismatches


def check(system: System) -> Iterator[Finding]:
    yield from type_mismatches(system.services, "every call fails, or waits forever")


CHECK = Check(
    id="service-type-mismatch",
    summary="Service server and client with different service types.",
    level=Level.ERROR,
    catalogue="G07",
    tags=("services",),
    run=check,
)
