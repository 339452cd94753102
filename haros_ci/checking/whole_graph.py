# SPDX-License-Identifier: Apache-2.0
"""All configurations of a workspace as one graph: launch files that run side by side on a robot are seldom included by a common one."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property

from haros_ci.checking.kinds import ACTION, NO_SYSTEMS, SERVICE, TOPIC
from haros_ci.checking.system import End, System, SystemNode

#: What libraries and tools have in every system.
COMMON = frozenset({"tf", "tf_static", "clock", "rosout", "parameter_events", "diagnostics", "robot_description"})
#: The kind of the other side.
OTHER = {kind: other for pair in (TOPIC, SERVICE, ACTION) for kind, other in (pair, pair[::-1])}


class WholeGraph:
    """All ends of a revision by kind and name, each with the configurations that have it."""

    def __init__(self, systems: Iterable[System]) -> None:
        self.systems = {system.name: system for system in systems if not system.name.endswith(NO_SYSTEMS)}
        self.ends: dict[tuple[str, str], list[tuple[End, str]]] = {}
        self.vague: dict[str, list[End]] = {}
        for system in self.systems.values():
            for end in system.ends:
                if end.kind not in OTHER or end.implicit:
                    continue
                if end.known:
                    self.ends.setdefault((end.kind, end.name), []).append((end, system.name))
                else:
                    self.vague.setdefault(end.kind, []).append(end)

    def of(self, kind: str, name: str) -> list[tuple[End, str]]:
        return self.ends.get((kind, name), [])

    @cached_property
    def held(self) -> frozenset[tuple[str, str, str]]:
        """Kind, name and program of every end."""
        return frozenset((kind, name, end.node.type) for (kind, name), ends in self.ends.items() for end, _ in ends)

    @cached_property
    def by_program(self) -> dict[tuple[str, str], list[tuple[End, str]]]:
        found: dict[tuple[str, str], list[tuple[End, str]]] = {}
        for (kind, _), ends in self.ends.items():
            for end, system in ends:
                found.setdefault((kind, end.node.type), []).append((end, system))
        return found

    @cached_property
    def programs(self) -> dict[str, frozenset[str]]:
        """The programs that each configuration starts."""
        return {name: frozenset(node.type for node in system.nodes) for name, system in self.systems.items()}

    @cached_property
    def texts(self) -> frozenset[str]:
        """The names that remapping rules lead to, and the values and arguments that may be names: of nodes whose ends are not all known."""
        found: set[str] = set()
        for system in self.systems.values():
            for node in system.nodes:
                if is_opaque(node):
                    found |= {rule.target_name for rule in node.raw.rules if rule.target_name}
                    found |= {target for _, target in node.raw.remaps}
                    found |= set(node.raw.arguments.replace("=", " ").split())
            found |= {parameter.value for parameter in system.parameters if isinstance(parameter.value, str)}
        return frozenset(text.lstrip("/") for text in found)


def is_opaque(node: SystemNode) -> bool:
    """Whether *node* may have ends of any name: nothing is known of it, or something that makes ends could not be followed."""
    return not any(not end.implicit for end in node.ends) or any(u.field == "endpoints" for u in node.raw.unknowns)
