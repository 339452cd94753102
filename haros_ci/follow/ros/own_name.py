# SPDX-License-Identifier: Apache-2.0
"""The name that a ROS 1 process gives itself (``ros::init``, ``rospy.init_node``): of several calls, which may count."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from haros_ci.graph.names import UNKNOWN, clean, pattern
from haros_ci.model.architecture import Condition
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.values.abstract import Choice, Known, Library, Opaque, Text, Value, join, written

if TYPE_CHECKING:
    from haros_ci.follow.frames import Frame
    from haros_ci.follow.walk import Walk

#: Why a name is not known.
ANONYMOUS = "the node is anonymous: its name ends in a number of its own"
PERHAPS_ANONYMOUS = "whether the node is anonymous is not known"
NOT_SEEN = "no call that names the node is seen"
#: Flags of ros::init (roscpp's init.h, ros::init_options).
_FLAGS, _ANONYMOUS_NAME = "ros::init_options::", 2


@dataclass(frozen=True, slots=True)
class Naming:
    """A call by which the process takes a *name*, under *conditions*; *is_ruled_out* if they do not hold as things are.

    *is_anonymous* is None where that is not known.
    """

    name: Value
    is_anonymous: bool | None
    conditions: frozenset[Condition]
    is_ruled_out: bool


def named(walk: Walk, name: Value, flags: Value | None, frame: Frame) -> bool:
    """The process takes *name*, anonymous by *flags*, in *frame*; whether it is followed under another one."""
    is_ruled_out = bool(walk.ruled_out() or walk.beyond or frame.is_dead)
    is_anonymous = _is_anonymous(flags, frame.source.separator == ".")
    is_first = all(other.is_ruled_out for other in walk.names)
    walk.names.append(Naming(name, is_anonymous, frozenset(walk.conditions), is_ruled_out))
    return is_first and not is_ruled_out and walk.context.renames(name, is_anonymous)


def _is_anonymous(flags: Value | None, is_python: bool) -> bool | None:
    if isinstance(flags, Known) and isinstance(flags.value, (bool, int)):
        return bool(flags.value) if is_python or flags.value is True else bool(flags.value & _ANONYMOUS_NAME)
    if isinstance(flags, Library) and flags.name.startswith(_FLAGS):
        return flags.name == f"{_FLAGS}AnonymousName"
    return None


def counting(namings: Iterable[Naming]) -> tuple[tuple[Value, bool | None], ...]:
    """The names that may be the node's, each with whether it is anonymous.

    The first call that is made counts (roscpp's init.cpp; rospy's client.py raises at a second one): what is called
    where an earlier one has been called does not. Those that are not made as things are count where there are no others.
    """
    found: list[Naming] = []
    every = tuple(namings)
    for naming in [item for item in every if not item.is_ruled_out] or every:
        if not any(earlier.conditions <= naming.conditions for earlier in found):
            found.append(naming)
    return tuple((item.name, item.is_anonymous) for item in found)


@dataclass(frozen=True, slots=True)
class OwnName:
    """The full *name* of a node that names itself, ``?`` for what is not known in it, with why and where.

    *reason* is None where all of it is known but the number in which the name of an anonymous node ends.
    """

    name: str
    reason: str | None = None
    location: Location | None = None


def own_name(names: Sequence[tuple[Value, bool | None]]) -> OwnName:
    """What a process is called that takes one of *names*."""
    if not names:
        return OwnName(f"/{UNKNOWN}", NOT_SEEN)
    value = _whole(*names[0])
    for name, is_anonymous in names[1:]:
        value = join(value, _whole(name, is_anonymous))
    text, reason, location = pattern(value)
    if reason is None or isinstance(value, Text):
        return OwnName(clean(text), None if reason == ANONYMOUS else reason, location)
    return OwnName(f"/{UNKNOWN}", reason, location)


def _whole(name: Value, is_anonymous: bool | None) -> Value:
    """*name* with the number in which it ends, or may end."""
    if is_anonymous is False or isinstance(name, Opaque | Choice):
        return name
    parts = name.parts if isinstance(name, Text) else (written(name.value),) if isinstance(name, Known) else ()
    if is_anonymous is None:
        return Text((*parts, Opaque(PERHAPS_ANONYMOUS)))
    return Text((*parts, "_", Opaque(ANONYMOUS)))
