# SPDX-License-Identifier: Apache-2.0
"""Formats of Python whose values do not fit: in Python 2, which linters for Python 3 cannot read, and where parentheses are missing."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project
from haros_ci.api.code import misfits, parsed_of_any_version


def check(project: Project) -> Iterator[Finding]:
    for file in project.workspace.files:
        if file.language != "python" or file.is_generated:
            continue
        text = project.text(file.path)
        found = parsed_of_any_version(text) if "%" in text or "format" in text else None
        for fault in misfits(found[0], found[2]) if found is not None else ():
            places = f"{fault.places} value{'s' if fault.places != 1 else ''}"
            if fault.is_open:
                message = "only the first stands right of the %, the others are arguments of the call: the line raises TypeError; put all of them into parentheses"
            else:
                message = f"is given {fault.received}: the line raises an exception; give as many values as it has placeholders"
            yield Finding(
                at=Location(file.path, fault.line),
                message=f"the format has room for {places}, and {message}",
                about=(file.path, f"{fault.places}"),
                apart=(file.path, f"{fault.line}"),
            )


CHECK = Check(
    id="wrong-format-arguments",
    summary="Format of Python with too few or too many values.",
    level=Level.ERROR,
    tags=("code",),
    project=check,
)
