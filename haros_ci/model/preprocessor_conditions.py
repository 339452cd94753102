# SPDX-License-Identifier: Apache-2.0
"""Whether the condition of an ``#if`` holds, by what is known of macros ([cpp.cond]); read, never evaluated as code."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from haros_ci.regex import regex

#: What macros stand for: a text, None where they are defined as something that is not known.
Macros = Mapping[str, str | None]
#: Longer conditions, more words, parentheses and macros inside each other, and larger numbers are not understood.
LONGEST, WORDS, DEEPEST, LARGEST = 1000, 200, 20, 2**63
#: What macros may be looked up in one condition.
_EXPANSIONS = 100

_TOKEN = regex(r"\s*(?:(\d[\w']*|\.\d\w*)|([A-Za-z_]\w*)|(&&|\|\||[=!<>]=|<<|>>|[-+*/%!<>()~&|^?:,]))")
_NUMBER = regex(r"(?:0[xX]([0-9a-fA-F']{1,20})|0[bB]([01']{1,64})|(0[0-7']{0,30})|([1-9][0-9']{0,20}))[uUlLzZ]{0,3}")

_BINARY: Mapping[str, tuple[int, Callable[[int, int], int]]] = {
    "|": (3, lambda a, b: a | b),
    "^": (4, lambda a, b: a ^ b),
    "&": (5, lambda a, b: a & b),
    "==": (6, lambda a, b: int(a == b)),
    "!=": (6, lambda a, b: int(a != b)),
    "<": (7, lambda a, b: int(a < b)),
    ">": (7, lambda a, b: int(a > b)),
    "<=": (7, lambda a, b: int(a <= b)),
    ">=": (7, lambda a, b: int(a >= b)),
    "+": (9, lambda a, b: a + b),
    "-": (9, lambda a, b: a - b),
    "*": (10, lambda a, b: a * b),
}
_LEVELS = {"||": 1, "&&": 2, **{symbol: level for symbol, (level, _) in _BINARY.items()}}
#: Where ``?`` may come: such a condition is not understood.
_LOOSEST = 0


class _Malformed(Exception):
    """It is no condition of the kinds that are read."""


def holds(text: str, macros: Macros, undefined: frozenset[str] | set[str]) -> bool | None:
    """Whether the condition *text* holds where *macros* are defined and *undefined* are not; None where that is not known.

    A macro that is in neither may be defined. A text that is no condition is not known.
    """
    try:
        value = _Reader(macros, undefined, [_EXPANSIONS], 0).whole(text)
    except _Malformed:
        return None
    return None if value is None else bool(value)


def is_defined(name: str, macros: Macros, undefined: frozenset[str] | set[str]) -> bool | None:
    """Whether a macro is defined; None where that is not known."""
    return True if name in macros else False if name in undefined else None


class _Reader:
    """Recursive descent over the words of a condition; a value that is not known is None."""

    def __init__(self, macros: Macros, undefined: frozenset[str] | set[str], left: list[int], depth: int) -> None:
        self.macros = macros
        self.undefined = undefined
        self.left = left
        self.depth = depth
        self.words: list[str] = []
        self.at = 0

    def whole(self, text: str) -> int | None:
        """The value of all of *text*."""
        self.words = _words(text)
        value = self.binary(_LOOSEST)
        if self.at != len(self.words):
            raise _Malformed
        return value

    def ahead(self) -> str:
        return self.words[self.at] if self.at < len(self.words) else ""

    def binary(self, level: int) -> int | None:
        value = self.unary()
        while _LEVELS.get(symbol := self.ahead(), 0) > level:
            self.at += 1
            right = self.binary(_LEVELS[symbol])
            value = _combined(symbol, value, right)
        return value

    def unary(self) -> int | None:
        word = self.ahead()
        self.at += 1
        if word in ("!", "-", "+"):
            self.deeper()
            value = self.unary()
            self.depth -= 1
            return None if value is None else int(not value) if word == "!" else -value if word == "-" else value
        if word == "(":
            self.deeper()
            value = self.binary(_LOOSEST)
            self.depth -= 1
            self.closed()
            return value
        if word == "defined":
            return self.defined()
        if word[:1].isdigit():
            return _number(word)
        if not word.isidentifier():
            raise _Malformed
        return self.named(word)

    def deeper(self) -> None:
        self.depth += 1
        if self.depth > DEEPEST:
            raise _Malformed

    def closed(self) -> None:
        if self.ahead() != ")":
            raise _Malformed
        self.at += 1

    def defined(self) -> int | None:
        is_inside = self.ahead() == "("
        self.at += is_inside
        name = self.ahead()
        if not name.isidentifier():
            raise _Malformed
        self.at += 1
        if is_inside:
            self.closed()
        found = is_defined(name, self.macros, self.undefined)
        return None if found is None else int(found)

    def named(self, name: str) -> int | None:
        """What a name stands for: a macro's value, 0 for one that is not defined; a call of a macro is not known."""
        if self.ahead() == "(":
            self.call()
            return None
        if name in ("true", "false"):
            return int(name == "true")
        if name in self.undefined and name not in self.macros:
            return 0
        text = self.macros.get(name)
        self.left[0] -= 1
        if text is None or self.left[0] < 0 or self.depth >= DEEPEST:
            return None
        words = _words(text)
        if len(words) != 1 and (
            words[:1] != ["("] or words[-1:] != [")"]
        ):  # a macro is text: what is around it may be nearer
            return None
        try:
            return _Reader(self.macros, self.undefined, self.left, self.depth + 1).whole(text)
        except _Malformed:
            return None

    def call(self) -> None:
        """Pass over the arguments of a macro."""
        depth = 0
        while self.at < len(self.words):
            depth += {"(": 1, ")": -1}.get(self.words[self.at], 0)
            self.at += 1
            if not depth:
                return
        raise _Malformed


def _words(text: str) -> list[str]:
    found: list[str] = []
    at = 0
    text = text.rstrip()
    while at < len(text):
        match = _TOKEN.match(text, at) if len(text) <= LONGEST and len(found) < WORDS else None
        if match is None:
            raise _Malformed
        found.append(match[0].strip())
        at = match.end()
    return found


def _number(word: str) -> int | None:
    match = _NUMBER.fullmatch(word)
    if match is None:
        return None
    for digits, base in zip(match.groups(), (16, 2, 8, 10), strict=True):
        if digits is not None:
            value = int(digits.replace("'", "") or "0", base)
            return value if value < LARGEST else None
    return None


def _combined(symbol: str, left: int | None, right: int | None) -> int | None:
    if symbol in ("&&", "||"):
        deciding = symbol == "||"
        sides = [None if side is None else bool(side) for side in (left, right)]
        return int(deciding) if deciding in sides else None if None in sides else int(not deciding)
    if left is None or right is None:
        return None
    value = _BINARY[symbol][1](left, right)
    return value if -LARGEST < value < LARGEST else None
