# SPDX-License-Identifier: Apache-2.0
"""Lifecycle managers with names of nodes that the system does not have, and managed nodes that no manager names."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import (
    Check,
    Decidability,
    Finding,
    Level,
    Parameter,
    System,
    SystemNode,
    alternatives,
    equally_near,
    together,
)
from haros_ci.api.launch import IncludeUse


def check(system: System) -> Iterator[Finding]:
    managers = list(_managers(system))
    if not managers or not all(node.known for node in system.nodes):
        return
    # What an include starts that cannot be read may be what is missing.
    if any(use.path is None for use in system.facts(IncludeUse)):
        return
    managed: set[str] = set()
    for manager, parameter, names in managers:
        space = manager.name.rpartition("/")[0]
        full = {name: name if name.startswith("/") else f"{space}/{name}" for name in names}
        managed |= set(full.values())
        there = {node.name: node for node in system.nodes if together(node.presence, manager.presence) is not None}
        if not system.closed and not any(item in there for item in full.values()):
            continue
        for name, expected in full.items():
            if expected not in there:
                yield _lost(manager, parameter, name, expected, sorted(there))
    if system.closed:
        yield from _unmanaged(system, managed)


def _managers(system: System) -> Iterator[tuple[SystemNode, Parameter, list[str]]]:
    """The lifecycle managers with the names of the nodes that they manage."""
    for node in system.nodes:
        if "lifecycle_manager" not in node.raw.type and node.package != "nav2_lifecycle_manager":
            continue
        found = [parameter for parameter in system.parameters if parameter.name == f"{node.name}:node_names"]
        for parameter in found[:1]:
            names = parameter.value
            if isinstance(names, list) and all(isinstance(name, str) and "?" not in name for name in names):
                if names and not parameter.unknowns and not parameter.conditions and not node.raw.conditions:
                    yield node, parameter, names


def _lost(manager: SystemNode, parameter: Parameter, name: str, expected: str, there: list[str]) -> Finding:
    similar = alternatives([repr(name) for name in equally_near(expected, there, 0.8)])
    hint = f"; did you mean {similar}?" if similar else ""
    return Finding(
        at=parameter.origin or parameter.location or manager.location,
        message=(
            f"{manager} manages {name!r}, but the launch file does not start {expected}: the manager waits for it and "
            f"activates none of its other nodes{hint}"
        ),
        about=(manager, expected),
        related=((manager.location, f"{manager} is started here"),),
        apart=(expected,),
    )


def _unmanaged(system: System, managed: set[str]) -> Iterator[Finding]:
    for node in system.nodes:
        if node.kind == "lifecycle" and node.name not in managed and node.is_launched:
            yield Finding(
                at=node.location,
                message=f"{node} is a lifecycle node, but no lifecycle manager of the system lists it: it stays unconfigured; add "
                "it to node_names",
                about=(node,),
            )


CHECK = Check(
    id="unmanaged-lifecycle-node",
    summary="Lifecycle node and lifecycle manager that do not match.",
    level=Level.WARNING,
    decidability=Decidability.CLOSED_WORLD,
    catalogue="L15",
    tags=("launch", "lifecycle"),
    run=check,
)
