# SPDX-License-Identifier: Apache-2.0
"""What rates and timers are made of: the argument of a constructor that is the frequency, and durations with their units."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.code import classes, kinds
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.model.location import Location
from haros_ci.rates.sleeps import CHRONO, DURATIONS, RATES
from haros_ci.syntax import Expression

#: Types of numbers with a fraction.
REAL = frozenset(("double", "float"))
#: What durations are cast to without being rounded in a way that matters.
FINE = frozenset(("std::chrono::nanoseconds", "std::chrono::microseconds"))


def duration(call: syntax.Call) -> tuple[float, Expression]:
    """The unit in seconds of the number that a duration is made of, and that number; below zero: it is the duration given; zero: none."""
    name = syntax.name_of(call.callee)
    if len(call.arguments) != 1:
        return 0.0, syntax.Null()
    only, last = call.arguments[0], name.removeprefix('operator""').rpartition("::")[2]
    first = call.templates[0].name if call.templates and isinstance(call.templates[0], syntax.Type) else ""
    if last == "duration" and len(call.templates) == 1 and first in REAL:
        return 1.0, only
    if last == "duration_cast" and first in FINE:
        return -1.0, only
    if name in DURATIONS or name == "rclcpp::Duration::from_seconds":
        return 1.0, only
    is_unit = last in CHRONO and (name.startswith(("std::chrono::", "chrono::", 'operator""')))
    return (CHRONO[last], only) if is_unit else (0.0, only)


def of_period(call: syntax.Call) -> Expression | None:
    """The turns a second of the rate whose ``period()`` a call asks for; None for other calls."""
    callee = call.callee
    if not isinstance(callee, syntax.Member) or callee.name != "period" or not isinstance(callee.object, syntax.Call):
        return None
    made = callee.object
    return made.arguments[0] if syntax.name_of(made.callee) in RATES and made.arguments else None


def frequency(code: Codebase, routine: Routine, place: Location) -> tuple[Routine, Expression] | None:
    """The frequency that the rate made at *place* is given, if it is made in *routine*."""
    body = code.body(routine)
    for call in body.calls:
        if (call.line, call.column) == (place.line, place.column):
            return _of_call(code, routine, call.whole)
    for every in body.variables.values():
        for local in every:
            if (local.line, local.column) == (place.line, place.column) and local.parts:
                return _of_class(code, routine, local.type, local.parts)
    return None


def _of_call(code: Codebase, routine: Routine, call: syntax.Call) -> tuple[Routine, Expression] | None:
    name = kinds.dotted(code, routine, call.callee) if routine.is_python else syntax.name_of(call.callee)
    if not call.arguments or isinstance(call.arguments[0], syntax.Keyword):
        return None
    if name in RATES or (routine.is_python and name.endswith(".create_rate")):
        return routine, call.arguments[0]
    first = call.templates[0] if call.templates else None
    if name.rpartition("::")[2] in ("make_unique", "make_shared") and isinstance(first, syntax.Type):
        return _of_class(code, routine, first, call.arguments)
    return None


def _of_class(
    code: Codebase, routine: Routine, kind: syntax.Type, arguments: tuple[Expression, ...]
) -> tuple[Routine, Expression] | None:
    """The frequency among the *arguments* of a rate's constructor, or of that of a class that is one."""
    scope = routine.method.function.name.rpartition("::")[0]
    name = classes.resolved(code, kind, scope, routine.source).name
    if name in RATES:
        return routine, arguments[0]
    owner = classes.class_named(code, name, routine.source)
    if owner is None or not RATES & {above for _, above in classes.bases(code, owner)}:
        return None
    every = classes.methods(code, owner, name.rpartition("::")[2])
    fitting = [one for one in every if classes.accepts(one.function, arguments)]
    if len(fitting) != 1:
        return None
    for init in fitting[0].function.inits:
        value = init.arguments[0] if init.arguments else None
        if classes.resolved(code, init.type, scope, fitting[0].source).name in RATES or init.name in RATES:
            position = position_of(fitting[0], value.name) if isinstance(value, syntax.Name) else None
            return (routine, arguments[position]) if position is not None else None
    return None


def position_of(where: Routine, name: str) -> int | None:
    """The position of the parameter *name* of a function; None if it has none."""
    found = [number for number, one in enumerate(where.function.parameters) if one.name == name]
    return found[0] if found else None
