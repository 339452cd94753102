# SPDX-License-Identifier: Apache-2.0
"""Facts of ROS 2 launch files, recorded while their descriptions are performed."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from haros_ci.launch.facts.conditions import comparisons, is_constant, written
from haros_ci.launch.facts.texts import (
    absolute_paths,
    is_file_name,
    named_files,
    named_packages,
    package_run,
    without_comments,
)
from haros_ci.model.launch_facts import (
    ArgumentDeclaration,
    ArgumentRead,
    CommandUse,
    ConditionUse,
    ConstructUse,
    FileUse,
    LaunchFact,
    NodePattern,
    PackageUse,
    ParameterFileUse,
    PathUse,
    ProgramUse,
    RefusedValue,
)
from haros_ci.model.location import Location
from haros_ci.substitutions.names import Text

if TYPE_CHECKING:
    from haros_ci.launch.ros2.context import Context
    from haros_ci.model.launch import LaunchedNode
    from haros_ci.model.launch_actions import Action, Description, Substitution, Test


def note(context: Context, fact: type[LaunchFact], location: Location, /, **values: Any) -> None:
    """Record a *fact* of this kind as it is here; nothing where the context only asks."""
    if not getattr(context, "is_asking", False):
        context.facts.add(fact(location=location, presence=presence(context), included=context.included, **values))


def presence(context: Context) -> Any:
    return getattr(context, "presence", ())


def named(context: Context, text: Text, location: Location, kind: str, name: str = "") -> None:
    """Files, packages and absolute paths in *text*, the value of *name*; of an include or parameter file *text* is the path."""
    seen(context, text.raw, location, kind, name)


def seen(context: Context, raw: str, location: Location, kind: str, name: str = "") -> None:
    """As ``named``, of plain text."""
    if "/" not in raw and "$(" not in raw and not raw.startswith("~"):
        return
    raw = without_comments(raw)
    for package in named_packages(raw):
        note(context, PackageUse, location, kind="find", package=package, is_here=False)
    for path, is_whole in named_files(raw):
        if is_whole and is_file_name(path):
            note(context, FileUse, location, kind=kind, text=path, name=name)
    for how, path in absolute_paths(raw, kind in ("include", "parameters")):
        note(context, PathUse, location, kind=how, text=path, name=name)


def given(context: Context, name: str, text: Text | None) -> None:
    """A value that a launch configuration is given."""
    if text is not None:
        context.facts.values.setdefault(name, {})[text.raw] = None


def declared(context: Context, action: Action, name: str, default: Text | None) -> None:
    """DeclareLaunchArgument; *default* as performed."""
    phrase = action.get("default")
    choices = tuple(
        dict.fromkeys(
            "".join(part for part in phrase if isinstance(part, str))
            for key, phrase in action.phrases
            if key == "choices"
        )
    )
    if default is not None:
        named(context, default, action.location, "default", name)
    for value in (default, context.scope.configurations.get(name), *(Text(choice) for choice in choices)):
        given(context, name, value)
    if getattr(context, "is_asking", False):
        return
    fact = ArgumentDeclaration(
        location=action.location,
        presence=presence(context),
        included=context.included,
        name=name,
        default=None if phrase is None else written(phrase),
        choices=choices,
        is_top=not context.included,
    )
    context.facts.declare(fact, context.path)


def read(context: Context, part: Substitution) -> None:
    """``$(var name)``: that it is read, or that nothing has set it."""
    phrase = part.arguments[0] if part.arguments else ()
    if len(phrase) != 1 or not isinstance(phrase[0], str):
        return
    name = phrase[0]
    facts = context.facts
    facts.read.add(name)
    if name in context.scope.configurations or len(part.arguments) > 1 or facts.is_open or part.location is None:
        return
    if name not in getattr(context.scope, "unset", ()) and name not in facts.values:
        note(context, ArgumentRead, part.location, name=name)


def tested(context: Context, test: Test, holds: bool | None, place: Location) -> None:
    """A condition of an action."""
    if test.kind == "?":
        return
    note(
        context,
        ConditionUse,
        test.location or place,
        statement="unless" if test.kind == "unless" else "if",
        text=test.text or (written(test.phrases[0]) if test.phrases else ""),
        value=holds,
        is_constant=is_constant(test),
        comparisons=comparisons(test, context.facts.values),
    )


def constructs(context: Context, action: Action) -> None:
    """Spellings that launch has given up."""
    for text, instead in action.deprecated:
        note(context, ConstructUse, action.location, kind="deprecated", text=text, instead=instead)


def started(context: Context, made: LaunchedNode) -> LaunchedNode:
    """A node, container or component; returns it with the parameter files that it is given."""
    place = made.location
    name = None if made.name is None or "?" in made.name else f"{(made.namespace or '').rstrip('/')}/{made.name}"
    program = (made.package, made.type)
    files = tuple(
        replace(parameter_file_use, node=name, program=program) for parameter_file_use in context.facts.taken()
    )
    if "?" not in made.package and made.package:
        kind = "component" if made.kind == "component" else "node"
        note(context, PackageUse, place, kind=kind, package=made.package, is_here=False)
        if made.type and "?" not in made.type and not made.path:
            how = "component" if made.kind == "component" else "executable"
            note(context, ProgramUse, place, kind=how, package=made.package, program=made.type)
    for name, text in (("args", made.arguments), ("ros_args", made.ros_arguments), ("prefix", made.launch_prefix)):
        seen(context, text, place, "value", name)
    for rule in made.parameters:
        for value in rule.value if isinstance(rule.value, list) else (rule.value,):
            if isinstance(value, str):
                seen(context, value, rule.origin or rule.location, "value", rule.name)
    return replace(made, files=files)


def command(context: Context, text: Text, place: Location) -> None:
    """What a command names that is run, or whose output is taken."""
    named(context, text, place, "value", "command")
    note(context, CommandUse, place, text=text.shown)


def program(context: Context, text: Text, place: Location) -> None:
    """The package whose program a command runs, or the name of a program that is searched for."""
    if package := package_run(text.shown):
        note(context, PackageUse, place, kind="command", package=package, is_here=False)


def parameter_file(
    context: Context,
    path: Text,
    location: Location,
    found: str | None,
    patterns: Iterable[NodePattern] | None,
    substitutes: bool = False,
    refused: RefusedValue | None = None,
) -> None:
    """A parameter file that a node is given by the text *path*; *patterns* are its sections, None if it is not read.

    *substitutes* says that launch opens it; *refused* is where the node's process stops that reads it.
    """
    if path.known and not getattr(context, "is_asking", False):
        fact = ParameterFileUse(
            location=location,
            presence=presence(context),
            included=context.included,
            text=path.raw,
            node=None,
            program=("", ""),
            path=found,
            is_read=patterns is not None,
            patterns=tuple(patterns or ()),
            substitutes=substitutes,
            refused=refused,
        )
        context.facts.files.append(fact)


def let(context: Context, action: Action) -> None:
    """SetLaunchConfiguration, once it is done."""
    name = action.get("name") or ()
    if len(name) == 1 and isinstance(name[0], str):
        value = context.scope.configurations.get(name[0])
        given(context, name[0], value)
        if value is not None:
            named(context, value, action.location, "value", name[0])


def foreign(context: Context, description: Description) -> None:
    """Constructs of ROS 1 in a launch file, when it is begun."""
    for location, text, instead in description.foreign:
        note(context, ConstructUse, location, kind="foreign", text=text, instead=instead)
