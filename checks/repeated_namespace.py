# SPDX-License-Identifier: Apache-2.0
"""Namespaces that were pushed twice."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, Status, System, SystemNode, named_at


def check(system: System) -> Iterator[Finding]:
    containers = {node.raw.container for node in system.nodes}
    for node in system.nodes if system.is_launched else ():
        if not node.known or node.raw.kind == "library" or node.name in containers:
            continue
        twice = _twice(node.name.split("/")[:-1])
        if twice:
            yield _of_node(node, twice)
            continue
        for end in node.ends:
            rest = end.name.split("/")
            if end.implicit or not end.known or ":" in end.name or end.name.startswith(f"{node.name}/"):
                continue
            twice = _twice(rest[:-1])
            if twice and not _twice(end.original_name.split("/")[:-1]):
                yield Finding(
                    at=named_at(end),
                    message=f"{end.name}, {end.word} of {node}, has the namespace {twice} twice in a row: other nodes search for it "
                    "below one; remove one of the two",
                    about=(end,),
                    related=((end.location, f"{end.word} {end.original_name}"),),
                )


def _twice(segments: list[str]) -> str:
    return next((one for one, next_one in zip(segments, segments[1:]) if one and one == next_one), "")


def _of_node(node: SystemNode, twice: str) -> Finding:
    return Finding(
        at=node.location,
        message=(
            f"{node.name} has the namespace {twice} twice in a row, because two places push it: nodes that search for "
            "it below one namespace do not find it; push it once"
        ),
        about=(node,),
    )


CHECK = Check(
    id="repeated-namespace",
    summary="Namespace pushed twice.",
    level=Level.WARNING,
    decidability=Decidability.HEURISTIC,
    status=Status.PREVIEW,
    catalogue="N04",
    tags=("names", "launch"),
    run=check,
)
