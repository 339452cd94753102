# SPDX-License-Identifier: Apache-2.0
"""Variables whose address a library has (``add("x", &x)``, ``declare("x", std::ref(x))``): it may keep that, and change them at any later time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import expressions, unknown_calls
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import harmless
from haros_ci.follow.walk import Walk
from haros_ci.index.types import pointee
from haros_ci.values.abstract import Cell, Choice, Known, Object, Opaque, Pointer, Sequence, Text, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: What wraps a reference to a variable that may be changed through it.
REFERENCES = frozenset(("std::ref", "boost::ref", "ref"))
#: Functions and classes that keep arguments for a function of the workspace, which does not see whose they are.
PASSING = frozenset(
    "std::thread boost::thread std::jthread std::async std::bind boost::bind bind std::call_once".split()
)
#: Lists in lists that are looked into for addresses, and elements that are looked at.
DEEP, MOST = 3, 300


def wrapped(walk: Walk, expression: syntax.Call) -> syntax.Expression | None:
    """What ``std::ref(x)`` refers to; None for all other calls."""
    callee = expression.callee
    if type(callee) is not syntax.Name or callee.name not in REFERENCES or len(expression.arguments) != 1:
        return None
    return None if callee.name in walk.index.functions else expression.arguments[0]


def referred(walk: Walk, frame: Frame, name: str, argument: PassedArgument) -> Value:
    """``std::ref(x)`` that no call is given, but a variable or a list: who changes *x* through it is not seen."""
    if argument.cell is None:
        return argument.value
    _gone(walk, frame, argument.cell, name)
    return argument.cell.value


def note(walk: Walk, frame: Frame, name: str, args: tuple[PassedArgument, ...], is_kept: bool = True) -> None:
    """The function or class *name* is not known, and may keep the addresses among *args*, if it does not only read what they lead to."""
    if frame.source.separator != "::":
        return
    is_passing = name.removeprefix("::") in PASSING
    is_harmless = not is_passing and harmless.is_harmless(name, False)
    for argument in args:
        if argument.is_wrapped and argument.cell is not None:
            _gone(walk, frame, argument.cell, name)
        elif is_passing or (is_kept and not is_harmless):
            _inside(walk, frame, argument.value, name, [MOST], DEEP)


def stored(walk: Walk, frame: Frame, target: syntax.Member, value: Value) -> None:
    """An address is assigned to a member of an object whose class is not in the workspace (``option.value = &x``)."""
    owner = expressions.evaluate(walk, frame, target.object)
    kind = owner.type if isinstance(owner, Opaque) else None
    is_outside = isinstance(owner, Object) and owner.definition is None
    if isinstance(value, Pointer) and (
        is_outside or (kind is not None and walk.class_of(pointee(kind).name, frame.source) is None)
    ):
        _gone(walk, frame, value.cell, f"what has its address in {target.name}")


def _inside(walk: Walk, frame: Frame, value: Value, name: str, left: list[int], depth: int) -> None:
    """The addresses in lists are given away with them."""
    left[0] -= 1
    if isinstance(value, Pointer):
        _gone(walk, frame, value.cell, name)
    elif isinstance(value, Sequence) and isinstance(value.content.value, tuple) and depth > 0:
        for cell in value.content.value if left[0] > 0 else ():
            _inside(walk, frame, cell.value, name, left, depth - 1)


def _gone(walk: Walk, frame: Frame, cell: Cell, name: str) -> None:
    """What *cell* holds is not known any more, now and whenever something is called back."""
    if cell.type is not None and "c" in cell.type.marks and "*" not in cell.type.marks:
        return
    if not isinstance(cell.value, (Known, Text, Choice)) and not _is_plain(cell):
        return
    unknown_calls.forget(walk, frame, cell, f"{name} may change it")
    if not walk.quiet and cell not in walk.handed and len(walk.handed) < MOST:
        walk.handed[cell] = walk.opaque(f"{name} may change it", frame, None, cell.type)


def _is_plain(cell: Cell) -> bool:
    return isinstance(cell.value, Opaque) and cell.type is not None and "*" not in cell.type.marks


def changed(walk: Walk) -> None:
    """Something is called back: until now libraries may have changed what they know the address of."""
    for cell, unknown in walk.handed.items():
        if isinstance(cell.value, (Known, Text, Choice)):
            walk.state.put(cell, unknown)
