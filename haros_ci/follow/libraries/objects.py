# SPDX-License-Identifier: Apache-2.0
"""Objects of libraries' classes, and objects of which only the class is known."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import call_arguments, callbacks, copies, handed_out, methods, partials
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import library
from haros_ci.follow.ros import api_rows, given_nodes, outside_nodes, ros2_nodes
from haros_ci.follow.walk import Walk
from haros_ci.model.location import Location
from haros_ci.syntax import Class, Type
from haros_ci.syntax.source import Source
from haros_ci.values.abstract import Callable, Object, Opaque, Value


def summary_object(walk: Walk, owner: tuple[Source, Class], kind: Type, receiver: Opaque) -> Object:
    """Some object of a class, of which only the class is known."""
    source, definition = owner
    templates = dict(zip(definition.templates, kind.arguments, strict=False))
    return Object(definition.name, kind.arguments, owner, location=receiver.location, templates=templates)


def owners(walk: Walk, value: Object) -> list[str]:
    """The class names under which rows may know an object's methods: its own, then its libraries' bases."""
    is_template = value.definition is not None and bool(value.definition[1].templates)
    key = (
        "owners",
        value.name,
        id(value.definition[1]) if value.definition is not None else 0,
        walk.context.process is None,
        walk.numbered(value.templates) if is_template and value.templates else 0,
    )
    if key in walk.found:
        known: list[str] = walk.found[key]
        return known
    templates = value.templates if is_template else methods.NOTHING
    found = (
        [value.name] if value.definition is None else list(methods.library_bases(walk, *value.definition, templates))
    )
    for name in found:
        for row in walk.rows.get(name, ()):
            if row.is_class:
                found += [base for base in row.bases if base not in found]
    if value.definition is None or value.definition[0].separator == "::":
        walk.found[key] = found
    return found


def library_object(
    walk: Walk, frame: Frame, kind: Type, args: tuple[call_arguments.PassedArgument, ...], location: Location
) -> Value:
    """An instance of a library's class."""
    modelled = library.instance(walk, frame, kind, args)
    if modelled is not None:
        return modelled
    if not kind.name or "()" in kind.name:
        return args[0].value if args else walk.opaque("it is not known", frame)
    if len(args) == 1 and isinstance(args[0].value, Object) and args[0].value.name == kind.name:
        return copies.copied(walk, args[0].value, kind)
    if len(args) == 1 and isinstance(args[0].value, Callable) and kind.name not in walk.rows:
        return args[0].value  # boost::function and its kin
    this = Object(kind.name, kind.arguments, location=location)
    construct_library(walk, frame, this, kind, args, location)
    _hidden(walk, frame, kind, args, location)
    handed_out.note(walk, frame, kind.name, args, kind.name not in walk.rows)
    outside_nodes.given(walk, frame, kind, this, location)
    if kind.name not in walk.rows:
        ros2_nodes.handed(walk, kind.name, (argument.value for argument in args))
    for argument in args if kind.name not in partials.BEHIND else ():
        callbacks.register(walk, argument.value, args)
    return this


def _hidden(
    walk: Walk, frame: Frame, kind: Type, args: tuple[call_arguments.PassedArgument, ...], location: Location
) -> None:
    """A library's template over a class of the workspace may be, or have, one: it is given the class's node handle."""
    handles = [
        argument for argument in args if isinstance(argument.value, Object) and argument.value.namespace is not None
    ]
    if walk.quiet or not handles or kind.name in walk.rows:
        return
    for inner in kind.arguments:
        owner = walk.class_of(inner.name, frame.source) if type(inner) is syntax.Type else None
        if owner is not None and walk.relevance.named(owner[1].name):
            message = f"{kind.name} is given class {owner[1].name} and a node handle: whether it makes one is not seen"
            walk.gaps.setdefault(message, location)


def construct_library(
    walk: Walk,
    frame: Frame,
    this: Object,
    kind: Type,
    args: tuple[call_arguments.PassedArgument, ...],
    location: Location,
) -> None:
    """What the constructor of a library's class makes, on *this*."""
    if kind.name not in walk.rows:
        given_nodes.to_class(walk, kind.name, args, location)
    api_rows.construct(walk, frame, this, kind, args, location)
