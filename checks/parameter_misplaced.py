# SPDX-License-Identifier: Apache-2.0
"""Parameters whose name has a prefix too much: a doubled section, the node's own name, ros__parameters twice."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System, misplaced


def check(system: System) -> Iterator[Finding]:
    for each in system.given:
        is_taken = each.place in system.taken or each.place in system.whole.taken
        found = None if is_taken else misplaced(each)
        if found is None:
            continue
        meant, why = found
        has = " has" if each.node.names.has(meant) else " may have"
        yield Finding(
            at=each.at,
            message=(
                f"{each.node} is given the parameter {each.key}, but {each.node.type}{has} {meant}: {why}, so this value "
                f"has no effect; write {meant}"
            ),
            about=(each.node, each.key),
            flow=((each.tag, f"{each.node} is given the parameters"), (each.at, f"{meant} is meant")),
            presence=each.presence,
        )


CHECK = Check(
    id="parameter-misplaced",
    summary="Parameter under the wrong section.",
    level=Level.WARNING,
    catalogue="P05",
    tags=("parameters",),
    run=check,
)
