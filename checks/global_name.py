# SPDX-License-Identifier: Apache-2.0
"""Names in code that begin with a slash (HAROS's ``no_global_names``)."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import ACTION, SERVICE, TOPIC, Check, End, Finding, Level, System, rule_of

#: Names that are global by agreement (REP 105, ROS itself).
COMMON = frozenset(
    {"/tf", "/tf_static", "/clock", "/rosout", "/rosout_agg", "/parameter_events", "/diagnostics", "/diagnostics_agg"}
)


def check(system: System) -> Iterator[Finding]:
    for node in system.nodes:
        for end in node.of(*TOPIC, *SERVICE, *ACTION):
            if end.implicit or not end.in_source or end.original_name in COMMON:
                continue
            written = end.raw.written or ""
            if written.startswith("/"):
                yield Finding(
                    at=end.location,
                    message=f"{end.word} {written} has a global name: namespaces do not apply to it, and all instances of the node "
                    f"share it; write {written.lstrip('/')}",
                    about=(end,),
                )
            elif written and written[0] not in "~?":
                yield from _rule(end)


def _rule(end: End) -> Iterator[Finding]:
    """The rule for a relative name that is written as a global one: it works in one namespace alone."""
    rule = rule_of(end)
    if rule is not None and rule.source.startswith("/"):
        yield Finding(
            at=rule.location,
            message=f"this rule remaps the global name {rule.source}, but the code of {end.node} uses {end.raw.written}: in "
            f"another namespace the rule has no effect; write from {end.raw.written}",
            about=(end,),
            related=((end.location, f"{end.word} {end.raw.written}"),),
        )


CHECK = Check(
    id="global-name",
    summary="Global name of a topic, service or action in the code.",
    level=Level.WARNING,
    catalogue="N01",
    aliases=("no_global_names",),
    tags=("names",),
    profiles=("strict",),
    run=check,
)
