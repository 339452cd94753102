# SPDX-License-Identifier: Apache-2.0
"""Texts as Python makes them: ``%``, ``str.format``, paths."""

from __future__ import annotations

import posixpath
import re
import string
from dataclasses import replace
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import members
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.model.digits import whole_number
from haros_ci.regex import regex
from haros_ci.values.abstract import (
    NONE,
    Cell,
    Character,
    Known,
    Mapped,
    Object,
    Opaque,
    Sequence,
    Text,
    Value,
    concatenate,
    printed,
)

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

_SPECIFIER = regex(r"%(?:\((\w+)\))?([-#0 +]{0,3}\d{0,2}(?:\.\d{1,2})?)([diouxXeEfFgGcras%])")
_SPECIFICATION = regex(r"(?:.?[<>=^])?[-+ ]?#?0?\d{0,2}(?:\.\d{1,2})?[bdeEfFgGosxX%]?")
_FIELD = regex(r"(\w*)((?:\.\w+|\[\w+\])*)")
_STEP = regex(r"\.\w+|\[\w+\]")
#: What joins paths; a path of pathlib is its text.
JOINING = frozenset(
    (
        "os.path.join",
        "posixpath.join",
        *(f"pathlib.{name}" for name in ("Path", "PurePath", "PosixPath", "PurePosixPath")),
    )
)
#: Functions of paths that compute with texts alone.
PATHS = {
    f"{module}.{function.__name__}": function
    for module in ("os.path", "posixpath")
    for function in (posixpath.basename, posixpath.dirname, posixpath.normpath, posixpath.splitext, posixpath.split)
}


def of_path(name: str, text: str) -> Value:
    """What one of ``PATHS`` gives."""
    made = PATHS[name](text)
    return Sequence(Cell(tuple(Cell(Known(item)) for item in made))) if isinstance(made, tuple) else Known(made)


def percent(walk: Walk, frame: Frame, text: str, right: Value) -> Value:
    """Python's ``%`` with a tuple, a value or a dictionary
    (docs.python.org/3/library/stdtypes.html#printf-style-string-formatting)."""
    pieces = _SPECIFIER.split(text)
    specifiers = list(zip(pieces[1::4], pieces[2::4], pieces[3::4], strict=True))
    if any("%" in piece for piece in pieces[::4]) or any(flags and kind == "%" for _, flags, kind in specifiers):
        return walk.opaque("its format is not understood", frame)
    provided = _format_arguments(right, [name for name, _, kind in specifiers if kind != "%"])
    if provided is None:
        return walk.opaque("it is formatted from what is not known, or does not fit", frame)
    values: list[Value] = [Known(pieces[0])]
    for (_, flags, kind), piece in zip(specifiers, pieces[4::4], strict=True):
        values += [Known("%") if kind == "%" else _shown(provided.pop(0), flags, kind), Known(piece)]
    return concatenate(tuple(values), printed)


#: Functions of C++ that format as ``str.format`` does (fmt.dev/latest/syntax).
FMT = frozenset(("fmt::format", "std::format"))
#: What says in C how long a number is.
_LENGTH = regex(r"(%[-#0 +]{0,3}\d{0,2}(?:\.\d{1,2})?)(?:hh|ll|[hljztL])(?=[diouxXeEfFgG])")


def fmt(walk: Walk, frame: Frame, args: tuple[PassedArgument, ...]) -> Value:
    """``fmt::format``; flags and characters are written as C++ does."""
    form = args[0].value
    if not isinstance(form, Known) or not issubclass(form.kind, str):
        return walk.opaque("its format is not known", frame, None, syntax.Type("std::string"))
    return braces(
        walk, frame, form.of(str), tuple(replace(argument, value=_of_cpp(argument.value)) for argument in args[1:])
    )


def _of_cpp(value: Value) -> Value:
    if isinstance(value, Known) and issubclass(value.kind, (bool, Character)):
        return Known(str(value.value).lower() if value.kind is bool else chr(value.of(int)))
    return value


def printf(walk: Walk, frame: Frame, args: tuple[PassedArgument, ...], is_cut: bool) -> Value:
    """The text that ``sprintf`` writes; *is_cut* is ``snprintf``, of which the first of *args* is the size.

    A size that is not known (``sizeof``) is taken to be enough.
    """
    size = args[0].value.value if is_cut and args and isinstance(args[0].value, Known) else None
    form, *values = [argument.value for argument in args[is_cut:]] or [NONE]
    if not isinstance(form, Known) or not issubclass(form.kind, str):
        return walk.opaque("it is formatted by sprintf", frame, None, syntax.Type("std::string"))
    text = percent(walk, frame, _LENGTH.sub(r"\1", form.of(str)), Sequence(Cell(tuple(map(Cell, values)))))
    if isinstance(text, Known) and type(size) is int:
        return Known(text.of(str)[: max(size - 1, 0)])
    return text


def _format_arguments(right: Value, names: list[str | None]) -> list[Value] | None:
    """What is formatted, one value for each specifier; None if that is not known or they do not fit."""
    if any(names):
        if not all(names) or not isinstance(right, (Mapped, Known)):
            return None
        pairs = right.content.value if isinstance(right, Mapped) else right.value
        if not isinstance(pairs, dict) or not all(name in pairs for name in names):
            return None
        found = [pairs[name] for name in names]
        return [item.value if isinstance(item, Cell) else Known(item) for item in found]
    if isinstance(right, Sequence):
        cells = right.content.value
        return [cell.value for cell in cells] if isinstance(cells, tuple) and len(cells) == len(names) else None
    return [right] if len(names) == 1 else None


