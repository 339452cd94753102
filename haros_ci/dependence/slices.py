# SPDX-License-Identifier: Apache-2.0
"""What decides whether a step runs, and what it works with: the variables of its routine are followed back to what they are made of."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci import syntax
from haros_ci.code.body import Call
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.dependence.steps import Guard, Step, all_nodes, steps
from haros_ci.dependence.targets import closure, mentioned, registered, targets
from haros_ci.dependence.uses import calls_by_node, is_log, uses, uses_in
from haros_ci.dependence.variables import Held
from haros_ci.dependence.writes import change
from haros_ci.records import dataclass, field
from haros_ci.syntax import Expression

#: Roles in which what is held neither decides nor gives data.
UNREAD = frozenset(("through", "logged", "whole"))


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
    """What *values*, a part of *step*, and the running of the step depend on; many effects ask for the same."""
    key = ("slice", id(routine), step.number, tuple(map(id, values)))
    if key not in code.kept:
        work = _Slicer(code, routine)
        guards = [*step.around, *exits(code, routine, step)]
        work.made.guards = guards
        work.expressions(step, values)
        for guard in guards:
            work.expressions(step, guard.test)
        work.follow()
        code.kept[key] = work.made
        code.kept["keep", key] = routine, values
    found: Slice = code.kept[key]
    return found


def exits(code: Codebase, routine: Routine, step: Step) -> tuple[Guard, ...]:
    """The conditions under which the function, or the turn of a loop around it, is left before *step*."""
    key = ("exits", id(routine), step.number)
    if key not in code.kept:
        code.kept[key] = tuple(_exits(code, routine, step))
        code.kept["keep", id(routine)] = routine
    found: tuple[Guard, ...] = code.kept[key]
    return found


def _exits(code: Codebase, routine: Routine, step: Step) -> Iterator[Guard]:
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
        names, reads = _facts(self.code, self.routine, step, values)
        for what in names:
            if what not in self.seen:
                self.seen.add(what)
                self.waiting.append(what)
        for what, reason in reads.items():
            self.made.read(what, reason)

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
        for step in _changing(self.code, self.routine).get(what, ()):
            if step.number not in self.steps_seen:
                self.steps_seen.add(step.number)
                self.expressions(step, step.values)
                for guard in step.around:
                    self.expressions(step, guard.test)

    def is_shared(self, what: Held) -> bool:
        """Whether a local keeps its value for the next call, or a function inside this one changes it."""
        static, inner = _lasting(self.code, self.routine)
        return what.name in static or any(what in changed for changed in inner)


def _facts(
    code: Codebase, routine: Routine, step: Step, values: tuple[Expression, ...]
) -> tuple[tuple[Held, ...], dict[Held, str]]:
    """What *values* mention, and what the functions of the workspace that they call depend on."""
    key = ("facts", id(routine), tuple(map(id, values)))
    if key not in code.kept:
        names = dict.fromkeys(use.what for use in uses_in(code, routine, step, values) if use.role not in UNREAD)
        reads: dict[Held, str] = {}
        for target, reason in _run_by(code, routine, values):
            for what, why in reads_of(code, target).items():
                if reads.get(what, "?") != "":
                    reads[what] = reason or why
        code.kept[key] = tuple(names), reads
        code.kept["keep", key] = routine, values
    found: tuple[tuple[Held, ...], dict[Held, str]] = code.kept[key]
    return found


def _run_by(code: Codebase, routine: Routine, values: tuple[Expression, ...]) -> Iterator[tuple[Routine, str]]:
    """The functions of the workspace that *values* call, or hand on as lambdas."""
    known = calls_by_node(code, routine)
    for node in all_nodes(values):
        if isinstance(node, syntax.Lambda):
            inner = code.inner(routine, node.function)
            if inner is not None and id(inner) not in registered(code):
                yield inner, ""
        call = known.get(id(node))
        if call is not None and not is_log(code, routine, call):
            yield from targets(code, routine, call)
    yield from mentioned(code, routine, values)


def _changing(code: Codebase, routine: Routine) -> dict[Held, list[Step]]:
    """The steps of a routine that may change something, by what they change."""
    key = ("changing", id(routine))
    if key not in code.kept:
        made: dict[Held, list[Step]] = {}
        for use in uses(code, routine):
            if change(code, routine, use) is not None:
                made.setdefault(use.what, []).append(use.step)
        code.kept[key] = made
        code.kept["keep", id(routine)] = routine
    found: dict[Held, list[Step]] = code.kept[key]
    return found


def _lasting(code: Codebase, routine: Routine) -> tuple[frozenset[str], tuple[dict[Held, list[Step]], ...]]:
    """The static variables of a routine, and what each function inside it changes."""
    key = ("lasting", id(routine))
    if key not in code.kept:
        static = frozenset(step.name for step in steps(code, routine) if step.is_static)
        inside = (code.inner(routine, index) for index, _ in code.body(routine).inner)
        code.kept[key] = static, tuple(_changing(code, inner) for inner in inside if inner is not None)
        code.kept["keep", id(routine)] = routine
    found: tuple[frozenset[str], tuple[dict[Held, list[Step]], ...]] = code.kept[key]
    return found


def reads_of(code: Codebase, routine: Routine) -> dict[Held, str]:
    """All that a function, and what it calls, mentions outside of its own variables: "" or the reason why that is not certain."""
    key = ("reads of", id(routine))
    if key not in code.kept:
        found: dict[Held, str] = {}
        for other, reason in closure(code, routine).values():
            for use in uses(code, other):
                if use.what.kind != "local" and use.role not in ("logged", "whole") and found.get(use.what, "?") != "":
                    found[use.what] = reason
        code.kept[key] = found
        code.kept["keep", id(routine)] = routine
    known: dict[Held, str] = code.kept[key]
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
