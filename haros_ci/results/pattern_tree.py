# SPDX-License-Identifier: Apache-2.0
"""A regular expression as a tree, as far as linear_regex.py can match it: its doc says what patterns can have."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

MAX_PATTERN = 500  # characters
MAX_DEPTH = 50
MAX_GROUPS = 20

Test = Callable[[str], bool]
#: A tuple that begins with its kind: ("char", c), ("any", test), ("where", "^"), ("all", nodes), ("either", nodes),
#: ("group", node, number), ("repeat", node, least, most or None, lazy).
Node = tuple[Any, ...]
_COUNT = re.compile(r"\{(\d{0,4})(?:(,)(\d{0,4}))?\}")
_NAME = re.compile(r"\(\?P<([A-Za-z_]\w{0,30})>")
_PLAIN_ESCAPES = {"t": "\t", "n": "\n", "r": "\r", "f": "\f", "v": "\v"}
_UNSUPPORTED = {
    "(?=": "look-ahead",
    "(?!": "look-ahead",
    "(?<=": "look-behind",
    "(?<!": "look-behind",
    "(?P=": "a back reference",
    "(?(": "a condition",
    "(?>": "an atomic group",
}


class PatternError(ValueError):
    """The pattern is malformed, too large, or uses what cannot be matched in linear time."""


@dataclass(frozen=True, slots=True)
class Parsed:
    """The tree, its named groups, the number of groups that capture, and a text that every match contains."""

    tree: Node
    names: dict[str, int]
    groups: int
    literal: str


def parsed(source: str) -> Parsed:
    """*source* taken apart. Raises PatternError."""
    if len(source) > MAX_PATTERN:
        raise PatternError(f"more than {MAX_PATTERN} characters")
    parser = _Parser(source)
    tree = parser.whole()
    literal = "" if parser.ignores_case else max(_literals(tree), key=len, default="")
    return Parsed(tree, parser.names, parser.groups, literal)


@dataclass(slots=True)
class _Parser:
    """Recursive descent over the pattern; nodes are tuples whose first entry is their kind."""

    source: str
    at: int = 0
    groups: int = 0
    depth: int = 0
    names: dict[str, int] = field(default_factory=dict)
    ignores_case: bool = False

    def whole(self) -> Node:
        if self.source.startswith("(?i)"):
            self.ignores_case, self.at = True, 4
        tree = self.alternatives()
        if self.at < len(self.source):
            raise self.error("an unmatched ')'")
        return tree

    def error(self, what: str) -> PatternError:
        return PatternError(f"{what} at character {self.at + 1}")

    def alternatives(self) -> Node:
        branches = [self.sequence()]
        while self.source.startswith("|", self.at):
            self.at += 1
            branches.append(self.sequence())
        return branches[0] if len(branches) == 1 else ("either", branches)

    def sequence(self) -> Node:
        parts: list[Node] = []
        while self.at < len(self.source) and self.source[self.at] not in "|)":
            parts.append(self.repeated(self.part()))
        return ("all", parts)

    def repeated(self, node: Node) -> Node:
        character = self.source[self.at : self.at + 1]
        counts = _COUNT.match(self.source, self.at)
        if character and character in "*+?":
            low, high, length = {"*": (0, None, 1), "+": (1, None, 1), "?": (0, 1, 1)}[character]
        elif counts is not None and counts[0] != "{}" and counts[0] != "{,}":
            low, length = int(counts[1] or 0), len(counts[0])
            high = low if not counts[2] else int(counts[3]) if counts[3] else None
            if high is not None and high < low:
                raise self.error("a repetition whose least is above its most")
        else:
            return node
        if node[0] == "where":
            raise self.error("nothing to repeat")
        self.at += length
        lazy = self.source.startswith("?", self.at)
        self.at += lazy
        if self.source[self.at : self.at + 1] in ("*", "+", "?") or _COUNT.match(self.source, self.at):
            raise self.error("a repetition of a repetition")
        return ("repeat", node, low, high, lazy)

    def part(self) -> Node:
        character = self.source[self.at]
        match character:
            case "(":
                return self.group()
            case "[":
                return self.characters()
            case "\\":
                return self.escape()
            case "^" | "$":
                self.at += 1
                return ("where", character)
            case ".":
                self.at += 1
                return ("any", lambda char: True)
            case "*" | "+" | "?":
                raise self.error("nothing to repeat")
        self.at += 1
        return self.literal(character)

    def literal(self, character: str) -> Node:
        if self.ignores_case:
            return ("any", re.compile(re.escape(character), re.IGNORECASE).fullmatch)
        return ("char", character)

    def group(self) -> Node:
        for start, what in _UNSUPPORTED.items():
            if self.source.startswith(start, self.at):
                raise self.error(f"{what}, which cannot be matched in linear time,")
        name = _NAME.match(self.source, self.at)
        captures = name is not None or not self.source.startswith("(?", self.at)
        if not captures and not self.source.startswith("(?:", self.at):
            raise self.error("an unknown kind of group")
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise self.error(f"more than {MAX_DEPTH} groups in one another")
        number = 0
        if captures:
            self.groups += 1
            number = self.groups
            if number > MAX_GROUPS:
                raise self.error(f"more than {MAX_GROUPS} groups that capture")
        if name is not None:
            if name[1] in self.names:
                raise self.error(f"a second group {name[1]!r}")
            self.names[name[1]] = number
        self.at += len(name[0]) if name else 1 if captures else 3
        inner = self.alternatives()
        if not self.source.startswith(")", self.at):
            raise self.error("a missing ')'")
        self.at += 1
        self.depth -= 1
        return ("group", inner, number) if captures else inner if inner[0] == "either" else ("all", [inner])

    def characters(self) -> Node:
        """A class in brackets; it tests one character, so Python's own may do it."""
        end = self.at + 1
        end += self.source.startswith("^", end)
        end += self.source.startswith("]", end)
        while end < len(self.source) and self.source[end] != "]":
            end += 2 if self.source[end] == "\\" else 1
        if end >= len(self.source):
            raise self.error("a missing ']'")
        written = self.source[self.at : end + 1]
        test = self.one(
            re.sub(r"(?<!^)(?<!^\[\^)(?<!\\)([\[&~|])", r"\\\1", written)
        )  # not yet special to ``re``, but it warns
        self.at = end + 1
        return ("any", test)

    def escape(self) -> Node:
        character = self.source[self.at + 1 : self.at + 2]
        if not character:
            raise self.error("a lone backslash")
        if character.isdigit():
            raise self.error("a back reference, which cannot be matched in linear time,")
        self.at += 2
        if character in "bB":
            return ("where", character)
        if character in "dDwWsS":
            return ("any", self.one("\\" + character))
        if character in _PLAIN_ESCAPES:
            return ("char", _PLAIN_ESCAPES[character])
        if character.isalpha():
            self.at -= 2
            raise self.error(f"an unknown escape \\{character}")
        return self.literal(character)

    def one(self, source: str) -> Test:
        try:
            return re.compile(source, re.IGNORECASE if self.ignores_case else 0).fullmatch  # type: ignore[return-value]
        except (re.error, OverflowError) as err:
            raise self.error(f"a class that is malformed ({str(err)[:80]})") from err


def _literals(node: Node) -> list[str]:
    """Texts that every match of *node* contains."""
    if node[0] == "char":
        return [node[1]]
    if node[0] == "group" or (node[0] == "repeat" and node[2] > 0):
        return _literals(node[1])
    if node[0] != "all":
        return []
    found, run = [], ""
    for part in [*node[1], ("end",)]:
        if part[0] == "char":
            run += part[1]
            continue
        found.append(run)
        run = ""
        found += _literals(part)
    return found
