# SPDX-License-Identifier: Apache-2.0
"""Servers and clients of one action that disagree on its type."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System, type_mismatches


def check(system: System) -> Iterator[Finding]:
    yield from type_mismatches(system.actions, "no goal gets there")


CHECK = Check(
    id="action-type-mismatch",
    summary="The server and the clients of an action have the same action type.",
    level=Level.ERROR,
    catalogue="G08",
    tags=("actions",),
    run=check,
)
