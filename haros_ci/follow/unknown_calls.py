# SPDX-License-Identifier: Apache-2.0
"""What is not known any more after a call that is not followed: what it was given to change, and what it may call."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci.follow import activation, call_arguments, conversions
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import harmless
from haros_ci.follow.walk import Walk
from haros_ci.syntax import Class
from haros_ci.values.abstract import Callable, Cell, Choice, Known, Mapped, Object, Pointer, Sequence, Text, Value
from haros_ci.values.state import joined

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: Structs inside structs, and their members in all, that are forgotten.
DEEP = 4
MEMBERS = 200
#: Methods that a struct may have.
PLAIN = frozenset(("__init__", "__repr__", "__str__", "__eq__", "__ne__", "__hash__", "__lt__"))


def forget_passed(walk: Walk, frame: Frame, name: str, args: tuple[PassedArgument, ...]) -> None:
    """Forget what a function that is not known is given by reference or address.

    Texts, numbers, lists, maps and structs; objects with methods keep what they have, as most are only registered.
    """
    is_python = frame.source.program.language == "python"
    is_harmless = harmless.is_harmless(name, is_python)
    for number, argument in enumerate(args):
        value = argument.value
        if isinstance(value, Pointer):
            if not is_harmless or not isinstance(value.cell.value, (Sequence, Mapped)):
                forget(walk, frame, value.cell, f"{name} may change it")
        elif is_harmless or _is_kept(walk, name, number, len(args)):
            continue
        elif argument.cell is not None and not (is_python and not _is_data(value)):
            forget(walk, frame, argument.cell, f"{name} may change it")
        elif isinstance(value, (Sequence, Mapped, Object)):
            _forget_inside(walk, frame, value, f"{name} may change it", [MEMBERS], DEEP)


def _is_data(value: Value) -> bool:
    """Whether a value of Python is a list or dictionary that is held as data."""
    return isinstance(value, Known) and issubclass(value.kind, (list, dict))


def called(walk: Walk, frame: Frame, name: str, args: tuple[PassedArgument, ...], is_algorithm: bool = False) -> None:
    """Lambdas that are given to a function that is not known may run there, any number of times; so does any function that an algorithm is given."""
    for argument in args:
        function = argument.value
        if not isinstance(function, Callable) or function.function.body is None:
            continue
        if function.frame is None and not is_algorithm:
            continue
        mark = walk.state.mark()
        walk.quiet += 1
        try:
            activation.invoke(walk, frame, function, unknown_arguments(walk, frame, name, function))
        finally:
            walk.quiet -= 1
            writes = walk.state.undo(mark)
        for cell, after in writes.items():
            if joined(cell.value, after) is not cell.value:
                kind = cell.type or (conversions.value_type(after) if not isinstance(after, (tuple, dict)) else None)
                walk.state.forget(
                    cell, walk.opaque(f"a function that is given to {name} may change it", frame, None, kind)
                )


def unknown_arguments(walk: Walk, frame: Frame, name: str, function: Callable) -> tuple[PassedArgument, ...]:
    """What a *function* is called with by one of that *name* which is not known: values of the types of its parameters."""
    return tuple(
        call_arguments.PassedArgument(walk.opaque(f"what {name} gives", frame, None, walk.type_in(p.type, frame)))
        for p in function.function.parameters[len(function.bound) :]
        if p.default is None and not p.name.startswith("*")
    )


def method(
    walk: Walk, frame: Frame, receiver: Value, cell: Cell | None, name: str, args: tuple[PassedArgument, ...]
) -> Value:
    """A method of a text or container of which nothing is known: it may change what it is called on and given."""
    reason = f"{name} may change it"
    if isinstance(receiver, (Sequence, Mapped)):
        walk.state.forget(receiver.content, walk.opaque(reason, frame))
    elif cell is not None and (frame.source.program.language != "python" or _is_data(receiver)):
        forget(walk, frame, cell, reason)
    called(walk, frame, name, args)
    forget_passed(walk, frame, name, args)
    return walk.opaque(f"what {name} returns is not known", frame)


def forget(walk: Walk, frame: Frame, cell: Cell, reason: str) -> None:
    """What *cell* holds is not known any more, unless it is a constant."""
    if cell.type is not None and "c" in cell.type.marks:
        return
    value = cell.value
    if isinstance(value, (Known, Text, Choice)):
        kind = cell.type or conversions.value_type(value)
        walk.state.write(cell, walk.opaque(reason, frame, None, kind))
    elif isinstance(value, (Sequence, Mapped, Object)):
        _forget_inside(walk, frame, value, reason, [MEMBERS], DEEP)


def _forget_inside(
    walk: Walk, frame: Frame, value: Sequence | Mapped | Object, reason: str, left: list[int], depth: int
) -> None:
    """Forget the elements of a container, the members of a struct, what an iterator leads to, a stream's text."""
    left[0] -= 1
    if left[0] < 0 or depth < 0:
        return
    if isinstance(value, (Sequence, Mapped)):
        walk.state.forget(value.content, walk.opaque(reason, frame))
        return
    if value.definition is None:
        for name in ("[text]", "[of]"):
            cell = value.fields.get(name)
            if cell is not None and isinstance(cell.value, (Sequence, Mapped)):
                _forget_inside(walk, frame, cell.value, reason, left, depth - 1)
            elif cell is not None:
                inner = cell.value.cell if isinstance(cell.value, Pointer) else cell
                walk.state.write(inner, walk.opaque(reason, frame, None, inner.type))
        return
    if not is_plain(walk, value):
        return
    for cell in value.fields.values():
        held = cell.value
        if isinstance(held, (Sequence, Mapped, Object)):
            _forget_inside(walk, frame, held, reason, left, depth - 1)
        elif isinstance(held, (Known, Text, Choice)):
            forget(walk, frame, cell, reason)


def is_plain(walk: Walk, value: Object) -> bool:
    """Whether an object's class has no methods but constructors and operators: it is a struct."""
    assert value.definition is not None
    source, definition = value.definition
    key = ("plain", definition.name, source.path)
    found = walk.found.get(key)
    if found is None:
        found = walk.found[key] = not definition.bases and not any(
            function.owner == definition.name and _is_method(function.name, function.kind, definition)
            for function in source.program.functions
        )
    return bool(found)


def _is_method(name: str, kind: str, definition: Class) -> bool:
    last = name.rpartition("::")[2].rpartition(".")[2]
    own = definition.name.rpartition("::")[2].rpartition(".")[2]
    return (
        kind in ("function", "lambda")
        and last not in PLAIN
        and last.lstrip("~") != own
        and not last.startswith("operator")
    )


def _is_kept(walk: Walk, name: str, number: int, count: int) -> bool:
    """Whether every declaration of a function of that name takes its argument by value or as a constant."""
    found = [f for _, f in walk.index.functions.get(name, ()) if len(f.parameters) >= count]
    if not found:
        return False
    marks = [f.parameters[number].type.marks for f in found if f.parameters[number].type.name]
    return len(marks) == len(found) and all("c" in mark or not ("&" in mark or "*" in mark) for mark in marks)
