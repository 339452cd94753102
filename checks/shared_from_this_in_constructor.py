# SPDX-License-Identifier: Apache-2.0
"""shared_from_this() in a constructor: no shared_ptr owns the object yet (ISO C++17, [util.smartptr.enab])."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, syntax
from haros_ci.api.code import Call, Codebase, Routine, called, calls_of, own_method, turns_never

_NAME = "shared_from_this"
#: So many calls lie between a constructor and what it runs at most.
_DEEP = 3
#: Code that asks whether the object has an owner yet.
_ASKS = "weak_from_this"
_BRANCHES = frozenset(("then", "else", "case"))
#: A constructor, what it calls of its own class down to the routine with the call, whether all of that runs each time.
_Way = tuple[tuple[tuple[Routine, Call], ...], bool]


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    using: dict[int, list[Call]] = {}
    for routine, call in calls_of(code, _NAME):
        if not routine.is_python and _is_of_this(call) and not own_method(code, routine, call) and not call.args:
            using.setdefault(id(routine), []).append(call)
    asking = code.mentioning(_ASKS)
    seen: set[Location] = set()
    for path in _paths(code) if using else ():
        for routine in code.routines(path):
            if routine.function.kind != "constructor" or routine.outer is not None or routine.is_test:
                continue
            for way, is_sure in _ways(code, routine, using):
                user, call = way[-1]
                at = Location(user.path, call.line, call.column)
                if at not in seen and user.path not in asking:
                    seen.add(at)
                    yield _finding(routine, way, at, is_sure)


def _paths(code: Codebase) -> Iterator[str]:
    """The C++ files whose constructors may come to such a call: those with it, and those that may see their classes."""
    users = code.mentioning(_NAME)
    for source in code.sources:
        if source.separator == "::" and (source.path in users or users & {*code.cpp.reach(source.path)}):
            if source.path not in code.unbuilt:
                yield source.path


def _is_of_this(call: Call) -> bool:
    return call.receiver is None or isinstance(call.receiver, syntax.This)


def _ways(code: Codebase, constructor: Routine, using: dict[int, list[Call]]) -> Iterator[_Way]:
    """The calls of shared_from_this() that *constructor* comes to, itself or in methods of its object; each method is seen once."""
    waiting: list[tuple[Routine, tuple[tuple[Routine, Call], ...], bool]] = [(constructor, (), True)]
    seen = {id(constructor)}
    while waiting:
        routine, before, is_sure = waiting.pop(0)
        for call in using.get(id(routine), ()):
            if not _is_harmless(code, constructor, routine, call):
                yield (*before, (routine, call)), is_sure and _is_certain(call)
        for call in code.body(routine).calls if len(before) < _DEEP else ():
            if call.name == _NAME or not _is_of_this(call) or _is_harmless(code, constructor, routine, call):
                continue
            for target in called(code, routine, call.whole):
                if id(target) not in seen and _is_of_class(call, routine, target):
                    seen.add(id(target))
                    waiting.append((target, (*before, (routine, call)), is_sure and _is_certain(call)))


def _is_harmless(code: Codebase, constructor: Routine, routine: Routine, call: Call) -> bool:
    """Whether a *call* is in a ``try`` that catches what it throws, or is not made while the *constructor* runs."""
    return _is_tried(call) or turns_never(code, constructor, routine, call)


def _is_of_class(call: Call, routine: Routine, target: Routine) -> bool:
    """Whether a method is called on the object itself: by its plain name, or on ``this``."""
    made = target.function
    if made.kind != "function" or not target.owner or made.is_static:
        return False
    return call.receiver is not None or "::" not in syntax.name_of(call.callee) or target.owner == routine.owner


def _is_tried(call: Call) -> bool:
    return any(place.kind == "try" for place in call.around)


def _is_certain(call: Call) -> bool:
    return not any(place.kind in _BRANCHES for place in call.around)


def _finding(constructor: Routine, way: tuple[tuple[Routine, Call], ...], at: Location, is_sure: bool) -> Finding:
    name = constructor.owner.rpartition("::")[2]
    through = f", which the constructor of {name} calls" if len(way) > 1 else ""
    where = f"in {way[-1][0].title}(){through}" if len(way) > 1 else f"in the constructor of {name}"
    return Finding(
        at=at,
        message=f"shared_from_this() {where}: no shared_ptr owns the object before its constructor has ended, so this throws "
        "std::bad_weak_ptr (before C++17 the behaviour is undefined); call it in a method that runs after std::make_shared, or "
        "pass the node by *this or by its interfaces",
        about=(constructor.owner, way[-1][0].title),
        flow=tuple((Location(routine.path, call.line, call.column), "calls this") for routine, call in way)
        if len(way) > 1
        else (),
        level=None if is_sure else Level.WARNING,
        apart=(constructor.owner,),
    )


CHECK = Check(
    id="shared-from-this-in-constructor",
    summary="shared_from_this() in a constructor.",
    level=Level.ERROR,
    tags=("code", "cpp"),
    project=check,
)
