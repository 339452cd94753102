# SPDX-License-Identifier: Apache-2.0
"""Keywords that launch_ros has dropped."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Fix, Level, System
from haros_ci.api.launch import ConstructUse, included_by, renamed_keyword


def check(system: System) -> Iterator[Finding]:
    for use in system.facts(ConstructUse):
        if use.kind == "deprecated":
            yield Finding(
                at=use.location,
                message=f"{use.text} is taken up to ROS 2 Foxy only, later launch stops here; write {use.instead}",
                about=(use.text,),
                flow=included_by(use),
                presence=use.presence,
                apart=(use.text,),
                fixes=fixes(system, use),
            )


def fixes(system: System, use: ConstructUse) -> tuple[Fix, ...]:
    """The keyword written as it is today."""
    text = system.workspace.text(use.location.path) if system.workspace is not None else ""
    edit = renamed_keyword(text, use.location, use.text.rstrip("="), use.instead.rstrip("="))
    return (Fix(f"write {use.instead}", (edit,)),) if edit is not None else ()


CHECK = Check(
    id="deprecated-launch-keyword",
    summary="Launch files use the keywords that launch_ros has today.",
    level=Level.WARNING,
    catalogue="L13",
    tags=("launch",),
    run=check,
)
