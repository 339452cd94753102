# SPDX-License-Identifier: Apache-2.0
"""Readings of parameters that a node does not declare: they throw, or find nothing."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import NO_SYSTEMS, Check, End, Finding, Level, System, SystemNode, near


def check(system: System) -> Iterator[Finding]:
    for node in system.nodes:
        if node.ros != 2 or not node.names.is_whole or system.name.endswith(NO_SYSTEMS):
            continue
        for key, ends in node.names.read.items():
            if "?" in key or node.names.has(key) is not False:
                continue
            meant = near(key, (name for name in node.names.declared if name not in node.names.read)) or _below(
                key, node
            )
            for end in ends:
                if end.implicit or end.raw.source == "known-node" or _is_guarded(end):
                    continue
                what = (
                    "the call throws"
                    if end.raw.is_strict
                    else "the call never finds a value, even if a launch file sets it"
                )
                yield Finding(
                    at=end.location,
                    message=(
                        f"{node.type} reads the parameter {key}, but does not declare it: {what}"
                        + (f"; did you mean {meant}?" if meant else "; declare it first")
                    ),
                    about=(end, key),
                    level=None if end.raw.is_strict else Level.WARNING,
                )


def _below(key: str, node: SystemNode) -> str:
    """The one parameter that ends with the plain name *key* below a prefix, read elsewhere or not; "" if there is none."""
    found = sorted(name for name in node.names.declared if "?" not in name and name.endswith(f".{key}"))
    return found[0] if len(found) == 1 and "." not in key else ""


def _is_guarded(end: End) -> bool:
    """Whether a condition around it asks for the parameter, it is only read where something has failed, or what it throws is caught.

    A call that throws has nothing that tells a type; where it is not strict, somebody catches it.
    """
    if (
        not end.raw.is_strict
        and end.raw.type is None
        and not any(unknown.field == "type" for unknown in end.raw.unknowns)
    ):
        return True
    return any("has_parameter" in condition.condition or condition.statement == "catch" for condition in end.conditions)


CHECK = Check(
    id="parameter-read-undeclared",
    summary="Parameter read but not declared.",
    level=Level.ERROR,
    catalogue="P08",
    tags=("parameters",),
    run=check,
)
