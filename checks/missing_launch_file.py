# SPDX-License-Identifier: Apache-2.0
"""Files that launch files name, and that their packages do not have."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System
from haros_ci.api.launch import FileUse, ParameterFileUse, included_by, meant
from haros_ci.api.packages import is_ignored

#: Files that nodes read; of others they may be the ones who write them.
_READ = re.compile(r"\.(ya?ml|rviz|urdf|xacro|sdf|srdf|world|launch|launch\.\w+|py|lua|perspective|stl|dae|vcg)$", re.I)
_WRITES = re.compile(r"output|save|write|dump|record|store|cache|result|calibrat|camera_info|log", re.I)
_WHAT = {
    "include": "includes",
    "parameters": "loads parameters from",
    "text": "reads",
    "value": "names",
    "default": "has the default",
}


def check(system: System) -> Iterator[Finding]:
    # What a ROS 2 node is given is told by parameter-file-missing, also of the argument that leads there.
    said = {use.text for use in system.facts(ParameterFileUse) if use.is_found is False and use.ros == 2}
    for use in system.facts(FileUse):
        if use.is_found is not False or use.text in said:
            continue
        if use.kind == "parameters" and use.ros == 2:
            continue
        if use.kind in ("value", "default") and (
            not _READ.search(use.inner) or _WRITES.search(f"{use.name} {use.inner}")
        ):
            continue
        said.add(use.text)
        is_made = system.workspace is not None and use.path is not None and is_ignored(system.workspace, use.path)
        hint = "; .gitignore names it, so that it may be made elsewhere" if is_made else meant(use.similar)
        level = None if use.kind in ("include", "parameters", "text") else Level.WARNING
        what = _WHAT[use.kind] + (f" of {use.name!r}," if use.kind == "default" else "")
        yield Finding(
            at=use.location,
            message=f"{what} {use.inner} of {use.package}, but this file does not exist{hint}",
            about=(f"{use.package}/{use.inner}",),
            flow=included_by(use),
            apart=(use.text,),
            level=Level.NOTE if is_made else level,
            presence=use.presence,
        )


CHECK = Check(
    id="missing-launch-file",
    summary="Reference of a launch file to a file that does not exist.",
    level=Level.ERROR,
    catalogue="L01",
    tags=("launch",),
    run=check,
)
