# SPDX-License-Identifier: Apache-2.0
"""Functions that rewrite a text as a whole: std::replace, std::transform (cppreference), Boost's string algorithms;
and std::find, std::find_if in lists that are known."""

from __future__ import annotations

from collections.abc import Callable as Function_
from functools import partial
from typing import TYPE_CHECKING

from haros_ci.follow import activation, call_arguments
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import arranging, splits
from haros_ci.follow.walk import Walk
from haros_ci.values import iterators
from haros_ci.values.abstract import (
    NONE,
    TEXT_LIMIT,
    Callable,
    Cell,
    Character,
    Choice,
    Known,
    Library,
    Object,
    Opaque,
    Pointer,
    Sequence,
    Text,
    Value,
)

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

BOOST = ("boost::", "boost::algorithm::")
#: Single characters become single characters: what is known of a text stays so, whatever stands beside it.
CASES: dict[str, Function_[[str], str]] = {
    "tolower": lambda text: _ascii(text, str.lower),
    "toupper": lambda text: _ascii(text, str.upper),
}
#: Longer lists are not gone through.
SOUGHT = 64
SPACES = " \t\n\v\f\r"


def rewritten(walk: Walk, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """What the function returns, with its text argument rewritten; None if that is not known."""
    if name in ("std::replace", "std::transform") and len(args) == 4:
        return _ranged(walk, name, args)
    known = splits.called(walk, name, args) or arranging.called(walk, name, args)
    if known is not None:
        return known
    tail = next((name[len(space) :] for space in reversed(BOOST) if name.startswith(space)), "")
    words = [argument.value for argument in args[1:]]
    if not args or not all(isinstance(word, Known) and issubclass(word.kind, str) for word in words):
        return None
    change = _boost(tail.removesuffix("_copy"), [str(word.value) for word in words if isinstance(word, Known)])
    if change is None:
        return None
    after = _changed(args[0].value, change, tail.startswith("to_"))
    if tail.endswith("_copy"):
        return after
    if after is None or args[0].cell is None:
        return None
    walk.state.write(args[0].cell, after)
    return NONE


def found(walk: Walk, frame: Frame, args: tuple[PassedArgument, ...]) -> Value | None:
    """``std::find`` and ``std::find_if`` from a list's ``begin()`` to its ``end()``: a pointer to the element, or the end.

    None if that depends on what is not known.
    """
    start, end = args[0].value, args[1].value if len(args) > 1 else None
    if isinstance(start, Object) and start.name == "[end]":
        return start
    of = start.fields.get("[of]") if isinstance(start, Object) and start.name == "[iterator]" else None
    every = of.value if of is not None else None
    if not isinstance(every, Sequence) or end is not every.end or len(args) != 3:
        return None
    cells = every.content.value
    if not isinstance(cells, tuple) or len(cells) > SOUGHT:
        return None
    for cell in cells[iterators.position(start) or 0 :]:
        fits = _fits(walk, frame, args[2].value, cell)
        if fits is None:
            return None
        if fits:
            return Pointer(cell)
    return every.end


def for_each(walk: Walk, frame: Frame, args: tuple[PassedArgument, ...]) -> Value | None:
    """``std::for_each`` over a list from its ``begin()`` to its ``end()``; None if its elements are not known."""
    start, end = args[0].value, args[1].value
    of = start.fields.get("[of]") if isinstance(start, Object) else None
    every = of.value if of is not None else None
    cells = every.content.value if isinstance(every, Sequence) and end is every.end else None
    if not isinstance(cells, tuple) or len(cells) > SOUGHT or not isinstance(args[2].value, Callable):
        return None
    place = iterators.position(start)
    for cell in cells[place:] if place is not None else ():
        activation.invoke(walk, frame, args[2].value, (call_arguments.PassedArgument(cell.value, cell, cell.type),))
    return args[2].value if place is not None else None


def _fits(walk: Walk, frame: Frame, expected: Value, cell: Cell) -> bool | None:
    """Whether the element in *cell* is the one *expected*, a value or a predicate; None if that is not known."""
    if not isinstance(expected, Callable):
        if isinstance(expected, Known) and isinstance(cell.value, Known):
            return bool(expected.value == cell.value.value)
        return None
    mark = walk.state.mark()
    argument = call_arguments.PassedArgument(cell.value, cell, cell.type)
    verdict = activation.invoke(walk, frame, expected, (argument,))
    changes = walk.state.undo(mark)
    result = isinstance(verdict, Known) and issubclass(verdict.kind, (bool, int)) and not changes
    return bool(verdict.value) if result and isinstance(verdict, Known) else None


def _ranged(walk: Walk, name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """The algorithm on a whole text, from its ``begin()`` to its ``end()``."""
    cells = [_text_of(argument.value) for argument in args[: 2 if name == "std::replace" else 3]]
    if cells[0] is None or any(cell is not cells[0] for cell in cells):
        return None
    change = None
    if name == "std::transform" and isinstance(args[3].value, Library):
        change = CASES.get(args[3].value.name.removeprefix("::").removeprefix("std::"))
    elif name == "std::replace":
        old, new = _character(args[2].value), _character(args[3].value)
        change = partial(_replaced, old, new) if old and new else None
    after = _changed(cells[0].value, change, True) if change is not None else None
    if after is None:
        return None
    walk.state.write(cells[0], after)
    return NONE


def _text_of(value: Value) -> Cell | None:
    """The text that an iterator goes through."""
    of = value.fields.get("[of]") if isinstance(value, Object) and value.name == "[iterator]" else None
    return of.value.cell if of is not None and isinstance(of.value, Pointer) else None


def _character(value: Value) -> str | None:
    if isinstance(value, Known) and issubclass(value.kind, Character):
        return chr(value.of(int))
    return (
        value.of(str) if isinstance(value, Known) and issubclass(value.kind, str) and len(value.of(str)) == 1 else None
    )


def _boost(name: str, words: list[str]) -> Function_[[str], str] | None:
    if not words:
        return {
            "to_lower": CASES["tolower"],
            "to_upper": CASES["toupper"],
            "trim": lambda text: text.strip(SPACES),
            "trim_left": lambda text: text.lstrip(SPACES),
            "trim_right": lambda text: text.rstrip(SPACES),
        }.get(name)
    if len(words) == 1 and words[0] and name == "erase_all":
        return partial(_replaced, words[0], "")
    if len(words) == 2 and words[0] and name == "replace_all":
        return partial(_replaced, words[0], words[1])
    return None


def _replaced(old: str, new: str, text: str) -> str:
    return text.replace(old, new)


def _ascii(text: str, change: Function_[[str], str]) -> str:
    return "".join(change(letter) if letter.isascii() else letter for letter in text)


def _changed(value: Value, change: Function_[[str], str], is_by_letter: bool) -> Value | None:
    if isinstance(value, Known) and issubclass(value.kind, str):
        after = change(value.of(str))
        return Known(after) if len(after) <= TEXT_LIMIT else Opaque("it is a long text")
    if isinstance(value, Text) and is_by_letter:
        return Text(tuple(change(part) if isinstance(part, str) else part for part in value.parts))
    if isinstance(value, Choice):
        options = [_changed(option, change, is_by_letter) for option in value.options]
        known = tuple(dict.fromkeys(option for option in options if option is not None))
        if len(known) < len(set(options)):
            return None
        return known[0] if len(known) == 1 else Choice(known)
    return None
