# SPDX-License-Identifier: Apache-2.0
"""Launch arguments that are read, or needed, but not set."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from haros_ci.api import Check, Finding, Level, Location, System, nearest, regex
from haros_ci.api.launch import ArgumentDeclaration, ArgumentRead, IncludeUse, included_by, meant

#: Arguments that each user has a value of his own for, and launch files that are parts of others.
_OWN = regex(
    r"bag|file|path|dir|log|record|(?:^|_)(?:ip|port|dev|device|serial|host|address|user|url|uri)(?:_|$)", re.IGNORECASE
)
_PARTS = regex(r"(?:^|/)include[sd]?/|\.xml$")
#: So many further places that read a name are shown.
_SHOWN = 10


def check(system: System) -> Iterator[Finding]:
    yield from _missing(system)
    needs = any(fact.is_top and fact.default is None and fact.ros == 2 for fact in system.facts(ArgumentDeclaration))
    places: dict[str, set[str]] = {}
    own: set[tuple[str, str]] = set()
    for fact in system.facts(ArgumentDeclaration):
        places.setdefault(fact.name, set()).add(fact.location.path)
        if f"$(var {fact.name})" in (fact.default or ""):
            own.add((fact.location.path, fact.name))
    reads = system.facts(ArgumentRead)
    given = {read.location.path for read in reads if _OWN.search(read.name)}  # launched with arguments, on purpose
    for read, others in _first(reads):
        # A launch file of ROS 2 that cannot be launched by itself is there to be included, and inherits what is set around it.
        if read.ros == 2 and needs:
            continue
        how = f"$(arg {read.name})" if read.ros == 1 else f"launch configuration {read.name!r}"
        if read.ros == 2 and (read.location.path, read.name) in own:
            is_given = system.whole.is_shown(read.name, read.location.path, read.ros)
            yield _circular(read, others, Level.NOTE if is_given else Level.WARNING)
            continue
        if read.ros == 2 and read.name in places:
            yield _undeclared(read, others, how, read.location.path in places[read.name])
            continue
        # Both launchers set what the command line gives, declared or not; ROS 1 for the launched file alone.
        is_settable = not read.similar and (read.ros == 2 or not read.included)
        unless = f", unless '{read.name}:=…' is given; declare it" if is_settable else ""
        is_given = is_settable and (
            system.whole.is_shown(read.name, read.location.path, read.ros)
            or system.whole.is_of_others(read.location.path)
        )
        yield Finding(
            at=read.location,
            message=f"{how} is read, but never declared or set: launch stops here{unless}{meant(read.similar)}",
            level=Level.NOTE
            if is_given
            else Level.WARNING
            if is_settable and (read.location.path in given or not _stops(read))
            else None,
            about=(read.name,),
            related=tuple((place, "is read here, too") for place in others),
            apart=(read.name,),
            flow=included_by(read),
            presence=read.presence,
        )


def _stops(read: ArgumentRead) -> bool:
    """Whether a launch file of ROS 1 stops for everybody who starts it as it is.

    No file can include it and pass the argument, as roslaunch refuses arguments that the included file does not declare (roslaunch/loader.py,
    post_include_args). One of ROS 2 inherits what the file sets that includes it. A file or an address is often left to the command line on purpose.
    """
    return (
        read.ros == 1
        and not (read.presence or read.is_undecided)
        and not (_OWN.search(read.name) or _PARTS.search(read.location.path))
    )


def _first(reads: Iterable[ArgumentRead]) -> Iterator[tuple[ArgumentRead, tuple[Location, ...]]]:
    """Of the reads of a name in a file the first that needs no other launch arguments, and where the others are.

    One declaration mends all of them.
    """
    groups: dict[tuple[str, str, bool, bool], list[ArgumentRead]] = {}
    for read in reads:
        key = (read.location.path, read.name, bool(read.similar), bool(read.included))
        groups.setdefault(key, []).append(read)
    for group in groups.values():
        first = min(group, key=lambda read: (bool(read.presence), read.location.sort_key))
        others = {read.location for read in group} - {first.location}
        yield first, tuple(sorted(others, key=lambda place: place.sort_key))[:_SHOWN]


def _undeclared(read: ArgumentRead, others: tuple[Location, ...], how: str, is_here: bool) -> Finding:
    """A name that is declared, but not yet: further down in the file, or only in a file that this one includes (launch/actions/declare_launch_argument.py).

    Who starts the latter by hand gives the argument, as launch sets what the command line gives, declared or not.
    """
    if is_here:
        message = f"{how} is read before its declaration: launch stops here; move the declaration up"
    else:
        message = (
            f"{how} is declared only in an included file: launch stops here, unless '{read.name}:=…' is given; "
            "declare it in this file, too"
        )
    return Finding(
        at=read.location,
        message=message,
        about=(read.name,),
        related=tuple((place, "is read here, too") for place in others),
        apart=(read.name,),
        flow=included_by(read),
        presence=read.presence,
        level=None if is_here else Level.NOTE,
    )


def _circular(read: ArgumentRead, others: tuple[Location, ...], level: Level) -> Finding:
    """A name that stands in the default of its own declaration: it has to be given, as one without a default, and `ros2 launch --show-args` does not say so."""
    return Finding(
        at=read.location,
        message=(
            f"launch configuration {read.name!r} stands in the default of its own declaration: launch stops here, "
            f"unless '{read.name}:=…' is given; write another default, or none"
        ),
        about=(read.name,),
        related=tuple((place, "is read here, too") for place in others),
        apart=(read.name,),
        flow=included_by(read),
        presence=read.presence,
        level=level,
    )


def _missing(system: System) -> Iterator[Finding]:
    for use in system.facts(IncludeUse):
        unknown = [
            passed.name for passed in use.passed if use.is_whole and passed.name not in {*use.declared, *use.read}
        ]
        for name in use.missing:
            if any(nearest(other, [name], 0.7) for other in unknown):
                continue  # a slip in its name, of which unused-launch-argument tells
            yield Finding(
                at=use.location,
                message=f"includes {use.path} without the argument {name!r}, which has no default: launch stops here; pass it",
                about=(use.path or "", name),
                apart=(use.path or "", name),
                flow=included_by(use),
                presence=use.presence,
            )


CHECK = Check(
    id="unset-launch-argument",
    summary="Launch argument that is read but not declared or set.",
    level=Level.ERROR,
    catalogue="L07",
    tags=("launch",),
    run=check,
)
