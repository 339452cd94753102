# SPDX-License-Identifier: Apache-2.0
"""What decides whether a step runs, and what it works with: the variables of its routine are followed back to what they are made of."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from haros_ci import syntax
from haros_ci.code.body import Call
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.dependence.steps import Guard, Step, all_nodes, steps
from haros_ci.dependence.targets import closure, targets
from haros_ci.dependence.uses import Use, uses, uses_in
from haros_ci.dependence.variables import Held
from haros_ci.dependence.writes import change, is_log
from haros_ci.syntax import Expression


@dataclass(slots=True)
class Slice:
    """*reads* are the things outside the routine that it depends on, with "" or the reason why that is not certain.

    *parameters* are those of the routine that count, *guards* what stands around the step, or lets the function return before it.
    """

    reads: dict[Held, str] = field(default_factory=dict)
    parameters: set[str] = field(default_factory=set)
    guards: list[Guard] = field(default_factory=list)

    def read(self, what: Held, reason: str) -> None:
        """Note that it depends on *what*; a certain way counts more."""
        if self.reads.get(what, "?") != "":
            self.reads[what] = reason


def slice_of(code: Codebase, routine: Routine, step: Step, values: tuple[Expression, ...]) -> Slice:
    """What *values*, a part of *step*, and the running of the step depend on."""
    work = _Slicer(code, routine)
    guards = [*step.around, *exits(code, routine, step)]
    work.made.guards = guards
    work.expressions(step, values)
    for guard in guards:
        work.expressions(step, guard.test)
    work.follow()
    return work.made


def exits(code: Codebase, routine: Routine, step: Step) -> Iterator[Guard]:
    """The conditions under which the function, or the turn of a loop around it, is left before *step*."""
    seen = {id(guard) for guard in step.around}
    loops = {id(guard) for guard in step.loops}
    for other in steps(code, routine):
        shared = loops & {id(guard) for guard in other.loops}
        if not other.leaves or (other.number > step.number and not shared):
            continue
        if other.leaves in ("break", "continue") and not shared:
            continue
        for guard in other.around:
            if id(guard) not in seen:
                seen.add(id(guard))
                yield guard


@dataclass(slots=True)
class _Slicer:
    code: Codebase
    routine: Routine
    made: Slice = field(default_factory=Slice)
    waiting: list[Held] = field(default_factory=list)
    seen: set[Held] = field(default_factory=set)
    steps_seen: set[int] = field(default_factory=set)

    def expressions(self, step: Step, values: tuple[Expression, ...]) -> None:
        self.mentioned(uses_in(self.code, self.routine, step, values))
        self.calls(values)

    def mentioned(self, found: Iterable[Use]) -> None:
        for use in found:
            if use.role != "through" and use.what not in self.seen:
                self.seen.add(use.what)
                self.waiting.append(use.what)

    def calls(self, values: tuple[Expression, ...]) -> None:
        """What the functions of the workspace that *values* call depend on."""
        known = {id(call.whole): call for call in self.code.body(self.routine).calls}
        for node in all_nodes(values):
            if isinstance(node, syntax.Lambda):
                inner = self.code.inner(self.routine, node.function)
                for what, reason in reads_of(self.code, inner).items() if inner is not None else ():
                    self.made.read(what, reason)
            call = known.get(id(node))
            if call is None or is_log(call.name):
                continue
            for target, reason in targets(self.code, self.routine, call):
                for what, why in reads_of(self.code, target).items():
                    self.made.read(what, reason or why)

    def follow(self) -> None:
        here = f"{self.routine.path}:{self.routine.function.line}:{self.routine.function.column}"
        parameters = {parameter.name.lstrip("*") for parameter in self.routine.function.parameters}
        while self.waiting:
            what = self.waiting.pop()
            if what.kind != "local" or what.owner != here:
                self.made.read(what, "")
                self.assigned_here(what)
                continue
            if what.name in parameters:
                self.made.parameters.add(what.name)
            if self.is_shared(what):
                self.made.read(what, "")
            self.assigned_here(what)

    def assigned_here(self, what: Held) -> None:
        """All steps of the routine that may change *what* count, with what stands around them."""
        for use in uses(self.code, self.routine):
            if use.what == what and change(self.code, self.routine, use) is not None:
                step = use.step
                if step.number not in self.steps_seen:
                    self.steps_seen.add(step.number)
                    self.expressions(step, step.values)
                    for guard in step.around:
                        self.expressions(step, guard.test)

    def is_shared(self, what: Held) -> bool:
        """Whether a local keeps its value for the next call, or a function inside this one changes it."""
        if any(step.is_static and step.name == what.name for step in steps(self.code, self.routine)):
            return True
        for index, _ in self.code.body(self.routine).inner:
            inner = self.code.inner(self.routine, index)
            for use in uses(self.code, inner) if inner is not None else ():
                if use.what == what and inner is not None and change(self.code, inner, use) is not None:
                    return True
        return False


def reads_of(code: Codebase, routine: Routine) -> dict[Held, str]:
    """All that a function, and what it calls, mentions outside of its own variables: "" or the reason why that is not certain."""
    key = ("reads of", id(routine))
    if key not in code.kept:
        found: dict[Held, str] = {}
        for other, reason in closure(code, routine).values():
            for use in uses(code, other):
                if use.what.kind != "local" and found.get(use.what, "?") != "":
                    found[use.what] = reason
        code.kept[key] = found
        code.kept["keep", id(routine)] = routine
    known: dict[Held, str] = code.kept[key]  # type: ignore[assignment]
    return known


def arguments_for(call: Call, routine: Routine, names: set[str]) -> tuple[Expression, ...]:
    """What *call* gives to the parameters of *routine* called *names*; all that it gives where that is not certain."""
    if not names:
        return ()
    plain = [value for value in call.args if not isinstance(value, syntax.Keyword)]
    if any(isinstance(value, (syntax.Star, syntax.DoubleStar)) for value in plain):
        return call.args
    found: list[Expression] = []
    for number, parameter in enumerate(routine.function.parameters):
        if parameter.name.startswith("*"):
            return call.args
        if parameter.name in names and number < len(plain):
            found.append(plain[number])
    found += [value for value in call.args if isinstance(value, syntax.Keyword) and value.name in names]
    return tuple(found)
