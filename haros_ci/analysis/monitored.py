# SPDX-License-Identifier: Apache-2.0
"""Which properties a recording of a configuration is held against, and what their topics are called in it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

from haros_ci.analysis.architectures import Architectures, project_of
from haros_ci.behaviour.declared import WORKSPACE, Owner, Stated, in_file
from haros_ci.behaviour.meaning import mistakes
from haros_ci.behaviour.messages import Constant, Scene, Typed
from haros_ci.behaviour.text import canonical
from haros_ci.behaviour.tree import Event, Expression, Property
from haros_ci.checking.kinds import TOPIC
from haros_ci.checking.properties import Properties, node_names, stated_in
from haros_ci.checking.system import Channel, System, SystemNode, systems
from haros_ci.errors import UserError
from haros_ci.model.architecture import Qos
from haros_ci.model.location import Location
from haros_ci.model.workspace import Workspace
from haros_ci.monitoring.monitor import Monitor
from haros_ci.monitoring.patterns import monitor_of
from haros_ci.records import dataclass, field

COMMAND_LINE = "command line"


@dataclass(frozen=True, slots=True)
class Monitored:
    """A property with its monitor. *node* is the instance that a property of a node is about, "" for others; *location* is None on the command line.

    *typed* says what a field of one of its events is.
    """

    title: str
    text: str
    stated: Stated
    node: str
    monitor: Monitor
    location: Location | None
    typed: Callable[[Event, Expression], Typed]


@dataclass(frozen=True, slots=True)
class Publisher:
    """Where messages of a topic come from in the source."""

    node: str
    location: Location


@dataclass(frozen=True, slots=True)
class Chosen:
    """The *configuration* ("" for none) of ROS 1 or 2, its properties, the publishers of each topic, its types and what QoS they offer, the types of services, and sentences
    about properties that are left out."""

    configuration: str
    properties: tuple[Monitored, ...]
    publishers: Mapping[str, tuple[Publisher, ...]]
    types: Mapping[str, tuple[str, ...]]
    ros: int
    notes: tuple[str, ...]
    system: System | None = None
    qos: Mapping[str, tuple[Qos | None, ...]] = field(default_factory=dict)
    services: Mapping[str, tuple[str, ...]] = field(default_factory=dict)


def chosen(
    workspace: Workspace,
    architectures: Architectures,
    configuration: str | None,
    asked: Sequence[str],
    project_file: str = "",
) -> Chosen:
    """The properties of the *configuration* and of its nodes; those *asked* for alone, by id or as text. UserError where it is not clear which."""
    made = architectures.of(workspace)
    every = tuple(systems(made.architecture, workspace))
    project = project_of(made, workspace, every, project_file=project_file)
    stated = stated_in(project) if project.project_file else ()
    name = configuration if configuration is not None else _only(stated, every, asked)
    system = _system(every, name)
    candidates = [stated for stated in stated if _is_of(stated.owner, name, system)]
    picked = tuple(_picked(candidates, asked, Owner("configuration", name) if name else WORKSPACE))
    notes = [f"{stated.location}: is no HPL; haros-ci hpl says why" for stated in picked if not _is_sound(stated)]
    properties = Properties(project, picked)
    found = [one for stated in picked if _is_sound(stated) for one in _monitored(properties, stated, system, notes)]
    if system is None:
        return Chosen(name, tuple(found), _publishers(None), {}, 1, tuple(notes))
    return Chosen(
        name,
        tuple(found),
        _publishers(system),
        {topic.name: topic.types for topic in system.topics if not _is_of_libraries(topic)},
        system.ros,
        tuple(notes),
        system,
        _qos(system),
        {service.name: service.types for service in system.services},
    )


def configuration_of(stated: Iterable[Stated], every: Sequence[System], name: str | None) -> System:
    """The configuration of this *name*, or the only one; UserError where it is not clear which."""
    found = _system(every, name if name is not None else _only(stated, every, ()))
    if found is None:
        raise UserError("no configuration is named", help="name one: --configuration NAME")
    return found


def with_properties(workspace: Workspace, architectures: Architectures, project_file: str = "") -> tuple[str, ...]:
    """The configurations of the workspace that have properties, or whose nodes have, in order of their names."""
    made = architectures.of(workspace)
    every = tuple(systems(made.architecture, workspace))
    project = project_of(made, workspace, every, project_file=project_file)
    stated = stated_in(project) if project.project_file else ()
    return tuple(sorted(s.name for s in every if any(_is_of(one.owner, s.name, s) for one in stated)))


def _system(every: Iterable[System], name: str) -> System | None:
    known = {system.name: system for system in every}
    if name and name not in known:
        shown = ", ".join(sorted(known)[:10]) or "none"
        raise UserError(f"no configuration {name} in the workspace", help=f"there is {shown}")
    return known.get(name)


def _only(stated: Iterable[Stated], every: Sequence[System], asked: Sequence[str]) -> str:
    owners = sorted({other_stated.owner.name for other_stated in stated if other_stated.owner.kind == "configuration"})
    if len(owners) == 1:
        return owners[0]
    if not owners and len(every) == 1:
        return every[0].name
    if asked and not any(other_stated.identity in asked for other_stated in stated):
        return ""
    names = owners or sorted(system.name for system in every)
    raise UserError(
        "the workspace has several configurations, and none is named",
        help=f"name the recording's: --configuration NAME; there are {', '.join(names[:10]) or 'none'}",
    )


def _is_of(owner: Owner, name: str, system: System | None) -> bool:
    if owner.kind == "node":
        return system is not None and any(node.type == owner.name for node in system.nodes)
    return owner.kind == "configuration" and owner.name == name


def _picked(candidates: Sequence[Stated], asked: Sequence[str], owner: Owner) -> Iterator[Stated]:
    if not asked:
        yield from candidates
    for text in asked:
        named = [candidate for candidate in candidates if text in (candidate.identity, candidate.source.text.strip())]
        if named:
            yield from named
            continue
        for stated in in_file(text, COMMAND_LINE, owner):
            if stated.fault is not None or (stated.parsed is not None and mistakes(stated.parsed)):
                what = stated.fault.whole if stated.fault is not None else mistakes(stated.parsed)[0].message  # type: ignore[arg-type]  # parsed where there is no fault
                raise UserError(
                    f"--property {text}: is no id of a property, and no HPL: {what}",
                    help="docs/hpl.md has the language",
                )
            yield stated


def _is_sound(stated: Stated) -> bool:
    return stated.parsed is not None and not mistakes(stated.parsed)


def _monitored(properties: Properties, stated: Stated, system: System | None, notes: list[str]) -> Iterator[Monitored]:
    property = stated.parsed
    assert property is not None
    scenes = {id(event): scene for event, scene in properties.scenes(stated)}

    def typed(event: Event, expression: Expression) -> Typed:
        scene: Scene | None = scenes.get(id(event))
        return scene.typed(expression) if scene is not None else None

    def constant(event: Event, expression: Expression) -> Any:
        found = typed(event, expression)
        return found.value if isinstance(found, Constant) else None

    given = property.metadata_of("id")
    text = canonical(property)
    title = given.value if given is not None else text
    location = None if stated.source.path == COMMAND_LINE else stated.location
    nodes = (
        [node for node in system.nodes if node.type == stated.owner.name]
        if system and stated.owner.kind == "node"
        else [None]
    )
    for node in nodes:
        names = names_in_system(property, node)
        if isinstance(names, str):
            notes.append(f"{title}: {names}")
            continue
        yield Monitored(
            title,
            text,
            stated,
            node.name if node is not None else "",
            monitor_of(property, names, constant),
            location,
            typed,
        )


def names_in_system(property: Property, node: SystemNode | None) -> dict[str, str] | str:
    """What the topics of *property* are called in the running system; a sentence where that is not known."""
    found: dict[str, str] = {}
    for event in property.events:
        topic = event.topic if event.topic[0] in "/~" else f"/{event.topic}"
        if node is None:
            found[event.topic] = topic
            continue
        names = {end.name for end in node.of(*TOPIC) if end.known and topic in node_names(end)}
        if len(names) > 1:
            return f"{event.topic} of {node.name} can be {' or '.join(sorted(names))}"
        if not names and not node.complete:
            return f"what {event.topic} of {node.name} is called when it runs is not known"
        found[event.topic] = names.pop() if names else topic if topic[0] == "/" else f"{node.name}/{topic.lstrip('~/')}"
    return found


def _is_of_libraries(topic: Channel) -> bool:
    """Whether only client libraries are on the topic."""
    return all(end.implicit for end in topic.ends)


def _qos(system: System | None) -> dict[str, tuple[Qos | None, ...]]:
    """What the publishers of each topic offer; None where that is not known."""
    found: dict[str, tuple[Qos | None, ...]] = {}
    for node in system.nodes if system is not None else ():
        for end in node.of("publishers"):
            found[end.name] = (*found.get(end.name, ()), end.qos)
    return found


def _publishers(system: System | None) -> dict[str, tuple[Publisher, ...]]:
    found: dict[str, dict[Publisher, None]] = {}
    for node in system.nodes if system is not None else ():
        for end in node.of("publishers"):
            if end.known:
                found.setdefault(end.name, {})[Publisher(node.name, end.location)] = None
    return {name: tuple(item) for name, item in found.items()}
