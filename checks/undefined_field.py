# SPDX-License-Identifier: Apache-2.0
"""Python code that asks a message for a field that its definition does not have."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, alternatives, equally_near
from haros_ci.api.code import weighed
from haros_ci.api.interfaces import MissingField, missing_fields


def check(project: Project) -> Iterator[Finding]:
    yield from weighed(project, _found(project))


def _found(project: Project) -> Iterator[Finding]:
    for missing in missing_fields(project):
        yield Finding(
            at=missing.location,
            message=f"{missing.written}: {missing.struct.name} has no field {missing.field}, so the line raises "
            f"AttributeError{_like(missing)}",
            about=(missing.struct.name, missing.field),
            apart=(missing.routine.title, missing.struct.name, missing.field),
        )


def _like(missing: MissingField) -> str:
    names = sorted(missing.struct.fields)
    found = alternatives(equally_near(missing.field, names, 0.6))
    if found:
        return f"; it has {found}"
    return f"; it has {', '.join(names)}" if 0 < len(names) < 6 else ""


CHECK = Check(
    id="undefined-field",
    summary="Message field that does not exist.",
    level=Level.ERROR,
    catalogue="I03",
    tags=("interfaces", "python"),
    project=check,
)
