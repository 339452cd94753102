# SPDX-License-Identifier: Apache-2.0
"""Callbacks that certainly do nothing: what they are given is looked at, and kept where nobody looks."""

from __future__ import annotations

import re

from haros_ci import syntax
from haros_ci.code import classes, kinds
from haros_ci.code.body import Call
from haros_ci.code.callbacks import Callback
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.dependence.steps import Step, steps
from haros_ci.dependence.targets import by_name, closure, targets
from haros_ci.dependence.uses import Use, uses, uses_of
from haros_ci.dependence.variables import Held
from haros_ci.dependence.writes import change

#: Functions and methods that certainly do nothing but return a value (std, math, message fields' containers).
HARMLESS = frozenset(
    "abs fabs sqrt pow sin cos tan asin acos atan atan2 hypot floor ceil round fmod fmin fmax min max isnan isinf isfinite "
    "size length empty at front back begin end data c_str len float int bool str range to_string toSec to_sec seconds "
    "nanoseconds now list tuple".split()
)
#: Functions of one callback that are looked at.
MOST = 40


def unread(code: Codebase, callback: Callback) -> tuple[str, ...] | None:
    """The names that a callback keeps something under, and that nobody reads, where that is all that it does; None for any other one."""
    routine = callback.routine
    if not routine.function.body or routine.function.decorators or _may_be_replaced(code, routine):
        return None
    every = closure(code, routine)
    if len(every) > MOST or any(reason for _, reason in every.values()):
        return None
    names: dict[str, None] = {}
    for one, _ in every.values():
        kept = _kept(code, one)
        if kept is None:
            return None
        names.update(dict.fromkeys(kept))
    return tuple(names) if names else None


def _may_be_replaced(code: Codebase, routine: Routine) -> bool:
    """Whether a derived class has a method of that name, too."""
    owner = classes.owner_of(code, routine)
    name = routine.function.name.rpartition(routine.source.separator)[2]
    if owner is None:
        return False
    others = (classes.owner_of(code, other) for other in by_name(code, name, routine.is_python) if other is not routine)
    return any(other is not None and owner[1].name in classes.base_names(code, other) for other in others)


def _kept(code: Codebase, routine: Routine) -> tuple[str, ...] | None:
    """What a function keeps where nobody reads it; None where it may do anything else."""
    if not _only_assigns(code, routine):
        return None
    found: dict[Held, None] = {}
    for use in uses(code, routine):
        if change(code, routine, use) is None:
            continue
        if use.what.kind == "local" and _is_own(code, routine, use):
            continue
        if use.role not in ("whole", "set") or use.what.kind == "local":
            return None
        found[use.what] = None
    return tuple(what.title for what in found) if all(_is_unread(code, what, routine) for what in found) else None


def _only_assigns(code: Codebase, routine: Routine) -> bool:
    """Whether a function makes no objects or functions, throws nothing, and calls what does nothing but what is looked at."""
    body = code.body(routine)
    if body.is_partial or body.inner or body.nested or body.news or body.imports:
        return False
    if any(step.leaves == "throw" or step.is_static or _makes(code, routine, step) for step in steps(code, routine)):
        return False
    return all(_is_harmless(code, routine, call) for call in body.calls)


def _makes(code: Codebase, routine: Routine, step: Step) -> bool:
    """Whether a step makes an object of a class whose constructor may do something."""
    if not step.name or routine.is_python:
        return False
    if step.type.name in ("auto", "") or "&" in step.type.marks:
        return False
    kind = step.type.name
    return "::" in kind and not kind.startswith(("std::", "::std::")) and "msg" not in kind


def _is_harmless(code: Codebase, routine: Routine, call: Call) -> bool:
    return bool(targets(code, routine, call)) or call.name in HARMLESS


def _is_own(code: Codebase, routine: Routine, use: Use) -> bool:
    """Whether a local is a variable of the routine that stands for nothing else, not a parameter that others have, too."""
    if any(parameter.name.lstrip("*") == use.what.name for parameter in routine.function.parameters):
        return False
    made = [step for step in steps(code, routine) if step.name == use.what.name]
    if routine.is_python:
        return use.role == "whole"
    return bool(made) and not any({"&", "*"} & set(step.type.marks) or _points(code, routine, step) for step in made)


def _points(code: Codebase, routine: Routine, step: Step) -> bool:
    name = kinds.type_of(code, routine, syntax.Name(step.name))
    return name is None or "*" in name.marks or "ptr" in name.name.lower()


def _is_unread(code: Codebase, what: Held, routine: Routine) -> bool:
    """Whether a name stands nowhere in the workspace's programs but where it is assigned to, and where it is declared."""
    if what.kind != "member":
        return False
    name = what.name.rpartition("::")[2]
    word = re.compile(rf"(?<![\w]){re.escape(name)}(?![\w])")
    count = sum(len(word.findall(code.text(path))) for path in sorted(code.mentioning(name)))
    return 0 < count <= _assigned(code, what, routine.is_python)


def _assigned(code: Codebase, what: Held, is_python: bool) -> int:
    """How often a member is assigned to, its declaration counted."""
    found = [use for _, use in uses_of(code, what, is_python) if use.role in ("whole", "set")]
    return len(found) + (0 if is_python else 1)
