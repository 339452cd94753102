# SPDX-License-Identifier: Apache-2.0
"""What is said of a way from an input to an output: its places, and the conditions on it with what they ask for."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci import syntax
from haros_ci.code.body import Call
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.code.ways import place
from haros_ci.dependence.influence import Chain, influence
from haros_ci.dependence.search import Way
from haros_ci.dependence.slices import exits
from haros_ci.dependence.steps import Guard, Step, all_nodes
from haros_ci.dependence.variables import Held, chain, held
from haros_ci.dependence.writes import writes
from haros_ci.model.architecture import Node
from haros_ci.model.dependence import When
from haros_ci.model.location import Location
from haros_ci.rates.turns import RUNNING

#: Conditions of one way that are kept.
MOST = 20
#: Lines of a routine that are looked at for where something stands.
LINES = 2_000


def whens(code: Codebase, node: Node, way: Way) -> tuple[When, ...]:
    """The conditions on a way, each once, in its order; those that hold as long as the program runs are none."""
    found: dict[tuple[Location, bool], When] = {}
    for routine, step in (*way.chain, *way.after):
        for guard, is_met in _guards(code, routine, step):
            text = " ".join(guard.text.split())
            if not text or RUNNING.fullmatch(text) or guard.kind == "loop" and not guard.test:
                continue
            at = Location(routine.path, guard.line, guard.column)
            reads = tuple(dict.fromkeys(_reads(code, node, routine, guard, way)))
            found.setdefault((at, is_met), When(text[:200], is_met, at, reads))
    return tuple(found.values())[:MOST]


def _guards(code: Codebase, routine: Routine, step: Step) -> Iterator[tuple[Guard, bool]]:
    for guard in step.around:
        yield guard, guard.is_met
    for guard in exits(code, routine, step):
        yield guard, not guard.is_met


def _reads(code: Codebase, node: Node, routine: Routine, guard: Guard, way: Way) -> Iterator[str]:
    for value in all_nodes(guard.test):
        if not isinstance(value, (syntax.Name, syntax.Member)):
            continue
        every, _ = chain(value)
        if not every:
            continue
        what = held(code, routine, every[-1])
        if what is None:
            continue
        if what.kind != "local":
            yield _state(code, node, what, routine.is_python)
        elif routine is way.callback.routine and what.name in {p.name for p in routine.function.parameters}:
            path = ".".join(one.name for one in reversed(every[:-1]) if isinstance(one, syntax.Member))
            if path and isinstance(value, syntax.Member):
                yield f"field {path}"


def _state(code: Codebase, node: Node, what: Held, is_python: bool) -> str:
    """What a member is for a condition: a parameter that is read at the start alone, or state."""
    every = writes(code, what, is_python).found
    late = [one for one in every if influence(code, one.routine, one.use.step).triggers]
    if not late:
        places = {place(one.routine, inner) for one in every for inner in _calls(code, one.routine, one.use.step)}
        names = sorted(
            end.name for end in node.endpoints if end.kind in ("getters", "parameters") and end.location in places
        )
        if names:
            return f"parameter {names[0]}"
        return f"constant {what.title}"
    return f"state {what.title}"


def _calls(code: Codebase, routine: Routine, step: Step) -> Iterator[Call]:
    inside = {id(node) for node in all_nodes(step.values)}
    return (call for call in code.body(routine).calls if id(call.whole) in inside)


def path_of(code: Codebase, way: Way, sending: tuple[Routine, Call]) -> tuple[tuple[Location, str], ...]:
    """The places from the callback's registration to the call that sends, with what is to be seen there."""
    found = [(way.callback.location, f"{way.callback.routine.title} is the callback")]
    names = list(way.state)
    ways: Chain = (*way.chain, *way.after)
    changes = {len(way.chain) - 1 + number for number in range(len(names))}
    for number, (routine, step) in enumerate(ways[:-1]):
        if number in changes:
            what = names.pop(0)
            found.append((where(code, routine, step, what), f"{routine.title} changes {what}"))
        elif number < len(way.chain) - 1:
            after = way.chain[number + 1][0]
            found.append((where(code, routine, step, ""), f"{routine.title} leads to {after.title}"))
    found.append((place(*sending), f"{sending[0].title} sends it"))
    return tuple(found)


def where(code: Codebase, routine: Routine, step: Step, name: str) -> Location:
    """The line of a step: that of a call in it, else of a line of the routine that assigns to *name*, else of what is around it."""
    if name:
        lines = code.lines(routine, routine.function.line).split("\n")[:LINES]
        pattern = re.compile(rf"(?<!\w){re.escape(name)}\b[^=<>!\n]{{0,80}}=(?!=)")
        for number, text in enumerate(lines):
            if pattern.search(text):
                return Location(routine.path, routine.function.line + number)
    for node in all_nodes(step.values):
        if isinstance(node, (syntax.Call, syntax.New)) and node.line:
            return Location(routine.path, node.line, node.column)
    if step.around:
        return Location(routine.path, step.around[-1].line, step.around[-1].column)
    return Location(routine.path, routine.function.line, routine.function.column)
