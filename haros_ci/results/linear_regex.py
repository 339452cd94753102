# SPDX-License-Identifier: Apache-2.0
"""Regular expressions from settings, matched against text of unknown origin in time that grows with both lengths only.

The syntax is the part of Python's that needs no backtracking: literals, ``.``, classes, ``\\d \\w \\s`` and their opposites,
``^ $ \\b \\B``, groups (plain, ``(?:…)``, ``(?P<name>…)``), ``|``, ``* + ? {m,n}`` and their lazy forms, a leading ``(?i)``.
Matching runs all alternatives side by side, one character at a time (Thompson's construction, with captures as in Pike's
machine), and finds what Python's would: the leftmost match, earlier alternatives first. ``.`` matches any character, ``$``
the very end.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

MAX_PATTERN = 500  # characters
MAX_PROGRAM = 1_000  # instructions, counted repetitions written out
MAX_DEPTH = 50
MAX_GROUPS = 20
#: Steps of the machine that all searches with one Budget may take: some ten seconds.
MAX_STEPS = 20_000_000

_CHAR, _SPLIT, _JUMP, _SAVE, _ASSERT, _MATCH = range(6)
_Test = Callable[[str], bool]
_Node = tuple[Any, ...]
_COUNT = re.compile(r"\{(\d{0,4})(?:(,)(\d{0,4}))?\}")
_NAME = re.compile(r"\(\?P<([A-Za-z_]\w{0,30})>")
_PLAIN_ESCAPES = {"t": "\t", "n": "\n", "r": "\r", "f": "\f", "v": "\v"}
_UNSUPPORTED = {
    "(?=": "look-ahead", "(?!": "look-ahead", "(?<=": "look-behind", "(?<!": "look-behind",
    "(?P=": "a back reference", "(?(": "a condition", "(?>": "an atomic group",
}  # fmt: skip


class PatternError(ValueError):
    """The pattern is malformed, too large, or uses what cannot be matched in linear time."""


class TooMuchWork(ValueError):
    """The budget is used up."""


@dataclass(slots=True)
class Budget:
    """How many steps searches may still take, together."""

    left: int = MAX_STEPS

    def spend(self, steps: int) -> None:
        self.left -= steps
        if self.left < 0:
            raise TooMuchWork("matching takes too long; write the pattern simpler")


@dataclass(frozen=True, slots=True)
class LinearPattern:
    """A compiled pattern; *groups* are the named ones, *literal* is a text that every match contains."""

    source: str
    program: tuple[_Node, ...]
    groups: Mapping[str, int]
    literal: str = ""
    slots_needed: int = 0

    def search(self, text: str, budget: Budget) -> dict[str, str | None] | None:
        """The named groups of the leftmost match in *text*, those that took no part None; None without a match."""
        if self.literal not in text:
            return None
        found = _run(self, text, budget)
        if found is None:
            return None
        return {name: _slice(text, found, number) for name, number in self.groups.items()}


@lru_cache(maxsize=512)
def compiled(source: str) -> LinearPattern:
    """*source* as a pattern. Raises PatternError."""
    if len(source) > MAX_PATTERN:
        raise PatternError(f"more than {MAX_PATTERN} characters")
    parser = _Parser(source)
    tree = parser.whole()
    writer = _Writer()
    writer.write(tree)
    writer.add((_MATCH,))
    literal = "" if parser.ignores_case else max(_literals(tree), key=len, default="")
    return LinearPattern(source, tuple(writer.program), parser.names, literal, 2 * (parser.groups + 1))


@dataclass(slots=True)
class _Parser:
    """Recursive descent over the pattern; nodes are tuples whose first entry is their kind."""

    source: str
    at: int = 0
    groups: int = 0
    depth: int = 0
    names: dict[str, int] = field(default_factory=dict)
    ignores_case: bool = False

    def whole(self) -> _Node:
        if self.source.startswith("(?i)"):
            self.ignores_case, self.at = True, 4
        tree = self.alternatives()
        if self.at < len(self.source):
            raise self.error("an unmatched ')'")
        return tree

    def error(self, what: str) -> PatternError:
        return PatternError(f"{what} at character {self.at + 1}")

    def alternatives(self) -> _Node:
        branches = [self.sequence()]
        while self.source.startswith("|", self.at):
            self.at += 1
            branches.append(self.sequence())
        return branches[0] if len(branches) == 1 else ("either", branches)

    def sequence(self) -> _Node:
        parts: list[_Node] = []
        while self.at < len(self.source) and self.source[self.at] not in "|)":
            parts.append(self.repeated(self.part()))
        return ("all", parts)

    def repeated(self, node: _Node) -> _Node:
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

    def part(self) -> _Node:
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

    def literal(self, character: str) -> _Node:
        if self.ignores_case:
            return ("any", re.compile(re.escape(character), re.IGNORECASE).fullmatch)
        return ("char", character)

    def group(self) -> _Node:
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

    def characters(self) -> _Node:
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

    def escape(self) -> _Node:
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

    def one(self, source: str) -> _Test:
        try:
            return re.compile(source, re.IGNORECASE if self.ignores_case else 0).fullmatch  # type: ignore[return-value]
        except (re.error, OverflowError) as err:
            raise self.error(f"a class that is malformed ({str(err)[:80]})") from err


@dataclass(slots=True)
class _Writer:
    """From the tree to instructions."""

    program: list[_Node] = field(default_factory=list)

    def add(self, instruction: _Node) -> int:
        if len(self.program) >= MAX_PROGRAM:
            raise PatternError(f"repetitions that come to more than {MAX_PROGRAM} steps")
        self.program.append(instruction)
        return len(self.program) - 1

    def write(self, node: _Node) -> None:
        match node[0]:
            case "char" | "any":
                self.add((_CHAR, node[1]))
            case "where":
                self.add((_ASSERT, node[1]))
            case "all":
                for part in node[1]:
                    self.write(part)
            case "group":
                self.add((_SAVE, 2 * node[2]))
                self.write(node[1])
                self.add((_SAVE, 2 * node[2] + 1))
            case "either":
                self.either(node[1])
            case _:
                self.repeat(*node[1:])

    def either(self, branches: list[_Node]) -> None:
        leaving = []
        for branch in branches[:-1]:
            fork = self.add((_SPLIT,))
            self.write(branch)
            leaving.append(self.add((_JUMP,)))
            self.program[fork] = (_SPLIT, fork + 1, len(self.program))
        self.write(branches[-1])
        for jump in leaving:
            self.program[jump] = (_JUMP, len(self.program))

    def repeat(self, node: _Node, low: int, high: int | None, lazy: bool) -> None:
        for _ in range(low):
            self.write(node)
        forks = []
        if high is None:
            forks.append(self.add((_SPLIT,)))
            self.write(node)
            self.add((_JUMP, forks[0]))
        else:
            for _ in range(high - low):
                forks.append(self.add((_SPLIT,)))
                self.write(node)
        for fork in forks:
            ways = (fork + 1, len(self.program))
            self.program[fork] = (_SPLIT, *(reversed(ways) if lazy else ways))


def _literals(node: _Node) -> list[str]:
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


def _run(pattern: LinearPattern, text: str, budget: Budget) -> tuple[int, ...] | None:
    """The positions saved by the best match."""
    program = pattern.program
    nothing = (-1,) * pattern.slots_needed
    best: tuple[int, ...] | None = None
    threads: list[tuple[int, tuple[int, ...]]] = []
    seen: set[int] = set()
    for at in range(len(text) + 1):
        if best is None:
            _follow(program, 0, nothing, text, at, threads, seen)
        elif not threads:
            break
        budget.spend(len(seen) + 1)
        character = text[at] if at < len(text) else None
        following: list[tuple[int, tuple[int, ...]]] = []
        seen = set()
        for place, saved in threads:
            kind, *rest = program[place]
            if kind == _MATCH:
                best = saved
                break  # what comes after has a lower priority
            test = rest[0]
            if character is not None and (test == character if isinstance(test, str) else test(character)):
                _follow(program, place + 1, saved, text, at + 1, following, seen)
        threads = following
    return best


def _follow(
    program: tuple[_Node, ...],
    start: int,
    saved: tuple[int, ...],
    text: str,
    at: int,
    threads: list[tuple[int, tuple[int, ...]]],
    seen: set[int],
) -> None:
    """Adds the threads that *start* leads to without reading a character, the preferred ones first."""
    waiting = [(start, saved)]
    while waiting:
        place, saved = waiting.pop()
        if place in seen:
            continue
        seen.add(place)
        instruction = program[place]
        match instruction[0]:
            case 2:  # _JUMP
                waiting.append((instruction[1], saved))
            case 1:  # _SPLIT
                waiting += ((instruction[2], saved), (instruction[1], saved))
            case 3:  # _SAVE
                slot = instruction[1]
                waiting.append((place + 1, (*saved[:slot], at, *saved[slot + 1 :])))
            case 4:  # _ASSERT
                if _holds(instruction[1], text, at):
                    waiting.append((place + 1, saved))
            case _:
                threads.append((place, saved))


def _holds(where: str, text: str, at: int) -> bool:
    if where == "^":
        return at == 0
    if where == "$":
        return at == len(text)
    before, after = text[at - 1 : at] if at else "", text[at : at + 1]
    return (_is_word(before) != _is_word(after)) == (where == "b")


def _is_word(character: str) -> bool:
    return character.isalnum() or character == "_"


def _slice(text: str, saved: tuple[int, ...], number: int) -> str | None:
    start, end = saved[2 * number], saved[2 * number + 1]
    return text[start:end] if start >= 0 and end >= 0 else None
