# SPDX-License-Identifier: Apache-2.0
"""What makes a step of a program run: the callbacks that lead to it, and all that decides on the way or gives data to it."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.code import classes
from haros_ci.code.body import Call, last_part
from haros_ci.code.callbacks import Callback
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.code.dead import is_dead
from haros_ci.dependence.slices import Slice, arguments_for, slice_of
from haros_ci.dependence.steps import Step, all_nodes, step_of, steps
from haros_ci.dependence.variables import Held, held
from haros_ci.rates.runs import FRAMEWORK, HARMLESS, UNCALLED, runs
from haros_ci.records import dataclass, field
from haros_ci.syntax import Expression

#: Steps on ways to one effect that are looked at, and of these such as may not lead to it.
MOST, UNSURE = 2_000, 60
#: Functions that run what they are given before they return (en.cppreference.com/w/cpp/algorithm).
INLINE = frozenset(
    "sort stable_sort for_each find_if find_if_not any_of all_of none_of transform remove_if count_if accumulate min_element "
    "max_element copy_if partition generate lower_bound upper_bound erase_if call_once map filter sorted max min reduce "
    "parallel_for iter_swap invoke".split()
)
#: A routine, and the call or registration in it that leads on.
Chain = tuple[tuple[Routine, Step], ...]


@dataclass(frozen=True, slots=True, eq=False)
class Trigger:
    """A *callback* that leads to an effect over *chain*, from its own step to that of the effect; *reason* says why it may not."""

    callback: Callback
    chain: Chain
    reason: str


@dataclass(slots=True)
class Influence:
    """The *triggers* of an effect, what it *reads*, and why something else may lead to it; "" if that is all.

    *is_start* says that it is done when the program begins, *is_transition* when a managed node changes its state.
    """

    triggers: list[Trigger] = field(default_factory=list)
    reads: dict[Held, str] = field(default_factory=dict)
    is_start: bool = False
    is_transition: bool = False
    reason: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class _Item:
    routine: Routine
    step: Step
    values: tuple[Expression, ...]
    chain: Chain
    reason: str
    #: It registers what the effect is done in: when the program begins, it is not done yet.
    is_registering: bool = False


def influence(code: Codebase, routine: Routine, step: Step) -> Influence:
    """What *step* of *routine* depends on."""
    key = ("influence", id(routine), step.number)
    if key not in code.kept:
        code.kept[key] = _Search(code).run(routine, step)
        code.kept["keep", id(routine)] = routine
    found: Influence = code.kept[key]
    return found


@dataclass(slots=True)
class _Search:
    code: Codebase
    made: Influence = field(default_factory=Influence)
    waiting: list[_Item] = field(default_factory=list)
    unsure: list[_Item] = field(default_factory=list)
    seen: set[tuple[int, int, frozenset[int]]] = field(default_factory=set)
    guesses: int = 0

    def run(self, routine: Routine, step: Step) -> Influence:
        self.waiting.append(_Item(routine, step, step.values, ((routine, step),), ""))
        while self.waiting or self.unsure:
            if not self.waiting:
                self.guesses += 1
            item = (self.waiting or self.unsure).pop(0)
            key = id(item.routine), item.step.number, frozenset(map(id, item.values))
            if key in self.seen:
                continue
            self.seen.add(key)
            if len(self.seen) > MOST or self.guesses > UNSURE:
                self.hidden("there are too many ways that lead to it")
                break
            self.item(item)
        return self.made

    def hidden(self, reason: str) -> None:
        self.made.reason = self.made.reason or reason

    def read(self, what: Held, reason: str) -> None:
        if self.made.reads.get(what, "?") != "":
            self.made.reads[what] = reason

    def item(self, item: _Item) -> None:
        sliced = slice_of(self.code, item.routine, item.step, item.values)
        for what, reason in sliced.reads.items():
            self.read(what, item.reason or reason)
        found = runs(self.code, item.routine)
        for callback in found.callbacks:
            self.triggered(item, callback)
        if found.begins and not item.is_registering:
            self.made.is_start = True
        for where, call in (*found.calls, *found.threads):
            self.caller(item, sliced, where, call, "")
        for where, call in found.perhaps:
            self.caller(item, sliced, where, call, f"{where.title} may call {item.routine.title}")
        if found.is_made:
            self.constructed(item)
        if found.hidden:
            self.unseen(item, found.hidden)

    def push(self, item: _Item) -> None:
        (self.unsure if item.reason else self.waiting).append(item)

    def caller(self, item: _Item, sliced: Slice, where: Routine, call: Call, reason: str) -> None:
        step = step_of(self.code, where, call.whole)
        if step is None:
            self.hidden(f"{where.title} calls it in a way that is not understood")
            return
        values = arguments_for(call, item.routine, sliced.parameters)
        chain = (where, step), *item.chain
        self.push(_Item(where, step, values, chain, item.reason or reason, item.is_registering))

    def triggered(self, item: _Item, callback: Callback) -> None:
        self.made.triggers.append(Trigger(callback, item.chain, item.reason))
        step = step_of(self.code, callback.maker, callback.call.whole)
        if step is None:
            return
        for value in step.values:  # what keeps a timer or subscription can stop it
            if isinstance(value, syntax.Assignment):
                what = held(self.code, callback.maker, value.target)
                if what is not None:
                    self.read(what, item.reason)
        # what registers it is a cause of all that it does
        self.push(_Item(callback.maker, step, (), ((callback.maker, step), *item.chain), item.reason, True))

    def unseen(self, item: _Item, reason: str) -> None:
        """Who runs it is not seen: for a lambda, what it stands in, and perhaps others; a transition of a managed node."""
        routine = item.routine
        name = routine.function.name.rpartition(routine.source.separator)[2]
        if name in FRAMEWORK:
            self.made.is_transition = True
            return
        if routine.function.kind == "destructor":  # at the end of the program, or of an object that a callback makes
            self.constructed(item)
            return
        if routine.outer is None:
            if reason == UNCALLED and is_dead(self.code, routine):
                return
            self.hidden(f"{routine.title}: {reason}")
            return
        step, is_inline = _around(self.code, routine)
        if step is not None:
            self.push(_Item(routine.outer, step, (), ((routine.outer, step), *item.chain), item.reason))
        if step is None or not is_inline:
            self.hidden(f"{routine.title}: {reason}")

    def constructed(self, item: _Item) -> None:
        """Objects that are made in callbacks run their constructor there."""
        owner = classes.owner_of(self.code, item.routine)
        if owner is None or HARMLESS - {"object"} & classes.base_names(self.code, owner):
            return
        name = owner[1].name.rpartition(owner[0].separator)[2]
        for where, step in _makers(self.code, name, item.routine.is_python):
            if where is not item.routine:
                reason = item.reason or f"{where.title} makes an object of {name}"
                chain = (where, step), *item.chain
                self.push(_Item(where, step, step.values, chain, reason, item.is_registering))


def _makers(code: Codebase, name: str, is_python: bool) -> Chain:
    """The routines that make an object of the class called *name*, each with the step."""
    key = ("makers", name, is_python)
    if key not in code.kept:
        every = (where for path in sorted(code.naming(name)) for where in code.routines(path))
        made = ((one, _making(code, one, name)) for one in every if one.is_python is is_python and not one.is_test)
        code.kept[key] = tuple((where, step) for where, step in made if step is not None)
    found: Chain = code.kept[key]
    return found


def _making(code: Codebase, where: Routine, name: str) -> Step | None:
    """The step of a routine that makes an object of the class called *name*."""
    key = ("making", id(where))
    if key not in code.kept:
        made: dict[str, Step] = {}
        for step in steps(code, where):
            if step.name and not set("&*") & set(step.type.marks):
                made.setdefault(step.type.name.rpartition("::")[2], step)
            for node in all_nodes(step.values):
                if isinstance(node, syntax.New):
                    made.setdefault(node.type.name.rpartition("::")[2], step)
                elif isinstance(node, syntax.Call):
                    for one in (last_part(node.callee), *_types(node)):
                        made.setdefault(one.rpartition("::")[2], step)
        code.kept[key] = made
        code.kept["keep", id(where)] = where
    found: dict[str, Step] = code.kept[key]
    return found.get(name)


def _types(call: syntax.Call) -> list[str]:
    return [one.name for one in call.templates if isinstance(one, syntax.Type)]


def _around(code: Codebase, routine: Routine) -> tuple[Step | None, bool]:
    """The step that a lambda or nested function stands in, and whether it runs only while that does."""
    key = ("around", id(routine))
    if key not in code.kept:
        code.kept[key] = _looked_up(code, routine)
        code.kept["keep", id(routine)] = routine
    found: tuple[Step | None, bool] = code.kept[key]
    return found


def _looked_up(code: Codebase, routine: Routine) -> tuple[Step | None, bool]:
    outer = routine.outer
    assert outer is not None
    functions = outer.source.program.functions
    for step in steps(code, outer):
        for node in all_nodes(step.values):
            if isinstance(node, syntax.Lambda) and functions[node.function] is routine.function:
                return step, _is_inline(code, outer, step, node)
    every = steps(code, outer)
    return (every[0] if every else None), False


def _is_inline(code: Codebase, outer: Routine, step: Step, node: syntax.Lambda) -> bool:
    for call in code.body(outer).calls:
        if any(argument is node for argument in call.args):
            return call.name in INLINE
        if call.callee is node:
            return True
    if not step.name or step.values != (node,):
        return False
    # a local function: all mentions of it are calls
    mentions = calls = 0
    for other in steps(code, outer):
        for inner in all_nodes(other.values):
            mentions += isinstance(inner, syntax.Name) and inner.name == step.name
            calls += isinstance(inner, syntax.Call) and inner.callee == syntax.Name(step.name)
    return mentions == calls
