# SPDX-License-Identifier: Apache-2.0
"""Which node of the base is which node at head, in one configuration."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from haros_ci.changes.names import is_known, likeness, relative, too_many
from haros_ci.model.architecture import Endpoint, Node
from haros_ci.records import dataclass

#: Of the ends of two nodes of one program, so many have to be the same for the one to be the other under a new name.
ALIKE = 0.5
#: Of two programs.
ALIKE_PROGRAMS = 0.7

Ends = frozenset[tuple[str, str]]


@dataclass(frozen=True, slots=True)
class Pairs:
    """Nodes that are there on both sides, and those of one side alone."""

    both: tuple[tuple[Node, Node], ...]
    removed: tuple[Node, ...]
    added: tuple[Node, ...]


def identity(node: Node) -> tuple[str, str, str]:
    """What runs, whatever it is called."""
    return (node.package, node.type, node.class_name or "")


def program(node: Node) -> str:
    """``package/executable``, or package and class."""
    return f"{node.package}/{node.type}"


def said_ends(node: Node) -> Iterator[Endpoint]:
    """The ends whose changes are reported: all but those that the client library makes by itself."""
    for end in node.endpoints:
        if not end.implicit and not _is_derived(end, node):
            yield end


def _is_derived(end: Endpoint, node: Node) -> bool:
    """``qos_overrides`` come with a topic, ``use_sim_time`` with the node; ROS 2 reads what it has declared."""
    if node.ros == 2 and end.kind in ("getters", "setters"):
        return True
    name = relative(end.name, node.name)
    return end.kind == "parameters" and (name.startswith("qos_overrides.") or name == "use_sim_time")


def pair(base: Iterable[Node], head: Iterable[Node]) -> Pairs:
    """The nodes of a configuration on both sides: by name, then under a new name by what they run and have."""
    both: list[tuple[Node, Node]] = []
    left, right = _grouped(base), _grouped(head)
    removed: list[Node] = []
    for name, nodes in left.items():
        others = right.pop(name, [])
        both += _zipped(nodes, others)
        removed += nodes[len(others) :]
        right.setdefault(name, []).extend(others[len(nodes) :])
    added = [node for nodes in right.values() for node in nodes]
    renamed = [*_renamed(removed, added)]
    paired = {id(node) for pair in renamed for node in pair}
    left_over = (tuple(node for node in nodes if id(node) not in paired) for nodes in (removed, added))
    return Pairs((*both, *renamed), *left_over)


def _grouped(nodes: Iterable[Node]) -> dict[str, list[Node]]:
    groups: dict[str, list[Node]] = {}
    for node in nodes:
        groups.setdefault(node.name, []).append(node)
    return groups


def _zipped(nodes: list[Node], others: list[Node]) -> Iterator[tuple[Node, Node]]:
    """Several nodes of one name: those that run the same first; both lists lose what is left over at their ends."""
    if len(nodes) == len(others) == 1:
        yield nodes[0], others[0]
        return
    order = {identity(node): number for number, node in enumerate(nodes)}
    others.sort(key=lambda node: order.get(identity(node), len(order)))
    rank = {identity(node): number for number, node in enumerate(others)}
    nodes.sort(key=lambda node: rank.get(identity(node), len(rank)))
    yield from zip(nodes, others, strict=False)


def _renamed(removed: list[Node], added: list[Node]) -> Iterator[tuple[Node, Node]]:
    """Pairs of one program under two names, the likest first."""
    if too_many(removed, added):
        return
    ranked = []
    ends = {id(node): ends_of(node) for node in (*removed, *added)}
    for number, node in enumerate(removed):
        for place, other in enumerate(added):
            if identity(node) == identity(other) and node.kind == other.kind and is_known(node.name + other.name):
                same = share(ends[id(node)], ends[id(other)])
                if same >= ALIKE:
                    ranked.append((-likeness(node.name, other.name), -same, number, place))
    taken: set[int] = set()
    for _, _, number, place in sorted(ranked):
        node, other = removed[number], added[place]
        if not {id(node), id(other)} & taken:
            taken |= {id(node), id(other)}
            yield node, other


def ends_of(node: Node) -> Ends:
    """Kinds and names of its ends, whatever the node is called."""
    return frozenset((end.kind, relative(end.original_name, node.name)) for end in said_ends(node))


def share(one: Ends, other: Ends) -> float:
    """Of what either has, the part that both have; 1 where neither has anything."""
    return len(one & other) / len(one | other) if one or other else 1.0
