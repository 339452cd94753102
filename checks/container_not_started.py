# SPDX-License-Identifier: Apache-2.0
"""Components and nodelets that are to be loaded into a container that is not there."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Decidability, Finding, Level, System, SystemNode, is_slip


def check(system: System) -> Iterator[Finding]:
    if not system.is_launched:
        return
    names = {node.name for node in system.nodes}
    # Other nodes: an unknown name may be the container's.
    if not all(node.known for node in system.nodes):
        return
    lost: dict[str, list[SystemNode]] = {}
    for node in system.nodes:
        container = node.raw.container
        if container and "?" not in container and container not in names and not node.raw.conditions:
            lost.setdefault(container, []).append(node)
    for container, nodes in lost.items():
        meant = _meant(container, system)
        if meant is not None or system.closed:
            yield _finding(container, nodes, meant)


def _meant(container: str, system: System) -> SystemNode | None:
    """A node that has components or is a container, of nearly that name: in another namespace, or misspelt."""
    space, _, last = container.rpartition("/")
    used = {node.raw.container for node in system.nodes}
    for node in system.nodes:
        if not any(word in node.raw.type for word in ("container", "manager", "nodelet")) and node.name not in used:
            continue
        other, _, name = node.name.rpartition("/")
        if name == last or (space == other and is_slip(name, last)):
            return node
    return None


def _finding(container: str, nodes: list[SystemNode], meant: SystemNode | None) -> Finding:
    first = nodes[0]
    more = f" and {len(nodes) - 1} more" if len(nodes) > 1 else ""
    hint = f", but {meant.name}" if meant is not None else ""
    word = "nodelet manager" if first.ros == 1 else "container"
    advice = f"; load into {meant.name}" if meant is not None else f"; start the {word}"
    return Finding(
        at=first.location,
        message=f"{first.name}{more} is loaded into the container {container}, which the launch file does not "
        f"start{hint}: the loader waits for that {word}, and the component never runs{advice}",
        about=(*nodes, container, *((meant,) if meant is not None else ())),
        related=(
            *((node.location, f"{node.name} is also loaded into it") for node in nodes[1:]),
            *(((meant.location, f"{meant.name} is started here"),) if meant is not None else ()),
        ),
    )


CHECK = Check(
    id="container-not-started",
    summary="Components loaded into a container that the launch file does not start.",
    level=Level.ERROR,
    decidability=Decidability.CLOSED_WORLD,
    catalogue="G17",
    tags=("components", "nodelets", "launch"),
    run=check,
)
