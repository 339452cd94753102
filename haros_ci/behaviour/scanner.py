# SPDX-License-Identifier: Apache-2.0
"""The characters of an HPL text, taken piece by piece as the parser asks for them.

A word is a keyword only where the grammar has a place for it: ``no`` is a topic after ``causes``, ``to`` a field in a predicate. Words are whole
words (hpl-specs takes ``no`` off ``nodes`` where a pattern may begin). ``#`` begins a comment up to the end of the line, unless
it is the metadata of the next property.
"""

from __future__ import annotations

import re
from bisect import bisect_right

from haros_ci.behaviour.fault import HplFault, short
from haros_ci.behaviour.tree import Place
from haros_ci.regex import regex

#: Longer texts are refused: one property, and a file of them.
LONGEST_PROPERTY = 20_000
LONGEST_FILE = 1_000_000
#: Characters of a number; so it is one that a float can hold, or infinite.
LONGEST_NUMBER = 300

_SPACE = regex(r"[ \t\f\r\n\ufeff]+")
_COMMENT = regex(r"#[^\n]*")
_METADATA = regex(r"#[ \t\f\r\n]*(?:id|title|description)[ \t\f\r\n]*:")
_OTHER_METADATA = regex(
    r'#[ \t]*([A-Za-z_][A-Za-z_0-9-]*)[ \t]*:[ \t]*("(?:[^"\\\n]|\\.)*"|[A-Za-z_]\w*[ \t]*(?=\r?\n|\Z))', re.ASCII
)
_WORD = regex(r"[A-Za-z_][A-Za-z_0-9]*")
_TOPIC = regex(r"[/~]?[a-zA-Z][0-9a-zA-Z_]*(?:/[a-zA-Z][0-9a-zA-Z_]*)*")
_NUMBER = regex(r"(?:[0-9]+\.[0-9]*|\.[0-9]+|[0-9]+)(?:[eE][+-]?[0-9]+)?")
_TEXT = regex(r'"(?:[^"\\\n]|\\[^\n])*"')
_SHOWN = regex(r"[/~@$]?[A-Za-z_0-9][\w/.]*|&&|\|\||==|!=|<=|>=|.", re.ASCII | re.DOTALL)


class Scanner:
    """Where reading has come to in *text*; every method that takes a piece returns None if there is none and stays where it is."""

    def __init__(self, text: str, most: int = LONGEST_PROPERTY) -> None:
        self.text = text
        self.lines = [0]
        if len(text) > most:
            raise HplFault(f"the text has more than {most} characters", Place(1, 1, 0, 0), "take it apart")
        self.lines += [at + 1 for at, sign in enumerate(text) if sign == "\n"]
        self.at = 0
        #: How many brackets are open: metadata is nowhere in them.
        self.inside = 0
        #: Where the last piece ended.
        self.last = 0
        self.skip()

    def place(self, start: int, end: int | None = None) -> Place:
        """The place from the offset *start* to *end*, else to where the last piece ended."""
        row = bisect_right(self.lines, start)
        return Place(row, start - self.lines[row - 1] + 1, start, max(start, self.last if end is None else end))

    def here(self) -> Place:
        """The place of what comes next."""
        return self.place(self.at, self.at + len(self.next_text()))

    def skip(self) -> None:
        """Go to the next piece, over white space and comments."""
        while True:
            space = _SPACE.match(self.text, self.at)
            if space is not None:
                self.at = space.end()
            if not self.text.startswith("#", self.at):
                return
            if not self.inside and (_METADATA.match(self.text, self.at) or _OTHER_METADATA.match(self.text, self.at)):
                return
            comment = _COMMENT.match(self.text, self.at)
            assert comment is not None
            self.at = comment.end()

    @property
    def is_at_end(self) -> bool:
        return self.at >= len(self.text)

    def next_text(self) -> str:
        """What comes next, as a message shows it; "" at the end."""
        match = _SHOWN.match(self.text, self.at)
        return "" if match is None else match.group()

    def sign(self, *signs: str) -> str | None:
        """The first of *signs* that comes next."""
        for sign in signs:
            if self.text.startswith(sign, self.at):
                return self._taken(len(sign))
        return None

    def is_sign(self, sign: str) -> bool:
        return self.text.startswith(sign, self.at)

    def peek(self) -> str:
        """The word that comes next; "" if none does."""
        match = _WORD.match(self.text, self.at)
        return "" if match is None else match.group()

    def keyword(self, *words: str) -> str | None:
        """The word that comes next, if it is one of *words*."""
        word = self.peek()
        return self._taken(len(word)) if word in words else None

    def word(self) -> str | None:
        word = self.peek()
        return self._taken(len(word)) if word else None

    def variable(self) -> str | None:
        """A name after ``@``."""
        match = _WORD.match(self.text, self.at + 1) if self.is_sign("@") else None
        return None if match is None else self._taken(match.end() - self.at)[1:]

    def topic(self) -> str | None:
        return self._matched(_TOPIC)

    def number(self) -> str | None:
        begin, found = self.at, self._matched(_NUMBER)
        if found is not None and len(found) > LONGEST_NUMBER:
            raise HplFault(f"the number has more than {LONGEST_NUMBER} characters", self.place(begin))
        return found

    def quoted(self) -> str | None:
        """A text with its quotes."""
        return self._matched(_TEXT)

    def other_metadata(self) -> tuple[str, str] | None:
        """A line ``# key: value`` with a key that hpl-specs does not know."""
        match = _OTHER_METADATA.match(self.text, self.at)
        if match is None or _METADATA.match(self.text, self.at):
            return None
        self._taken(len(match.group()))
        return match[1], match[2]

    def fault(self, expected: str, help: str = "") -> HplFault:
        """The fault that something else comes next than what was *expected*."""
        found = self.next_text()
        message = (
            f"expected {expected}, found {short(found)!r}" if found else f"expected {expected}, but the text ends here"
        )
        return HplFault(message, self.here(), help)

    def _matched(self, pattern: re.Pattern[str]) -> str | None:
        match = pattern.match(self.text, self.at)
        return None if match is None or not match.group() else self._taken(len(match.group()))

    def _taken(self, length: int) -> str:
        found = self.text[self.at : self.at + length]
        self.at += length
        self.last = self.at
        self.skip()
        return found
