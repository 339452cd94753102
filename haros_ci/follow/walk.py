# SPDX-License-Identifier: Apache-2.0
"""One node followed from its entry: the state of the interpreter, what it looks up, and how far it may go."""

from __future__ import annotations

from collections.abc import Callable as Function_
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from haros_ci import syntax
from haros_ci.follow import server
from haros_ci.follow.command import Commands
from haros_ci.follow.context import Context, Exact
from haros_ci.follow.frames import Frame, Loop, looked_up_from
from haros_ci.follow.made import Entities, Key, MadeEntity, Root
from haros_ci.follow.ros.own_name import Naming
from haros_ci.follow.thrown import Trial
from haros_ci.follow.twins import Standing, Twin
from haros_ci.graph.ros2_process import RosNode
from haros_ci.index import compiled
from haros_ci.index.index import Index, Source
from haros_ci.index.relevance import Relevance
from haros_ci.index.types import NO_TYPE, resolve_type
from haros_ci.model.api import Row
from haros_ci.model.architecture import Condition
from haros_ci.model.build import ConfigFile
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.syntax import Class, Function, Type
from haros_ci.values.abstract import NONE, Cell, Known, Object, Opaque, Value, join
from haros_ci.values.cells import Slot
from haros_ci.values.effects import Effects
from haros_ci.values.state import Held, State, Writes

#: Statements and calls that one node may take, and as many in rehearsals (what is beyond is named in a notification); and one with all plug-ins of the workspace.
STEPS, WITH_PLUGINS = 80_000, 120_000
#: Calls inside calls.
DEPTH = 28
#: Callbacks of one node that are followed, and those of one function that are registered by callbacks.
ROOTS, CHAIN = 400, 8
#: Turns of a loop whose condition is known.
TURNS = 64


class OutOfSteps(Exception):
    """The node is larger than the budget."""


class Renamed(Exception):
    """The node gives itself another name than the one that it is followed under."""


