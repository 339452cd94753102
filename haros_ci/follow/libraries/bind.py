# SPDX-License-Identifier: Apache-2.0
"""``std::bind`` and ``boost::bind``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci.follow import handed_out, overriding
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import Callable, Library, Object, Pointer, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument


def bind(walk: Walk, frame: Frame, name: str, args: tuple[PassedArgument, ...]) -> Value:
    """``bind(&C::m, this, _1, x)``: what is bound keeps its place, placeholders are open."""
    handed_out.note(walk, frame, name, args)
    function = bound(args)
    return overriding.final(walk, function) if isinstance(function, Callable) else function


def bound(args: tuple[PassedArgument, ...]) -> Value:
    """A function with the arguments behind it."""
    function = args[0].value
    if isinstance(function, Pointer):
        function = function.cell.value
    if not isinstance(function, Callable):
        return function
    rest = list(args[1:])
    this = function.this
    if function.function.owner and rest and function.frame is None:
        first = rest[0].value.cell.value if isinstance(rest[0].value, Pointer) else rest[0].value
        if isinstance(first, Object):
            this = first
            rest = rest[1:]
        elif len(rest) > len(function.function.parameters):
            rest = rest[1:]
    held: list[Value | None] = [None if _is_placeholder(item.value) else item.value for item in rest]
    while held and held[-1] is None:
        held.pop()
    templates = this.templates if this is not None else function.templates
    return Callable(function.source, function.function, this, tuple(held), function.frame, templates)


def _is_placeholder(value: Value) -> bool:
    return isinstance(value, Library) and value.name.rpartition("::")[2].lstrip("_").isdigit()
