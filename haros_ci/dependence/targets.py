# SPDX-License-Identifier: Apache-2.0
"""The functions of the workspace that a call may run: all of them, each with the reason why it is not certain."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.code import classes, kinds
from haros_ci.code.body import Call, last_part, nodes
from haros_ci.code.callbacks import callbacks
from haros_ci.code.calls import called, function_meant
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.dependence.steps import steps
from haros_ci.dependence.variables import held
from haros_ci.rates.may import may_run
from haros_ci.syntax import Expression, Function
from haros_ci.syntax.source import Source

#: Of functions of one name so many are looked at.
MOST = 400
#: A function with "" where a call surely runs it, or the reason why it may.
Target = tuple[Routine, str]


def targets(code: Codebase, routine: Routine, call: Call) -> tuple[Target, ...]:
    """What *call* in *routine* may run, functions that are given to it included."""
    key = ("targets", id(call.whole))
    if key not in code.kept:
        code.kept[key] = (*_of_callee(code, routine, call), *_given(code, routine, call))
        code.kept["keep", id(call.whole)] = call.whole
    found: tuple[Target, ...] = code.kept[key]
    return found


def is_of_workspace(code: Codebase, routine: Routine, call: Call) -> bool:
    """Whether what a call runs is surely a function of the workspace."""
    return bool(called(code, routine, call.whole))


def _of_callee(code: Codebase, routine: Routine, call: Call) -> tuple[Target, ...]:
    sure = called(code, routine, call.whole)
    if sure:
        return tuple((target, "") for target in sure) + _overriding(code, routine, call, sure[0])
    meant = [
        one for one in function_meant(code, routine, call.callee) if classes.accepts(one.function, call.whole.arguments)
    ]
    if meant:
        return tuple((target, f"{call.name} may be one of several functions") for target in meant)
    name = last_part(call.callee)
    if not name or isinstance(call.callee, syntax.Name) and kinds.is_local(code, routine, call.callee.name):
        return ()
    every = by_name(code, name, routine.is_python)
    reason = f"{routine.title} calls {name}, and it is not seen which function that is"
    return tuple(
        (target, reason)
        for target in every[:MOST]
        if classes.accepts(target.function, call.whole.arguments) and may_run(code, routine, target, call.callee)
    )


def _overriding(code: Codebase, routine: Routine, call: Call, sure: Routine) -> tuple[Target, ...]:
    """The methods of derived classes that a call of a virtual method may run instead."""
    owner = classes.owner_of(code, sure)
    if owner is None or not isinstance(call.callee, (syntax.Member, syntax.Name)):
        return ()
    found = []
    for other in by_name(code, last_part(call.callee), routine.is_python)[:MOST]:
        below = classes.owner_of(code, other)
        if other is not sure and below is not None and owner[1].name in classes.base_names(code, below):
            found.append((other, f"{other.title} may run in place of {sure.title}"))
    return tuple(found)


def _given(code: Codebase, routine: Routine, call: Call) -> tuple[Target, ...]:
    """The lambdas that a call is given: it may run them."""
    found = []
    for argument in call.args:
        value = argument.value if isinstance(argument, syntax.Keyword) else argument
        if isinstance(value, syntax.Lambda):
            inner = code.inner(routine, value.function)
            if inner is not None and id(inner) not in registered(code):
                found.append((inner, ""))
    return tuple(found)


def registered(code: Codebase) -> frozenset[int]:
    """The functions that are callbacks, by identity: who names one registers it, and does not run it."""
    if "registered" not in code.kept:
        code.kept["registered"] = frozenset(id(callback.routine) for callback in callbacks(code))
    found: frozenset[int] = code.kept["registered"]
    return found


def by_name(code: Codebase, name: str, is_python: bool) -> tuple[Routine, ...]:
    """All functions and methods of that name with a body, in the programs of a language, tests left out."""
    key = ("by name", is_python)
    if key not in code.kept:
        made: dict[str, list[tuple[object, object]]] = {}
        for source in code.sources:
            if (source.program.language == "python") is is_python and source.path not in code.firmware:
                for function in source.program.functions:
                    if function.body is not None and function.kind != "lambda":
                        made.setdefault(function.name.rpartition(source.separator)[2], []).append((source, function))
        code.kept[key] = made
    table: dict[str, list[tuple[Source, Function]]] = code.kept[key]
    if ("by name", is_python, name) not in code.kept:
        every = (code.routine(source, function) for source, function in table.get(name, ()))
        code.kept["by name", is_python, name] = tuple(one for one in every if one is not None and not one.is_test)
    found: tuple[Routine, ...] = code.kept["by name", is_python, name]
    return found


def mentioned(code: Codebase, routine: Routine, values: tuple[Expression, ...]) -> tuple[Target, ...]:
    """Functions that *values* name without calling them: properties of Python, and what is handed on to be called."""
    found: dict[int, Target] = {}
    callees: set[int] = set()
    for node in (inner for value in values for inner in nodes(value)):
        if isinstance(node, syntax.Call):
            callees.add(id(node.callee))
        if not isinstance(node, (syntax.Name, syntax.Member)) or id(node) in callees:
            continue
        name = node.name.rpartition("::")[2]
        if not by_name(code, name, routine.is_python) or held(code, routine, node) is not None:
            continue
        for one in function_meant(code, routine, node):
            if id(one) not in registered(code):
                found[id(one)] = one, ""
        if not found and isinstance(node, syntax.Member) and routine.is_python:
            found.update((id(other), (other, reason)) for other, reason in _properties(code, routine, name))
    return tuple(found.values())


def _properties(code: Codebase, routine: Routine, name: str) -> list[Target]:
    """The properties of Python classes that a member of that name may be."""
    reason = f"{routine.title} may ask for the property {name}"
    return [(one, reason) for one in by_name(code, name, True)[:MOST] if one.function.decorators and one.owner]


def closure(code: Codebase, routine: Routine) -> dict[int, Target]:
    """All that runs when *routine* runs, itself included, by identity: certain ways first."""
    key = ("closure", id(routine))
    if key not in code.kept:
        found: dict[int, Target] = {}
        sure: list[Target] = [(routine, "")]
        unsure: list[Target] = []
        while sure or unsure:
            one, reason = sure.pop() if sure else unsure.pop(0)
            if id(one) in found:
                continue
            found[id(one)] = one, reason
            for call in code.body(one).calls:
                for target, why in targets(code, one, call):
                    (unsure if reason or why else sure).append((target, reason or why))
            for target, why in _all_mentioned(code, one):
                (unsure if reason or why else sure).append((target, reason or why))
        code.kept[key] = found
        code.kept["keep", id(routine)] = routine
    known: dict[int, Target] = code.kept[key]
    return known


def _all_mentioned(code: Codebase, routine: Routine) -> tuple[Target, ...]:
    key = ("functions mentioned", id(routine))
    if key not in code.kept:
        every = tuple(value for step in steps(code, routine) for value in step.values)
        code.kept[key] = mentioned(code, routine, every)
        code.kept["keep", id(routine)] = routine
    found: tuple[Target, ...] = code.kept[key]
    return found
