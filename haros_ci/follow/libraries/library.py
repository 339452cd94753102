# SPDX-License-Identifier: Apache-2.0
"""What well-known functions and methods of no ROS API do to values: strings, containers, streams, bind, YAML, paths."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import beside, callbacks, handed_out, methods, thrown, unknown_calls
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import applying, containers, given_away, harmless, optionals
from haros_ci.follow.libraries import cpp as library_cpp
from haros_ci.follow.libraries import python as library_python
from haros_ci.follow.ros import ros2_nodes
from haros_ci.follow.walk import Walk
from haros_ci.model.location import Location
from haros_ci.syntax import Type
from haros_ci.values.abstract import NONE, Callable, Cell, Known, Mapped, Object, Opaque, Sequence, Text, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

POINTER_METHODS = frozenset(("reset", "get", "release", "use_count", "unique", "swap"))

#: What a weak pointer has besides.
WEAK = frozenset(("lock", "expired"))


def pointer_methods(kind: Type | None) -> frozenset[str]:
    """The methods of a smart pointer or optional of that type itself."""
    if kind is not None and kind.name.endswith("weak_ptr"):
        return POINTER_METHODS | WEAK
    return POINTER_METHODS | optionals.METHODS if optionals.is_one(kind) else POINTER_METHODS


def pointer_method(
    walk: Walk, frame: Frame, cell: Cell, name: str, args: tuple[PassedArgument, ...], location: Location
) -> Value:
    """A method of a smart pointer itself; its value is the object that it points to."""
    if name in optionals.METHODS:
        return optionals.method(walk, frame, cell, name, args, location)
    if name == "reset":
        walk.state.write(cell, args[0].value if args else NONE)
        return NONE
    if name == "swap":
        other = args[0].cell if args else None
        if other is not None:
            return containers.swap(walk, cell, other)
        walk.state.forget(cell, Opaque("it is swapped with what is not known", None, cell.type))
        return NONE
    if name in ("get", "release", "lock"):
        return cell.value
    if name == "expired":
        return walk.opaque("whether an object is still there", frame, location.line, Type("bool"))
    return Opaque("the state of a smart pointer")


def _pointed_to(walk: Walk, receiver: Object, name: str) -> Value | None:
    """What ``get()`` or ``lock()`` of ``auto`` gives that a smart pointer was made for: the object itself, if it has no such method."""
    if receiver.definition is None and receiver.node is None:
        return None
    return receiver if methods.method_of(walk, receiver, name) is None and name not in receiver.fields else None


def method(
    walk: Walk,
    frame: Frame,
    receiver: Value,
    cell: Cell | None,
    name: str,
    args: tuple[PassedArgument, ...],
    location: Location,
    targs: tuple[syntax.Argument, ...] = (),
) -> Value | None:
    """A modelled method; None if there is no model of it."""
    if frame.source.program.language == "python":
        found = library_python.method(walk, frame, receiver, name, args)
    else:
        found = library_cpp.method(walk, frame, receiver, cell, name, args, location, targs)
        if found is None and name in ("get", "lock") and not args and isinstance(receiver, Object):
            found = _pointed_to(walk, receiver, name)
        if found is None and name in optionals.READERS and isinstance(receiver, (Known, Text)):
            found = optionals.read(walk, frame, receiver, name, args, location)  # texts and numbers have none of them
    if found is not None or not isinstance(receiver, (Known, Text, Sequence, Mapped)) or name in harmless.READERS:
        return found
    if isinstance(receiver, Known) and not issubclass(receiver.kind, (str, list, dict)):
        return None
    return unknown_calls.method(walk, frame, receiver, cell, name, args)


def function(
    walk: Walk,
    frame: Frame,
    name: str,
    args: tuple[PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
) -> Value | None:
    """A modelled function; None if there is no model of it."""
    if frame.source.program.language == "python":
        return library_python.function(walk, frame, name, args)
    if name in handed_out.REFERENCES and args:
        return handed_out.referred(walk, frame, name, args[0])
    return library_cpp.function(walk, frame, name, args, targs, location)


def instance(walk: Walk, frame: Frame, kind: Type, args: tuple[PassedArgument, ...]) -> Value | None:
    """A modelled class's instance; None if there is no model of it."""
    if frame.source.program.language == "python":
        return None
    return library_cpp.instance(walk, frame, kind, args)


def unknown_call(
    walk: Walk, frame: Frame, name: str, args: tuple[PassedArgument, ...], receiver: Opaque | None = None
) -> Value:
    """A call of which nothing is known: what it is given by address or reference is not known afterwards, functions
    that it is given may be called, and so is its result."""
    is_python = frame.source.program.language == "python"
    if walk.trials and not harmless.is_harmless(name, is_python):
        thrown.may_throw(walk)
    is_algorithm = name in applying.ALGORITHMS
    for argument in args:
        if not is_algorithm or not isinstance(argument.value, Callable):
            callbacks.register(walk, argument.value, args)
    beside.note(walk, *(argument.value for argument in args))
    unknown_calls.called(walk, frame, name, args, is_algorithm)
    if is_algorithm:
        applying.applied(walk, frame, name, args)
    held = given_away.among(frame, args)  # before what is given is forgotten
    handed_out.note(walk, frame, name, args)
    unknown_calls.forget_passed(walk, frame, name, args)
    if not harmless.is_harmless(name, is_python):
        ros2_nodes.handed(walk, name, (argument.value for argument in args))
        given_away.taken(walk, frame, name, held)
    elif name.startswith("super()."):  # of a library's class, which leaves alone what it is given, but knows it
        given_away.taken(walk, frame, name, held)
    if isinstance(receiver, Opaque):
        return Opaque(receiver.reason, receiver.location)
    return walk.opaque(f"what {name} returns is not known", frame)
