# SPDX-License-Identifier: Apache-2.0
"""The text of a shell script cut into words and operators; nothing of it is run."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.records import dataclass
from haros_ci.regex import regex

#: Stands for what a template puts in when it is expanded.
HOLE = "\ue001"
#: Characters that are read, and words and operators that they may be.
MAX_SCRIPT, MAX_TOKENS = 1 << 16, 1 << 14
#: How deep quotes and expansions may stand in one another.
MAX_NESTED = 8

_NAME = regex(r"[A-Za-z_]\w*")
_VARIABLE = regex(r"\{([A-Za-z_]\w*)(?:(:?[-=+?])|\})")
_OPERATORS = regex(r"&&|\|\||;;|[;|()\n]|&(?!>)|&?[<>]+&?(?:\d|-)?")


class UnreadableScript(Exception):
    """The text is no script that is understood: an end is missing, it is too long, or has what is not read."""


@dataclass(frozen=True, slots=True)
class ShellVariable:
    """``$name``, or ``${name<operator>other}`` where *operator* is one of ``:-``, ``:=``, ``:+``, ``:?`` with or without the colon."""

    name: str
    operator: str = ""
    other: tuple[Part, ...] = ()


#: A piece of a word: text, a variable, or None for what only a shell can tell (a command's output, arithmetic, a hole).
Part = str | ShellVariable | None


@dataclass(frozen=True, slots=True)
class Word:
    """A word of a command; *is_quoted* if a quote or a backslash stands in it. *start* and *end* are places in the script."""

    parts: tuple[Part, ...]
    is_quoted: bool
    start: int
    end: int

    @property
    def text(self) -> str | None:
        """What it is, where it is plain text."""
        if any(not isinstance(part, str) for part in self.parts):
            return None
        return "".join(part for part in self.parts if isinstance(part, str))


@dataclass(frozen=True, slots=True)
class Operator:
    """What stands between commands: ``;``, a line feed, ``&&``, ``||``, ``|``, ``&``, ``;;``, ``(``, ``)``, or a redirection."""

    text: str
    start: int
    end: int


Token = Word | Operator


def tokens(script: str) -> list[Token]:
    """All words and operators of *script*, a line feed at the end; Unreadable for what is no such thing."""
    if len(script) > MAX_SCRIPT:
        raise UnreadableScript
    found: list[Token] = []
    for token in _scan(script):
        found.append(token)
        if len(found) > MAX_TOKENS:
            raise UnreadableScript
    found.append(Operator("\n", len(script), len(script)))
    return found


def _scan(script: str) -> Iterator[Token]:
    at = 0
    while at < len(script):
        char = script[at]
        if char in " \t\r":
            at += 1
        elif script.startswith("\\\n", at):
            at += 2
        elif char == "#":
            end = script.find("\n", at)
            at = len(script) if end < 0 else end
        elif operator := _OPERATORS.match(script, at):
            text = operator[0]
            if text.startswith(("<<", "&<")):
                raise UnreadableScript  # a text inside the script
            yield Operator(">" if text[0] in "<>" else text, at, operator.end())
            at = operator.end()
        else:
            word, at = _word(script, at)
            yield word


def _word(script: str, start: int) -> tuple[Word, int]:
    parts: list[Part] = []
    at, is_quoted = start, False
    while at < len(script):
        char = script[at]
        if char in " \t\r\n;&|()<>":
            if char == "(" and script[at - 1 : at] in ("=", "?", "*", "+", "@", "!"):
                raise UnreadableScript  # an array, or a pattern
            break
        if char == "'":
            end = script.find("'", at + 1)
            if end < 0:
                raise UnreadableScript
            parts += _with_holes(script[at + 1 : end])
            at, is_quoted = end + 1, True
        elif char == '"':
            inside, at = _until(script, at + 1, '"', 0)
            parts += inside or [""]
            is_quoted = True
        elif char == "\\":
            parts.append(script[at + 1 : at + 2] if script[at + 1 : at + 2] != "\n" else "")
            at, is_quoted = at + 2, True
        elif char in "$`":
            part, at = _expansion(script, at, 0)
            parts.append(part)
        else:
            end = at + 1
            while end < len(script) and script[end] not in " \t\r\n;&|()<>'\"\\$`":
                end += 1
            parts += _with_holes(script[at:end])
            at = end
    return Word(tuple(parts), is_quoted, start, at), at


def _with_holes(text: str) -> list[Part]:
    """*text*, with None for each hole."""
    if HOLE not in text:
        return [text]
    parts: list[Part] = [part for piece in text.split(HOLE) for part in (None, piece)]
    return parts[1:]


def _until(script: str, at: int, end: str, depth: int) -> tuple[list[Part], int]:
    """The parts up to the sign *end*, as between double quotes, and the place after it."""
    if depth > MAX_NESTED:
        raise UnreadableScript
    parts: list[Part] = []
    while at < len(script):
        char = script[at]
        if char == end:
            return parts, at + 1
        if char == "\\" and at + 1 < len(script):
            following = script[at + 1]
            parts.append("" if following == "\n" else following if following in '$`"\\}' else f"\\{following}")
            at += 2
        elif char in "$`":
            part, at = _expansion(script, at, depth + 1)
            parts.append(part)
        elif char == '"' and end == "}":
            inside, at = _until(script, at + 1, '"', depth + 1)
            parts += inside
        else:
            stop = at + 1
            while stop < len(script) and script[stop] not in '\\$`"' and script[stop] != end:
                stop += 1
            parts += _with_holes(script[at:stop])
            at = stop
    raise UnreadableScript


def _expansion(script: str, at: int, depth: int) -> tuple[Part, int]:
    """What ``$…`` or a backquote at *at* is, and the place after it."""
    if script[at] == "`":
        end = script.find("`", at + 1)
        if end < 0:
            raise UnreadableScript
        return None, end + 1
    at += 1
    if script.startswith("(", at):
        return None, _closed(script, at)
    if script.startswith("{", at):
        plain = _VARIABLE.match(script, at)
        if plain is None:
            _, end = _until(script, at + 1, "}", depth + 1)
            return None, end
        if not plain[2]:
            return ShellVariable(plain[1]), plain.end()
        other, end = _until(script, plain.end(), "}", depth + 1)
        return ShellVariable(plain[1], plain[2], tuple(other)), end
    name = _NAME.match(script, at)
    if name is not None:
        return ShellVariable(name[0]), name.end()
    if script[at : at + 1] in tuple("?$!#*@-0123456789"):
        return None, at + 1
    return "$", at


def _closed(script: str, at: int) -> int:
    """The place after the parenthesis that closes the one at *at*."""
    depth = 0
    while at < len(script):
        char = script[at]
        if char in "'\"":
            at = script.find(char, at + 1)
            if at < 0:
                raise UnreadableScript
        elif char == "\\":
            at += 1
        elif char == "(":
            depth += 1
        elif char == ")":
            depth -= 1
            if not depth:
                return at + 1
        at += 1
    raise UnreadableScript