def _shown(value: Value, flags: str, kind: str) -> Value:
    if not isinstance(value, Known):
        if kind == "s" and not flags:
            return value
        return Opaque("it is formatted from what is not known")
    data = value.value
    if kind == "s":
        text = printed(value)
        return Known(f"%{flags}s" % text) if isinstance(text, str) else text
    if kind == "d" and not flags and isinstance(data, float) and abs(data) < 2**63:
        return Known(str(int(data)))
    if not isinstance(data, (int, float)) or kind in ("r", "c", "a") or abs(data) >= 2**63:
        return Opaque("it is no number")
    try:
        return Known(f"%{flags}{kind}" % data)
    except (TypeError, ValueError, OverflowError):
        return Opaque("it cannot be formatted so")


def braces(walk: Walk, frame: Frame, text: str, args: tuple[PassedArgument, ...]) -> Value:
    """``str.format``, see docs.python.org/3/library/string.html#format-string-syntax."""
    positional = [a.value for a in args if not a.keyword]
    named = {a.keyword: a.value for a in args if a.keyword}
    if "*" in named or "**" in named:
        return walk.opaque("unpacked arguments", frame)
    try:
        fields = list(string.Formatter().parse(text))
    except ValueError:
        return walk.opaque("its format is not understood", frame)
    keys = [re.match(r"\w*", field or "") for _, field, _, _ in fields if field is not None]
    numbered = {bool(key and key[0]) for key in keys if key is not None and (not key[0] or key[0].isdigit())}
    if len(numbered) > 1:
        return walk.opaque("its format is not understood", frame)
    parts: list[Value] = []
    count = 0
    for before, field, specifier, conversion in fields:
        parts.append(Known(before))
        if field is None:
            continue
        found = _FIELD.fullmatch(field)
        if found is None:
            return walk.opaque("its format is not understood", frame)
        key = found[1]
        value: Value | None = named.get(key)
        if key.isdecimal() or not key:
            index = whole_number(key) if key else count
            count += 1
            value = positional[index] if index is not None and index < len(positional) else None
        for step in _STEP.findall(found[2]):
            value = _step(walk, frame, value, step) if value is not None else None
        if value is None:
            value = walk.opaque("an argument is missing", frame)
        parts.append(_formatted(value, specifier or "", conversion))
    return concatenate(tuple(parts), printed)


def _step(walk: Walk, frame: Frame, value: Value, step: str) -> Value | None:
    """An attribute ``.x`` or an entry ``[k]`` of a value that is formatted."""
    if step.startswith("."):
        if isinstance(value, Object) and value.definition is not None:
            cell = members.member(walk, value, step[1:], frame)
            return cell.value if cell is not None else None
        return None
    index = whole_number(step[1:-1])
    key: str | int = step[1:-1] if index is None else index
    content: object = value.content.value if isinstance(value, (Sequence, Mapped)) else None
    if isinstance(value, Known) and issubclass(value.kind, (list, dict)):
        content = value.value
    if isinstance(content, dict):
        found = content.get(key)
    else:
        found = content[key] if isinstance(content, (tuple, list)) and type(key) is int and key < len(content) else None
    return found.value if isinstance(found, Cell) else Known(found) if found is not None else None


def _formatted(value: Value, specifier: str, conversion: str | None) -> Value:
    if conversion not in (None, "s") and not (isinstance(value, Known) and issubclass(value.kind, int)):
        return Opaque("its representation is not known")
    if not specifier:
        return value
    if not isinstance(value, Known) or not _SPECIFICATION.fullmatch(specifier):
        return Opaque("it is formatted from what is not known")
    data = str(value.value) if conversion else value.value
    if isinstance(data, bool) or not isinstance(data, (int, float, str)):
        return Opaque("it is formatted in a way that is not followed")
    if isinstance(data, (int, float)) and abs(data) >= 2**63:
        return Opaque("it is a long number")
    try:
        return Known(format(data, specifier))
    except (TypeError, ValueError, OverflowError):
        return Opaque("it cannot be formatted so")


def path(walk: Walk, frame: Frame, args: tuple[PassedArgument, ...]) -> Value:
    """``os.path.join``: an absolute part begins anew, a slash at the end of a part is not doubled."""
    parts: list[Value] = []
    for argument in args:
        first = argument.value.parts[0] if isinstance(argument.value, Text) else argument.value
        text = first.value if isinstance(first, Known) else first
        if parts and not isinstance(text, str):
            return walk.opaque("a part of a path may be absolute", frame)
        if isinstance(text, str) and text.startswith("/"):
            parts = []
        before = parts[-1] if parts else None
        end = before.parts[-1] if isinstance(before, Text) else before.value if isinstance(before, Known) else None
        if parts and not (isinstance(end, str) and (end.endswith("/") or (end == "" and len(parts) == 1))):
            parts.append(Known("/"))
        parts.append(argument.value)
    return concatenate(tuple(parts), printed)
