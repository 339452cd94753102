# SPDX-License-Identifier: Apache-2.0
"""Flags of gflags on the command line (gflags.github.io/gflags/#commandline): ``--name=value``, ``-name value``, ``--noname``."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci.follow import conversions, lookup
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import numbers
from haros_ci.follow.walk import Walk
from haros_ci.values.abstract import FALSE, TRUE, Cell, Known, Pointer, Sequence, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

PARSING = frozenset(
    f"{space}::{name}"
    for space in ("google", "gflags")
    for name in ("ParseCommandLineFlags", "ParseCommandLineNonHelpFlags")
)
PREFIX = "FLAGS_"
#: A flag that reads others from a file.
FILE = "flagfile"
WHY = "the command line is not known"


def parsed(walk: Walk, frame: Frame, args: tuple[PassedArgument, ...]) -> Value:
    """Set the flags that the command line names; all of them are not known where it is not."""
    cells = {name.rpartition("::")[2]: name for name in walk.index.variables if PREFIX in name}
    words = _words(args[1].value) if len(args) > 1 else None
    if words is None or any(not isinstance(word, Known) or str(word.value).startswith("-") for word in words):
        _left(walk, frame, args)
    for name, value in _settings(walk, frame, words, cells):
        if name in cells:
            _set(walk, frame, cells[name], value)
    return walk.opaque("how many words of the command line are no flags", frame)


def _settings(
    walk: Walk, frame: Frame, words: list[Value] | None, cells: dict[str, str]
) -> list[tuple[str, Value | None]]:
    """The variables among *cells* that are set, with their values, None for one that is not known."""
    if words is None:
        return [(name, None) for name in cells]
    given = list(_given(words, {name: _kind(walk, frame, cells[name]) for name in cells}))
    if any(name == f"{PREFIX}{FILE}" for name, _ in given):
        return [(name, None) for name in cells]
    if not words:  # who starts it by hand gives what is empty
        given += [(name, None) for name in cells if _is_empty(walk, frame, cells[name])]
    return given


def _set(walk: Walk, frame: Frame, name: str, value: Value | None) -> None:
    """Give the variable *name* what a word says; None: it is not known."""
    cell = lookup.named_cell(walk, frame, name)
    if cell is None:
        return
    is_text = cell.type is not None and cell.type.name == "std::string"
    read = value if value is None or is_text or value in (TRUE, FALSE) else numbers.of_text(value)
    unknown = walk.opaque(WHY, frame, None, cell.type)
    walk.state.write(cell, unknown if read is None else conversions.converted(read, cell.type))


def _left(walk: Walk, frame: Frame, args: tuple[PassedArgument, ...]) -> None:
    """What is left in ``argc`` and ``argv`` where flags may have been taken away."""
    for argument in args[:2]:
        cell = argument.value.cell if isinstance(argument.value, Pointer) else argument.cell
        unknown = walk.opaque("which words are no flags", frame)
        if cell is not None and isinstance(cell.value, Sequence):
            walk.state.write(cell.value.content, unknown)
        elif cell is not None:
            walk.state.write(cell, unknown)


def _is_empty(walk: Walk, frame: Frame, name: str) -> bool:
    cell = lookup.named_cell(walk, frame, name)
    return cell is not None and cell.value == Known("")


def _kind(walk: Walk, frame: Frame, name: str) -> str:
    cell = lookup.named_cell(walk, frame, name)
    return cell.type.name if cell is not None and cell.type is not None else ""


def _words(value: Value) -> list[Value] | None:
    """The words of ``&argv`` behind the program's name; None if they are not known."""
    if isinstance(value, Pointer):
        value = value.cell.value
    cells = value.content.value if isinstance(value, Sequence) else None
    return [cell.value for cell in cells[1:] if isinstance(cell, Cell)] if isinstance(cells, tuple) else None


def _given(words: list[Value], kinds: dict[str, str]) -> Iterator[tuple[str, Value | None]]:
    """The variables of flags that *words* set, with their values, None for one that is not known."""
    rest = list(words)
    while rest:
        word = rest.pop(0)
        text = word.value if isinstance(word, Known) else None
        if not isinstance(text, str):
            yield from ((name, None) for name in kinds)  # it may be any
            continue
        if text == "--":
            return
        if not text.startswith("-") or text.strip("-") == "":
            continue
        found = _flag(text, rest, kinds)
        if found is not None:
            yield found


def _flag(text: str, rest: list[Value], kinds: dict[str, str]) -> tuple[str, Value | None] | None:
    """What one word sets, perhaps with the first of the *rest*; None for a flag that is not there."""
    name, sign, value = text.lstrip("-").partition("=")
    full = PREFIX + name.replace("-", "_")
    is_bool = kinds.get(full) == "bool"
    if sign:
        return full, Known(value.lower() in ("1", "t", "true", "y", "yes")) if is_bool else Known(value)
    if is_bool:
        return full, TRUE
    if name.startswith("no") and kinds.get(PREFIX + name[2:]) == "bool":
        return PREFIX + name[2:], FALSE
    if full not in kinds or not rest:
        return None
    following = rest.pop(0)
    return full, following if isinstance(following, Known) else None
