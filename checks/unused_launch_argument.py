# SPDX-License-Identifier: Apache-2.0
"""Launch arguments that an include passes for nothing, and those that nothing reads."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from haros_ci.api import Check, Finding, Level, System
from haros_ci.api.launch import ArgumentDeclaration, ConstructUse, IncludeUse, included_by, meant


def check(system: System) -> Iterator[Finding]:
    for use in system.facts(IncludeUse):
        known = {*use.declared, *use.read}
        free = sorted({*use.declared} - {passed.name for passed in use.passed})
        for passed in use.passed if use.is_whole else ():
            if passed.name in known:
                continue
            similar = tuple(get_close_matches(passed.name, free, 1, 0.7))
            what = "launch stops here" if use.ros == 1 else "it has no effect"
            yield Finding(
                at=passed.location,
                message=f"passes {passed.name!r} to {use.path}, which does not declare it: {what}{meant(similar)}",
                about=(use.path or "", passed.name),
                apart=(use.path or "", passed.name),
                flow=included_by(use),
                level=Level.ERROR if use.ros == 1 else None,
                presence=use.presence,
            )
    refused = {use.location.path for use in system.facts(ConstructUse) if use.kind == "foreign"}
    for argument in system.facts(ArgumentDeclaration):
        if argument.is_used is False and argument.location.path not in refused and not _stands_in(argument, system):
            yield Finding(
                at=argument.location,
                message=f"launch argument {argument.name!r} is declared, but nothing reads it: setting it has no effect",
                about=(argument.name,),
                apart=(argument.name,),
                flow=included_by(argument),
                presence=argument.presence,
            )


def _stands_in(argument: ArgumentDeclaration, system: System) -> bool:
    """Whether *argument* is there for the sake of who includes the file: empty, and of use in a file beside it."""
    if argument.default != "":
        return False
    folder = argument.location.path.rpartition("/")[0]
    return (folder, argument.name) in system.whole.used_arguments


CHECK = Check(
    id="unused-launch-argument",
    summary="Launch arguments that are declared or passed have an effect.",
    level=Level.WARNING,
    catalogue="L08",
    tags=("launch",),
    run=check,
)
