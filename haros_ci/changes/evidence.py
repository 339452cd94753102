# SPDX-License-Identifier: Apache-2.0
"""Whether the text of a change bears out that an end has come or gone, or one revision is only better understood than the other.

What an analysis can follow depends on much of the code: a line that has become readable lets it see ends that were there all along. An
end that is on one side alone counts if the function that makes it has changed, if a file that says what runs has changed (launch files,
YAML, XML), or if the changed lines of any code name the function or its class.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Container, Iterable, Mapping
from functools import cached_property

from haros_ci.changes.change import ADDED, REMOVED, Difference
from haros_ci.changes.endpoints import WORDS
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.syntax import Program

_WORD = regex(r"[A-Za-z_]\w{2,}")
#: Languages of files that say what runs, and with which names and plug-ins.
SETTINGS = frozenset(("launch", "yaml", "xml"))


#: Where a function begins, its name and its class.
Begin = tuple[int, str, str]


@dataclass(frozen=True)
class RevisionCode:
    """The code of one revision.

    *functions* are all by file, in the order of their lines; *texts* are the files that have changed, *changed* the languages of
    those that may be part of a system.
    """

    functions: Mapping[str, tuple[Begin, ...]] = field(default_factory=dict)
    texts: Mapping[str, str] = field(default_factory=dict)
    changed: frozenset[str] = frozenset()

    def around(self, place: Location) -> Begin | None:
        """The function that *place* is in, as far as lines tell."""
        before = [function for function in self.functions.get(place.path, ()) if function[0] <= (place.line or 0)]
        return before[-1] if before else None

    def text(self, path: str, function: Begin) -> str:
        """The lines of a function in a changed file, without indentation."""
        after = next((line for line, _, _ in self.functions.get(path, ()) if line > function[0]), None)
        lines = self.texts.get(path, "").splitlines()[function[0] - 1 : after - 1 if after is not None else None]
        return "\n".join(line.strip() for line in lines if line.strip())

    def texts_of(self, path: str, name: str) -> set[str]:
        """The texts of the functions called *name* in the changed file *path*."""
        return {self.text(path, function) for function in self.functions.get(path, ()) if function[1] == name}


def functions_of(program: Program) -> tuple[Begin, ...]:
    """Where the functions of a file begin."""
    classes = {re.split(r"::|\.", class_.name)[-1] for class_ in program.classes}
    own = (function for function in program.functions if function.kind not in ("lambda", "module"))
    return tuple(sorted({(function.line, function.name, _class(function.owner, classes)) for function in own}))


def _class(owner: str, classes: Container[str]) -> str:
    """*owner* if it is a class: in C++ a namespace may stand there."""
    last = re.split(r"::|\.", owner)[-1]
    return owner if last in classes or last[:1].isupper() else ""


class TextEvidence:
    """What the change's text says of the differences that are found."""

    def __init__(self, base: RevisionCode, head: RevisionCode, moved: Callable[[str], str]) -> None:
        self._base, self._head = base, head
        self._moved = moved
        self._old = {moved(path): path for path in base.texts}

    def bears_out(self, difference: Difference) -> bool:
        """Whether an end that came or went did so by this change; True for all other differences."""
        is_new = difference.action == ADDED
        place = difference.head if is_new else difference.base
        if difference.action not in (ADDED, REMOVED) or place is None or difference.what not in _ENDS:
            return True
        if (self._base.changed | self._head.changed) & SETTINGS:
            return True
        here, there = (self._head, self._base) if is_new else (self._base, self._head)
        function = here.around(place)
        if function is None:
            return place.path in here.texts
        if self._names(function[1:]):
            return True
        if place.path not in here.texts:  # the file is the same on both sides
            return False
        other = self._old.get(place.path, place.path) if is_new else self._moved(place.path)
        return here.text(place.path, function) not in there.texts_of(other, function[1])

    def _names(self, names: Iterable[str]) -> bool:
        """Whether the changed lines name one of *names*."""
        last = {re.split(r"::|\.", name)[-1] for name in names if name}
        return bool(last & self._words)

    @cached_property
    def _words(self) -> frozenset[str]:
        """The words of the lines that are on one side alone."""
        words: set[str] = set()
        old = {self._moved(path): text for path, text in self._base.texts.items()}
        for path in {*old, *self._head.texts}:
            before, after = (set(map(str.strip, side.get(path, "").splitlines())) for side in (old, self._head.texts))
            for line in before ^ after:
                words.update(_WORD.findall(line))
        return frozenset(words)


_ENDS = frozenset(WORDS.values())
