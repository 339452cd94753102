# SPDX-License-Identifier: Apache-2.0
"""Parameters whose name has a prefix too much: a doubled section, the node's own name, ros__parameters twice."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System, misplaced


def check(system: System) -> Iterator[Finding]:
    for parameter in system.given:
        is_taken = parameter.place in system.taken or parameter.place in system.whole.taken
        found = None if is_taken else misplaced(parameter)
        if found is None:
            continue
        meant, why = found
        has = " has" if parameter.node.names.has(meant) else " may have"
        yield Finding(
            at=parameter.at,
            message=(
                f"{parameter.node} is given the parameter {parameter.key}, but {parameter.node.type}{has} {meant}: {why}, so this value "
                f"has no effect; write {meant}"
            ),
            about=(parameter.node, parameter.key),
            flow=((parameter.tag, f"{parameter.node} is given the parameters"), (parameter.at, f"{meant} is meant")),
            presence=parameter.presence,
        )


CHECK = Check(
    id="parameter-misplaced",
    summary="Parameter under the wrong section.",
    level=Level.WARNING,
    catalogue="P05",
    tags=("parameters",),
    run=check,
)
