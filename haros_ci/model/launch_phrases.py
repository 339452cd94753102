# SPDX-License-Identifier: Apache-2.0
"""The substitutions of ROS 2 launch files as text, ``$(var x)``, read into phrases (launch's frontend grammar)."""

from __future__ import annotations

from haros_ci.model.launch_actions import Phrase, Substitution
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex

#: How deep substitutions may be nested.
MAX_DEPTH = 40
MAX_CHARACTERS = 1_000_000

#: The least and greatest number of arguments of each substitution; None is any number.
_ARGUMENTS: dict[str, tuple[int, int | None]] = {
    "var": (1, 2),
    "env": (1, 2),
    "find-pkg-share": (1, 1),
    "find-pkg-prefix": (1, 1),
    "exec-in-pkg": (2, 2),
    "find-exec": (1, 1),
    "eval": (1, 2),
    "command": (1, 2),
    "anon": (1, 1),
    "dirname": (0, 0),
    "filename": (0, 0),
    "file-content": (1, 1),
    "log_dir": (0, 0),
    "launch_log_dir": (0, 0),
    "param": (1, 2),
    "not": (1, 1),
    "and": (2, 2),
    "or": (2, 2),
    "any": (0, None),
    "all": (0, None),
    "equals": (2, 2),
    "not-equals": (2, 2),
    "if": (2, 3),
}
_ALIASES = {name.replace("-", "_"): name for name in _ARGUMENTS if "-" in name}
_WORD = regex(r"[A-Za-z][A-Za-z0-9_-]*")
_ESCAPED = regex(r"\\(.)")


class _MalformedPhrase(Exception):
    """The text is none that launch can read."""


@dataclass(slots=True)
class _PhraseReader:
    text: str
    location: Location | None
    position: int = 0
    depth: int = 0

    def at(self, part: str) -> bool:
        return self.text.startswith(part, self.position)

    def template(self, quote: str) -> Phrase:
        """Text and substitutions up to *quote*, or to the end where there is none."""
        parts: list[str | Substitution] = []
        begin = self.position
        while self.position < len(self.text):
            if self.text[self.position] == "\\" and self.position + 1 < len(self.text):
                self.position += 2
            elif quote and self.at(quote):
                break
            elif self.at("$("):
                self.literal(parts, begin)
                parts.append(self.substitution(quote))
                begin = self.position
            else:
                self.position += 1
        else:
            if quote:
                raise _MalformedPhrase(f"a {quote} is not closed")
        self.literal(parts, begin)
        self.position += len(quote)
        return tuple(parts)

    def literal(self, parts: list[str | Substitution], begin: int) -> None:
        if self.position > begin:
            parts.append(unescaped(self.text[begin : self.position]))

    def substitution(self, quote: str) -> Substitution:
        """``$(name arguments)``; inside quotes the other kind of quote is text."""
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise _MalformedPhrase(f"substitutions are nested deeper than {MAX_DEPTH}")
        start = self.position
        self.position += 2
        match = _WORD.match(self.text, self.position)
        if match is None:
            raise _MalformedPhrase("no name of a substitution stands behind '$('; escape it as '\\$(' if it is text")
        self.position = match.end()
        arguments: list[Phrase] = []
        while True:
            if self.at(")"):
                self.position += 1
                break
            if not self.at(" "):
                raise _MalformedPhrase(f"the substitution '$({match[0]}' is not closed")
            while self.at(" "):
                self.position += 1
            if not self.at(")"):
                arguments.append(self.argument(quote))
        self.depth -= 1
        return self.made(match[0], tuple(arguments), self.text[start : self.position])

    def argument(self, quote: str) -> Phrase:
        if not quote and (self.at("'") or self.at('"')):
            own = self.text[self.position]
            self.position += 1
            return self.template(own)
        parts: list[str | Substitution] = []
        begin = self.position
        while self.position < len(self.text):
            here = self.text[self.position]
            if here == "\\" and self.text[self.position + 1 : self.position + 2] not in ("", " "):
                self.position += 2
            elif self.at("$("):
                self.literal(parts, begin)
                parts.append(self.substitution(quote))
                begin = self.position
            elif here in " )":
                break
            elif here == "(" or here == quote or (not quote and here in "'\""):
                raise _MalformedPhrase(f"a {here} stands in an argument; quote the argument, or write \\{here}")
            else:
                self.position += 1
        self.literal(parts, begin)
        return tuple(parts)

    def made(self, word: str, arguments: tuple[Phrase, ...], written: str) -> Substitution:
        kind = _ALIASES.get(word, word)
        bounds = _ARGUMENTS.get(kind)
        if bounds is None:
            raise _MalformedPhrase(f"launch knows no substitution '$({word})'; correct its name")
        least, most = bounds
        if len(arguments) < least or (most is not None and len(arguments) > most):
            needs = str(least) if least == most else f"{least} to {most}"
            short = written if len(written) < 80 else written[:77] + "..."
            raise _MalformedPhrase(
                f"'{short}' has {len(arguments)} arguments and needs {needs}; quote what holds a space"
            )
        return Substitution(kind, arguments, self.location)


def unescaped(text: str) -> str:
    """*text* with ``\\x`` as ``x``, as names of launch arguments are read."""
    return _ESCAPED.sub(r"\1", text)


def read_phrase(text: str, location: Location | None = None) -> tuple[Phrase, str]:
    """*text* as a phrase, and what is wrong with it, "" if nothing is.

    The grammar is launch's ``frontend/grammar.lark``: substitutions nest, arguments are parted by spaces, an argument
    may stand in quotes, a backslash makes the next character text. What cannot be read is one part of kind ``?``.
    """
    if "$(" not in text and "\\" not in text:
        return ((text,) if text else ()), ""
    try:
        if len(text) > MAX_CHARACTERS:
            raise _MalformedPhrase(f"the text is longer than {MAX_CHARACTERS} characters")
        return _PhraseReader(text, location).template(""), ""
    except _MalformedPhrase as err:
        return (Substitution("?", (), location, str(err)),), str(err)