@dataclass(slots=True)
class Walk:
    """The interpreter's state for one node."""

    index: Index
    rows: Mapping[str, tuple[Row, ...]]
    context: Context
    configs: Mapping[str, ConfigFile]
    relevance: Relevance
    files: frozenset[str] = frozenset()
    #: What the exact tier tells of calls, by path, line and column: types and constants of arguments by function and count.
    exact: Exact | None = None
    #: The target that counts where several compile the same file with other macros (``Entry.target``).
    target: str = ""
    state: State = field(default_factory=State)
    conditions: list[Condition] = field(default_factory=list)
    holding: int = 0  #: how many of these are known to hold
    made: Entities = field(default_factory=Entities)
    #: Timers and rates by place, period and node, each with the object whose method makes it (``ros.paces``).
    paces: dict[Key, tuple[MadeEntity, Object | None]] = field(default_factory=dict)
    roots: list[Root] = field(default_factory=list)
    #: The number of each root by what is called back; of a root that is gone it is that of none or another.
    known_roots: dict[Key, int] = field(default_factory=dict)
    #: Functions that were made, each as it would be called back, and by identity those whose bodies have been followed (``follow.uncalled``).
    held: dict[tuple[int, Object | None], Root] = field(default_factory=dict)
    invoked: set[int] = field(default_factory=set)
    is_program: bool = True  #: whether a program is followed, and no class that others make
    calls_unknown: bool = False  #: whether a function is called that is not known: it may be any of those
    #: Functions that are not followed any more though they are called as things are, in the beginning of the node (``follow.cut_short``).
    cut: dict[int, tuple[Source, Function]] = field(default_factory=dict)
    called: set[int] = field(default_factory=set)  #: numbers of roots called back, not in rehearsal
    #: What callbacks find outside of the workspace, with the number of modules then: base classes by class, libraries by file and name.
    outside_bases: dict[tuple[int, int], list[str]] = field(default_factory=dict)
    outside_names: dict[tuple[str, str, int], Value] = field(default_factory=dict)
    #: The places where every plug-in of a base class has been loaded, or a behaviour tree created, with which objects.
    offered: set[Key] = field(default_factory=set)
    #: The base classes of which the program has asked for the look-up names of all plug-ins.
    listed: set[str] = field(default_factory=set)
    #: These names, by identity.
    look_ups: dict[int, Known] = field(default_factory=dict)
    #: Groups of plug-ins of which one exists, with the names of their base classes.
    alternatives: list[tuple[str, tuple[Object, ...]]] = field(default_factory=list)
    #: Variables outside of functions, and static ones of functions that begin with plain data, by place and name.
    globals: dict[tuple[str, str], Cell] = field(default_factory=dict)
    #: Of both the cells: they are there as long as the program, whoever comes to them first.
    lasting: set[Cell] = field(default_factory=set)
    #: All other variables of functions that are made once.
    statics: dict[tuple[str, str], Cell] = field(default_factory=dict)
    modules: dict[str, Frame] = field(default_factory=dict)
    #: Look-ups that hold something of this node.
    own: dict[tuple[str, str, str], Value] = field(default_factory=dict)
    #: What click makes of functions, what is added to its groups, and the context of the command that runs (``follow.commands``).
    commands: Commands = field(default_factory=Commands)
    #: What the classes of nodes of behaviour trees declare, and whether that is all, by the identity of the class (``ros.behavior_tree_ports``).
    ports: dict[int, tuple[dict[str, tuple[Frame, syntax.Expression] | None], bool, Class]] = field(
        default_factory=dict
    )
    active: list[Function] = field(default_factory=list)
    #: Of each of these how many conditions were undecided, and how much was made, when it was called (``follow.recursion``).
    entered: list[tuple[int, int]] = field(default_factory=list)
    #: What the node itself sets on the parameter server, by full name; of ROS 2 what its nodes declare and set, by theirs and that of the parameter.
    server: Cell[dict[str, Value] | Opaque] = field(default_factory=lambda: Cell({}))
    declared: Cell[dict[str, Held] | Opaque] = field(default_factory=lambda: Cell({}))
    config_objects: dict[str, Object] = field(default_factory=dict)
    #: The calls that name a ROS 1 process.
    names: list[Naming] = field(default_factory=list)
    #: The nodes of a ROS 2 process, in the order in which they are made.
    nodes: list[RosNode] = field(default_factory=list)
    #: Those that are made whatever happens; by name two that there are at the same time; whether one may be gone by now.
    standing: list[Standing] = field(default_factory=list)
    twins: dict[str, Twin] = field(default_factory=dict)
    has_ended: bool = False
    #: The function that the program begins with, and the depth of calls whose failure ends it (``follow.early``).
    entry: Function | None = None
    judged: int = -1
    #: The place of the ``if`` that each ``else`` belongs to, and of the ``else`` of each ``if``; its own of an ``if`` without.
    pairs: dict[Location, Location] = field(default_factory=dict)
    loops: list[Loop] = field(default_factory=list)
    #: Those that are gone through turn by turn, of all functions that are active.
    turning: list[Loop] = field(default_factory=list)
    #: Whether the expression that is evaluated has raised an exception (``follow.thrown``).
    is_raised: bool = False
    is_interlude: bool = False
    #: What callbacks write that an executor calls in a thread, beside what is followed (ROS 2); None where none spins so.
    beside: Effects | None = None
    #: Whether callbacks are followed, not initialisation.
    is_called_back: bool = False
    #: Why there may be more than what was made, and where.
    gaps: dict[str, Location] = field(default_factory=dict)
    #: The cells that the last function returned a reference to: None if it was no reference, empty if they are not known.
    references: tuple[Cell, ...] | None = None
    rehearsed: int = 0  #: steps that went into rehearsals of callbacks
    #: How much was made when something last was, and the steps until then (``follow.barren``).
    last: tuple[int, int] = 0, 0
    #: What each callback writes by itself, as far as they have been rehearsed.
    effects: Effects = field(default_factory=Effects)
    #: Why what is made now may not be made at all, where no statement is the condition.
    doubts: list[str] = field(default_factory=list)
    news: int = 0  #: how often what was made already was made on a way that changes its conditions
    quiet: int = 0
    started: Location | None = None  #: where a process of ROS 2 initialises the client library
    #: Where the call stands that a wrapper forwards to an API, and the texts that it is given.
    outer: tuple[Location, frozenset[str]] | None = None
    #: Branches around what is followed that are not taken as things are.
    dead: int = 0
    #: Of these, for each that is not taken as a parameter is not set, the names of parameters that were not.
    lacking: list[tuple[str, ...]] = field(default_factory=list)
    #: The same of what was made in such branches alone, by key.
    lacks: dict[Key, tuple[tuple[str, ...], ...]] = field(default_factory=dict)
    #: The full names of parameters that were asked for and are not set, in turn.
    absent: list[str] = field(default_factory=list)
    #: The same around the registration of the callback that is followed.
    dead_root: int = 0
    trying: int = 0  #: ``try`` statements around what is followed
    #: Their blocks that are being followed, the innermost last.
    trials: list[Trial] = field(default_factory=list)
    #: Calls around what is followed that stand behind a return that is taken as things are.
    beyond: int = 0
    steps: int = 0
    quiet_steps: int = 0
    #: Steps that went into the nodes of behaviour trees: loops around them are no longer for that.
    aside: int = 0
    turns: int = 1
    #: Steps that the node may take, and as many in rehearsals.
    most: int = STEPS
    #: Steps spent in functions that make nothing, by function, and how often they were called.
    spent: dict[int, tuple[int, int]] = field(default_factory=dict)
    #: Steps and calls that went into functions that could make something, since they last did, by function, whether that was ruled out, and in a callback.
    idle: dict[tuple[int, bool, bool], tuple[int, int]] = field(default_factory=dict)
    #: What functions that are followed as they set numbers have set, under which names (``follow.setters``).
    settled: dict[Slot, tuple[Value, frozenset[str]]] = field(default_factory=dict)
    #: Such functions around what is followed: they register nothing, as they did not where they are not followed.
    setting: int = 0
    #: The names that callbacks and threads assign to, as far as there are any.
    disturbed: set[str] = field(default_factory=set)
    #: What libraries may change from outside at any time, as they have its address, with the reason (``follow.handed_out``).
    handed: dict[Cell, Opaque] = field(default_factory=dict)
    #: By identity, what stands for template arguments in look-ups.
    numbers: dict[int, tuple[int, Mapping[str, syntax.Argument]]] = field(default_factory=dict)
    #: Look-ups that depend on the name, the scope and the file only: shared by all nodes with the same files.
    found: dict[object, Any] = field(init=False)

    def __post_init__(self) -> None:
        self.most = STEPS if self.context.of_base is None else WITH_PLUGINS
        key = (self.files, self.context.of_base is not None, self.target)
        self.found = self.index.caches.setdefault(key, {})

    def step(self) -> None:
        self.steps += 1
        self.quiet_steps += self.quiet > 0
        if self.quiet_steps > self.most or self.steps - self.quiet_steps > self.most or self.state.is_full:
            raise OutOfSteps

    def enter(self, function: Function, depth: int) -> None:
        """The body of a function is followed from here, under so many conditions that are not decided."""
        self.active.append(function)
        self.entered.append((depth, len(self.made)))
        if not self.quiet:
            self.invoked.add(id(function))

    @property
    def around(self) -> tuple[Condition, ...]:
        """The conditions of the statements around what is followed, without the early ways out before it."""
        return tuple(item for item in self.conditions if not item.is_early)

    def extent(self) -> tuple[int, int, int, int, int]:
        """How much there is so far of what a function may make."""
        return len(self.made), len(self.roots), len(self.nodes), len(self.gaps), self.news

    def is_older(self, cell: Slot, tick: int) -> bool:
        """Whether a variable is there since before *tick*, as far as the program goes."""
        return cell.born < tick or cell in self.lasting

    def ruled_out(self) -> int:
        """Of the branches around what is made, those that are not taken as things are."""
        return self.dead + self.dead_root

    @contextmanager
    def doubted(self, reason: str | None) -> Iterator[None]:
        """What is made inside may not be made, for a reason that no statement shows; None is no doubt."""
        if reason is not None:
            self.doubts.append(reason)
        try:
            yield
        finally:
            if reason is not None:
                self.doubts.pop()

    def either_way(
        self, ways: Iterable[Function_[[], Value]], reason: str, settle: Function_[[list[Writes]], None] | None = None
    ) -> Value:
        """The join of values of which one is computed, each with its effects: there is no telling which.

        *settle* says of what they write, in their order, what holds whichever it is.
        """
        result: Value | None = None
        branches = []
        mark = self.state.mark()
        for way in ways:
            with self.doubted(reason):
                value = way()
            branches.append(self.state.undo(mark))
            result = value if result is None else join(result, value)
        if settle is not None:
            settle(branches)
        if branches:
            self.state.merge(branches)
        return result if result is not None else NONE

    @contextmanager
    def under(self, statement: str, text: str, place: Location, *, holds: bool = False) -> Iterator[None]:
        """What is made inside stands under this condition, which is known to hold if it *holds*."""
        depth = len(self.conditions)
        self.conditions.append(Condition(statement, text, place))
        self.holding += holds
        try:
            yield
        finally:
            self.holding -= holds
            del self.conditions[depth:]

    def parameter(self, name: str) -> Value | None:
        """The value of a parameter as the node finds it: what it has set itself, else what the configuration sets.

        None if there is none, which is so, too, where the node has deleted it (kept as ``NONE``).
        """
        own = self.server.value
        if isinstance(own, Opaque):
            return own
        if name in own:
            found = own[name]
            return None if found == NONE else found
        above = name.rpartition("/")[0]
        while above and own:
            if above in own:
                return server.inside(own[above], name[len(above) + 1 :])
            above = above.rpartition("/")[0]
        return self.context.parameter(name)

    def is_compiled(self, path: str, line: int) -> bool | None:
        """Whether the build compiles the branch of the ``#if``, ``#elif`` or ``#else`` at a line of a file; None if that is not known."""
        key = ("compiled", path, line)
        if key not in self.found:
            self.found[key] = compiled.is_compiled(self.index, path, line, self.files, self.target)
        known: bool | None = self.found[key]
        return known

    def type_in(self, kind: Type, frame: Frame) -> Type:
        """*kind* as written in *frame*, resolved."""
        if not kind.name:
            return NO_TYPE
        return self.resolved(kind, looked_up_from(self.index.inner, frame), frame.source, frame.templates)

    def resolved(self, kind: Type, scope: str, source: Source, templates: Mapping[str, syntax.Argument]) -> Type:
        """*kind* as written in a scope of a file, resolved; each once."""
        key = (kind.name, kind.arguments, kind.marks, scope, source.path, self.numbered(templates) if templates else 0)
        found: Type | None = self.found.get(key)
        if found is None:
            found = self.found[key] = resolve_type(self.index, kind, scope, source, self.files, templates)
        return found

    def numbered(self, templates: Mapping[str, syntax.Argument]) -> int:
        """What stands for *templates* and all that are the same, in the keys of look-ups."""
        known = self.numbers.get(id(templates))
        if known is None:
            key = ("templates", *templates.items())
            number: int = self.found.setdefault(key, len(self.found) + 1)
            known = self.numbers[id(templates)] = (number, templates)  # which keeps its identity from being used again
        return known[0]

    def opaque(self, reason: str, frame: Frame, line: int | None = None, kind: Type | None = None) -> Opaque:
        return Opaque(reason, Location(frame.source.path, line), kind)

    def bases(self, source: Source, definition: Class, templates: Mapping[str, syntax.Argument]) -> list[Type]:
        """The resolved base types of a class of the workspace."""
        if not definition.bases:
            return []
        scope = definition.name.rpartition(source.separator)[0]
        return [self.resolved(base, scope, source, templates) for base in definition.bases]

    def class_of(self, name: str, source: Source) -> tuple[Source, Class] | None:
        """The workspace's class of that qualified name, as seen from *source*."""
        key = ("class", name, source.path)
        if key not in self.found:
            found = self.index.near(self.index.classes, name, source, self.files)
            with_body = [item for item in found if item[1].fields or item[1].bases]
            self.found[key] = (with_body or found)[0] if found else None
        known: tuple[Source, Class] | None = self.found[key]
        return known
