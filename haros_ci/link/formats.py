# SPDX-License-Identifier: Apache-2.0
"""Texts as Python makes them: ``%``, ``str.format``, ``os.path.join``."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from haros_ci.link.run import Frame, Run
from haros_ci.link.values import Known, Opaque, Sequence, Text, Value, concatenate, printed

if TYPE_CHECKING:
    from haros_ci.link.call_arguments import Argument


def percent(run: Run, frame: Frame, text: str, right: Value) -> Value:
    """Python's ``%`` with ``%s`` and ``%d`` only."""
    arguments = [right]
    if isinstance(right, Sequence):
        if not isinstance(right.content.value, tuple):
            return run.opaque("it is formatted from a list that is not known", frame)
        arguments = [cell.value for cell in right.content.value]
    pieces = re.split(r"%([sdi%])", text)
    if sum(kind != "%" for kind in pieces[1::2]) != len(arguments) or any("%" in piece for piece in pieces[::2]):
        return run.opaque("its format is not understood", frame)
    values: list[Value] = [Known(pieces[0])]
    rest = iter(arguments)
    for kind, piece in zip(pieces[1::2], pieces[2::2], strict=True):
        values += [Known("%") if kind == "%" else _shown(next(rest), kind), Known(piece)]
    return concatenate(tuple(values), printed)


def _shown(value: Value, kind: str) -> Value:
    if kind == "s" or not isinstance(value, Known):
        return value
    if isinstance(value.value, (int, float)) and abs(value.value) < 2**63:
        return Known(int(value.value))
    return Opaque("it is no number")


def braces(run: Run, frame: Frame, text: str, args: tuple[Argument, ...]) -> Value:
    """``str.format`` with ``{}``, ``{0}`` and ``{name}`` only."""
    positional = [a.value for a in args if not a.keyword]
    named = {a.keyword: a.value for a in args if a.keyword}
    if "*" in named or "**" in named:
        return run.opaque("unpacked arguments", frame)
    parts: list[Value] = []
    end = count = 0
    for found in re.finditer(r"\{(\w*)\}", text):
        parts.append(Known(text[end : found.start()]))
        end = found.end()
        key = found[1]
        if key.isdigit() or not key:
            index = int(key) if key else count
            count += 1
            parts.append(positional[index] if index < len(positional) else run.opaque("an argument is missing", frame))
        else:
            parts.append(named.get(key) or run.opaque("an argument is missing", frame))
    parts.append(Known(text[end:]))
    rest = re.sub(r"\{\w*\}", "", text)
    if "{" in rest or "}" in rest:
        return run.opaque("its format is not understood", frame)
    return concatenate(tuple(parts), printed)


def path(run: Run, frame: Frame, args: tuple[Argument, ...]) -> Value:
    """``os.path.join``: an absolute part begins anew, a slash at the end of a part is not doubled."""
    parts: list[Value] = []
    for argument in args:
        first = argument.value.parts[0] if isinstance(argument.value, Text) else argument.value
        text = first.value if isinstance(first, Known) else first
        if parts and not isinstance(text, str):
            return run.opaque("a part of a path may be absolute", frame)
        if isinstance(text, str) and text.startswith("/"):
            parts = []
        before = parts[-1] if parts else None
        end = before.parts[-1] if isinstance(before, Text) else before.value if isinstance(before, Known) else None
        if parts and not (isinstance(end, str) and (end.endswith("/") or (end == "" and len(parts) == 1))):
            parts.append(Known("/"))
        parts.append(argument.value)
    return concatenate(tuple(parts), printed)
