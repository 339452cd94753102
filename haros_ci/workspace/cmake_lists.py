# SPDX-License-Identifier: Apache-2.0
"""CMake's ``list`` command."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from haros_ci.workspace.cmake_regex import replace, search, work
from haros_ci.workspace.cmake_state import CMakeState, EvaluatedCommand
from haros_ci.workspace.cmake_words import MAYBE, bare, is_certain, join_list, split_list, unknown


def run_list(state: CMakeState, call: EvaluatedCommand) -> None:
    """Every subcommand; what reads an element or a length that is not known sets its result to unknown."""
    words = call.words
    if len(words) < 2:
        return
    what, name, rest = words[0].upper(), words[1], words[2:]
    value = state.get(name)
    elements = split_list(value or "")
    state.spend(1 + len(value or "") // 100)
    if what == "APPEND":
        if rest:
            state.put(name, join_list([*([value] if value else []), *rest]))
    elif what == "PREPEND":
        state.put(name, join_list([*rest, *elements]))
    elif what in _CHANGING:
        if what == "FILTER" and rest:
            state.spend(sum(1 + work(rest[-1], element) for element in elements))
        changed = _CHANGING[what](elements, rest)
        state.put(name, unknown(name) if changed is None else join_list(changed))
    elif what == "TRANSFORM":
        _transform(state, name, elements, rest)
    elif what in ("POP_BACK", "POP_FRONT"):
        if not is_certain(value or ""):
            for variable in (name, *rest):
                state.put(variable, unknown(variable))
            return
        for variable in rest or [""]:
            taken = elements.pop(-1 if what == "POP_BACK" else 0) if elements else None
            if variable:
                state.put(variable, taken)
        state.put(name, join_list(elements))
    elif rest:
        result = _read(what, elements, rest[:-1])
        state.put(rest[-1], unknown(rest[-1]) if result is None else result)


def _read(what: str, elements: list[str], rest: list[str]) -> str | None:
    """The value of a subcommand that only reads; None if it is not known."""
    if what == "JOIN":
        return rest[0].join(elements) if rest and all(map(is_certain, elements)) else None
    if what == "FIND":
        sure = all(is_certain(element) for element in elements)
        return (str(elements.index(rest[0])) if rest[0] in elements else "-1") if rest and sure else None
    if not all(is_certain(element) for element in elements):
        return None
    if what == "LENGTH":
        return str(len(elements))
    numbers = [_integer(word) for word in rest]
    if what == "GET" and numbers:
        chosen = [elements[n] for n in numbers if n is not None and -len(elements) <= n < len(elements)]
        return join_list(chosen) if len(chosen) == len(numbers) else None
    if what == "SUBLIST" and len(numbers) == 2:
        start, length = numbers
        if start is not None and length is not None and start >= 0:
            return join_list(elements[start:] if length < 0 else elements[start : start + length])
    return None


def _integer(word: str) -> int | None:
    try:
        return int(word) if len(word) < 12 else None
    except ValueError:
        return None


def _insert(elements: list[str], rest: list[str]) -> list[str] | None:
    at = _integer(rest[0]) if rest else None
    if at is None or (at and not all(map(is_certain, elements))):
        return None
    return [*elements[:at], *rest[1:], *elements[at:]] if abs(at) <= len(elements) else None


def _remove_at(elements: list[str], rest: list[str]) -> list[str] | None:
    if not all(map(is_certain, elements)):
        return None
    places = {n + len(elements) if n is not None and n < 0 else n for n in map(_integer, rest)}
    return [element for number, element in enumerate(elements) if number not in places]


def _remove_item(elements: list[str], rest: list[str]) -> list[str] | None:
    """A doubtful item to remove makes the element it names doubtful."""
    certain = {word for word in rest if is_certain(word)}
    doubtful = {bare(word) for word in rest} - certain
    kept = [element for element in elements if bare(element) not in certain]
    return [MAYBE + element if element in doubtful else element for element in kept]


def _remove_duplicates(elements: list[str], _: list[str]) -> list[str]:
    return list(dict.fromkeys(elements))


def _filter(elements: list[str], rest: list[str]) -> list[str] | None:
    if len(rest) < 3 or rest[0] not in ("INCLUDE", "EXCLUDE") or rest[1] != "REGEX" or not is_certain(rest[2]):
        return None
    kept = []
    for element in elements:
        match = search(rest[2], bare(element))
        if match is None:
            return None
        if bool(match) == (rest[0] == "INCLUDE"):
            kept.append(element)
    return kept


def _sort(elements: list[str], rest: list[str]) -> list[str]:
    key = str.lower if "INSENSITIVE" in rest else str
    if "FILE_BASENAME" in rest:
        return sorted(elements, key=lambda e: key(bare(e).rpartition("/")[2]), reverse="DESCENDING" in rest)
    return sorted(elements, key=lambda e: key(bare(e)), reverse="DESCENDING" in rest)


_CHANGING: Mapping[str, Callable[[list[str], list[str]], list[str] | None]] = {
    "INSERT": _insert,
    "REMOVE_AT": _remove_at,
    "REMOVE_ITEM": _remove_item,
    "REMOVE_DUPLICATES": _remove_duplicates,
    "FILTER": _filter,
    "SORT": _sort,
    "REVERSE": lambda elements, _: elements[::-1],
}


def _transform(state: CMakeState, name: str, elements: list[str], rest: list[str]) -> None:
    """list(TRANSFORM l action [selector] [OUTPUT_VARIABLE v]); selectors are not followed, but REGEX."""
    target = name
    if "OUTPUT_VARIABLE" in rest[:-1]:
        at = rest.index("OUTPUT_VARIABLE")
        target, rest = rest[at + 1], rest[:at] + rest[at + 2 :]
    action = rest[0] if rest else ""
    size = {"APPEND": 2, "PREPEND": 2, "REPLACE": 3}.get(action, 1)
    selector = rest[size:]
    made: list[str] = []
    for element in elements:
        state.spend(1 + sum(work(word, element) for word in rest))
        changed: str | None = None
        if not selector or (selector[0] == "REGEX" and len(selector) == 2):
            chosen = search(selector[1], bare(element)) if selector else ("",)
            changed = element if chosen == () else (None if chosen is None else _changed(action, rest, element))
        if changed is None:
            state.put(target, unknown(target))
            return
        made.append(changed)
    state.put(target, join_list(made))


def _changed(action: str, rest: list[str], element: str) -> str | None:
    mark, text = (MAYBE, element[1:]) if element[:1] == MAYBE else ("", element)
    if action in ("APPEND", "PREPEND") and len(rest) > 1:
        return mark + (text + rest[1] if action == "APPEND" else rest[1] + text)
    if action == "REPLACE" and len(rest) > 2 and is_certain(text):
        replaced = replace(rest[1], rest[2], text)
        return None if replaced is None else mark + replaced
    simple = {"TOUPPER": text.upper(), "TOLOWER": text.lower(), "STRIP": text.strip()}.get(action)
    return None if simple is None or not is_certain(text) else mark + simple
