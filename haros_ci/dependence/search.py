# SPDX-License-Identifier: Apache-2.0
"""From what a node sends back to the callbacks that cause it, through all state in between; the same for all nodes of a program."""

from __future__ import annotations

from haros_ci.code import kinds
from haros_ci.code.callbacks import Callback
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.dependence.influence import Chain, Influence, influence
from haros_ci.dependence.steps import Step
from haros_ci.dependence.variables import Held
from haros_ci.dependence.writes import Write, writes
from haros_ci.model.dependence import DIRECT, PERHAPS, STATE
from haros_ci.records import dataclass, field
from haros_ci.syntax import Member, Name, This

#: What the transforms of others arrive in (docs.ros.org: tf, tf2_ros).
TRANSFORMS = frozenset(
    "tf2_ros::Buffer tf2_ros::TransformListener tf::TransformListener tf2::BufferCore tf2_ros.Buffer tf2_ros.TransformListener "
    "tf.TransformListener tf2_ros.buffer.Buffer tf2_ros.transform_listener.TransformListener".split()
)
#: State that is looked at for one output, and changes of state that may not count.
MOST, UNSURE = 3_000, 150


@dataclass(frozen=True, slots=True, eq=False)
class Way:
    """From a *callback* over *chain* to what is sent, or to a change of *state*; *after* are the further changes, and the sending."""

    callback: Callback
    chain: Chain
    after: Chain
    state: tuple[str, ...]
    reason: str

    @property
    def how(self) -> str:
        return PERHAPS if self.reason else STATE if self.state else DIRECT


@dataclass(slots=True)
class Found:
    """The best *ways* by callback; *transforms* is the state that holds transforms, by the reason why it may not count."""

    ways: dict[int, Way] = field(default_factory=dict)
    transforms: dict[str, str] = field(default_factory=dict)
    is_start: bool = False
    reason: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class _Item:
    influence: Influence
    place: tuple[Routine, Step]
    state: tuple[str, ...]
    after: Chain
    reason: str


def search(code: Codebase, routine: Routine, step: Step) -> Found:
    """All that can cause *step* of *routine*."""
    key = ("causes", id(routine), step.number)
    if key not in code.kept:
        code.kept[key] = _Search(code, routine.is_python).run(routine, step)
        code.kept["keep", id(routine)] = routine
    found: Found = code.kept[key]
    return found


@dataclass(slots=True)
class _Search:
    code: Codebase
    is_python: bool
    made: Found = field(default_factory=Found)
    sure: list[_Item] = field(default_factory=list)
    unsure: list[_Item] = field(default_factory=list)
    #: What has been looked at, with "" where that was certain.
    seen: dict[Held, str] = field(default_factory=dict)
    guesses: int = 0
    #: The fewest states on the way to what has been looked at, by its identity and whether that way was certain.
    fewest: dict[tuple[int, bool], int] = field(default_factory=dict)

    def run(self, routine: Routine, step: Step) -> Found:
        first = influence(self.code, routine, step)
        self.made.is_start = first.is_start or first.is_transition
        self.sure.append(_Item(first, (routine, step), (), (), ""))
        while self.sure or self.unsure:
            if not self.sure:
                self.guesses += 1
            if self.guesses > UNSURE:
                self.made.reason = self.made.reason or "there is too much that may count to look at it all"
                break
            self.item(self.sure.pop(0) if self.sure else self.unsure.pop(0))
        return self.made

    def is_known(self, influence: Influence, states: int, is_sure: bool) -> bool:
        """Whether it has been looked at already, in a way that was no longer and no less certain: it tells nothing new."""
        for known in (True, is_sure):
            if self.fewest.get((id(influence), known), MOST + 1) <= states:
                return True
        return False

    def item(self, item: _Item) -> None:
        states, is_sure = len(item.state), not item.reason
        if self.is_known(item.influence, states, is_sure):
            return
        self.fewest[id(item.influence), is_sure] = states
        self.made.reason = self.made.reason or item.influence.reason
        for trigger in item.influence.triggers:
            reason = item.reason or trigger.reason
            way = Way(trigger.callback, trigger.chain, item.after, item.state, reason)
            key = id(trigger.callback)
            known = self.made.ways.get(key)
            if known is None or _rank(way) < _rank(known):
                self.made.ways[key] = way
        for what, why in item.influence.reads.items():
            reason = item.reason or why
            if self.seen.get(what, "?") == "" or (what in self.seen and reason):
                continue
            if len(self.seen) >= MOST:
                self.made.reason = self.made.reason or "there is too much state to look at"
                return
            self.seen[what] = reason
            self.state(what, item, reason)

    def state(self, what: Held, item: _Item, reason: str) -> None:
        every = writes(self.code, what, self.is_python)
        if self.holds_transforms(what, every.found):
            if self.made.transforms.get(what.title, "?") != "":
                self.made.transforms[what.title] = reason
            return
        self.made.reason = self.made.reason or every.reason
        for write in every.found:
            inner = influence(self.code, write.routine, write.use.step)
            if not (inner.triggers or inner.reason or inner.is_transition):
                continue  # it is done before anything comes
            why = reason or write.reason
            if not why and self.is_known(inner, len(item.state) + 1, True):
                continue
            place = write.routine, write.use.step
            made = _Item(inner, place, (what.title, *item.state), (item.place, *item.after), why)
            (self.unsure if why else self.sure).append(made)

    def holds_transforms(self, what: Held, every: tuple[Write, ...]) -> bool:
        """Whether transforms of others arrive in *what*."""
        if not every:
            return False
        is_own = self.is_python and what.kind == "member"
        value = Member(This(), what.name) if is_own else Name(what.name)
        return kinds.type_name(self.code, every[0].routine, value) in TRANSFORMS


def _rank(way: Way) -> tuple[int, int]:
    return {DIRECT: 0, STATE: 1, PERHAPS: 2}[way.how], len(way.state)
