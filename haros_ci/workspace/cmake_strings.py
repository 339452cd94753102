# SPDX-License-Identifier: Apache-2.0
"""CMake's ``string`` command, and ``separate_arguments``."""

from __future__ import annotations

import re

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
    if what in ("TOUPPER", "TOLOWER", "STRIP") and len(words) == 2:
        text = words[0]
        return {"TOUPPER": text.upper(), "TOLOWER": text.lower(), "STRIP": text.strip()}[what]
    if what == "CONCAT":
        return "".join(words[1:])
    if what == "JOIN" and len(words) >= 2:
        return words[0].join(words[2:])
    if what == "REPLACE" and len(words) >= 3 and words[0]:
        text = "".join(words[3:])
        if text.count(words[0]) * len(words[1]) > MAX_VALUE:
            return None
        return text.replace(words[0], words[1])
    if what == "LENGTH" and len(words) == 2:
        return str(len(words[0].encode("utf-8", "replace")))
    if what == "SUBSTRING" and len(words) == 4 and all(re.fullmatch(r"-?\d{1,9}", word) for word in words[1:3]):
        start, length = int(words[1]), int(words[2])
        return words[0][start:] if length < 0 else words[0][start : start + length] if start >= 0 else None
    if what == "FIND" and len(words) >= 3:
        return str(words[0].rfind(words[1]) if "REVERSE" in words[3:] else words[0].find(words[1]))
    if what == "REPEAT" and len(words) == 3 and (times := whole_number(words[1])) is not None:
        return words[0] * times if len(words[0]) * times <= MAX_VALUE else None
    if what == "MAKE_C_IDENTIFIER" and len(words) == 2:
        made = re.sub(r"[^A-Za-z0-9_]", "_", words[0])
        return f"_{made}" if made[:1].isdigit() else made
    if what == "GENEX_STRIP" and len(words) == 2:
        return re.sub(r"\$<[^<>]*>", "", words[0])
    if what == "COMPARE" and len(words) == 4:
        left, right = words[1], words[2]
        verdict = {"EQUAL": left == right, "NOTEQUAL": left != right, "LESS": left < right, "GREATER": left > right}
        verdict |= {"LESS_EQUAL": left <= right, "GREATER_EQUAL": left >= right}
        return None if words[0] not in verdict else "1" if verdict[words[0]] else "0"
    return None


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
