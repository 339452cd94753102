# SPDX-License-Identifier: Apache-2.0
"""One node followed from its entry: what stays the same, what it has made so far, and how far it may go."""

from __future__ import annotations

from collections.abc import Callable as Function_
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from typing import Any

from haros_ci import syntax
from haros_ci.follow.twins import Standing, Twin
from haros_ci.graph.ros2_process import Process, RosNode
from haros_ci.index.behavior_tree_files import TreeFiles
from haros_ci.index.index import Index, Source
from haros_ci.index.relevance import Relevance
from haros_ci.index.types import NO_TYPE, resolve_type
from haros_ci.index.xml_files import Reader
from haros_ci.model.api import Row
from haros_ci.model.architecture import Condition, Qos
from haros_ci.model.build import ConfigFile
from haros_ci.model.location import Location
from haros_ci.syntax import Class, Function, Type
from haros_ci.values.abstract import NONE, Callable, Cell, Known, Object, Opaque, Value, join
from haros_ci.values.state import State

#: Statements and calls that one node may take, and as many in rehearsals; what is beyond is named in a notification.
STEPS = 60_000
#: The same for a node that is followed with all plug-ins of the workspace.
WITH_PLUGINS = 120_000
#: Why not all conditions are told.
SEVERAL = "it is made on several ways, each under conditions of its own"
#: Calls inside calls.
DEPTH = 28
#: Callbacks of one node that are followed, and those of one function that are registered by callbacks.
ROOTS, CHAIN = 400, 8
#: Turns of a loop whose condition is known.
TURNS = 64
#: How a block ends: it falls through, or it leaves in one of these ways.
NEXT, RETURN, BREAK, CONTINUE, THROW = "next", "return", "break", "continue", "throw"


#: From a call's place, the last part of its function's name and the number of its arguments to the arguments' types and
#: values and the template arguments' types, each None where it is not told.
Exact = Function_[[str, int, int, str, int], tuple[tuple[tuple[str | None, Any], ...], tuple[str | None, ...]] | None]


class OutOfSteps(Exception):
    """The node is larger than the budget."""


class Renamed(Exception):
    """The node gives itself another name than the one that it is followed under."""


@dataclass(slots=True)
class Frame:
    """An activation of a function: its names, what its template parameters mean, what it has returned so far."""

    source: Source
    scope: str
    function: Function | None = None
    this: Object | None = None
    scopes: list[dict[str, Cell]] = field(default_factory=lambda: [{}])
    templates: Mapping[str, syntax.Argument] = field(default_factory=dict)
    outer: Frame | None = None
    mark: int = 0
    returned: list[Value] = field(default_factory=list)
    exits: list[dict[Cell, Any]] = field(default_factory=list)
    #: Whether what is followed cannot be reached as things are: it is gone through for what it makes only.
    is_dead: bool = False

    def find(self, name: str) -> Cell | None:
        frame: Frame | None = self
        while frame is not None:
            for scope in reversed(frame.scopes):
                if name in scope:
                    return scope[name]
            frame = frame.outer
        return None

    def declare(self, name: str, cell: Cell) -> Cell:
        self.scopes[-1][name] = cell
        return cell


@dataclass(slots=True)
class Loop:
    """A loop (or switch) that is being followed: what the ways that break or continue have written since *mark*."""

    mark: int
    is_switch: bool = False
    #: How many turns have been gone through, where that is done one by one.
    turn: int = 0
    breaks: list[dict[Cell, Any]] = field(default_factory=list)
    continues: list[dict[Cell, Any]] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class Made:
    """What a call made, before remapping: *name* is absolute, with ``?`` for unknown parts."""

    kind: str
    name: str
    type: str | None
    location: Location
    conditions: tuple[Condition, ...]
    queue_size: int | None = None
    latched: bool | None = None
    value: Any = None
    implicit: bool = False
    qos: Qos | None = None
    effective: Any = None
    read_only: bool | None = None
    range: Any = None
    is_dynamic: bool = False
    is_strict: bool = False
    #: The ROS 2 node that has it; None if it is not known, and in ROS 1.
    node: RosNode | None = None
    is_exact: bool = False
    #: Of the branches around it, those that are not taken as things are.
    dead: int = 0
    unknowns: tuple[tuple[str, str, Location | None], ...] = ()
    #: The name as the call gives it, ``?`` for its unknown parts.
    written: str | None = field(default=None, compare=False)


