# SPDX-License-Identifier: Apache-2.0
"""What well-known functions and methods of no ROS API do to values: strings, containers, streams, bind, YAML, paths."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from haros_ci.link import callbacks, conversions, library_cpp, library_python
from haros_ci.link.run import Frame, Run
from haros_ci.link.values import NONE, Cell, Known, Object, Opaque, Pointer, Sequence, Value
from haros_ci.model.location import Location
from haros_ci.model.program import Type

if TYPE_CHECKING:
    from haros_ci.link.call_arguments import Argument

POINTER_METHODS = frozenset(("reset", "get", "release", "use_count", "unique", "swap"))
#: Functions that leave their arguments alone, by the beginning of their name.
HARMLESS = (
    "ROS_",
    "NODELET_",
    "std::",
    "ros::",
    "printf",
    "fprintf",
    "assert",
    "boost::",
    "rospy.",
    "print",
    "tf",
    "YAML::",
)


def pointer_method(run: Run, cell: Cell, name: str, args: tuple[Argument, ...]) -> Value:
    """A method of a smart pointer itself; its value is the object that it points to."""
    if name == "reset":
        run.state.write(cell, args[0].value if args else NONE)
        return NONE
    if name in ("get", "release"):
        return cell.value
    return Opaque("the state of a smart pointer")


def method(
    run: Run,
    frame: Frame,
    receiver: Value,
    cell: Cell | None,
    name: str,
    args: tuple[Argument, ...],
    location: Location,
) -> Value | None:
    """A modelled method; None if there is no model of it."""
    if frame.source.program.language == "python":
        return library_python.method(run, frame, receiver, name, args)
    return library_cpp.method(run, frame, receiver, cell, name, args)


def function(
    run: Run, frame: Frame, name: str, args: tuple[Argument, ...], targs: Any, location: Location
) -> Value | None:
    """A modelled function; None if there is no model of it."""
    if frame.source.program.language == "python":
        return library_python.function(run, frame, name, args)
    return library_cpp.function(run, frame, name, args, targs, location)


def instance(run: Run, frame: Frame, kind: Type, args: tuple[Argument, ...]) -> Value | None:
    """A modelled class's instance; None if there is no model of it."""
    if frame.source.program.language == "python":
        return None
    return library_cpp.instance(run, frame, kind, args)


def unknown_call(
    run: Run, frame: Frame, name: str, args: tuple[Argument, ...], receiver: Opaque | None = None
) -> Value:
    """A call of which nothing is known: what it is given by address or reference is not known afterwards, functions
    that it is given may be called, and so is its result."""

    harmless = name.startswith(HARMLESS) or name.isupper()
    for argument in args:
        callbacks.register(run, argument.value, args)
        if harmless:
            continue
        if isinstance(argument.value, Pointer):
            target: Cell | None = argument.value.cell
        elif argument.cell is not None and frame.source.program.language != "python":
            target = argument.cell
        else:
            target = None
        if target is not None and isinstance(target.value, (Known, Sequence)) and not _is_constant(target):
            if isinstance(target.value, Sequence):
                run.state.write(target.value.content, run.opaque(f"the list is given to {name}", frame))
                continue
            kind = target.type or conversions.value_type(target.value)
            run.state.write(target, run.opaque(f"{name} may change it", frame, None, kind))
    if isinstance(receiver, Opaque):
        return Opaque(receiver.reason, receiver.location)
    return run.opaque(f"what {name} returns is not known", frame)


def _is_constant(cell: Cell) -> bool:
    return cell.type is not None and "c" in cell.type[2]


def instance_of(name: str, **fields: Value) -> Object:
    """An object of a modelled class."""
    return Object(name, fields={key: Cell(value) for key, value in fields.items()})
