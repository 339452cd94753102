# SPDX-License-Identifier: Apache-2.0
"""Values that a node is given from outside, which know whether the program has ever looked at them.

What a program makes under a name, or with a parameter, that it only passes on is the same but for that text whatever the text is. A ``Given``
value has it twice: as it is, and as a *mark* that stands for it in what is made. Whoever reads ``value`` makes the result depend on it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from math import isfinite
from typing import Any

from haros_ci.values.abstract import Known, Opaque, Value, concatenate

#: What begins and ends a mark; Unicode has no characters there (U+FDD0, U+FDD1).
BEGIN, END = "\ufdd0", "\ufdd1"
#: What the mark of a parameter begins with.
PARAMETER = f"{BEGIN}p"
#: A mark by its key; that of a namespace (s) has the slash that it begins with, and the next one.
_MARKS = re.compile(f"/?{BEGIN}(s\\d+){END}(/?)|{BEGIN}([np]\\d+){END}")
#: Texts of which the first character and the kind of name say nothing but that they are one.
_PLAIN = re.compile(r"[A-Za-z0-9_][\w ./:+-]{0,200}", re.ASCII)
#: Numbers that every type of C++ holds, characters aside.
_INTEGERS = range(2**31)


class Given(Known):
    """Data from outside, of the *cells* (names of what is given); reading ``value`` adds these to *seen*.

    *mark* is the text with marks for its cells; None if the value is no text. ``kind`` may be read, it is compared in any case.
    """

    __slots__ = ("cells", "held", "mark", "seen")
    cells: tuple[str, ...]
    held: Any
    mark: str | None
    seen: set[str]

    def __init__(self, held: Any, mark: str | None, cells: tuple[str, ...], seen: set[str]) -> None:
        for name, value in (("held", held), ("mark", mark), ("cells", cells), ("seen", seen)):
            object.__setattr__(self, name, value)

    @property
    def value(self) -> Any:
        self.seen.update(self.cells)
        return self.held

    @property
    def kind(self) -> type:
        return type(self.held)

    def __eq__(self, other: object) -> bool:
        if self is other:
            return True
        if isinstance(other, Given) and other.held == self.held and other.mark == self.mark and self.mark is not None:
            return True
        if not isinstance(other, Known) or (other.__class__ is Known and other.value in (None, "")):
            return False  # there is a value, and a text that is given is not empty
        return bool(self.value == other.value)

    def __hash__(self) -> int:
        return hash((self.value,))

    def __repr__(self) -> str:
        return f"Known(value={self.value!r})"

    def joined(self, values: tuple[Value, ...], show: Callable[[Any], str | Opaque] | None) -> Value:
        """The text of *values*, of which some are ``Given``: one itself, if all of it is known."""
        given = [value for value in values if isinstance(value, Given)]
        for value in given:
            if value.mark is None:
                value.seen.update(value.cells)
        whole = concatenate(tuple(Known(v.held) if isinstance(v, Given) else v for v in values), show)
        marked = [value for value in given if value.mark is not None]
        if not marked:
            return whole
        if isinstance(whole, Known):
            mark = concatenate(tuple(Known(v.mark) if isinstance(v, Given) else v for v in map(_plain, values)), show)
            if isinstance(mark, Known):
                cells = tuple(dict.fromkeys(cell for value in marked for cell in value.cells))
                return Given(whole.value, mark.value, cells, self.seen)
        for value in marked:
            value.seen.update(value.cells)
        return whole


def _plain(value: Value) -> Value:
    return Known(value.held) if isinstance(value, Given) and value.mark is None else value


@dataclass(frozen=True, slots=True)
class Unseen:
    """In place of the value of a parameter that a program has never looked at: any of that *shape* will do."""

    shape: str


@dataclass(frozen=True, slots=True)
class AsGiven:
    """In place of a value that is what the parameter of that *key* is given."""

    key: str


def shape(value: Value | None) -> str | None:
    """What may be known of a value without looking at it: its type. None where it is not passed on as it is."""
    if value.__class__ is not Known:
        return None
    data = value.value
    if isinstance(data, str):
        return "str" if _PLAIN.fullmatch(data) else None
    if type(data) is int:
        return "int" if data in _INTEGERS else None
    if type(data) is float:
        return "double" if isfinite(data) else None
    return "bool" if isinstance(data, bool) else None


class Marks:
    """What is given from outside to one program that is followed: texts by the key of their mark.

    *names* are those of nodes and namespaces; parameters come as they are asked for.
    """

    def __init__(self, names: Mapping[str, str] = {}) -> None:  # noqa: B006
        self.texts = dict(names)
        self.cells = {key: key for key in names}
        self.seen: set[str] = set()
        self.held: set[str] = set()

    def given(self, cell: str, key: str, value: Value | None) -> Value | None:
        """The value of a parameter, as the program gets it."""
        if shape(value) is None:
            return value
        assert isinstance(value, Known)
        self.held.add(cell)
        mark = None
        if isinstance(value.value, str):
            mark, self.texts[key], self.cells[key] = f"{BEGIN}{key}{END}", value.value, cell
        return Given(value.value, mark, (cell,), self.seen)

    def real(self, text: str) -> str:
        """*text* as it is."""
        return filled(text, self.texts) if BEGIN in text else text

    def known(self, text: str) -> Known:
        """*text* as a value of the program."""
        cells = tuple(dict.fromkeys(self.cells[key] for key in _keys(text)))
        return Given(self.real(text), text, cells, self.seen) if cells else Known(text)

    def looked_at(self, text: str) -> str:
        """*text* as it is; what is done depends on it from now on."""
        self.seen.update(self.cells[key] for key in _keys(text))
        return self.real(text)

    def settled(self, asked: Mapping[str, Value | None]) -> dict[str, Any]:
        """*asked* as it has to be again: as it is, or only its type; and the names that were looked at."""
        found: dict[str, Any] = {}
        for name, value in asked.items():
            kind = shape(value) if name in self.held and name not in self.seen else None
            found[name] = value if kind is None else Unseen(kind)
        return found | {key: Known(text) for key, text in self.texts.items() if key in self.seen and key[0] != "p"}


def _keys(text: str) -> Iterator[str]:
    return (found[1] or found[3] for found in _MARKS.finditer(text)) if BEGIN in text else iter(())


def filled(text: str, texts: Mapping[str, str]) -> str:
    """*text* with what its marks stand for; a mark that *texts* has not stays."""

    def put(found: re.Match[str]) -> str:
        space, after, other = found.groups()
        known = texts.get(space or other)
        if known is None:
            return found[0]
        return known if known == "/" and after else known + (after or "")

    return _MARKS.sub(put, text)


def marked(value: Value) -> Value:
    """*value* for what is made of it: the text with marks, where it has some."""
    return Known(value.mark) if isinstance(value, Given) and value.mark is not None else value
