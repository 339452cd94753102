# SPDX-License-Identifier: Apache-2.0
"""The turns of loops: what foreach() goes through, in every form of it, and how often while() does."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.workspace.cmake_conditions import decide
from haros_ci.workspace.cmake_parse import ParsedCommand
from haros_ci.workspace.cmake_state import CMakeBudgetExhausted, CMakeState, Doubt, condition_text
from haros_ci.workspace.cmake_words import bare, is_certain, split_list

MAX_TURNS = 5_000
MAX_WHILE = 1_000


def foreach_rows(state: CMakeState, words: list[str]) -> tuple[list[str], list[tuple[str, ...]]]:
    """The loop's variables and their values in each turn; at most MAX_TURNS turns."""
    name, rest = words[0], words[1:]
    if rest[:1] == ["RANGE"]:
        return [name], [(str(number),) for number in _range(rest[1:])]
    if "IN" in rest:
        at = words.index("IN", 1)
        names, rest = words[:at], words[at + 1 :]
        return _zipped(state, names, rest[1:]) if rest[:1] == ["ZIP_LISTS"] else ([name], _items(state, rest))
    return [name], [(item,) for item in rest[:MAX_TURNS]]


def _items(state: CMakeState, words: list[str]) -> list[tuple[str, ...]]:
    """IN [LISTS variables] [ITEMS values]."""
    items: list[str] = []
    mode = ""
    for word in words:
        if word in ("LISTS", "ITEMS"):
            mode = word
        elif mode == "LISTS":
            items += split_list(state.get(word) or "")
        elif mode == "ITEMS":
            items.append(word)
    return [(item,) for item in items[:MAX_TURNS]]


def _zipped(state: CMakeState, names: list[str], variables: list[str]) -> tuple[list[str], list[tuple[str, ...]]]:
    lists = [split_list(state.get(variable) or "") for variable in variables]
    if len(names) == 1:
        names = [f"{names[0]}_{number}" for number in range(len(lists))]
    if len(names) != len(lists):
        return names, []
    longest = min(max(map(len, lists), default=0), MAX_TURNS)
    return names, [tuple(items[turn] if turn < len(items) else "" for items in lists) for turn in range(longest)]


def _range(words: list[str]) -> range:
    """RANGE stop, or RANGE start stop [step]; both ends are in it."""
    try:
        numbers = [int(word) for word in words if len(word) < 12]
    except ValueError:
        return range(0)
    if len(numbers) == 1:
        return range(numbers[0] + 1)[:MAX_TURNS]
    if len(numbers) not in (2, 3):
        return range(0)
    first, last = numbers[:2]
    step = max(abs(numbers[2]), 1) if len(numbers) == 3 else 1
    return (range(first, last + 1, step) if first <= last else range(first, last - 1, -step))[:MAX_TURNS]


def while_turns(state: CMakeState, command: ParsedCommand, macro: dict[str, str] | None) -> Iterator[bool]:
    """Whether the condition is known to hold, for each turn that may be."""
    for _ in range(MAX_WHILE):
        call = state.expand(command, command.arguments, macro)
        verdict = decide(state, list(zip(call.words, call.quoted, strict=True)))
        if verdict is not False:
            yield bool(verdict)
        if not verdict:
            return
    raise CMakeBudgetExhausted


def foreach_turns(state: CMakeState, command: ParsedCommand, macro: dict[str, str] | None) -> Iterator[bool]:
    """Set the loop variables for each turn, by every form of foreach()."""
    words = state.expand(command, command.arguments, macro).words
    if not words:
        return
    names, rows = foreach_rows(state, words)
    saved = [state.get(name) for name in names]
    for row in rows:
        mark = len(state.doubts)
        if not all(is_certain(value) for value in row):
            state.doubts.append(Doubt(state.file, command.line, condition_text(command)))
        for name, value in zip(names, row, strict=True):
            state.put(name, bare(value))
        yield True
        if not all(is_certain(value) for value in row):
            del state.doubts[mark : mark + 1]
    for name, old in zip(names, saved, strict=True):
        state.put(name, old)