@dataclass(frozen=True, slots=True, eq=False)
class Root:
    """A function that is called back later, under the conditions of its registration.

    *writes* are what the callback that registered it leaves behind, if it was one.
    """

    function: Callable
    conditions: tuple[Condition, ...]
    writes: Mapping[Cell, Any] = field(default_factory=dict)
    #: Whether it is called when somebody sets parameters, or takes a node down: what it changes then is not seen elsewhere.
    is_update: bool = False
    #: Whether a managed node is brought up by it, before anything else is called back.
    is_setup: bool = False
    #: Whether a behaviour tree calls it: what it changes is not seen elsewhere.
    is_tick: bool = False
    #: Why it may not be registered although the conditions hold, where no statement says so.
    doubt: str | None = None


@dataclass(frozen=True, slots=True)
class Kept:
    """What a run had told at some point."""

    made: Mapping[Any, Made]
    gaps: Mapping[str, Location]
    #: Of nodes, names and alternatives.
    counts: tuple[int, int, int]
    #: The static variables and plug-ins that there were.
    sets: tuple[frozenset[Any], frozenset[Any]]
    #: The callbacks, and the number of each.
    roots: tuple[tuple[Root, ...], Mapping[Any, int]]


@dataclass(slots=True)
class Context:
    """What the node is given from outside: its names, its arguments, the parameter server, files of the workspace."""

    name: str
    namespace: str
    arguments: tuple[str, ...] | None
    #: The classes that pluginlib can load, by look-up name: where they are defined.
    plugins: Mapping[str, tuple[Source, Class]]
    #: Where a node is followed for all that its plug-ins could make: the workspace's plug-ins by base class.
    of_base: Mapping[str, tuple[tuple[Source, Class], ...]] | None = field(default=None, kw_only=True)
    #: Behaviour trees in files of the workspace; None where nothing makes any.
    trees: TreeFiles | None = field(default=None, kw_only=True)
    #: The workspace's XML files and directories; None in ROS 1.
    xml: Reader | None = field(default=None, kw_only=True)
    #: Whether all of them are followed where it is not known which is created.
    any_tree: bool = field(default=False, kw_only=True)
    #: The value of a parameter that the configuration sets (a Choice if under a condition), None if it does not.
    parameter: Function_[[str], Value | None]
    #: The data of a YAML file by the path as values have it; None if it is not in the workspace.
    read_yaml: Function_[[str], Value | None]
    #: The pointed-to remapping of an absolute name.
    remap: Function_[[str], str] = lambda name: name
    #: The remappings of absolute names.
    remaps: Mapping[str, str] = field(default_factory=dict)
    #: What the nodelet of a look-up name makes, under a full name and in the namespace above, as part of the node; and
    #: why that may not be all. None if the nodelet is not known. *loaded* are those asked for so far.
    nodelet: Function_[
        [str, str, str, Function_[[str], Value | None]], tuple[tuple[Made, ...], Mapping[str, Location]] | None
    ] = lambda look_up, name, above, parameter: None
    loaded: list[str] = field(default_factory=list)
    #: The process that a nodelet is loaded into; the node itself otherwise.
    process_name: str = ""
    process_namespace: str = "/"
    #: What a ROS 2 process is given; None in ROS 1.
    process: Process | None = None
    #: Whether to stop at the first name that the node gives itself (a value, and whether it is made anonymous).
    renames: Function_[[Value, bool], bool] = lambda name, anonymous: False


def either(
    one: tuple[Condition, ...], other: tuple[Condition, ...], pairs: Mapping[Location, Location]
) -> tuple[tuple[Condition, ...], bool]:
    """The conditions of what is made on two ways, and whether they are all: what both ways have in common.

    That is all where the other way has no more, or where one takes an ``if`` and the other its ``else``; *pairs* has
    the place of each ``else``'s ``if``.
    """
    for number, (left, right) in enumerate(zip(one, other, strict=False)):
        if left != right:
            if left.statement == "else":
                left, right = right, left
            both = left.statement == "if" and right.statement == "else" and pairs.get(right.location) == left.location
            return one[:number], both and number == len(one) - 1 == len(other) - 1
    return (other if len(other) < len(one) else one), True


def _inside(value: Value, path: str) -> Value | None:
    """What is at *path* in a parameter that is a map; None if it is no map, or has nothing there."""
    if not isinstance(value, Known):
        return Opaque("it is inside a parameter that the node sets")
    data = value.value
    for part in path.split("/"):
        if not isinstance(data, dict) or part not in data:
            return None
        data = data[part]
    return Known(data)


