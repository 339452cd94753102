# SPDX-License-Identifier: Apache-2.0
"""What a picture of a configuration is made of: nodes, what connects them, and the boxes around them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

from haros_ci.model.architecture import Configuration, Node
from haros_ci.records import dataclass, field
from haros_ci.report.channels import OUTGOING, Channel, channels, nodes_of

#: Names that nearly every node has or uses, by the switch that shows them: the last part of the name.
WELL_KNOWN: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("rosout", ("rosout", "rosout_agg")),
    ("tf", ("tf", "tf_static")),
    ("clock", ("clock",)),
    ("diagnostics", ("diagnostics", "diagnostics_agg", "bond")),
    (
        "parameter services",
        (
            "parameter_events", "describe_parameters", "get_parameter_types", "get_parameters", "list_parameters",
            "set_parameters", "set_parameters_atomically", "get_type_description", "get_loggers", "set_logger_level",
        ),
    ),
    (
        "life cycle services",
        ("change_state", "get_state", "get_available_states", "get_available_transitions", "get_transition_graph", "transition_event"),
    ),
)  # fmt: skip
_SWITCH = {name: switch for switch, names in WELL_KNOWN for name in names}
#: Where there is room, what only one node has is drawn as well.
FEW = 40
#: The most that is drawn; what is larger is shown as tables.
MOST_ELEMENTS, MOST_EDGES = 1_200, 4_000


def switch_of(channel: Channel) -> str:
    """The switch that shows *channel*, "" for what is always shown."""
    known = _SWITCH.get(channel.name.rpartition("/")[2], "")
    return known or ("parameter services" if channel.implicit else "")


@dataclass(frozen=True, slots=True)
class Drawn:
    """A channel in the picture: the index of each node at it, and whether the arrow goes from the node to it."""

    channel: Channel
    ends: tuple[tuple[int, bool], ...]
    switch: str
    box: int = -1


@dataclass(frozen=True, slots=True)
class Box:
    """A namespace or a container of components, with the index of the box around it, -1 for none."""

    kind: str
    name: str
    parent: int = -1


@dataclass(slots=True)
class Elements:
    """The nodes in their order with the box of each, the channels that are drawn, and by node what only it has."""

    nodes: tuple[Node, ...]
    boxes: list[Box] = field(default_factory=list)
    box_of: list[int] = field(default_factory=list)
    channels: list[Drawn] = field(default_factory=list)
    own: list[list[Channel]] = field(default_factory=list)

    @property
    def is_too_large(self) -> bool:
        edges = sum(len(channel.ends) for channel in self.channels)
        return len(self.nodes) + len(self.channels) > MOST_ELEMENTS or edges > MOST_EDGES


def elements(configuration: Configuration) -> Elements:
    """What is drawn of *configuration*. A name that is not known is one node's own, as it meets no other."""
    nodes = nodes_of(configuration)
    made = Elements(nodes, own=[[] for _ in nodes])
    _boxes(made)
    index = {id(node): number for number, node in enumerate(nodes)}
    every = channels(configuration)
    has_room = sum(not channel.implicit for channel in every) + len(nodes) <= FEW
    for channel in every:
        ends = dict.fromkeys((index[id(node)], end.kind in OUTGOING) for node, end in channel.ends)
        touched = {number for number, _ in ends}
        switch = switch_of(channel)
        if len(touched) > 1 or (has_room and not switch and "?" not in channel.name):
            made.channels.append(Drawn(channel, tuple(ends), switch, _common(made, touched)))
        elif not switch:
            made.own[min(touched)].append(channel)
    return made


def _boxes(made: Elements) -> None:
    """A box for each container with components, and for each namespace of several nodes."""
    spaces = Counter(space for node in made.nodes for space in _above(node.name))
    containers = {node.container for node in made.nodes if node.container is not None and node.kind != "nodelet"}
    held = Counter(container for node in made.nodes if (container := _container(node, containers)) is not None)
    known: dict[tuple[str, str], int] = {}

    def space_box(name: str, more_than: int = 1) -> int:
        """The box of the innermost namespace around *name* that has more nodes than so many, and not all of them."""
        for space in _above(name):
            inner = any(one.rpartition("/")[0] == space and spaces[one] == spaces[space] for one in spaces)
            if more_than < spaces[space] < len(made.nodes) and not inner:
                return box("namespace", space, 1)
        return -1

    def box(kind: str, name: str, more_than: int) -> int:
        if (kind, name) not in known:
            parent = space_box(name, more_than)
            known[kind, name] = len(made.boxes)
            made.boxes.append(Box(kind, name, parent))
        return known[kind, name]

    for node in made.nodes:
        container = _container(node, containers)
        made.box_of.append(
            box("container", container, held[container]) if container is not None else space_box(node.name)
        )


def _container(node: Node, containers: set[str]) -> str | None:
    """The container that *node* is in, or is, None for none whose name is known."""
    name = node.container if node.container in containers else node.name if node.name in containers else None
    return name if name is not None and "?" not in name else None


def _above(name: str) -> list[str]:
    """The namespaces around a name, the innermost first, the root left out."""
    parts = name.rpartition("/")[0]
    found: list[str] = []
    while parts and "?" not in parts and len(found) < 20:
        found.append(parts)
        parts = parts.rpartition("/")[0]
    return found


def _common(made: Elements, touched: Iterable[int]) -> int:
    """The innermost box around all the nodes *touched*, -1 for none."""
    ways = [ancestors(made.boxes, made.box_of[number]) for number in touched]
    shared = set(ways[0]).intersection(*ways[1:])
    return next((box for box in ways[0] if box in shared), -1)


def ancestors(boxes: Sequence[Box], box: int) -> list[int]:
    """*box* and those around it, the innermost first."""
    found = []
    while box != -1:
        found.append(box)
        box = boxes[box].parent
    return found
