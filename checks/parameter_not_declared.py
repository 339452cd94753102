# SPDX-License-Identifier: Apache-2.0
"""Parameters in YAML and launch files that the node which gets them does not declare."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from haros_ci.api import (
    Check,
    Finding,
    Given,
    Level,
    Location,
    System,
    SystemNode,
    is_mentioned,
    is_read_besides,
    is_slip,
    misplaced,
    near,
)

#: So many parameters that several nodes of a launch file are given alike are one set for all of them.
_SET = 3
#: So many parameters of a node are compared with those that it declares.
_COMPARED = 300


def check(system: System) -> Iterator[Finding]:
    groups: dict[tuple[str, str, str, str], list[Given]] = {}
    meant = _Meant({}, {})
    found = list(_undeclared(system))
    in_sets = _in_sets(system, [parameter for parameter, _ in found])
    for parameter, section in found:
        if id(parameter) in in_sets:
            continue
        name = "" if section else meant.by(parameter) or (parameter.key if "." not in parameter.key else "")
        groups.setdefault(
            (parameter.node.name, parameter.at.path, section or parameter.key.rpartition(".")[0], name), []
        ).append(parameter)
    for (_, _, section, _), group in groups.items():
        lines = {parameter.place: parameter for parameter in group}
        keys = sorted({key for _, key in lines})
        first = min(group, key=lambda parameter: parameter.at.sort_key)
        hint = meant.by(first) if len(keys) == 1 else ""
        yield _finding(first, section, keys, hint, _declaring(system, group[0], keys))


def _undeclared(system: System) -> Iterator[tuple[Given, str]]:
    """What nodes are given and do not declare, with the section of which nothing is declared."""
    shared = _Shared(system)
    for parameter in system.given:
        if (
            parameter.place not in system.taken
            and parameter.place not in system.whole.taken
            and misplaced(parameter) is None
        ):
            section = _section(parameter)
            is_spare = bool(section) and _is_spare(parameter.node, section)
            if not (
                is_spare
                or is_mentioned(system, parameter.node, section or parameter.key)
                or is_read_besides(system, parameter)
                or shared.has(parameter)
            ):
                yield parameter, section


def _in_sets(system: System, undeclared: Sequence[Given]) -> set[int]:
    """Which of *undeclared* are of a set that a launch file gives to several nodes: three or more, each with the same value for a node that declares it."""
    by_node: dict[tuple[int, str], list[Given]] = {}
    for parameter in undeclared:
        if parameter.raw.origin is None:
            by_node.setdefault((id(parameter.node), parameter.at.path), []).append(parameter)
    taken = {
        (given.at.path, given.key, repr(given.value))
        for node in system.nodes
        for given in node.given
        if given.raw.origin is None and given.key in node.names.declared
    }
    found: set[int] = set()
    for (_, path), group in by_node.items():
        shared = [given for given in group if (path, given.key, repr(given.value)) in taken]
        if len({given.key for given in shared}) >= _SET:
            found.update(map(id, shared))
    return found


def _section(parameter: Given) -> str:
    """The section of the key in which the node declares nothing at all; "" if there is none."""
    parts = parameter.key.split(".")
    for count in range(1, len(parts)):
        head = ".".join(parts[:count])
        if head not in parameter.node.names.sections:
            return head
    return ""


def _is_spare(node: SystemNode, section: str) -> bool:
    """Whether values choose among sections, and this one is not chosen: ``plugins: [a]`` where ``b`` has parameters, too."""
    above, _, last = section.rpartition(".")
    found = {text for text in node.names.texts if (f"{above}.{text}" if above else text) in node.names.sections}
    return bool(found) and not any(is_slip(last, text) for text in found)


class _Shared:
    """Files that are given to several nodes of *system* as a whole; what each node is given by each file is gathered once."""

    def __init__(self, system: System) -> None:
        self.system = system
        self.given: dict[int, dict[str, set[tuple[Location, str]]]] = {}
        self.known: dict[tuple[int, int, str], bool] = {}

    def has(self, parameter: Given) -> bool:
        """Whether one file is given to several nodes as a whole, and another one declares the key, which it is given a second time elsewhere.

        All that this node is given by the file the other one is given by it, too, but for what the tag of that one sets itself.
        """
        if parameter.raw.origin is None:
            return False
        others = (other for other in self.system.nodes if other is not parameter.node)
        return any(
            parameter.key in other.names.declared and self._covers(other, parameter.node, parameter.at.path)
            for other in others
        )

    def _covers(self, other: SystemNode, node: SystemNode, path: str) -> bool:
        key = (id(other), id(node), path)
        if key not in self.known:
            theirs = self._by_path(other)
            here = theirs.get(path, set())
            elsewhere = {name for place, every in theirs.items() if place != path for _, name in every}
            ours = self._by_path(node).get(path, set())
            self.known[key] = bool(here) and all(place in here or place[1] in elsewhere for place in ours)
        return self.known[key]

    def _by_path(self, node: SystemNode) -> dict[str, set[tuple[Location, str]]]:
        if id(node) not in self.given:
            found: dict[str, set[tuple[Location, str]]] = {}
            for given in node.given:
                found.setdefault(given.at.path, set()).add(given.place)
            self.given[id(node)] = found
        return self.given[id(node)]


class _Meant(NamedTuple):
    """The parameters of nodes that nothing gives, by node, and which of them was found to be meant by what is given, by node and key."""

    free: dict[int, list[str]]
    found: dict[int, dict[str, str]]

    def by(self, parameter: Given) -> str:
        """A parameter of the node that nothing else gives, and that is called nearly the same; "" if there is none, or too many were looked for."""
        node = parameter.node
        if id(node) not in self.free:
            own = {other.key for other in node.given}
            self.free[id(node)] = [name for name in node.names.declared if name not in own]
        known = self.found.setdefault(id(node), {})
        if parameter.key not in known and len(known) < _COMPARED:
            known[parameter.key] = near(parameter.key, self.free[id(node)]) or ""
        return known.get(parameter.key, "")


def _declaring(system: System, parameter: Given, keys: Sequence[str]) -> str:
    """The one other node that declares all *keys*, which have words of their own (no ``rate``); "" if there is none, or several do."""
    if not all("_" in key for key in keys):
        return ""
    found = [
        node
        for node in system.nodes
        if node is not parameter.node and node.names.is_whole and all(key in node.names.declared for key in keys)
    ]
    return str(found[0]) if len(found) == 1 else ""


def _finding(parameter: Given, section: str, keys: Sequence[str], meant: str, declaring: str) -> Finding:
    node = parameter.node
    if len(keys) == 1:
        what = f"is given the parameter {keys[0]}, but {node.type} does not declare it"
    else:
        names = ", ".join(key.removeprefix(f"{section}.") for key in keys[:4]) + (", …" if len(keys) > 4 else "")
        what = f"is given {len(keys)} parameters below {section} that {node.type} does not declare ({names})"
    return Finding(
        at=parameter.at,
        message=f"{node} {what}: the value has no effect"
        + (
            f"; did you mean {meant}?"
            if meant
            else f"; {declaring} declares {'it' if len(keys) == 1 else 'them'}: give {'it' if len(keys) == 1 else 'them'} to that node"
            if declaring
            else "; correct the name, or remove it"
        ),
        about=(node, section if len(keys) > 1 else keys[0]),
        flow=((parameter.tag, f"{node} is given the parameters"), (parameter.at, "this one is not declared")),
        presence=parameter.presence,
    )


CHECK = Check(
    id="parameter-not-declared",
    summary="Parameter set for a node that does not declare it.",
    level=Level.WARNING,
    catalogue="P01",
    tags=("parameters",),
    run=check,
)
