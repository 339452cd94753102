# SPDX-License-Identifier: Apache-2.0
"""Macros, properties, arguments and files that a xacro file uses, and that are not there."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project
from haros_ci.api.launch import meant
from haros_ci.api.robots import Description, Fault, descriptions, is_by_itself, lead

#: What whoever includes a file may define.
_FROM_OUTSIDE = ("property", "argument", "macro", "block")


def check(project: Project) -> Iterator[Finding]:
    for description in descriptions(project):
        own = is_by_itself(description)
        faults = [each for each in description.robot.faults if each.certain and is_for_us(each, description, own)]
        for fault in (each for each in faults if not (description.ros == 1 and each.defined_later)):
            said = message(fault, description)
            if said and not any(is_same(fault, each, description) for each in faults[: faults.index(fault)]):
                is_given = fault.kind == "argument" and description.location is not None
                yield Finding(
                    at=description.location if is_given and description.location else fault.location,
                    message=said,
                    about=(description.package or description.robot.path, fault.kind, fault.name),
                    related=((fault.location, f"reads $(arg {fault.name})"),) if is_given else (),
                    flow=() if is_given else flow(fault, description),
                    apart=(fault.kind, fault.name),
                    level=Level.WARNING if fault.kind == "unprefixed" and description.ros == 1 else None,
                )


def is_for_us(fault: Fault, description: Description, own: bool) -> bool:
    """Whether nobody else can mend it: of files that nobody names, what they include may be put beside them later."""
    if fault.kind == "include":
        return description.is_named
    return own or fault.kind not in _FROM_OUTSIDE


def is_same(one: Fault, other: Fault, description: Description) -> bool:
    """Whether both are one defect: a call that does not fit its macro, or a command that gives too few arguments."""
    if one.kind == other.kind == "argument":
        return bool(description.command) or one.name == other.name
    kinds = ("parameter", "extra")
    return one.kind in kinds and other.kind in kinds and (one.location, one.of) == (other.location, other.of)


def flow(fault: Fault, description: Description) -> tuple[tuple[Location, str], ...]:
    way = lead(description, fault.way)
    return (*way, (fault.location, "the argument is read here")) if way else ()


def message(fault: Fault, description: Description) -> str:
    """What xacro does there; "" for what is not for this check."""
    name, hint = fault.name, meant(fault.similar)
    if fault.kind == "property":
        return f"the property {name!r} is not defined here: xacro stops with an error{hint}"
    if fault.kind == "argument":
        if description.command:
            names = [each.name for each in description.robot.faults if each.certain and each.kind == "argument"]
            every = ", ".join(dict.fromkeys(names))
            return f"{description.robot.path} reads the argument{'s' if ',' in every else ''} {every}, not given here and without a default: xacro stops with an error"
        return (
            f"$(arg {name}) is read, but no xacro:arg declares {name!r} before: xacro stops unless the command line "
            "passes it"
        )
    if fault.kind == "macro":
        return f"calls the macro {name!r}, which is not defined here: xacro stops with an error{hint}"
    if fault.kind == "block":
        return f"inserts the block {name!r}, which no caller passes: xacro stops with an error{hint}"
    if fault.kind == "parameter":
        many = "s" if " " in name else ""
        return f"calls the macro {fault.of!r} without its parameter{many} {name}: xacro stops with an error"
    if fault.kind == "extra":
        return f"gives {name!r} to the macro {fault.of!r}, which has no such parameter: xacro stops with an error{hint}"
    if fault.kind == "default":
        return f'the xacro:arg {name!r} has no default: xacro stops with an error; give it default=""'
    if fault.kind == "include":
        return f"includes {name}, but this file does not exist: xacro stops with an error{hint}"
    if fault.kind == "unprefixed":
        since = "since ROS Noetic " if description.ros == 1 else ""
        return (
            f"<{name}> has the name of a macro, but {since}xacro expands <xacro:{name}> only: the element has no "
            f"effect; write <xacro:{name}>"
        )
    return ""


CHECK = Check(
    id="undefined-in-xacro",
    summary="Undefined macro, property, argument or file in xacro.",
    level=Level.ERROR,
    catalogue="X01",
    tags=("robot-description",),
    project=check,
)
