# SPDX-License-Identifier: Apache-2.0
"""CMake's ``string`` command, and ``separate_arguments``."""

from __future__ import annotations

import operator
import re
from collections.abc import Callable

from haros_ci.model.digits import whole_number
from haros_ci.workspace.cmake_regex import find_all, replace, search, work
from haros_ci.workspace.cmake_state import MAX_VALUE, CMakeState, EvaluatedCommand
from haros_ci.workspace.cmake_words import is_certain, join_list, unknown


def run_string(state: CMakeState, call: EvaluatedCommand) -> None:
    """The subcommands whose result follows from the text; all others (hashes, times, JSON) give unknown."""
    words = call.words
    if len(words) < 2:
        return
    what = words[0].upper()
    state.spend(1 + sum(map(len, words)) // 100)
    if what in ("APPEND", "PREPEND"):
        value = state.get(words[1]) or ""
        added = "".join(words[2:])
        state.put(words[1], _joined(words[1], value + added if what == "APPEND" else added + value, value, added))
    elif what == "REGEX":
        _regex(state, words[1:])
    else:
        made = _PLACES.get(what)
        name = words[-1] if made is None else words[made] if -len(words) <= made < len(words) else ""
        inputs = words[1:]
        result = _value(what, inputs) if all(is_certain(word) for word in inputs) else None
        if name and is_certain(name):
            state.put(name, unknown(name) if result is None else result)


def _joined(name: str, value: str, *parts: str) -> str:
    """A concatenation; with something doubtful in it, it stays a list only if the parts meet at semicolons."""
    if is_certain(value) or not parts[0] or not parts[1] or parts[0][-1] == ";" or parts[1][0] == ";":
        return value
    return unknown(name)


#: Where the result's name stands, if it is not the last word.
_PLACES = {"CONCAT": 1, "JOIN": 2, "REPLACE": 3, "FIND": 3, "COMPARE": -1, "TIMESTAMP": 1, "UUID": 1, "JSON": 1}
_PLACES |= dict.fromkeys(("MD5", "SHA1", "SHA224", "SHA256", "SHA384", "SHA512"), 1)


def _value(what: str, words: list[str]) -> str | None:
    """What the subcommand makes of its words, without the name of the result for those of two words; None if it is not known."""
    if what in _OF_TEXT:
        return _OF_TEXT[what](words[0]) if len(words) == 2 else None
    least, make = _OF_WORDS.get(what, (0, None))
    return make(words) if make is not None and len(words) >= least else None


def _identifier(text: str) -> str:
    made = re.sub(r"[^A-Za-z0-9_]", "_", text)
    return f"_{made}" if made[:1].isdigit() else made


def _replaced(words: list[str]) -> str | None:
    text = "".join(words[3:])
    if not words[0] or text.count(words[0]) * len(words[1]) > MAX_VALUE:
        return None
    return text.replace(words[0], words[1])


def _part(words: list[str]) -> str | None:
    if len(words) > 4 or not all(re.fullmatch(r"-?\d{1,9}", word) for word in words[1:3]):
        return None
    start, length = int(words[1]), int(words[2])
    return words[0][start:] if length < 0 else words[0][start : start + length] if start >= 0 else None


def _repeated(words: list[str]) -> str | None:
    times = whole_number(words[1])
    if times is None or len(words) > 3 or len(words[0]) * times > MAX_VALUE:
        return None
    return words[0] * times


def _compared(words: list[str]) -> str | None:
    if words[0] not in _COMPARISONS or len(words) > 4:
        return None
    return "1" if _COMPARISONS[words[0]](words[1], words[2]) else "0"


_COMPARISONS: dict[str, Callable[[str, str], bool]] = {
    "EQUAL": operator.eq,
    "NOTEQUAL": operator.ne,
    "LESS": operator.lt,
    "GREATER": operator.gt,
    "LESS_EQUAL": operator.le,
    "GREATER_EQUAL": operator.ge,
}
#: What has one text, and the name of its result.
_OF_TEXT: dict[str, Callable[[str], str]] = {
    "TOUPPER": str.upper,
    "TOLOWER": str.lower,
    "STRIP": str.strip,
    "LENGTH": lambda text: str(len(text.encode("utf-8", "replace"))),
    "MAKE_C_IDENTIFIER": _identifier,
    "GENEX_STRIP": lambda text: re.sub(r"\$<[^<>]*>", "", text),
}
#: What has more, by the least number of words.
_OF_WORDS: dict[str, tuple[int, Callable[[list[str]], str | None]]] = {
    "CONCAT": (0, lambda words: "".join(words[1:])),
    "JOIN": (2, lambda words: words[0].join(words[2:])),
    "REPLACE": (3, _replaced),
    "SUBSTRING": (4, _part),
    "FIND": (3, lambda words: str(words[0].rfind(words[1]) if "REVERSE" in words[3:] else words[0].find(words[1]))),
    "REPEAT": (3, _repeated),
    "COMPARE": (4, _compared),
}


def _regex(state: CMakeState, words: list[str]) -> None:
    """REGEX MATCH, MATCHALL and REPLACE; a match sets CMAKE_MATCH_<n>."""
    what = words[0].upper()
    at = 3 if what == "REPLACE" else 2
    if len(words) <= at:
        return
    name, pattern, text = words[at], words[1], "".join(words[at + 1 :])
    result: str | None = None
    if is_certain(pattern) and is_certain(text) and is_certain(words[2]):
        state.spend(1 + len(text) // 10 + work(pattern, text))
        if what == "REPLACE":
            result = replace(pattern, words[2], text)
        elif what == "MATCHALL":
            found = find_all(pattern, text)
            result = None if found is None else join_list(found)
        elif what == "MATCH":
            match = search(pattern, text)
            result = None if match is None else (match[0] if match else "")
            state.put_groups(match)
    elif what == "MATCH":
        state.put_groups(None)
    state.put(name, unknown(name) if result is None else result)


def separate_arguments(state: CMakeState, call: EvaluatedCommand) -> None:
    """separate_arguments(variable [mode text]): words at blanks; quotes in them are unknown."""
    if not call.words:
        return
    name = call.words[0]
    text = call.words[-1] if len(call.words) > 2 else state.get(name) or ""
    if '"' in text or "'" in text or "\\" in text or not is_certain(text):
        state.put(name, unknown(name))
    else:
        state.put(name, join_list(text.split()))
