# SPDX-License-Identifier: Apache-2.0
"""Values that a node is given from outside, which know whether the program has ever looked at them.

What a program makes under a name, or with a parameter, that it only passes on is the same but for that text whatever the text is. A ``Given``
value has it twice: as it is, and as a *mark* that stands for it in what is made. Whoever reads ``value`` makes the result depend on it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from math import isfinite

from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.values.abstract import Character, Choice, Known, Opaque, Text, Value, concatenate
from haros_ci.values.marks import BEGIN, END, filled, keys
from haros_ci.values.questions import MOST, PLAIN, QUESTIONS, Answer

#: Texts of which the first character and the kind of name say nothing but that they are one, and paths below a package's share directory.
_PLAIN = regex(r"(?:[A-Za-z0-9_]|\$\(find-pkg-share \w{1,100}\)/)[\w ./:+-]{0,200}", re.ASCII)
#: Numbers that every type of C++ holds, characters aside.
_INTEGERS = range(2**31)


@dataclass(slots=True)
class Looks:
    """What a program has looked at: *seen* are the names of what is given that count as they are, *answers* are what it has asked of others."""

    seen: set[str] = field(default_factory=set)
    #: By each answer the names that it is about.
    answers: dict[Answer, tuple[str, ...]] = field(default_factory=dict)


class Given(Known):
    """Data from outside, of the *cells* (names of what is given); reading ``value`` makes these count as they are, ``ask`` the answer alone.

    *mark* is the text with marks for its cells; None if the value is no text. ``kind`` may be read, it is compared in any case.
    """

    __slots__ = ("cells", "held", "looks", "mark")
    cells: tuple[str, ...]
    held: object
    looks: Looks
    mark: str | None

    def __init__(self, held: object, mark: str | None, cells: tuple[str, ...], looks: Looks) -> None:
        for name, value in (("held", held), ("mark", mark), ("cells", cells), ("looks", looks)):
            object.__setattr__(self, name, value)

    @property
    def value(self) -> object:
        self.looks.seen.update(self.cells)
        return self.held

    def __reduce__(self) -> tuple[type[Known], tuple[object]]:
        """Another process gets the data alone."""
        return Known, (self.held,)

    def ask(self, question: str, operand: object = None) -> int:
        answer = QUESTIONS[question](self.held, operand)
        self._answered(question, operand, answer, self.cells)
        return answer

    def _answered(self, question: str, operand: object, answer: int, cells: tuple[str, ...]) -> None:
        looks = self.looks
        if looks.seen.issuperset(cells):
            return
        if (operand is not None and operand.__class__ not in PLAIN) or len(looks.answers) >= MOST:
            looks.seen.update(cells)
            return
        looks.answers[self._answer(question, operand, answer)] = cells

    def _answer(self, question: str, operand: object, answer: int) -> Answer:
        return Answer(self.mark or self.cells[0], self.mark is not None, question, operand, answer)

    @property
    def kind(self) -> type:
        return type(self.held)

    def made(self) -> object:
        """What stands for the value in what is made of it."""
        return self.mark if self.mark is not None else AsGiven(self.cells[0])

    def __eq__(self, other: object) -> bool:
        if self is other:
            return True
        if isinstance(other, Given):
            if self.mark is None or other.mark is None:
                return bool(self.value == other.value)
            same = bool(self.held == other.held)
            if self.mark != other.mark:
                self._answered("==", other.mark, same, (*self.cells, *other.cells))
            return same
        if not isinstance(other, Known) or other.value in (None, ""):
            return False  # there is a value, and a text that is given is not empty
        data = plain(other.value)
        return bool(self.ask("==", data) if data.__class__ in PLAIN else self.value == data)

    def __hash__(self) -> int:
        return hash((self.value,))

    def __repr__(self) -> str:
        return f"Known(value={self.value!r})"

    def joined(self, values: tuple[Value, ...], show: Callable[[Value], str | Opaque] | None) -> Value:
        return _joined(self.looks, values, show)


class GivenText(Text):
    """A text of which some parts are not known, and others given from outside: reading ``parts`` makes the *cells* of these count as they are.

    *mark* is the text with marks for its cells.
    """

    __slots__ = ("cells", "held", "looks", "mark")
    cells: tuple[str, ...]
    held: tuple[str | Opaque, ...]
    looks: Looks
    mark: Text

    def __init__(self, held: tuple[str | Opaque, ...], mark: Text, cells: tuple[str, ...], looks: Looks) -> None:
        for name, value in (("held", held), ("mark", mark), ("cells", cells), ("looks", looks)):
            object.__setattr__(self, name, value)

    @property
    def parts(self) -> tuple[str | Opaque, ...]:
        self.looks.seen.update(self.cells)
        return self.held

    def __reduce__(self) -> tuple[type[Text], tuple[tuple[str | Opaque, ...]]]:
        """Another process gets the parts alone."""
        return Text, (self.held,)

    @property
    def unknown(self) -> Opaque:
        return self.mark.unknown

    def __eq__(self, other: object) -> bool:
        if self is other or (isinstance(other, GivenText) and self.mark == other.mark):
            return True
        return isinstance(other, Text) and self.parts == other.parts

    def __hash__(self) -> int:
        return hash((self.parts,))

    def __repr__(self) -> str:
        return f"Text(parts={self.parts!r})"

    def joined(self, values: tuple[Value, ...], show: Callable[[Value], str | Opaque] | None) -> Value:
        return _joined(self.looks, values, show)


def _joined(looks: Looks, values: tuple[Value, ...], show: Callable[[Value], str | Opaque] | None) -> Value:
    """The text of *values*, of which some are given from outside: it is, too, as far as its parts have marks."""
    parameters = [value for value in values if isinstance(value, (Given, GivenText))]
    for value in parameters:
        if value.mark is None:
            looks.seen.update(value.cells)
    whole = concatenate(tuple(map(_held, values)), show)
    cells = tuple(dict.fromkeys(cell for value in parameters if value.mark is not None for cell in value.cells))
    if not cells:
        return whole
    mark = concatenate(tuple(_held(value) if marked(value) is value else marked(value) for value in values), show)
    if isinstance(whole, Known) and isinstance(mark, Known):
        return Given(whole.value, str(mark.value), cells, looks)
    if isinstance(whole, Text) and isinstance(mark, Text):
        return GivenText(whole.parts, mark, cells, looks)
    looks.seen.update(cells)
    return whole


def _held(value: Value) -> Value:
    """*value* as it is, without looking at what is given of it."""
    if isinstance(value, GivenText):
        return Text(value.held)
    return Known(value.held) if isinstance(value, Given) else value


class Letter(Given):
    """The character at a *place* of a given *text*, as the number that it is."""

    __slots__ = ("place", "text")
    place: int
    text: str

    def __init__(self, whole: Given, place: int) -> None:
        super().__init__(Character(ord(str(whole.held)[place])), None, whole.cells, whole.looks)
        object.__setattr__(self, "place", place)
        object.__setattr__(self, "text", whole.mark)

    __eq__ = Given.__eq__
    __hash__ = Given.__hash__

    def made(self) -> object:
        return self.value

    def _answer(self, question: str, operand: object, answer: int) -> Answer:
        return Answer(self.text, True, question, operand, answer, self.place)


def letter(value: Known, place: int) -> Known:
    """The character at a *place* that a text has."""
    if isinstance(value, Given) and value.mark is not None and str(value.held)[place].isascii():
        return Letter(value, place)
    return Known(value.of(str)[place])


def beginning(value: Known, count: int) -> Known | None:
    """The first *count* characters of a given text where the rest of it is not given, or which are none; None for others."""
    held = value.held if isinstance(value, Given) else None
    if not isinstance(value, Given) or not isinstance(held, str) or value.mark is None or not 0 <= count <= len(held):
        return None
    if count == 0:
        return Known("")
    rest = held[count:]
    if not value.mark.endswith(rest):
        return None
    value.ask("size")
    mark = value.mark.removesuffix(rest)
    return Given(held[:count], mark, value.cells, value.looks) if END in mark else Known(held[:count])


def looked_at(value: Value) -> Value:
    """*value*; of what is given from outside the data or parts, which count as looked at."""
    if isinstance(value, Given):
        return Known(value.value)
    return Text(value.parts) if isinstance(value, GivenText) else value


def plain(data: object) -> object:
    """*data*, a character as its number."""
    return int(data) if isinstance(data, Character) else data


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

    def __init__(self, names: Mapping[str, str] = {}) -> None:
        self.texts = dict(names)
        self.cells = {key: key for key in names}
        self.looks = Looks()
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
        return Given(value.value, mark, (cell,), self.looks)

    def real(self, text: str) -> str:
        """*text* as it is."""
        return filled(text, self.texts) if BEGIN in text else text

    def known(self, text: str) -> Known:
        """*text* as a value of the program."""
        cells = tuple(dict.fromkeys(self.cells[key] for key in keys(text)))
        return Given(self.real(text), text, cells, self.looks) if cells else Known(text)

    def partly(self, text: Text) -> Text:
        """*text*, which is not wholly known, as a value of the program."""
        written = "".join(part for part in text.parts if isinstance(part, str))
        cells = tuple(dict.fromkeys(self.cells[key] for key in keys(written)))
        held = tuple(self.real(part) if isinstance(part, str) else part for part in text.parts)
        return GivenText(held, text, cells, self.looks) if cells else text

    def looked_at(self, text: str) -> str:
        """*text* as it is; what is done depends on it from now on."""
        self.looks.seen.update(self.cells[key] for key in keys(text))
        return self.real(text)

    def answers(self) -> tuple[Answer, ...]:
        """What was asked of that which does not count as it is."""
        return tuple(
            requested for requested, cells in self.looks.answers.items() if not self.looks.seen.issuperset(cells)
        )

    def settled(self, requested: Mapping[str, Value | None]) -> dict[str, Value | Unseen | None]:
        """*requested* as it has to be again: as it is, or only its type; and the names that were looked at."""
        found: dict[str, Value | Unseen | None] = {}
        for name, value in requested.items():
            kind = shape(value) if name in self.held and name not in self.looks.seen else None
            found[name] = value if kind is None else Unseen(kind)
        return found | {
            key: Known(text) for key, text in self.texts.items() if key in self.looks.seen and key[0] != "p"
        }


def marked(value: Value) -> Value:
    """*value* for what is made of it: the text with marks, where it has some."""
    if isinstance(value, GivenText):
        return value.mark
    if isinstance(value, Choice) and any(isinstance(option, GivenText) for option in value.options):
        return Choice(tuple(option.mark if isinstance(option, GivenText) else option for option in value.options))
    return Known(value.mark) if isinstance(value, Given) and value.mark is not None else value
