# SPDX-License-Identifier: Apache-2.0
"""What tests of a configuration and of its nodes are about, from the model and the properties that a project file states."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from haros_ci.analysis.architectures import Architectures, project_of
from haros_ci.analysis.monitored import configuration_of, names_in_system
from haros_ci.analysis.requested import configurations
from haros_ci.behaviour.declared import Stated
from haros_ci.behaviour.meaning import mistakes
from haros_ci.behaviour.messages import Constant, Scene
from haros_ci.behaviour.text import canonical, time_text
from haros_ci.behaviour.tree import Bound, Event, Expression, Pattern, PatternKind, Property, Scope
from haros_ci.checking.kinds import TOPIC
from haros_ci.checking.properties import OF_ALL, Properties, stated_in
from haros_ci.checking.system import End, System, SystemNode, systems
from haros_ci.errors import UserError
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.test_files.suite import LaunchFile, Suite, Tested, Topic

PUBLISHERS, SUBSCRIBERS = TOPIC


def suites(
    workspace: Workspace,
    architectures: Architectures,
    configuration: str | None,
    project_file: str = "",
    patience: float = 2.0,
) -> tuple[Suite, ...]:
    """The suites of a configuration: its own, and one for each node with properties. *patience* bounds what has no bound, in seconds.

    UserError where it is not clear which configuration is meant, or where no launch file starts it.
    """
    made = architectures.of(workspace)
    every = tuple(systems(made.architecture, workspace))
    project = project_of(made, workspace, every, project_file=project_file)
    stated = stated_in(project) if project.project_file else ()
    system = configuration_of(stated, every, configuration)
    requested = configurations(workspace, architectures.settings.project, [], project_file) or ()
    arguments = next((item.arguments for item in requested if item.name == system.name), {})
    launches = tuple(_launches(system, arguments))
    found = _Finder(Properties(project, stated), stated, system, launches, patience)
    own = [found.suite(None), *(found.suite(node) for node in system.nodes if node.is_default)]
    return tuple(suite for suite in own if suite.properties or suite.notes)


def _launches(system: System, arguments: Mapping[str, str]) -> Iterator[LaunchFile]:
    if not system.launch:
        raise UserError(
            f"no launch file starts {system.name}",
            help="name the launch file under configurations of the project file: tests start nothing else",
        )
    given = tuple(f"{name}:={value}" for name, value in arguments.items())
    for path in system.launch:
        package, _, rest = path.partition("/")
        if package not in system.packages or not rest:
            raise UserError(f"{path} lies in no package", help="roslaunch finds launch files in packages")
        yield LaunchFile(package, rest, given)


@dataclass(frozen=True, slots=True)
class _Finder:
    properties: Properties
    stated: Sequence[Stated]
    system: System
    launches: tuple[LaunchFile, ...]
    patience: float

    def suite(self, node: SystemNode | None) -> Suite:
        """What is tested of *node*, or of the whole system."""
        tested = [node] if node is not None else [item for item in self.system.nodes if item.is_default]
        notes: list[str] = []
        inputs, outputs = self._topics(tested)
        promised, assumed = self._sorted(node, inputs, outputs, notes)
        used = {event.topic for item in (*promised, *assumed) for event in item.parsed.events}
        seen = {name: topic for name, topic in outputs.items() if name in used}
        return Suite(
            self.system.name,
            node.name if node is not None else "",
            self.system.ros,
            self.launches,
            _started(node),
            tuple(f"{item.name} ({item.type})" for item in tested),
            tuple(inputs[name] for name in sorted(inputs)),
            tuple(seen[name] for name in sorted(seen)),
            tuple(sorted(_edges(tested, inputs, seen))),
            promised,
            assumed,
            self.properties.messages(self.system.ros),
            tuple(dict.fromkeys(notes)),
        )

    def _sorted(
        self, node: SystemNode | None, inputs: Mapping[str, Topic], outputs: Mapping[str, Topic], notes: list[str]
    ) -> tuple[tuple[Tested, ...], tuple[Tested, ...]]:
        """What is put to the test, and what is taken for granted: assumptions, and promises about open topics alone."""
        promised, assumed = [], []
        for stated in self.stated:
            is_promise = self._is_own(stated, node) and not stated.is_axiom
            for item in self._resolved(stated, node, notes):
                on = {event.topic for event in item.parsed.events}
                missing = ", ".join(sorted(on - {*inputs, *outputs}))
                if missing and is_promise:
                    notes.append(f"{item.title}: not tested: the type or the nodes of {missing} are not known")
                elif not missing and is_promise and on & outputs.keys():
                    promised.append(self._bounded(item))
                elif not missing and (is_promise or stated.is_axiom):
                    assumed.append(item)
        return tuple(promised), tuple(assumed)

    def _is_own(self, stated: Stated, node: SystemNode | None) -> bool:
        """Whether the property is about this node, or about the configuration if there is none."""
        if node is not None:
            return stated.owner.kind == "node" and stated.owner.name == node.type
        return stated.owner.kind == "configuration" and stated.owner.name == self.system.name

    def _resolved(self, stated: Stated, node: SystemNode | None, notes: list[str]) -> Iterator[Tested]:
        """The property in the names of the running system, for *node* or for each instance of its node."""
        parsed = stated.parsed
        if parsed is None or mistakes(parsed):
            return
        for instance in self._instances(stated, node):
            names = names_in_system(parsed, instance)
            if isinstance(names, str):
                notes.append(f"{canonical(parsed)}: not tested: {names}")
            else:
                yield self._tested(stated, parsed, names)

    def _instances(self, stated: Stated, node: SystemNode | None) -> Sequence[SystemNode | None]:
        """The nodes that the property is about, None for the configuration; promises of a node are in a suite of its own alone."""
        owner = stated.owner
        if owner.kind == "configuration" and owner.name == self.system.name:
            return (None,)
        if owner.kind != "node" or (node is None and not stated.is_axiom):
            return ()
        if node is not None:
            return (node,) if owner.name == node.type else ()
        return [item for item in self.system.nodes if item.type == owner.name]

    def _tested(self, stated: Stated, parsed: Property, names: Mapping[str, str]) -> Tested:
        made, pairs = renamed(parsed, names)
        known = {id(event): scene for event, scene in self.properties.scenes(stated)}
        scenes = {id(new): known[id(old)] for old, new in pairs}

        def constant(event: Event, expression: Expression) -> Any:
            scene: Scene | None = scenes.get(id(event))
            typed = scene.typed(expression) if scene is not None else None
            return typed.value if isinstance(typed, Constant) else None

        text = canonical(made)
        title = parsed.metadata_of("id")
        return Tested(text if title is None else title.value, text, str(stated.location), made, scenes, constant)

    def _bounded(self, item: Tested) -> Tested:
        """The property with a bound, where it says that something comes and not when: no test waits for ever."""
        pattern = item.parsed.pattern
        if pattern.bound is not None or pattern.kind not in (PatternKind.CAUSES, PatternKind.SOME):
            return item
        bound = Bound(pattern.at, f"within {time_text(self.patience)}", self.patience)
        made = replace(item.parsed, pattern=replace(pattern, bound=bound))
        return replace(item, parsed=made, text=canonical(made), patience=self.patience)

    def _topics(self, nodes: Sequence[SystemNode]) -> tuple[dict[str, Topic], dict[str, Topic]]:
        """The open topics of *nodes*, and those on which they publish; only such as have one known type."""
        givers: dict[str, list[End]] = {}
        takers: dict[str, list[End]] = {}
        for node in nodes:
            for end in node.of(*TOPIC):
                if end.known and not end.implicit and end.name not in OF_ALL:
                    (givers if end.kind == PUBLISHERS else takers).setdefault(end.name, []).append(end)
        inputs = {name: topic for name, ends in takers.items() if name not in givers and (topic := _topic(name, ends))}
        outputs = {
            name: topic for name, ends in givers.items() if (topic := _topic(name, (*ends, *takers.get(name, ()))))
        }
        return inputs, outputs


def _topic(name: str, ends: Sequence[End]) -> Topic | None:
    types = {end.type for end in ends}
    kind = types.pop()
    if types or kind is None:
        return None
    asked = [end.qos for end in ends if end.qos is not None]
    reliable = not any(qos.reliability == "best_effort" for qos in asked)
    return Topic(name, kind, reliable, any(qos.durability == "transient_local" for qos in asked))


def _started(node: SystemNode | None) -> tuple[str, ...]:
    """The names of the nodes to start: a nodelet with its manager; () for all."""
    return () if node is None else tuple(name for name in (node.raw.container, node.name) if name)


def _edges(
    nodes: Sequence[SystemNode], inputs: Mapping[str, Topic], outputs: Mapping[str, Topic]
) -> set[tuple[str, str, bool]]:
    """The edges that have to be there before a test begins: those that no condition can keep away."""
    return {
        (node.raw.container or node.name, end.name, end.kind == PUBLISHERS)
        for node in nodes
        for end in node.of(*TOPIC)
        if not end.conditions and end.name in (outputs if end.kind == PUBLISHERS else inputs)
    }


def renamed(parsed: Property, names: Mapping[str, str]) -> tuple[Property, list[tuple[Event, Event]]]:
    """*parsed* with other names of topics, and its events with those that they became."""
    pairs: list[tuple[Event, Event]] = []

    def events(group: tuple[Event, ...]) -> tuple[Event, ...]:
        made = tuple(replace(event, topic=names[event.topic]) for event in group)
        pairs.extend(zip(group, made))
        return made

    scope, pattern = parsed.scope, parsed.pattern
    made = replace(
        parsed,
        scope=Scope(scope.at, scope.kind, events(scope.activator), events(scope.terminator)),
        pattern=Pattern(pattern.at, pattern.kind, events(pattern.behaviour), events(pattern.trigger), pattern.bound),
    )
    return made, pairs
