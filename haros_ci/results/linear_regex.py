# SPDX-License-Identifier: Apache-2.0
"""Regular expressions from settings, matched against text of unknown origin in time that grows with both lengths only.

The syntax is the part of Python's that needs no backtracking: literals, ``.``, classes, ``\\d \\w \\s`` and their opposites,
``^ $ \\b \\B``, groups (plain, ``(?:…)``, ``(?P<name>…)``), ``|``, ``* + ? {m,n}`` and their lazy forms, a leading ``(?i)``.
Matching runs all alternatives side by side, one character at a time (Thompson's construction, with captures as in Pike's
machine), and finds what Python's would: the leftmost match, earlier alternatives first. ``.`` matches any character, ``$``
the very end.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache

from haros_ci.results.pattern_tree import MAX_PATTERN, Node, PatternError, parsed

MAX_PROGRAM = 1_000  # instructions, counted repetitions written out
#: Steps of the machine that all searches with one Budget may take: some ten seconds.
MAX_STEPS = 20_000_000

_CHAR, _SPLIT, _JUMP, _SAVE, _ASSERT, _MATCH = range(6)


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
    program: tuple[Node, ...]
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
    pattern = parsed(source)
    writer = _Writer()
    writer.write(pattern.tree)
    writer.add((_MATCH,))
    return LinearPattern(source, tuple(writer.program), pattern.names, pattern.literal, 2 * (pattern.groups + 1))


@dataclass(slots=True)
class _Writer:
    """From the tree to instructions."""

    program: list[Node] = field(default_factory=list)

    def add(self, instruction: Node) -> int:
        if len(self.program) >= MAX_PROGRAM:
            raise PatternError(f"repetitions that come to more than {MAX_PROGRAM} steps")
        self.program.append(instruction)
        return len(self.program) - 1

    def write(self, node: Node) -> None:
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

    def either(self, branches: list[Node]) -> None:
        leaving = []
        for branch in branches[:-1]:
            fork = self.add((_SPLIT,))
            self.write(branch)
            leaving.append(self.add((_JUMP,)))
            self.program[fork] = (_SPLIT, fork + 1, len(self.program))
        self.write(branches[-1])
        for jump in leaving:
            self.program[jump] = (_JUMP, len(self.program))

    def repeat(self, node: Node, low: int, high: int | None, lazy: bool) -> None:
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
    program: tuple[Node, ...],
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


__all__ = ["MAX_PATTERN", "Budget", "LinearPattern", "PatternError", "TooMuchWork", "compiled"]
