# SPDX-License-Identifier: Apache-2.0
"""QString: texts of Qt, what they are made of, and how they are put together (doc.qt.io/qt-6/qstring.html).

A QString is a text as ``std::string`` is one. A method that is not known here may change it, as everywhere.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci.regex import regex
from haros_ci.values.abstract import FALSE, Cell, Known, Opaque, Text, Value, concatenate

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument
    from haros_ci.follow.walk import Walk

#: What gives the text that it is given; ``tr`` does not, as it translates.
_SAME = frozenset(
    "QString QStringLiteral QLatin1String QString::fromStdString QString::fromUtf8 QString::fromLatin1 "
    "QString::fromLocal8Bit qPrintable qUtf8Printable".split()
)
#: Methods that give the text itself, of a QString or of the bytes that it is made into.
_ITSELF = frozenset("toStdString toUtf8 toLatin1 toLocal8Bit constData".split())
_PLACE = regex(r"%L?([1-9][0-9]?)")


def function(name: str, args: tuple[PassedArgument, ...]) -> Value | None:
    """A text of Qt that a function or constructor makes; None if *name* is none of these."""
    if name in _SAME and len(args) <= 1:
        return args[0].value if args else Known("")
    if name == "QString::number" and len(args) == 1 and not _is_boolean(args[0].value):
        return concatenate((args[0].value,))
    return None


def method(
    walk: Walk, receiver: Known | Text, cell: Cell | None, name: str, args: tuple[PassedArgument, ...]
) -> Value | None:
    """A method that only QString has; None for all others."""
    if name in _ITSELF and not args:
        return receiver
    if name == "isEmpty" and not args:
        if isinstance(receiver, Known):
            return Known(receiver.of(str) == "")
        return FALSE if any(isinstance(part, str) for part in receiver.parts) else None
    if name == "prepend" and len(args) == 1:
        made = concatenate((args[0].value, receiver))
        if cell is not None:
            walk.state.write(cell, made)
        return made
    if name == "arg" and args and (len(args) == 1 or all(map(_is_text, args))):
        made = receiver
        for argument in args:
            made = _filled(made, argument.value)
        return made
    return None


def _filled(text: Value, value: Value) -> Value:
    """*text* with *value* in the places of the lowest number that it has (QString::arg)."""
    parts = text.parts if isinstance(text, Text) else (text.of(str),) if isinstance(text, Known) else ()
    numbers = [int(found[1]) for part in parts if isinstance(part, str) for found in _PLACE.finditer(part)]
    if not numbers or _is_boolean(value):
        return Opaque("what is put into a text has no place in it")
    lowest, made = min(numbers), list[Value]()
    for part in parts:
        if not isinstance(part, str):
            made.append(part)
            continue
        done = 0
        for found in _PLACE.finditer(part):
            if int(found[1]) == lowest:
                made += [Known(part[done : found.start()]), value]
                done = found.end()
        made.append(Known(part[done:]))
    return concatenate(tuple(made))


def _is_text(argument: PassedArgument) -> bool:
    value = argument.value
    return isinstance(value, Text) or (isinstance(value, Known) and issubclass(value.kind, str))


def _is_boolean(value: Value) -> bool:
    """A boolean is a number to Qt; it is not written as one here."""
    return isinstance(value, Known) and value.kind is bool
