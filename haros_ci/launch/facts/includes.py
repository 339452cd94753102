# SPDX-License-Identifier: Apache-2.0
"""Includes of ROS 2 launch files as facts, and what is known of arguments once all has been performed."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import TYPE_CHECKING

from haros_ci.launch.facts import ros2
from haros_ci.launch.facts.static import Statics
from haros_ci.launch.facts.texts import named_packages
from haros_ci.launch.ros2.places import Places
from haros_ci.model.launch_actions import Description
from haros_ci.model.launch_facts import ArgumentRead, IncludeUse, LaunchFact, PackageUse, PassedArgument
from haros_ci.model.slips import equally_near
from haros_ci.substitutions.names import Text

#: How many names are likened to each other.
MAX_KNOWN = 2_000
MAX_READS = 200

if TYPE_CHECKING:
    from haros_ci.launch.ros2.context import Context
    from haros_ci.model.launch_actions import Action


def statics_of(load: Callable[[str], Description | None], places: Places) -> Statics:
    """What the launch files say by themselves, remembered with *places*."""
    made = places.remembered.get(("statics", ""))
    if not isinstance(made, Statics) or made.load is not load:
        made = places.remembered["statics", ""] = Statics(load, places)
    return made


def named(context: Context, action: Action, file: Text) -> None:
    """The file that an include names; until it has been performed, nobody knows what it sets."""
    ros2.named(context, file, action.location, "include")
    for package in list(named_packages(file.raw))[:1]:
        ros2.note(context, PackageUse, action.location, kind="include", package=package, is_here=False)


def lost(context: Context, action: Action, file: Text, message: str, certain: bool = False) -> None:
    """An include that is not followed, for which *message* says why: it may set anything."""
    context.problem(action.location, message, certain)
    context.facts.is_open = True
    names = (context.text(name) for name, _ in action.arguments)
    passed = tuple(PassedArgument(name.raw, action.location) for name in names if name.known)
    ros2.note(context, IncludeUse, action.location, text=file.shown, passed=passed)


def followed(
    context: Context,
    action: Action,
    statics: Statics,
    file: Text,
    path: str,
    passed: Iterable[Text],
    missing: list[str],
) -> None:
    """An include of the file *path* with the names *passed*; *missing* are arguments that launch asks for in vain."""
    entry = statics.closure(path)
    names = [name for name in passed if name.known]
    ros2.note(
        context,
        IncludeUse,
        action.location,
        text=file.shown,
        path=path,
        passed=tuple(PassedArgument(name.raw, action.location) for name in names),
        declared=tuple(sorted(entry.declared)),
        read=tuple(sorted(entry.read | entry.mentioned)),
        missing=tuple(missing),
        is_whole=entry.is_whole,
    )


def finished(context: Context, statics: Statics) -> tuple[LaunchFact, ...]:
    """All facts in launch order; of arguments it is known by now whether they are used, of reads what may be meant."""
    facts = context.facts
    found: list[LaunchFact] = []
    for declaration, path in facts.declared.values():
        name = declaration.name
        used = True if name in facts.read else statics.is_used(name, path)
        if used is False and declaration.included and facts.is_open:
            used = None
        found.append(replace(declaration, is_used=used))
    known = sorted({declaration.name for declaration, _ in facts.declared.values()} | set(facts.values))[:MAX_KNOWN]
    reads = 0
    for fact in facts.found.values():
        if isinstance(fact, ArgumentRead) and reads < MAX_READS:
            reads += 1
            others = [name for name in known if name != fact.name]
            fact = replace(fact, similar=equally_near(fact.name, others, 0.7))
        found.append(fact)
    return tuple(found)
