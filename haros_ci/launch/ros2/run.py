# SPDX-License-Identifier: Apache-2.0
"""One evaluation of ROS 2 launch descriptions: its actions performed, the nodes found so far, and what is put off."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

from haros_ci.launch.facts import ros2
from haros_ci.launch.ros2 import presences
from haros_ci.launch.ros2.assuming import assume
from haros_ci.launch.ros2.context import Context, GroupScope, LaunchBudgetExhausted
from haros_ci.launch.ros2.including import include
from haros_ci.launch.ros2.launching_processes import launched
from haros_ci.launch.ros2.node import TOOLS, component, full_name, loading, node, processes
from haros_ci.launch.ros2.settings import SETTERS, doubt, kept, name_of
from haros_ci.launch.ros2.substitutions import truth_of
from haros_ci.launch.ros2.written import note_written
from haros_ci.model.architecture import Condition
from haros_ci.model.faults import FAULTS, fault
from haros_ci.model.launch import LaunchedNode
from haros_ci.model.launch_actions import Action, Description
from haros_ci.model.location import Location
from haros_ci.model.presence import Presence
from haros_ci.records import dataclass, field
from haros_ci.substitutions.names import Text, literal, quoted, unknown
from haros_ci.substitutions.presence import Assumed

#: How deep groups, includes and lists may be nested, together.
MAX_DEPTH = 80
#: How many actions may be put off until something happens.
MAX_EVENTS = 1_000
#: How many assumptions about launch arguments are made inside one another.
MAX_ASSUMPTIONS = 3
SHUT_DOWN = "launch is shut down here as soon as it has begun, whatever it has started; shut it down when something has happened"
_Conditions = tuple[Condition, ...]


@dataclass(slots=True)
class LaunchEvaluation:
    """One evaluation: the nodes found so far, and the actions put off until their events."""

    context: Context
    load: Callable[[str], Description | None]
    given: frozenset[str]
    nodes: list[LaunchedNode] = field(default_factory=list)
    arguments: dict[str, Text] = field(default_factory=dict)
    declared: set[str] = field(default_factory=set)
    included: set[str] = field(default_factory=set)
    waiting: list[tuple[Action, _Conditions, str, Presence, Assumed, tuple[Location, ...]]] = field(
        default_factory=list
    )
    #: The includes that lead here: path and configurations when it was begun.
    chain: list[tuple[str, tuple[tuple[str, Text], ...]]] = field(default_factory=list)
    #: Containers that have been started, by the handle that a load has of one.
    containers: dict[str, Text] = field(default_factory=dict)
    depth: int = 0
    #: What is started with other launch arguments, and how many assumptions lead here.
    alternatives: list[LaunchedNode] = field(default_factory=list)
    assumptions: int = 0

    def file(self, path: str, provided: Mapping[str, Text]) -> None:
        """One file named by the user, in a context of its own."""
        context = self.context
        context.scope = GroupScope(dict(provided), dict(context.initial))
        description = self.description(path)
        if description is None:
            context.problem(Location(path), "no ROS 2 launch file of the workspace; correct its path")
            self.declared.update(provided)
            return
        self.inside(path, description.actions, ())

    def inside(self, path: str, actions: tuple[Action, ...], conditions: _Conditions) -> None:
        """Perform the actions of the file at *path*; where one of them asks, that is the launch file it is in."""
        before = self.context.path
        self.context.path = path
        self.chain.append((path, tuple(sorted(self.context.scope.configurations.items(), key=lambda item: item[0]))))
        self.actions(actions, conditions)
        self.chain.pop()
        self.context.path = before

    def description(self, path: str) -> Description | None:
        found = self.load(path)
        if found is None:
            return None
        self.context.files.add(path)
        for line, message in found.problems:
            self.context.problem(Location(path, line), message)
        ros2.foreign(self.context, found)
        return found

    def events(self) -> None:
        """What is done when something happens is done after all else, when every scope has been left."""
        done = 0
        while self.waiting and done < MAX_EVENTS:
            action, conditions, path, presence, assumed, self.context.included = self.waiting.pop(0)
            self.context.path = path
            done += 1
            if assumed:
                assume(self, assumed, presence, partial(self.actions, action.children, conditions))
                continue
            self.context.presence = presence
            self.actions(action.children, conditions)
            self.context.presence = ()

    def actions(self, actions: tuple[Action, ...], conditions: _Conditions) -> None:
        self.depth += 1
        if self.depth > MAX_DEPTH:
            location = actions[0].location if actions else None
            message = f"groups and includes are nested deeper than {MAX_DEPTH}; what is inside is left out"
            self.context.problem(location, message)
        else:
            for action in actions:
                self.context.spend(5)
                self._contained(action, conditions)
        self.depth -= 1

    def _contained(self, action: Action, conditions: _Conditions) -> None:
        """Perform *action*; a fault of ours in it is a problem there, and what stands behind it is performed."""
        context = self.context
        depth, chain, assumptions = self.depth, len(self.chain), self.assumptions
        path, scope, presence, assumed = context.path, context.scope, context.presence, context.assumed
        try:
            self.action(action, conditions)
        except FAULTS as err:
            self.depth, self.assumptions = depth, assumptions
            del self.chain[chain:]
            context.path, context.scope, context.presence, context.assumed = path, scope, presence, assumed
            context.problem(action.location, fault("what this does could not be followed", err))
            context.facts.is_open = True

    def action(self, action: Action, conditions: _Conditions, handler: _Handler | None = None) -> None:
        """Perform *action* if its tests hold; if that is not known, under a condition that they do."""
        context = self.context
        undecided = self.undecided(action)
        handler = handler or _HANDLERS.get(action.kind, LaunchEvaluation.setting if action.kind in SETTERS else None)
        key = presences.key_of(context, action) if not (action.kind == "arg" and len(self.chain) == 1) else None
        before = presences.stored(context, key) if key is not None else None
        if undecided is not None:
            outer = context.presence
            context.presence = presences.held(context, action.tests)
            self.perform(action, conditions, undecided, handler)
            context.presence = outer
        elif handler is not None and action.kind in presences.STARTING and self.assumptions < MAX_ASSUMPTIONS:
            other = presences.otherwise(context, action.tests)
            if other is not None:
                assumed = {**context.assumed, **other[0]}
                assume(self, assumed, other[1], lambda: self.perform(action, conditions, (), handler))
        if key is not None:
            presences.guard(context, action, key, before)

    def perform(
        self, action: Action, conditions: _Conditions, undecided: _Conditions, handler: _Handler | None
    ) -> None:
        if handler is None:
            if action.kind not in ("shutdown", "log", "set-use-sim-time"):
                reason = action.reason or f"an action '{action.kind}'"
                self.context.problem(action.location, f"what this does is not known: {reason}")
                self.context.facts.is_open = True
            elif action.kind == "shutdown" and not conditions and not undecided:
                self.context.problem(action.location, SHUT_DOWN)
            return
        ros2.constructs(self.context, action)
        if not undecided:
            handler(self, action, conditions)
            return
        before = self.context.scope.copy()
        self.context.spend(len(before.configurations) // 4 + len(before.environment) // 4)
        counts = (len(before.remaps or ()), len(before.parameters or ()))
        handler(self, action, (*conditions, *undecided))
        doubt(self.context, before, counts, undecided)

    def undecided(self, action: Action) -> _Conditions | None:
        """The tests of *action* that may hold, as conditions; None if one does not."""
        found: list[Condition] = []
        for test in action.tests:
            holds = self.context.test(test)
            ros2.tested(self.context, test, holds, action.location)
            if holds is False:
                return None
            if holds is None:
                statement = "unless" if test.kind == "unless" else "if"
                text = test.text or test.reason or "?"
                found.append(Condition(statement, text, test.location or action.location))
        return tuple(found)

    def setting(self, action: Action, conditions: _Conditions) -> None:
        SETTERS[action.kind](self.context, action)
        if action.kind == "let":
            ros2.let(self.context, action)

    def written(self, action: Action, conditions: _Conditions) -> None:
        note_written(self.context, action)

    def nested(self, action: Action, conditions: _Conditions) -> None:
        self.actions(action.children, conditions)

    def arg(self, action: Action, conditions: _Conditions) -> None:
        name = name_of(self.context, action)
        if name is None:
            return
        configurations = self.context.scope.configurations
        self.declared.add(name)
        default = action.get("default")
        performed = None
        if name not in configurations:
            if default is None:
                configurations[name] = unknown(f"launch argument {quoted(name)} has no default and is not given")
            else:
                performed = configurations[name] = self.context.text(default)
            is_own = True
        else:
            is_own = name in self.given and configurations[name].origin is None
        ros2.declared(self.context, action, name, performed)
        if len(self.chain) == 1:
            if is_own and self.context.arguments is not None and not self.assumptions:
                choices = (self.context.text(phrase).raw for key, phrase in action.phrases if key == "choices")
                configurations[name] = self.context.arguments.declare(name, configurations[name], choices)
            self.arguments.setdefault(name, configurations[name])

    def group(self, action: Action, conditions: _Conditions) -> None:
        outer = self.context.scope
        keep = kept(self.context, action)
        if self.flag(action, "scoped"):
            self.context.spend(len(outer.configurations) // 4 + len(outer.environment) // 4)
            inner = outer.copy()
            if not self.flag(action, "forwarding"):
                inner = GroupScope({}, dict(self.context.initial))
            inner.configurations.update(keep)
            self.context.scope = inner
            self.actions(action.children, conditions)
            self.context.scope = outer
        else:
            outer.configurations.update(keep)
            self.actions(action.children, conditions)

    def flag(self, action: Action, name: str) -> bool:
        """An attribute that is true unless it says otherwise."""
        phrase = action.get(name)
        return phrase is None or truth_of(self.context.text(phrase)) is not False

    def node(self, action: Action, conditions: _Conditions) -> None:
        self.context.facts.taken()
        started = ros2.started(self.context, node(self.context, action, conditions))
        self.nodes.append(started)
        if action.kind == "container":
            name = full_name(started)
            reasons = tuple(u.reason for u in started.unknowns if u.field in ("name", "namespace"))
            if started.name is None:
                reasons = ("the program itself gives its name",)
            container = Text(name, reasons) if reasons else literal(name)
            handle = action.get("handle")
            if handle is not None:
                self.containers[self.context.text(handle).raw] = container
            self.components(action, conditions, container)

    def load_components(self, action: Action, conditions: _Conditions) -> None:
        """Into the container that has been started before, or one by its name.

        By name launch's own node calls it: relative to the root, not to a namespace that is pushed.
        """
        handle = action.get("handle")
        if handle is not None and (started := self.containers.get(self.context.text(handle).raw)) is not None:
            self.components(action, conditions, started)
            return
        phrase = action.get("target")
        target = self.context.text(phrase) if phrase is not None else unknown("no container is named")
        if not target.raw.startswith("/"):
            target = Text("/" + target.raw, target.reasons)
        self.components(action, conditions, target)

    def components(self, action: Action, conditions: _Conditions, container: Text) -> None:
        def load(run: LaunchEvaluation, child: Action, under: _Conditions) -> None:
            run.context.facts.taken()
            run.nodes.append(ros2.started(run.context, component(run.context, child, under, container)))

        for child in action.children:
            self.context.spend(5)
            self.action(child, conditions, load if child.kind == "component" else None)

    def executable(self, action: Action, conditions: _Conditions) -> None:
        self.context.facts.taken()
        every = processes(self.context, action, conditions)
        tools = [one for one in every if one.package in TOOLS.values() or one.type in ("gazebo", "gzserver")]
        launched(self, action, conditions)
        self.nodes += (one if one in tools else ros2.started(self.context, one) for one in every)
        if len(tools) < len(every):
            return
        asking = loading(self.context, action, conditions)
        self.nodes += [asking] if asking is not None else []  # a command, which has nodes
        line = self.context.text(action.get("cmd") or ())
        ros2.command(self.context, line, action.location)
        ros2.program(self.context, line, action.location)

    def event(self, action: Action, conditions: _Conditions) -> None:
        """Put the children off; by then every scope is left, as launch does it."""
        if len(self.waiting) >= MAX_EVENTS:
            self.context.problem(action.location, f"more than {MAX_EVENTS} events are waited for; this is left out")
            return
        condition = Condition("if", action.deferred or "something happens", action.location)
        context = self.context
        self.waiting.append(
            (action, (*conditions, condition), context.path, context.presence, context.assumed, context.included)
        )

    def opaque(self, action: Action, conditions: _Conditions) -> None:
        """Call the function with the context; nothing that it does may end the evaluation."""
        self.context.spend(100)
        if action.function is None:
            self.context.problem(action.location, f"what this does is not known: {action.reason or 'no function'}")
            return
        try:
            made = action.function(self.context)
        except LaunchBudgetExhausted:
            raise
        except Exception as err:
            self.context.problem(action.location, f"what this function returns is not known: {err}")
            self.context.facts.is_open = True
            return
        self.actions(tuple(made or ()), conditions)


_Handler = Callable[[LaunchEvaluation, Action, _Conditions], None]
_HANDLERS: Mapping[str, _Handler] = {
    "arg": LaunchEvaluation.arg,
    "group": LaunchEvaluation.group,
    "include": include,
    "node": LaunchEvaluation.node,
    "lifecycle-node": LaunchEvaluation.node,
    "container": LaunchEvaluation.node,
    "load": LaunchEvaluation.load_components,
    "executable": LaunchEvaluation.executable,
    "event": LaunchEvaluation.event,
    "opaque": LaunchEvaluation.opaque,
    "list": LaunchEvaluation.nested,
    "written": LaunchEvaluation.written,
}
