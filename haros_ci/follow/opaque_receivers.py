# SPDX-License-Identifier: Apache-2.0
"""Methods of what is not known: by the type that it is declared with, and by names that only one class has."""

from __future__ import annotations

from functools import partial

from haros_ci import syntax
from haros_ci.follow import alternatives, call_arguments, calls, dynamic, handles, methods
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import library
from haros_ci.follow.libraries import objects as library_objects
from haros_ci.follow.ros import api_rows, outside_nodes
from haros_ci.follow.walk import Walk
from haros_ci.index.types import pointee
from haros_ci.model.location import Location
from haros_ci.values.abstract import Cell, Library, Object, Opaque, Value


def method_call(
    walk: Walk,
    frame: Frame,
    receiver: Opaque,
    cell: Cell | None,
    name: str,
    args: tuple[call_arguments.PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
) -> Value:
    """``receiver.name(args)`` where nothing is known of the receiver but perhaps its type."""
    kind = receiver.type or (cell.type if cell is not None else None)
    if kind is not None and kind.name:
        kind = pointee(kind)
        loaded = alternatives.of_base(walk, kind.name) if walk.alternatives else ()
        if loaded:
            item = [partial(calls.method_call, walk, frame, one, None, name, args, targs, location) for one in loaded]
            return walk.either_way(item, "it is called on one of several objects")
        if walk.alternatives and (held := alternatives.element(walk, kind, name)) is not None:
            return Opaque(receiver.reason, receiver.location, held)
        owner_class = walk.class_of(kind.name, frame.source)
        if owner_class is not None:
            summary = library_objects.summary_object(walk, owner_class, kind, receiver)
            if methods.method_of(walk, summary, name, args) is not None:
                dynamic.virtual(walk, owner_class, name, location)
                return calls.method_call(walk, frame, summary, None, name, args, targs, location)
        else:
            stand_in = Object(kind.name, kind.arguments, namespace=receiver if kind.name in api_rows.HANDLES else None)
            for owner in library_objects.owners(walk, stand_in):
                found = api_rows.call(
                    walk, frame, f"{owner}{frame.source.separator}{name}", stand_in, args, targs, location
                )
                if found is not None:
                    return found
            summary = stand_in
        of_node = outside_nodes.of_type(walk, frame, summary, receiver, name, args, targs, location)
        if of_node is not None:
            return of_node
    else:
        handle = handles.node_class(walk, frame, name, args, targs)
        if handle:
            stand_in = Object(handle, namespace=receiver)
            qualified = f"{handle}{frame.source.separator}{name}"
            found = api_rows.call(walk, frame, qualified, stand_in, args, targs, location)
            if found is not None:
                return found
    walk.calls_unknown |= name == "second"  # a function of a map
    return library.unknown_call(walk, frame, name, args, receiver)


def of_member(
    walk: Walk,
    frame: Frame,
    receiver: Value,
    name: str,
    args: tuple[call_arguments.PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
) -> Value | None:
    """A method that only a node has, of a member of an object of a class from outside."""
    if not isinstance(receiver, Library) or not isinstance(receiver.this, Opaque):
        return None
    if not outside_nodes.is_strange(walk, receiver.name):
        return None
    return outside_nodes.of_type(walk, frame, Object("object"), receiver.this, name, args, targs, location)
