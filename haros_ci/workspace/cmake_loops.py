# SPDX-License-Identifier: Apache-2.0
"""What foreach() goes through, in every form of it."""

from __future__ import annotations

from haros_ci.workspace.cmake_state import State
from haros_ci.workspace.cmake_words import split_list

MAX_TURNS = 5_000


def foreach_rows(state: State, words: list[str]) -> tuple[list[str], list[tuple[str, ...]]]:
    """The loop's variables and their values in each turn; at most MAX_TURNS turns."""
    name, rest = words[0], words[1:]
    if rest[:1] == ["RANGE"]:
        return [name], [(str(number),) for number in _range(rest[1:])]
    if "IN" in rest:
        at = words.index("IN", 1)
        names, rest = words[:at], words[at + 1 :]
        return _zipped(state, names, rest[1:]) if rest[:1] == ["ZIP_LISTS"] else ([name], _items(state, rest))
    return [name], [(item,) for item in rest[:MAX_TURNS]]


def _items(state: State, words: list[str]) -> list[tuple[str, ...]]:
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


def _zipped(state: State, names: list[str], variables: list[str]) -> tuple[list[str], list[tuple[str, ...]]]:
    lists = [split_list(state.get(variable) or "") for variable in variables]
    if len(names) == 1:
        names = [f"{names[0]}_{number}" for number in range(len(lists))]
    if len(names) != len(lists):
        return names, []
    longest = min(max(map(len, lists), default=0), MAX_TURNS)
    return names, [tuple(each[turn] if turn < len(each) else "" for each in lists) for turn in range(longest)]


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
