# SPDX-License-Identifier: Apache-2.0
"""Names in code that begin with a slash (HAROS's ``no_global_names``)."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import ACTION, SERVICE, TOPIC, Check, Finding, Level, System

#: Names that are global by agreement (REP 105, ROS itself).
COMMON = frozenset(
    {"/tf", "/tf_static", "/clock", "/rosout", "/rosout_agg", "/parameter_events", "/diagnostics", "/diagnostics_agg"}
)


def check(system: System) -> Iterator[Finding]:
    for node in system.nodes:
        for end in node.of(*TOPIC, *SERVICE, *ACTION):
            written = end.raw.written or ""
            if not written.startswith("/") or end.implicit or not end.in_source or written in COMMON:
                continue
            yield Finding(
                at=end.location,
                message=(
                    f"the {end.word} {written} has a global name: no namespace applies to it, and two instances of the node "
                    f"share it; write {written.lstrip('/')}"
                ),
                about=(end,),
            )


CHECK = Check(
    id="global-name",
    summary="Topics, services and actions have relative or private names in the code.",
    level=Level.WARNING,
    catalogue="N01",
    aliases=("no_global_names",),
    tags=("names",),
    profiles=("strict",),
    run=check,
)
