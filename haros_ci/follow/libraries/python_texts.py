# SPDX-License-Identifier: Apache-2.0
"""The methods of Python's texts that only compute, and what is left of its built-in functions on plain data."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import TEXT_LIMIT, Cell, Known, Opaque, Sequence, Value, data_of

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: Methods of texts that give a text, a number, a flag or texts.
METHODS = frozenset(
    "strip lstrip rstrip lower upper replace split startswith endswith title capitalize rsplit swapcase casefold zfill "
    "center ljust rjust count find rfind index rindex isdigit isalpha isalnum isspace isupper islower isidentifier "
    "partition rpartition splitlines removeprefix removesuffix expandtabs __contains__".split()
)
#: Functions of plain data, by what they may be given.
NUMBERS: dict[str, Callable[..., object]] = {"abs": abs, "max": max, "min": min, "sum": sum, "ord": ord, "chr": chr}
FLAGS: dict[str, Callable[..., object]] = {"any": any, "all": all}


def method(walk: Walk, frame: Frame, text: str, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """What ``text.name(*args)`` gives (docs.python.org/3/library/stdtypes.html#string-methods); None if not known."""
    if name not in METHODS or any(argument.keyword for argument in args):
        return None
    provided: list[object] = []
    for argument in args:
        known, data = data_of(argument.value)
        if not known or not isinstance(data, (str, int, list, type(None))) or _is_large(data):
            return None
        provided.append(tuple(data) if isinstance(data, list) else data)
    longest = max((len(item) for item in provided if isinstance(item, str)), default=0)
    if name == "replace" and longest * (len(text) + 1) > 100 * TEXT_LIMIT:
        return walk.opaque("it is a long text", frame)
    try:
        made = getattr(text, name)(*provided)
    except (TypeError, ValueError, AttributeError, OverflowError):
        return walk.opaque(f"{name} fails with what it is given", frame)
    if isinstance(made, tuple):
        return Sequence(Cell(tuple(Cell(Known(item)) for item in made)))
    return walk.opaque("it is a long text", frame) if isinstance(made, str) and len(made) > TEXT_LIMIT else Known(made)


def _is_large(data: object) -> bool:
    return isinstance(data, int) and abs(data) > TEXT_LIMIT


def computed(walk: Walk, frame: Frame, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """What a built-in function of plain data gives; None if it is no such function, or its arguments are not known."""
    if name not in NUMBERS and name not in FLAGS and name != "repr":
        return None
    provided = [data_of(argument.value) for argument in args]
    if not provided or not all(known for known, _ in provided) or any(argument.keyword for argument in args):
        return None
    data = [item for _, item in provided]
    try:
        if name == "chr":
            return Known(NUMBERS[name](data[0])) if len(data) == 1 else None
        if name == "repr":  # of texts, numbers with digits after the point and all else Python 2 and 3 differ
            return Known(repr(data[0])) if len(data) == 1 and isinstance(data[0], (bool, int)) else None
        if name in FLAGS and not (len(data) == 1 and isinstance(data[0], list)):
            return None
        made = {**NUMBERS, **FLAGS}[name](*data)
    except (TypeError, ValueError, OverflowError, ArithmeticError):
        return Opaque(f"{name} fails with what it is given")
    return Known(made) if isinstance(made, (bool, int, float, str)) else None
