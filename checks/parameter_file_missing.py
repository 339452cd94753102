# SPDX-License-Identifier: Apache-2.0
"""Parameter files that a launch file gives to a node and that do not exist (ROS 2)."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, System
from haros_ci.api.launch import FileUse, ParameterFileUse, meant
from haros_ci.api.packages import is_ignored, writer_of


def check(system: System) -> Iterator[Finding]:
    similar = {use.location: use.similar for use in system.facts(FileUse) if use.kind == "parameters"}
    for use in system.facts(ParameterFileUse):
        if use.is_found is not False or use.ros != 2:
            continue
        program = "/".join(use.program)
        is_loaded = any(node.kind == "component" and node.type == program for node in system.nodes)
        hint = meant(similar.get(use.location, ())) or "; correct the path, or add the file"
        is_made = system.workspace is not None and use.path is not None and is_ignored(system.workspace, use.path)
        if is_made:
            hint = "; .gitignore names it, so that it may be made elsewhere"
        elif writer := writer_of(system, use.path or use.text):
            is_made, hint = True, f"; {writer} writes a file of this name, so that it may be made at run time"
        at = _named(system, use)
        yield Finding(
            at=at,
            message=f"the parameter file {use.text} does not exist: {_effect(use, use.node or program, is_loaded)}{hint}",
            about=(use.text, program),
            related=((use.location, f"{use.node or program} gets the file here"),) if at != use.location else (),
            flow=tuple((place, "includes the next one") for place in use.included),
            level=Level.NOTE if is_made else None,
            presence=use.presence,
        )


def _effect(use: ParameterFileUse, node: str, is_loaded: bool) -> str:
    """What launch does without the file; it opens one with substitutions before it looks for it (launch_ros, parameter_descriptions.py)."""
    if use.substitutes:
        return (
            f"launch stops here, as it opens the file for the substitutions in it (allow_substs), and starts no {node}"
        )
    if is_loaded:
        return f"launch cannot start {node}"
    return f"launch prints a warning and starts {node} without these parameters"


def _named(system: System, use: ParameterFileUse) -> Location:
    """The one line of the launch file that has the file's name in quotes; where the node gets it, if there are several or none."""
    name = use.text.rpartition("/")[2]
    if system.workspace is None or not name or "?" in name or "$" in name:
        return use.location
    quoted = re.compile(rf"""['"/]{re.escape(name)}['"]""")
    lines = system.workspace.text(use.location.path).split("\n")
    found = [number for number, line in enumerate(lines, 1) if quoted.search(line)]
    if len(found) != 1 or found[0] == use.location.line or re.match(r"\s*(?:#|<!--)", lines[found[0] - 1]):
        return use.location
    return Location(use.location.path, found[0])


CHECK = Check(
    id="parameter-file-missing",
    summary="Parameter file that does not exist.",
    level=Level.ERROR,
    catalogue="P12",
    tags=("parameters", "launch"),
    run=check,
)
