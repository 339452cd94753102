# SPDX-License-Identifier: Apache-2.0
"""What is verified of a configuration: its own properties, with those of its nodes as axioms."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from haros_ci.analysis.architectures import Architectures
from haros_ci.analysis.monitored import Chosen, Monitored, chosen
from haros_ci.checking.kinds import TOPIC
from haros_ci.checking.properties import CONTAINERS
from haros_ci.checking.system import End, System, SystemNode
from haros_ci.errors import UserError
from haros_ci.model.architecture import Qos
from haros_ci.model.location import Location
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.verification.problem import Claim, Limits, Member, Network, Problem

#: Properties that are verified at once, and axioms.
MOST_CLAIMS, MOST_AXIOMS = 200, 500


@dataclass(frozen=True, slots=True)
class ToVerify:
    """A *problem*, the properties by the numbers of its claims and axioms, what they were *chosen* from, and sentences about what is left out."""

    problem: Problem
    properties: tuple[Monitored, ...]
    chosen: Chosen
    notes: tuple[str, ...]

    @property
    def incomplete(self) -> tuple[str, ...]:
        """The nodes that may publish on topics that are not known."""
        nodes = (node for node in _nodes(self.chosen.system) if node.package not in CONTAINERS)
        return tuple(
            node.name for node in nodes if not node.complete or not all(end.known for end in node.of("publishers"))
        )

    def places(self, node: str, topic: str, kind: str) -> tuple[Location, ...]:
        """Where *node* publishes on *topic*, or subscribes to it (*kind* as in the model)."""
        ends = (end for member in _nodes(self.chosen.system) if member.name == node for end in member.of(kind))
        return tuple(dict.fromkeys(end.location for end in ends if end.name == topic))


def to_verify(
    workspace: Workspace,
    architectures: Architectures,
    configuration: str | None,
    asked: Sequence[str],
    project_file: str,
    network: Network,
    limits: Limits,
) -> ToVerify:
    """The problem of one configuration; of its properties only those *asked* for. UserError where there is nothing to verify."""
    every = chosen(workspace, architectures, configuration, (), project_file)
    if every.system is None:
        raise UserError("no configuration is named", help="name one: --configuration NAME")
    axioms, claims = _parted(every)
    notes = list(every.notes)
    if asked:
        picked = chosen(workspace, architectures, every.configuration, asked, project_file)
        claims = list(_questions(picked.properties))
        notes += [note for note in picked.notes if note not in notes]
    if not claims:
        for_nodes = f" ({len(axioms)} of its nodes are axioms)" if axioms else ""
        raise UserError(
            f"the configuration {every.configuration} has no properties to verify{for_nodes}",
            help="state them in the project file under hpl of the configuration, or give --property 'globally: …'",
        )
    notes += [*_cut(claims, MOST_CLAIMS, "properties"), *_cut(axioms, MOST_AXIOMS, "axioms")]
    properties = (*axioms, *claims)
    made = tuple(_claim(number, item) for number, item in enumerate(properties))
    members = tuple(_member(node) for node in _nodes(every.system))
    problem = Problem(members, made[: len(axioms)], made[len(axioms) :], network, limits)
    return ToVerify(problem, properties, every, tuple(notes))


def _parted(every: Chosen) -> tuple[list[Monitored], list[Monitored]]:
    """What is taken for granted, and what is in question."""
    running = {node.name for node in _nodes(every.system)}
    stated = [item for item in every.properties if not item.node or item.node in running]
    axioms = [item for item in stated if item.node or item.stated.is_axiom]
    return axioms, [item for item in stated if not item.node and not item.stated.is_axiom]


def _cut(found: list[Monitored], most: int, what: str) -> Iterator[str]:
    """Leave out what is too much."""
    if len(found) > most:
        yield f"of {len(found)} {what} the first {most} are looked at"
        del found[most:]


def _nodes(system: System | None) -> tuple[SystemNode, ...]:
    """The nodes that run with the launch arguments as they are by default."""
    return tuple(node for node in system.nodes if node.is_default) if system is not None else ()


def _questions(picked: Iterable[Monitored]) -> Iterator[Monitored]:
    """Those that are asked for, which must be about the configuration."""
    for item in picked:
        if item.node or item.stated.is_axiom:
            raise UserError(
                f"--property {item.title}: is taken for granted here, as it is one of a node, or an assumption",
                help="haros-ci verify verifies properties of configurations",
            )
        yield item


def _claim(number: int, item: Monitored) -> Claim:
    monitor = item.monitor
    return Claim(number, item.title, monitor.property, dict(monitor.names), item.node, item.typed, monitor.constants)


def _member(node: SystemNode) -> Member:
    ends = [end for end in node.of(*TOPIC) if end.known]
    publishes = frozenset(end.name for end in ends if end.kind == "publishers")
    return Member(node.name, publishes, {end.name: _queue(end) for end in ends if end.kind == "subscribers"})


def _queue(end: End) -> int | None:
    """How many messages the queue of a subscriber holds; None if that is not known, 0 without end."""
    qos: Qos | None = end.qos
    if qos is None:
        return end.raw.queue_size
    if qos.history == "keep_all":
        return 0
    return qos.depth if isinstance(qos.depth, int) else None
