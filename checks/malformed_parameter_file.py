# SPDX-License-Identifier: Apache-2.0
"""Parameter files that launch files load and that are no YAML."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, System
from haros_ci.api.launch import FileUse, yaml_fault
from haros_ci.api.packages import conflicts


def check(system: System) -> Iterator[Finding]:
    if system.workspace is None:
        return
    seen: set[str] = set()
    for use in system.facts(FileUse):
        path = use.path
        if use.kind != "parameters" or use.is_found is not True or path is None or path in seen:
            continue
        seen.add(path)
        if conflicts(system.workspace.text(path)):
            continue  # merge-conflict says it
        fault = yaml_fault(system.workspace.text(path)) if path.endswith((".yaml", ".yml")) else None
        if fault is None:
            continue
        line, why = fault
        effect = "roslaunch stops here" if use.ros == 1 else "the node that is given it does not start"
        yield Finding(
            at=Location(path, line),
            message=f"{path} is not valid YAML: {why}; {effect}; correct the line, or the one before it",
            about=(path,),
            presence=use.presence,
        )


CHECK = Check(
    id="malformed-parameter-file",
    summary="Parameter file that is not valid YAML.",
    level=Level.ERROR,
    tags=("parameters", "launch"),
    run=check,
)
