# SPDX-License-Identifier: Apache-2.0
"""Whether a call that is not known to run anything may run a function of that name."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.code import classes, kinds
from haros_ci.code.body import last_part
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.syntax import Expression


def may_run(code: Codebase, where: Routine, routine: Routine, callee: Expression) -> bool:
    """Whether a call of that name that is not known to run anything may run *routine*."""
    if isinstance(callee, syntax.Name):
        if "::" in callee.name:
            head = callee.name.rpartition("::")[0].rpartition("::")[2]
            return not routine.owner or head == routine.owner.rpartition("::")[2]
        return not kinds.is_local(code, where, callee.name) and (
            not routine.owner or routine.outer is not None or _is_in_reach(code, where, routine)
        )
    if not isinstance(callee, syntax.Member):
        return False
    if not routine.owner:
        return (
            where.is_python and not isinstance(callee.object, syntax.This) and not _is_made(code, where, callee.object)
        )
    owner = classes.owner_of(code, routine)
    if isinstance(callee.object, syntax.This):
        other = classes.owner_of(code, where)
    else:
        if kinds.type_name(code, where, callee.object) and kinds.class_of(code, where, callee.object) is None:
            return False
        other = kinds.class_of(code, where, callee.object)
    if other is None or owner is None:
        return True
    names = classes.base_names(code, other) | classes.base_names(code, owner)
    return other[1].name == owner[1].name or owner[1].name in names or other[1].name in names


def _is_made(code: Codebase, where: Routine, value: Expression) -> bool:
    """Whether a name in Python is a variable that is only ever given what calls of classes make: no module, whose functions it could have."""
    if not isinstance(value, syntax.Name):
        return False
    around: Routine | None = where
    while around is not None:
        if any(one.name.lstrip("*") == value.name for one in around.function.parameters):
            return False
        found = code.body(around).assigned(value.name)
        if found or value.name in code.body(around).imports:
            return bool(found) and value.name not in code.body(around).imports and all(map(_is_object, found))
        around = around.outer
    modules = [one for one in code.routines(where.path) if one.function.kind == "module"]
    if len(modules) != 1 or where is modules[0]:
        return False
    found = code.body(modules[0]).assigned(value.name)
    return bool(found) and value.name not in code.body(modules[0]).imports and all(map(_is_object, found))


def _is_object(value: Expression) -> bool:
    """Whether a value is what a class makes, by the capital that classes have in Python; modules are given by functions."""
    return isinstance(value, syntax.Call) and last_part(value.callee).rpartition(".")[2][:1].isupper()


def _is_in_reach(code: Codebase, where: Routine, routine: Routine) -> bool:
    """Whether a plain name in *where* may mean the method *routine*: in C++ in methods of its class and classes that are related."""
    if where.is_python or not where.owner:
        return False
    own, owner = classes.owner_of(code, where), classes.owner_of(code, routine)
    if own is None or owner is None:
        return True
    above = classes.base_names(code, own)
    names = above | classes.base_names(code, owner)
    if own[1].name == owner[1].name or owner[1].name in names or own[1].name in names:
        return True
    return bool(above & set(own[1].templates))  # a base that a template argument names
