# SPDX-License-Identifier: Apache-2.0
"""The call graph: which routines of the workspace a call runs, and who calls a routine.

Silent on what is not known: overloads with the same number of arguments, virtual methods without a body,
values that are called, names of several classes.
"""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci import syntax
from haros_ci.code import classes, kinds
from haros_ci.code.body import Call
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.syntax import Expression


def called(code: Codebase, routine: Routine, call: syntax.Call, steps: int = kinds.STEPS) -> tuple[Routine, ...]:
    """The routine that a call expression in *routine* runs: one, or none where it is not known."""
    key = ("called", id(call))
    if key in code.kept:
        found: tuple[Routine, ...] = code.kept[key]
        return found
    if steps <= 0:
        return ()
    every = function_meant(code, routine, call.callee, steps)
    fitting = [other_routine for other_routine in every if classes.accepts(other_routine.function, call.arguments)]
    result = (fitting[0],) if len(fitting) == 1 else ()
    code.kept[key] = result
    code.kept["keep", id(call)] = call  # so that its identity stays its own
    return result


def function_meant(
    code: Codebase, routine: Routine, callee: Expression, steps: int = kinds.STEPS
) -> tuple[Routine, ...]:
    """The routines that a name or member may mean as a function; several are overloads."""
    if isinstance(callee, syntax.Lambda):
        found = code.inner(routine, callee.function)
        return (found,) if found is not None else ()
    if isinstance(callee, syntax.Address):
        return function_meant(code, routine, callee.value, steps)
    if isinstance(callee, syntax.Name):
        if routine.is_python:
            return _python_name(code, routine, callee.name)
        return _cpp_name(code, routine, callee.name, steps)
    if isinstance(callee, syntax.Member):
        return _method(code, routine, callee, steps)
    return ()


def _method(code: Codebase, routine: Routine, callee: syntax.Member, steps: int) -> tuple[Routine, ...]:
    base, name = callee.object, callee.name
    if routine.is_python and isinstance(base, syntax.Call) and syntax.name_of(base.callee) == "super":
        owner = classes.owner_of(code, routine)
        for above, _ in classes.bases(code, owner) if owner is not None else ():
            if above is not None and (found := classes.methods(code, above, name)):
                return found
        return ()
    if isinstance(base, syntax.This):
        owner = classes.owner_of(code, routine)
    else:
        written = classes.pointed(kinds.type_of(code, routine, base, steps - 1))
        owner = classes.class_named(code, written, routine.source) if written else None
    if owner is not None:
        head, _, last = name.rpartition("::")
        return classes.methods(code, owner, last if head else name)
    if routine.is_python:
        dotted = kinds.dotted(code, routine, callee)
        return _of_module(code, dotted) if "." in dotted else ()
    return ()


def _cpp_name(code: Codebase, routine: Routine, name: str, steps: int) -> tuple[Routine, ...]:
    if "::" not in name and kinds.is_local(code, routine, name):
        found = kinds.variable(code, routine, name)
        if isinstance(found, tuple) and len(found) == 2:
            where, local = found
            if isinstance(local.assigned, syntax.Lambda):
                return function_meant(code, where, local.assigned, steps)
        return ()
    owner = classes.owner_of(code, routine)
    if owner is not None and "::" not in name:
        methods = classes.methods(code, owner, name)
        if methods:
            return methods
    head, _, last = name.rpartition("::")
    if head:
        scope = routine.method.function.name.rpartition("::")[0]
        kind = classes.resolved(code, syntax.Type(head), scope, routine.source)
        named = classes.class_named(code, kind.name, routine.source)
        if named is not None:
            return classes.methods(code, named, last)
    scope = routine.method.function.name.rpartition("::")[0]
    for candidate in code.cpp.scopes(name, scope, routine.source):
        near = code.cpp.near(code.cpp.functions, candidate, routine.source, frozenset())
        if near:
            return _defined(code, routine, candidate)
    return ()


