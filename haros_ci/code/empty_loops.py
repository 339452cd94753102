# SPDX-License-Identifier: Apache-2.0
"""Loops that do not turn while a constructor of C++ runs: over a container of the object that nothing has filled yet."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci import syntax
from haros_ci.code.body import Around, Call
from haros_ci.code.calls import reached
from haros_ci.code.classes import owner_of
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.code.kinds import is_local
from haros_ci.syntax import Expression
from haros_ci.syntax.walk import everything

#: Containers that are empty when nothing is said of what is in them.
_CONTAINERS = frozenset(
    "vector list deque forward_list set multiset map multimap unordered_set unordered_multiset unordered_map unordered_multimap".split()
)
#: Methods of them that put nothing in.
_LOOKING = frozenset(
    "begin end cbegin cend rbegin rend find count contains empty size at front back erase clear reserve max_size lower_bound "
    "upper_bound equal_range pop_back pop_front".split()
)


def turns_never(code: Codebase, constructor: Routine, routine: Routine, call: Call) -> bool:
    """Whether *call*, in a *routine* of the object that *constructor* makes and runs, stands in a loop that does not turn then."""
    return _is_never(code, constructor, routine, call.around)


def _is_never(code: Codebase, constructor: Routine, routine: Routine, around: Around, depth: int = 3) -> bool:
    loops = (place.statement for place in around if place.kind == "loop")
    values = (value for loop in loops for value in _iterated(loop))
    return any(_is_empty(code, constructor, routine, value, depth) for value in values)


def _iterated(loop: object) -> Iterator[Expression]:
    """What a loop goes over: ``for (x : value)``, ``for (auto it = value.begin(); ...)``."""
    if isinstance(loop, syntax.Each):
        yield loop.iterable
    elif isinstance(loop, syntax.Loop) and loop.keyword == "for":
        for before in loop.before:
            for value in syntax.started(before.init) if isinstance(before, syntax.Variable) else ():
                if isinstance(value, syntax.Call) and isinstance(value.callee, syntax.Member):
                    if value.callee.name in ("begin", "cbegin", "rbegin"):
                        yield value.callee.object


def _is_empty(code: Codebase, constructor: Routine, routine: Routine, value: Expression, depth: int) -> bool:
    if depth == 0:
        return False
    if isinstance(value, syntax.Name) and is_local(code, routine, value.name):
        return _is_empty_local(code, constructor, routine, value, depth)
    name = _member(value)
    owner = owner_of(code, constructor)
    if not name or owner is None or routine.owner != constructor.owner:
        return False
    if not _begins_empty(owner[1], name) or any(
        init.name == name and init.arguments for init in constructor.function.inits
    ):
        return False
    running = [other_routine for other_routine, _ in reached(code, constructor)]
    return all(
        not _may_fill(other_routine.function, name)
        for other_routine in running
        if other_routine.owner == constructor.owner
    )


def _begins_empty(owner: syntax.Class, name: str) -> bool:
    """Whether the member called *name* is a container that its declaration leaves empty."""
    fields = [field for field in owner.fields if field.name == name]
    return len(fields) == 1 and not fields[0].is_static and fields[0].init is None and _is_container(fields[0].type)


def _is_empty_local(code: Codebase, constructor: Routine, routine: Routine, value: syntax.Name, depth: int) -> bool:
    """Whether a local container begins as empty and is filled in loops alone that do not turn."""
    body = code.body(routine)
    made = body.variables.get(value.name, ())
    if len(made) != 1 or made[0].init is not None or not _is_container(made[0].type) or made[0].is_static:
        return False
    fills = [call for call in body.calls if call.receiver == value and call.name not in _LOOKING]
    if not all(_is_never(code, constructor, routine, fill.around, depth - 1) for fill in fills):
        return False
    return _mentions(routine.function, value.name) == _looks(routine.function, value.name) + len(fills)


def _may_fill(function: syntax.Function, name: str) -> bool:
    """Whether *function* does more with a member of its object than to look into it."""
    return _mentions(function, name) > _looks(function, name)


def _mentions(function: syntax.Function, name: str) -> int:
    return sum(_member(record) == name for record in everything(function))


def _looks(function: syntax.Function, name: str) -> int:
    """How often a container called *name* is gone over, or one of its methods that put nothing in is called."""
    found = 0
    for record in everything(function):
        if isinstance(record, syntax.Each):
            found += _member(record.iterable) == name
        elif isinstance(record, syntax.Call) and isinstance(record.callee, syntax.Member):
            found += record.callee.name in _LOOKING and _member(record.callee.object) == name
    return found


def _member(value: object) -> str:
    """The name of a member of ``this``, or of a variable."""
    if isinstance(value, syntax.Member) and isinstance(value.object, syntax.This):
        return value.name
    return value.name if isinstance(value, syntax.Name) else ""


def _is_container(made: syntax.Type) -> bool:
    return made.name.rpartition("::")[2] in _CONTAINERS and "*" not in made.marks and "&" not in made.marks
