# SPDX-License-Identifier: Apache-2.0
"""Timers and rates: what their period is, as the node's parameters and constants say.

They are kept beside what is made, so that whether a function makes something is the same as without them.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from math import isfinite
from typing import TYPE_CHECKING

from haros_ci.follow.made import MadeEntity
from haros_ci.follow.ros import ros2_nodes
from haros_ci.follow.ros.qos_profiles import UNITS
from haros_ci.model.api import Entry
from haros_ci.model.rates import Pace
from haros_ci.syntax import Type
from haros_ci.values.abstract import Known, Object, Opaque, Pointer, Value, opaque_of
from haros_ci.values.given import Given

if TYPE_CHECKING:
    from haros_ci.follow.ros.selectors import Applied

KINDS = ("rate", "timer")
FREQUENCY = "frequency"
#: Why a period is not known that is no duration.
NO_DURATION = "its period is no duration that is known"
#: Turns a second that are taken for a limit; a timer of less than a nanosecond is none.
LEAST = 1e-9
#: What ``std::chrono::duration<T, ratio>`` counts, by its ratio.
COUNT = "count"
RATIOS = {
    "std::ratio": "seconds",
    "std::milli": "milliseconds",
    "std::micro": "microseconds",
    "std::nano": "nanoseconds",
}
_DURATION = frozenset((*UNITS, FREQUENCY, COUNT))


def emit(applied: Applied, entry: Entry) -> None:
    """Keep a timer or rate with its period: its unit, or ``frequency``, is in ``type``, the number in ``effective``."""
    from haros_ci.follow.ros.selectors import value_of

    walk = applied.walk
    if entry.kind not in KINDS or walk.quiet or walk.is_raised:
        return
    how = next((key for key in (FREQUENCY, "period") if key in entry.values), "period")
    found = value_of(applied, entry.values[how]) if how in entry.values else _duration_among(applied)
    value = found if isinstance(found, (Known, Object, Opaque)) or found is None else opaque_of(found)
    unit, number, why = _measured(applied, value, FREQUENCY if how == FREQUENCY else "seconds")
    node = ros2_nodes.of_value(walk, applied.receiver) if walk.context.process is not None else None
    key = (entry.kind, applied.location, unit, repr(number), node and node.name)
    this = applied.frame.this
    made = MadeEntity(
        kind=entry.kind,
        name="",
        type=unit,
        location=applied.location,
        conditions=walk.around,
        effective=number,
        node=node.whole if node is not None else None,
        dead=walk.ruled_out() + bool(walk.doubts or applied.frame.is_dead or walk.beyond),
        unknowns=(("period", why, applied.location),) if why else (),
    )
    known = walk.paces.get(key)
    if known is not None:
        before, owner = known
        conditions = min(before.conditions, made.conditions, key=len)
        is_repeated = before.is_dynamic or owner is not this
        made = replace(made, conditions=conditions, dead=min(before.dead, made.dead), is_dynamic=is_repeated)
        this = owner
    walk.paces[key] = (made, this)


def _duration_among(applied: Applied) -> Value | None:
    """The one argument that is a duration, of a call whose overloads have it in several places (rclcpp/create_timer.hpp)."""
    every = [argument.value for argument in applied.args]
    found = [value for value in every if isinstance(value, Object) and not _DURATION.isdisjoint(value.fields)]
    return found[0] if len(found) == 1 else None


def _measured(applied: Applied, value: Value | None, unit: str) -> tuple[str, object, str]:
    """The unit and number of a period or frequency; the number is None for a reason."""
    if isinstance(value, Pointer):
        value = value.cell.value
    if isinstance(value, Object):
        if FREQUENCY in value.fields:  # what ``rclcpp::Rate(hertz).period()`` returns
            return _number(value.fields[FREQUENCY].value, FREQUENCY)
        if COUNT in value.fields:
            ratio = _ratio(value)
            return _number(value.fields[COUNT].value, RATIOS[ratio]) if ratio in RATIOS else (unit, None, NO_DURATION)
        parts = [(name, cell.value) for name, cell in value.fields.items() if name in UNITS]
        if len(parts) == 1:
            return _number(parts[0][1], parts[0][0])
        numbers = [_plain(part) for _, part in parts]
        if parts and all(number is not None for number in numbers):
            whole = sum(number * UNITS[name] for (name, _), number in zip(parts, numbers, strict=True) if number)
            return "seconds", round(whole, 9), ""
        return unit, None, NO_DURATION
    if value is None:
        return unit, None, NO_DURATION
    is_chrono = applied.walk.context.process is not None and applied.frame.source.separator == "::"
    if is_chrono and unit != FREQUENCY and isinstance(value, Known):
        return unit, None, NO_DURATION
    return _number(value, unit)


def _ratio(duration: Object) -> str:
    """The name of a duration's ratio, ``std::ratio`` without one; "" where it is one with numbers."""
    if len(duration.arguments) < 2:
        return "std::ratio"
    ratio = duration.arguments[1]
    return ratio.name if isinstance(ratio, Type) and not ratio.arguments and ratio.name != "std::ratio" else ""


def _number(value: Value, unit: str) -> tuple[str, object, str]:
    if isinstance(value, Known) and issubclass(value.kind, (int, float)) and not issubclass(value.kind, bool):
        if isinstance(value, Given):
            return unit, value.made(), ""
        number = value.value
        is_finite = isinstance(number, (int, float)) and isfinite(number)
        return (unit, number, "") if is_finite else (unit, None, "its period is no finite number")
    why = opaque_of(value)
    return unit, None, f"its period is not known: {why.reason}" if why is not None else NO_DURATION


def _plain(value: Value) -> float | None:
    if not isinstance(value, Known) or not issubclass(value.kind, (int, float)) or issubclass(value.kind, bool):
        return None
    number = value.value
    return float(number) if isinstance(number, (int, float)) else None


def paces(made: Iterable[MadeEntity], node: str | None = None) -> tuple[Pace, ...]:
    """The timers and rates among what was *made*, by place: those of a *node* of a ROS 2 process, and of none of its nodes."""
    found = [
        _pace(item)
        for item in made
        if item.kind in KINDS and (node is None or item.node is None or item.node.name == node)
    ]
    return tuple(sorted(found, key=lambda pace: (pace.location.sort_key, pace.kind, pace.period or 0.0, pace.reason)))


def _pace(item: MadeEntity) -> Pace:
    number, period = item.effective, None
    reason = item.unknowns[0][1] if item.unknowns else ""
    if isinstance(number, (int, float)) and not isinstance(number, bool):
        if item.type != FREQUENCY:
            period = float(number) * UNITS[item.type or "seconds"]
        else:
            period = 1.0 / number if abs(number) > LEAST else 0.0
    return Pace(
        kind=item.kind,
        location=item.location,
        period=period,
        reason=reason if period is not None or reason else NO_DURATION,
        is_conditional=bool(item.conditions) or item.dead > 0,
        is_repeated=item.is_dynamic,
    )


def endpoints_only(made: Iterable[MadeEntity]) -> tuple[MadeEntity, ...]:
    """What was *made* but for timers and rates."""
    return tuple(item for item in made if item.kind not in KINDS)
