# SPDX-License-Identifier: Apache-2.0
"""Names that a launch file gives to nodes and that differ from the program's name by one wrong letter."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, System, is_slip


def check(system: System) -> Iterator[Finding]:
    for node in system.nodes:
        name, program = node.name.rpartition("/")[2], node.raw.type.removesuffix(".py")
        if not node.is_launched or not node.known or node.kind not in ("node", "lifecycle") or "?" in program:
            continue
        if len(name) < 8 or len(name) != len(program) or _plain(name) == _plain(program) or not is_slip(name, program):
            continue
        yield Finding(
            at=node.location,
            message=f"the node of {node.type} is called {name}: probably a slip; parameters and remappings for {program} do not reach it; write "
            f"{program}",
            about=(node.type, name),
            apart=(name,),
        )


def _plain(name: str) -> str:
    return "".join(filter(str.isalnum, name)).lower()


CHECK = Check(
    id="misspelt-node-name",
    summary="Node name that differs from its program's by one letter.",
    level=Level.NOTE,
    decidability=Decidability.HEURISTIC,
    tags=("launch",),
    run=check,
)
