# SPDX-License-Identifier: Apache-2.0
"""Publishers that callbacks make for themselves."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci import syntax
from haros_ci.code.body import Call
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.code.ways import in_callbacks
from haros_ci.syntax.walk import everything


def late(code: Codebase) -> Iterator[tuple[Routine, Call, Call]]:
    """Publishers that a callback makes in a variable of its own, each with the call that makes it and the first that publishes."""
    seen: set[int] = set()
    for reached in in_callbacks(code):
        routine = reached.routine
        if id(routine) in seen or routine.is_test:
            continue
        seen.add(id(routine))
        yield from _late(code, routine)


def _late(code: Codebase, routine: Routine) -> Iterator[tuple[Routine, Call, Call]]:
    calls = code.body(routine).calls
    for made in calls:
        if made.name not in ("advertise", "create_publisher", "Publisher"):
            continue
        name = _variable(code, routine, made)
        first = next((one for one in calls if one.name == "publish" and one.receiver == syntax.Name(name)), None)
        if name and first is not None:
            yield routine, made, first


def _variable(code: Codebase, routine: Routine, made: Call) -> str:
    """The local variable that a call's result is kept in; "" for anything else."""
    body = code.body(routine)
    for name, every in body.variables.items():
        if len(every) == 1 and every[0].value is made.whole and not every[0].is_static:
            return name
    if not routine.is_python:
        return ""
    found = [target for target, operator, value, _ in body.sets if value is made.whole and operator == "="]
    return next((one.name for one in found if isinstance(one, syntax.Name) and not _is_outer(routine, one.name)), "")


def _is_outer(routine: Routine, name: str) -> bool:
    """Whether ``global`` or ``nonlocal`` says that a name is of somebody else."""
    parts = everything(routine.function.body or ())
    return any(isinstance(node, (syntax.Global, syntax.Nonlocal)) and name in node.names for node in parts)
