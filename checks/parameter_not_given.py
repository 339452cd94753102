# SPDX-License-Identifier: Apache-2.0
"""Parameters that a node declares without a value, and that nothing gives it: it throws when it starts."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, End, Finding, Level, System, near


def check(system: System) -> Iterator[Finding]:
    for node in system.nodes:
        if node.ros != 2 or not node.is_launched or not node.known or node.raw.conditions:
            continue
        given = {each.key for each in node.given}
        missing = [
            (key, end)
            for key, ends in node.names.declared.items()
            for end in ends
            if key not in given and _is_needed(end, key) and not node.names.set.get(key)
        ]
        if missing:
            keys = [key for key, _ in missing]
            end = missing[0][1]
            meant = near(keys[0], [key for key in given if key not in node.names.declared])
            yield Finding(
                at=node.location,
                message=(
                    (
                        f"{node} does not get {_listed(keys)}, which {node.type} declares without a default: the node throws at "
                        "start; set it here"
                    )
                    + (f"; {meant} is set, but not declared" if meant else "")
                ),
                about=(node, *(each for _, each in missing)),
                related=((end.location, f"{keys[0]} is declared without a default"),),
            )


def _is_needed(end: End, key: str) -> bool:
    raw = end.raw
    if not raw.is_strict or raw.unknowns or end.conditions or "?" in key or raw.is_dynamic or end.type is None:
        return False
    return raw.value is None and raw.effective is None


def _listed(keys: list[str]) -> str:
    shown = ", ".join(keys[:3])
    more = f" and {len(keys) - 3} more" if len(keys) > 3 else ""
    return f"the parameter{'s' if len(keys) > 1 else ''} {shown}{more}"


CHECK = Check(
    id="parameter-not-given",
    summary="Parameter without a default that the launch file does not set.",
    level=Level.ERROR,
    tags=("parameters",),
    run=check,
)
