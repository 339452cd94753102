# SPDX-License-Identifier: Apache-2.0
"""Names that nothing defines in files of Python 2, which linters for Python 3 cannot read."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project
from haros_ci.api.code import LOADS, parsed, undefined_names


def check(project: Project) -> Iterator[Finding]:
    loads: dict[str | None, bool] = {}
    for file in project.workspace.files:
        if file.language != "python" or file.is_generated:
            continue
        found = parsed(project.text(file.path))
        if found is None or not found[2]:
            continue
        if file.package not in loads:
            loads[file.package] = any(
                LOADS.search(project.text(each.path))
                for each in project.workspace.files
                if each.package == file.package and each.language == "python"
            )
        if loads[file.package]:
            continue
        for name, line in undefined_names(found[0], found[1]):
            yield Finding(
                at=Location(file.path, line),
                message=f"{name} is not defined in this file: the line raises NameError; import it, or correct the name",
                about=(file.path, name),
                apart=(file.path, name),
            )


CHECK = Check(
    id="undefined-name",
    summary="Undefined name in a file of Python 2.",
    level=Level.ERROR,
    tags=("code",),
    project=check,
)
