# SPDX-License-Identifier: Apache-2.0
"""Paths in launch files that only one machine has."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System
from haros_ci.api.launch import PathUse, included_by

_WHY = {"home": "lies in a user's home directory", "absolute": "is an absolute path"}


def check(system: System) -> Iterator[Finding]:
    said: set[str] = set()
    for use in system.facts(PathUse):
        if use.text in said:
            continue
        said.add(use.text)
        of = f" of {use.name!r}" if use.name else ""
        find = "$(find-pkg-share ...)" if use.ros == 2 else "$(find ...)"
        yield Finding(
            at=use.location,
            message=f"{use.text}{of} {_WHY[use.kind]}: other machines do not have this path; write {find}, or use a launch "
            "argument",
            about=(use.text,),
            flow=included_by(use),
            apart=(use.text,),
            presence=use.presence,
        )


CHECK = Check(
    id="machine-specific-path",
    summary="Absolute or home directory path in a launch file.",
    level=Level.WARNING,
    catalogue="L06",
    tags=("launch",),
    run=check,
)