def _defined(code: Codebase, routine: Routine, name: str) -> tuple[Routine, ...]:
    """The free functions of a qualified name that have a body, of the same file or else of the same package or headers."""
    every = [(where, function) for where, function in code.cpp.functions.get(name, ()) if function.body is not None]
    for fits in (
        lambda path, package: path == routine.path,
        lambda path, package: path in code.cpp.reach(routine.path),
        lambda path, package: package == routine.source.package,
        lambda path, package: True,
    ):
        found = [definition for definition in every if fits(definition[0].path, definition[0].package)]
        if found:
            made = (code.routine(*definition) for definition in found)
            return tuple(dict.fromkeys(other_routine for other_routine in made if other_routine is not None))
    return ()


def _python_name(code: Codebase, routine: Routine, name: str) -> tuple[Routine, ...]:
    around: Routine | None = routine
    while around is not None:
        nested = code.body(around).nested.get(name)
        if nested is not None:
            found = code.inner(around, nested)
            return (found,) if found is not None else ()
        around = around.outer
    if kinds.is_local(code, routine, name):
        return ()
    own = [
        function
        for where, function in code.python.functions.get(name, ())
        if where.path == routine.path and not function.owner and function.kind == "function"
    ]
    if own:
        made = code.routine(routine.source, own[-1])
        return (made,) if made is not None else ()
    dotted = kinds.dotted(code, routine, syntax.Name(name))
    return _of_module(code, dotted) if "." in dotted else ()


def _of_module(code: Codebase, dotted: str) -> tuple[Routine, ...]:
    """A function by its dotted name, of a module of the workspace; a method where a class is named."""
    module, _, name = dotted.rpartition(".")
    found = [
        made
        for where in code.python.modules.get(module, ())
        for function in where.program.functions
        if function.name == name and function.kind == "function" and not function.owner
        if (made := code.routine(where, function)) is not None
    ]
    return tuple(found) if len(found) == 1 else ()


def callees(code: Codebase, routine: Routine) -> tuple[tuple[Call, Routine], ...]:
    """The calls in a routine that run routines of the workspace, in the order of the text."""
    key = ("callees", id(routine))
    if key not in code.kept:
        code.kept[key] = tuple(
            (call, target) for call in code.body(routine).calls for target in called(code, routine, call.whole)
        )
    found: tuple[tuple[Call, Routine], ...] = code.kept[key]
    return found


#: The calls that lead to a routine, the first of them first: each with the routine that it stands in.
Path = tuple[tuple[Routine, Call], ...]


def reached(code: Codebase, start: Routine, depth: int = 6) -> Iterator[tuple[Routine, Path]]:
    """*start* and the routines that run when it runs, nearest first, each with the calls that lead there."""
    seen = {id(start)}
    waiting: list[tuple[Routine, Path]] = [(start, ())]
    while waiting:
        routine, path = waiting.pop(0)
        yield routine, path
        if len(path) >= depth:
            continue
        for call, target in callees(code, routine):
            if id(target) not in seen:
                seen.add(id(target))
                waiting.append((target, (*path, (routine, call))))


def callers(code: Codebase, target: Routine) -> tuple[tuple[Routine, Call], ...]:
    """The calls that run *target*, as far as they are known to."""
    name = target.function.name.rpartition(target.source.separator)[2]
    return tuple(
        (routine, call) for routine, call in calls_of(code, name) if target in called(code, routine, call.whole)
    )


def calls_of(code: Codebase, *names: str) -> tuple[tuple[Routine, Call], ...]:
    """All calls of functions and methods of these names, by file."""
    key = ("calls of", names)
    if key not in code.kept:
        names_ = frozenset(names)
        code.kept[key] = tuple(
            (routine, call)
            for path in sorted(code.mentioning(*names))
            for routine in code.routines(path)
            for call in code.body(routine).calls
            if call.name in names_
        )
    found: tuple[tuple[Routine, Call], ...] = code.kept[key]
    return found
