# SPDX-License-Identifier: Apache-2.0
"""Which configuration of the base is which at head, and what is there on one side alone."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

from haros_ci.changes.change import ADDED, CHANGED, REMOVED, RENAMED, Difference
from haros_ci.changes.names import is_known
from haros_ci.changes.nodes import ALIKE_PROGRAMS, ends_of, identity, program, said_ends, share
from haros_ci.model.architecture import Architecture, Configuration, Endpoint, Node
from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True)
class Matched:
    """Configurations on both sides, nodes to compare where one side starts them elsewhere, and what is on one side alone."""

    both: tuple[tuple[Configuration, Configuration], ...]
    elsewhere: tuple[tuple[Node, Node, str], ...]
    differences: tuple[Difference, ...]


def match(
    base: Architecture, head: Architecture, moved: Callable[[str], str], is_there: Callable[[str, str], bool]
) -> Matched:
    """The configurations by name; launch files that have moved, programs that another launch file starts now.

    *moved* says where a launch file (``package/path``) of the base is now, *is_there* whether one is on a side (``base`` or ``head``): a launch
    file that another one includes now is no configuration any more, and still not gone.
    """
    left = {configuration.name: configuration for configuration in base.configurations}
    right = {configuration.name: configuration for configuration in head.configurations}
    both = [(left.pop(name), right.pop(name)) for name in list(left) if name in right]
    found: list[Difference] = []
    for name, configuration in list(left.items()):
        other = right.get(moved(name)) if configuration.launch else None
        other = other or _same_system(configuration, right.values())
        if other is not None:
            both.append((left.pop(name), right.pop(other.name)))
            if configuration.launch and not is_there(name, "head"):
                found.append(_launch_file(RENAMED, other, old=name))
    elsewhere: list[tuple[Node, Node, str]] = []
    programs = _programs(base), _programs(head)
    for configuration in left.values():
        if configuration.launch:
            if not is_there(configuration.name, "head"):
                found.append(_launch_file(REMOVED, configuration))
            continue
        pairs = [(node, _whole(programs[1].get(identity(node), ()), node)) for node in configuration.nodes]
        elsewhere += [(node, other, configuration.name) for node, other in pairs if other is not None]
    for configuration in right.values():
        if configuration.launch:
            if not is_there(configuration.name, "base"):
                found.append(_launch_file(ADDED, configuration))
            continue
        pairs = [(node, _whole(programs[0].get(identity(node), ()), node)) for node in configuration.nodes]
        elsewhere += [(other, node, configuration.name) for node, other in pairs if other is not None]
    differences, renamed = _renamed_programs(*programs)
    return Matched(tuple(both), (*elsewhere, *renamed), (*found, *differences))


def _same_system(configuration: Configuration, others: Iterable[Configuration]) -> Configuration | None:
    """A launch file under a new name: the one other that starts the same nodes."""
    if not configuration.launch or not configuration.nodes:
        return None
    mine = sorted((node.name, identity(node)) for node in configuration.nodes)
    same = [o for o in others if o.launch and sorted((node.name, identity(node)) for node in o.nodes) == mine]
    return same[0] if len(same) == 1 else None


def _launch_file(action: str, configuration: Configuration, old: str = "") -> Difference:
    nodes = tuple(sorted({node.name for node in configuration.nodes if is_known(node.name)}))
    text = f"starts {len(configuration.nodes)} node{'' if len(configuration.nodes) == 1 else 's'}"
    return Difference(
        what="launch file",
        action=action,
        name=configuration.name,
        before=old or (text if action == REMOVED else None),
        after=configuration.name if old else text if action == ADDED else None,
        old_name=old,
        configuration=configuration.name,
        details=nodes,
    )


Programs = dict[tuple[str, str, str], tuple[Node, ...]]


def _programs(architecture: Architecture) -> Programs:
    """Every program with the nodes that run it anywhere."""
    found: dict[tuple[str, str, str], list[Node]] = {}
    for configuration in architecture.configurations:
        for node in configuration.nodes:
            found.setdefault(identity(node), []).append(node)
    return {key: tuple(nodes) for key, nodes in found.items()}


def _whole(nodes: tuple[Node, ...], like: Node) -> Node | None:
    """One node with the ends of all *nodes*, under the name of *like*; None without any."""
    if not nodes:
        return None
    if len(nodes) == 1:
        return nodes[0]
    ends: dict[tuple[str, str, str | None], Endpoint] = {}
    for node in nodes:
        for end in node.endpoints:
            if end.name.startswith(node.name):
                end = replace(
                    end,
                    name=like.name + end.name[len(node.name) :],
                    original_name=like.name + end.original_name[len(node.name) :],
                )
            ends.setdefault((end.kind, end.name, end.type), end)
    doubts = tuple(dict.fromkeys(unknown for node in nodes for unknown in node.unknowns))
    return replace(nodes[0], name=like.name, endpoints=tuple(ends.values()), unknowns=doubts, remaps=(), rules=())


def _is_own(node: Node) -> bool:
    """Whether its program was followed from source in this workspace, not taken from the table of known nodes."""
    return node.location is not None and bool(node.type) and is_known(f"{node.package}/{node.type}") and any(
        end.source in ("source", "exact-tier") for end in node.endpoints
    )  # fmt: skip


def _renamed_programs(base: Programs, head: Programs) -> tuple[list[Difference], list[tuple[Node, Node, str]]]:
    """Programs that are on one side alone; those of one package with mostly the same ends are renamed."""
    removed = {
        key: nodes[0] for key, nodes in base.items() if key[:2] not in {k[:2] for k in head} and _is_own(nodes[0])
    }
    new = {key: nodes[0] for key, nodes in head.items() if key[:2] not in {k[:2] for k in base} and _is_own(nodes[0])}
    renamed: list[tuple[Node, Node, str]] = []
    differences: list[Difference] = []
    ranked = sorted(
        ((share(ends_of(a), ends_of(b)), key, other) for key, a in removed.items() for other, b in new.items()
         if key[0] == other[0] and ends_of(a)),
        key=lambda item: (-item[0], item[1:]),
    )  # fmt: skip
    for same, key, other in ranked:
        if same < ALIKE_PROGRAMS or key not in removed or other not in new:
            continue
        node, now = removed.pop(key), new.pop(other)
        renamed.append((node, now, program(now)))
        differences.append(
            Difference(
                what="node", action=RENAMED, name=program(now), aspect="program", old_name=program(node), before=program(node),
                after=program(now), program=program(now), base=node.location, head=now.location,
            )
        )  # fmt: skip
    differences += (_program(REMOVED, node) for node in removed.values())
    differences += (_program(ADDED, node) for node in new.values())
    return differences, renamed


def _program(action: str, node: Node) -> Difference:
    text = summary(node)
    return Difference(
        what="node",
        action=action,
        name=program(node),
        aspect="program",
        before=text if action == REMOVED else None,
        after=text if action == ADDED else None,
        program=program(node),
        node=node.name if is_known(node.name) else "",
        details=listed(node),
    )


def summary(node: Node) -> str:
    """``2 publishers, 1 service server, 12 parameters``."""
    words = (("publishers", "publisher"), ("subscribers", "subscriber"), ("servers", "service"), ("action_servers", "action"),
             ("parameters", "parameter"), ("getters", "parameter"))  # fmt: skip
    counts: dict[str, int] = {}
    for end in said_ends(node):
        word = dict(words).get(end.kind)
        if word is not None:
            counts[word] = counts.get(word, 0) + 1
    counted = [f"{number} {word}{'' if number == 1 else 's'}" for word, number in counts.items()]
    return f"node {node.name}" + (f": {', '.join(counted)}" if counted else "")


def listed(node: Node) -> tuple[str, ...]:
    """The ends of a node, one text each: ``publisher /odom nav_msgs/msg/Odometry``."""
    from haros_ci.changes.endpoints import WORDS

    phrases = (f"{WORDS[end.kind]} {end.name} {end.type or '?'}" for end in said_ends(node) if end.kind in WORDS)
    return tuple(sorted(dict.fromkeys(phrases)))


def compare_nodes(base: Node, head: Node, configuration: str) -> Iterator[Difference]:
    """What is otherwise of a node as a whole: its name, what it runs, of which kind it is."""
    differences: list[tuple[str, str, str, str]] = []
    if base.name != head.name and is_known(base.name + head.name):
        differences.append((RENAMED, "name", base.name, head.name))
    if program(base) != program(head) and is_known(program(base) + program(head)):
        differences.append((CHANGED, "program", program(base), program(head)))
    elif base.kind != head.kind:
        differences.append((CHANGED, "kind", base.kind, head.kind))
    for action, aspect, before, after in differences:
        yield Difference(
            what="node",
            action=action,
            name=head.name,
            aspect=aspect,
            before=before,
            after=after,
            old_name=before if action == RENAMED else "",
            node=head.name,
            program=program(head),
            configuration=configuration,
            base=base.location,
            head=head.location,
        )


def one_sided(action: str, node: Node, configuration: str) -> Difference:
    """A node that is there on one side alone."""
    text = program(node)
    return Difference(
        what="node",
        action=action,
        name=node.name,
        before=text if action == REMOVED else None,
        after=text if action == ADDED else None,
        node=node.name,
        program=program(node),
        configuration=configuration,
        base=node.location if action == REMOVED else None,
        head=node.location if action == ADDED else None,
        details=listed(node),
    )
