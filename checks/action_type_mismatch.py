# SPDX-License-Identifier: Apache-2.0
"""Servers and clients of one action that disagree on its type."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System, type_mismatches


def check(system: System) -> Iterator[Finding]:
    yield from type_mismatches(system.actions, "the client's goals never reach the server")


CHECK = Check(
    id="action-type-mismatch",
    summary="Action server and client with different action types.",
    level=Level.ERROR,
    catalogue="G08",
    tags=("actions",),
    run=check,
)