@dataclass(slots=True)
class Run:
    """The interpreter's state for one node."""

    index: Index
    rows: Mapping[str, tuple[Row, ...]]
    context: Context
    configs: Mapping[str, ConfigFile]
    relevance: Relevance
    files: frozenset[str] = frozenset()
    #: What the exact tier tells of calls, by path, line and column: types and constants of arguments by function and count.
    exact: Exact | None = None
    state: State = field(default_factory=State)
    conditions: list[Condition] = field(default_factory=list)
    made: dict[Any, Made] = field(default_factory=dict)
    roots: list[Root] = field(default_factory=list)
    #: The number of each root by what is called back; of a root that is gone it is that of none or another.
    known_roots: dict[Any, int] = field(default_factory=dict)
    #: The numbers of those that have been called back, not in rehearsal.
    called: set[int] = field(default_factory=set)
    #: The places where every plug-in of a base class has been loaded, or a behaviour tree created, with which objects.
    offered: set[Any] = field(default_factory=set)
    #: Groups of plug-ins of which one exists, with the names of their base classes.
    alternatives: list[tuple[str, tuple[Object, ...]]] = field(default_factory=list)
    globals: dict[tuple[str, str], Cell] = field(default_factory=dict)
    #: Variables of functions that are made once.
    statics: dict[Any, Cell] = field(default_factory=dict)
    modules: dict[str, Frame] = field(default_factory=dict)
    active: list[Function] = field(default_factory=list)
    #: What the node itself sets on the parameter server, by full name.
    server: Cell = field(default_factory=lambda: Cell({}))
    config_objects: dict[str, Object] = field(default_factory=dict)
    names: list[tuple[Value, bool]] = field(default_factory=list)
    #: The nodes of a ROS 2 process, in the order in which they are made.
    nodes: list[RosNode] = field(default_factory=list)
    #: Those that are made whatever happens; by name two that there are at the same time; whether one may be gone by now.
    standing: list[Standing] = field(default_factory=list)
    twins: dict[str, Twin] = field(default_factory=dict)
    has_ended: bool = False
    #: The place of the ``if`` that each ``else`` belongs to.
    pairs: dict[Location, Location] = field(default_factory=dict)
    loops: list[Loop] = field(default_factory=list)
    is_interlude: bool = False
    #: Whether callbacks are followed, not initialisation.
    is_called_back: bool = False
    #: Why there may be more than what was made, and where.
    gaps: dict[str, Location] = field(default_factory=dict)
    #: The cells that the last function returned a reference to: None if it was no reference, empty if they are not known.
    references: tuple[Cell, ...] | None = None
    #: Steps that went into rehearsals of callbacks.
    rehearsed: int = 0
    #: What each callback writes by itself, as far as they have been rehearsed.
    effects: list[dict[Cell, Any]] = field(default_factory=list)
    #: What the first *joined* of them leave behind, joined.
    together: dict[Cell, Any] = field(default_factory=dict)
    joined: int = 0
    #: Why what is made now may not be made at all, where no statement is the condition.
    doubts: list[str] = field(default_factory=list)
    quiet: int = 0
    #: Where the call stands that a wrapper forwards to an API, and the texts that it is given.
    outer: tuple[Location, frozenset[str]] | None = None
    #: Branches around what is followed that are not taken as things are.
    dead: int = 0
    #: ``try`` statements around what is followed.
    trying: int = 0
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
    #: Steps that callbacks have put into functions that could make something, since they last did, by function.
    idle: dict[int, int] = field(default_factory=dict)
    #: By identity, what stands for template arguments in look-ups.
    numbers: dict[int, tuple[int, Mapping[str, syntax.Argument]]] = field(default_factory=dict)
    #: Look-ups that depend on the name, the scope and the file only.
    found: dict[Any, Any] = field(init=False)

    def __post_init__(self) -> None:
        self.most = STEPS if self.context.of_base is None else WITH_PLUGINS
        self.found = self.index.caches.setdefault((self.files, self.context.of_base is not None), {})

    def step(self) -> None:
        self.steps += 1
        self.quiet_steps += self.quiet > 0
        if self.quiet_steps > self.most or self.steps - self.quiet_steps > self.most:
            raise OutOfSteps

    def extent(self) -> tuple[int, int, int, int]:
        """How much there is so far of what a function may make."""
        return len(self.made), len(self.roots), len(self.nodes), len(self.gaps)

    def make(self, made: Made) -> None:
        """Keep *made* unless this is a rehearsal; of two ways to one endpoint the less conditional counts."""
        if self.quiet:
            return
        key = (
            made.kind,
            made.name,
            made.type,
            made.location,
            made.queue_size,
            made.latched,
            repr(made.value),
            made.qos,
            made.node and made.node.name,
        )
        known = self.made.get(key)
        conditions, unknowns = made.conditions, made.unknowns
        if self.doubts:
            unknowns = (*unknowns, ("conditions", self.doubts[-1], made.location))
        if known is not None:
            conditions, is_all = either(known.conditions, conditions, self.pairs)
            if not is_all and SEVERAL not in (unknown[1] for unknown in known.unknowns):
                unknowns = (*unknowns, ("conditions", SEVERAL, made.location))
            unknowns = tuple(dict.fromkeys((*known.unknowns, *unknowns)))
        dead = self.dead if known is None else min(self.dead, known.dead)
        if known is not None and known.is_strict and not made.is_strict:
            made = replace(made, is_strict=True)
        if dead != made.dead or conditions is not made.conditions or unknowns is not made.unknowns:
            made = replace(made, conditions=conditions, unknowns=unknowns, dead=dead)
        self.made[key] = made

    def kept(self) -> Kept:
        """What the run has told so far, to go back to."""
        counts = len(self.nodes), len(self.names), len(self.alternatives)
        sets = frozenset(self.statics), frozenset(self.offered)
        return Kept(dict(self.made), dict(self.gaps), counts, sets, (tuple(self.roots), dict(self.known_roots)))

    def go_back(self, kept: Kept) -> None:
        """Take back what was told since *kept* was."""
        self.made.clear()
        self.made.update(kept.made)
        self.gaps.clear()
        self.gaps.update(kept.gaps)
        nodes, names, alternatives = kept.counts
        del self.nodes[nodes:], self.names[names:], self.alternatives[alternatives:]
        self.roots[:] = kept.roots[0]
        self.known_roots = dict(kept.roots[1])
        statics, offered = kept.sets
        for key in self.statics.keys() - statics:
            del self.statics[key]
        self.offered &= offered

    def forget_again(self, known: int) -> None:
        """Of what was made after the first *known*, drop what stands where the same was made before."""
        every = list(self.made.items())
        before = {(made.kind, made.location) for _, made in every[:known]}
        for key, made in every[known:]:
            if (made.kind, made.location) in before:
                del self.made[key]

    def forget_dead(self, known: int) -> None:
        """Of what was made after the first *known*, drop what stands in branches that another turn of a loop takes.

        Where no turn takes all of the branches around a place, those count that take the most.
        """
        if len(self.made) > known:
            since = list(self.made.items())[known:]
            least: dict[tuple[str, Location], int] = {}
            for _, made in since:
                place = (made.kind, made.location)
                least[place] = min(made.dead, least.get(place, made.dead))
            for key, made in since:
                if made.dead > least[made.kind, made.location]:
                    del self.made[key]

    def forget_unowned(self) -> None:
        """Drop what is made on a node that is not known where the same call is seen to make it on one that is."""
        owned = {(made.kind, made.location) for made in self.made.values() if made.node is not None}
        for key, made in list(self.made.items()):
            if made.node is None and made.name.startswith("/?") and (made.kind, made.location) in owned:
                del self.made[key]

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
        self, ways: Iterable[Function_[[], Value]], reason: str, settle: Function_[[list[Any]], None] | None = None
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
    def under(self, statement: str, text: str, frame: Frame, line: int, column: int) -> Iterator[None]:
        """What is made inside stands under this condition."""
        self.conditions.append(Condition(statement, text, Location(frame.source.path, line, column)))
        try:
            yield
        finally:
            self.conditions.pop()

    def parameter(self, name: str) -> Value | None:
        """The value of a parameter as the node finds it: what it has set itself, else what the configuration sets.

        None if there is none, which is so, too, where the node has deleted it (kept as ``NONE``).
        """
        own: Any = self.server.value
        if isinstance(own, Opaque):
            return own
        if name in own:
            found: Value = own[name]
            return None if found == NONE else found
        above = name.rpartition("/")[0]
        while above and own:
            if above in own:
                return _inside(own[above], name[len(above) + 1 :])
            above = above.rpartition("/")[0]
        return self.context.parameter(name)

    def type_in(self, kind: Type, frame: Frame) -> Type:
        """*kind* as written in *frame*, resolved."""
        if not kind.name:
            return NO_TYPE
        return self.resolved(kind, frame.scope, frame.source, frame.templates)

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
