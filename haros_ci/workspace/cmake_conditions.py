# SPDX-License-Identifier: Apache-2.0
"""Whether a condition of CMake's ``if`` holds: True, False, or None where only a build knows."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from haros_ci.workspace.cmake_regex import search, work
from haros_ci.workspace.cmake_state import CMakeState
from haros_ci.workspace.cmake_words import inside, is_certain, place, split_list, truth
from haros_ci.workspace.language import language_of

MAX_NESTING = 30

ConditionWord = tuple[str, bool]


class _MalformedCondition(Exception):
    pass


def decide(state: CMakeState, words: list[ConditionWord]) -> bool | None:
    """The verdict on *words* (text, whether quoted), by the precedence that cmake ``if`` documents.

    Parentheses, then tests, then NOT, then AND and OR alike, from left to right. Quoted words are neither operators nor
    variables (CMP0054).
    """
    if not words:
        return False
    reader = _ConditionReader(state, words)
    try:
        verdict = reader.compound(0)
        return verdict if reader.at == len(words) else None
    except _MalformedCondition:
        return None


def _not(verdict: bool | None) -> bool | None:
    return None if verdict is None else not verdict


def _joined(deciding: bool, left: bool | None, right: bool | None) -> bool | None:
    """OR, which True decides, or AND, which False decides."""
    if deciding in (left, right):
        return deciding
    return None if None in (left, right) else not deciding


class _ConditionReader:
    """Recursive descent over the words; the position is ``at``."""

    def __init__(self, state: CMakeState, words: list[ConditionWord]) -> None:
        self.state = state
        self.words = words
        self.at = 0

    def keyword(self, offset: int = 0) -> str:
        """The unquoted word ahead, else ""."""
        at = self.at + offset
        return self.words[at][0] if at < len(self.words) and not self.words[at][1] else ""

    def compound(self, depth: int) -> bool | None:
        verdict = self.negation(depth)
        while (operator := self.keyword()) in ("AND", "OR"):
            self.at += 1
            verdict = _joined(operator == "OR", verdict, self.negation(depth))
        return verdict

    def negation(self, depth: int) -> bool | None:
        negated = False
        while self.keyword() == "NOT":
            self.at += 1
            negated = not negated
        verdict = self.test(depth)
        return _not(verdict) if negated else verdict

    def test(self, depth: int) -> bool | None:
        word = self.keyword()
        if word == "(":
            if depth >= MAX_NESTING:
                raise _MalformedCondition
            self.at += 1
            verdict = self.compound(depth + 1)
            if self.keyword() != ")":
                raise _MalformedCondition
            self.at += 1
            return verdict
        if self.keyword(1) in _BINARY and self.at + 2 < len(self.words):
            left, operator, right = self.words[self.at], self.keyword(1), self.words[self.at + 2]
            self.at += 3
            return _BINARY[operator](self.state, left, right)
        if word in _UNARY and self.at + 1 < len(self.words):
            operand = self.words[self.at + 1][0]
            self.at += 2
            return _UNARY[word](self.state, operand) if is_certain(operand) else None
        if self.at >= len(self.words):
            raise _MalformedCondition
        self.at += 1
        return _constant(self.state, self.words[self.at - 1])


def _constant(state: CMakeState, word: ConditionWord) -> bool | None:
    """``if(<constant or variable>)``."""
    text, is_quoted = word
    if not is_certain(text):
        return _of_list(text)
    verdict = truth(text)
    if verdict is not None or is_quoted:
        return bool(verdict)
    value = state.get(text)
    if value is None:
        return False
    if not is_certain(value):
        return _of_list(value)
    return truth(value) is not False


def _of_list(value: str) -> bool | None:
    """A list holds if one element is sure to be there and is no constant for false."""
    elements = split_list(value)
    return True if any(is_certain(element) and truth(element) is not False for element in elements) else None


def _operand(state: CMakeState, word: ConditionWord) -> str:
    """The value that a comparison sees: of the variable, if an unquoted word is the name of one."""
    if word[1] or not is_certain(word[0]):
        return word[0]
    is_choosing, state.is_choosing = state.is_choosing, False  # the word may as well be a value: Linux, GNU
    value = state.get(word[0])
    state.is_choosing = is_choosing
    return word[0] if value is None else value


def _comparing(
    compare: Callable[[str, str], bool | None],
) -> Callable[[CMakeState, ConditionWord, ConditionWord], bool | None]:
    def test(state: CMakeState, left: ConditionWord, right: ConditionWord) -> bool | None:
        first, second = _operand(state, left), _operand(state, right)
        return compare(first, second) if is_certain(first) and is_certain(second) else None

    return test


def _numbers(
    compare: Callable[[float, float], bool],
) -> Callable[[CMakeState, ConditionWord, ConditionWord], bool | None]:
    def test(left: str, right: str) -> bool:
        try:
            return len(left) < 40 and len(right) < 40 and compare(float(left), float(right))
        except ValueError:
            return False

    return _comparing(test)


def _versions(
    compare: Callable[[list[int], list[int]], bool],
) -> Callable[[CMakeState, ConditionWord, ConditionWord], bool | None]:
    def test(left: str, right: str) -> bool:
        first, second = _version(left), _version(right)
        length = max(len(first), len(second))
        return compare(first + [0] * (length - len(first)), second + [0] * (length - len(second)))

    return _comparing(test)


def _version(text: str) -> list[int]:
    """The components up to the first that is no number; missing ones count as 0."""
    found: list[int] = []
    for part in text[:100].split("."):
        digits = part[: len(part) - len(part.lstrip("0123456789"))]
        found.append(int(digits or "0"))
        if digits != part:
            break
    return found


def _matches(state: CMakeState, left: ConditionWord, right: ConditionWord) -> bool | None:
    value = _operand(state, left)
    if not is_certain(value) or not is_certain(right[0]):
        state.put_groups(None)
        return None
    state.spend(1 + work(right[0], value))
    match = search(right[0], value)
    state.put_groups(match)
    return None if match is None else bool(match)


def _in_list(state: CMakeState, left: ConditionWord, right: ConditionWord) -> bool | None:
    value = _operand(state, left)
    elements = state.get(right[0])
    if elements is None:
        return False
    if not is_certain(value):
        return None
    found = split_list(elements)
    if value in found:
        return True
    return False if is_certain(elements) else None


def _target(state: CMakeState, name: str) -> bool | None:
    made = state.targets.get(name)
    if made is not None:
        return None if made.is_conditional and not state.doubts else True
    return None if "::" in name or state.is_foreign(f"{name}_") else False


def _exists(state: CMakeState, path: str) -> bool | None:
    inner = inside(place(path, state.source_directory()))
    if inner is None:
        return None
    if state.tree.exists(inner):
        return True
    return False if language_of(inner.rpartition("/")[2]) else None


def _is_directory(state: CMakeState, path: str) -> bool | None:
    inner = inside(place(path, state.source_directory()))
    if inner is None:
        return None
    if inner in state.tree.directories:
        return True
    return False if inner in state.tree.files else None


def _defined(state: CMakeState, name: str) -> bool | None:
    if name.startswith("ENV{"):
        return True if name[4:-1] in state.environment else None
    value = state.cache.get(name[6:-1]) if name.startswith("CACHE{") else state.get(name)
    if value is None:
        return False
    return True if is_certain(value) or any(map(is_certain, split_list(value))) else None


def _command(state: CMakeState, name: str) -> bool | None:
    return True if name.lower() in state.functions else None


_Binary = Callable[[CMakeState, ConditionWord, ConditionWord], bool | None]
_BINARY: Mapping[str, _Binary] = {
    "STREQUAL": _comparing(lambda a, b: a == b),
    "STRLESS": _comparing(lambda a, b: a < b),
    "STRGREATER": _comparing(lambda a, b: a > b),
    "STRLESS_EQUAL": _comparing(lambda a, b: a <= b),
    "STRGREATER_EQUAL": _comparing(lambda a, b: a >= b),
    "EQUAL": _numbers(lambda a, b: a == b),
    "LESS": _numbers(lambda a, b: a < b),
    "GREATER": _numbers(lambda a, b: a > b),
    "LESS_EQUAL": _numbers(lambda a, b: a <= b),
    "GREATER_EQUAL": _numbers(lambda a, b: a >= b),
    "VERSION_EQUAL": _versions(lambda a, b: a == b),
    "VERSION_LESS": _versions(lambda a, b: a < b),
    "VERSION_GREATER": _versions(lambda a, b: a > b),
    "VERSION_LESS_EQUAL": _versions(lambda a, b: a <= b),
    "VERSION_GREATER_EQUAL": _versions(lambda a, b: a >= b),
    "PATH_EQUAL": _comparing(lambda a, b: place(a, "") == place(b, "")),
    "IS_NEWER_THAN": lambda *_: None,
    "MATCHES": _matches,
    "IN_LIST": _in_list,
}
_UNARY: Mapping[str, Callable[[CMakeState, str], bool | None]] = {
    "DEFINED": _defined,
    "TARGET": _target,
    "EXISTS": _exists,
    "IS_DIRECTORY": _is_directory,
    "IS_ABSOLUTE": lambda _, path: path.startswith("/"),
    "IS_SYMLINK": lambda *_: None,
    "IS_READABLE": _exists,
    "IS_WRITABLE": _exists,
    "IS_EXECUTABLE": lambda *_: None,
    "COMMAND": _command,
    "POLICY": lambda *_: True,
    "TEST": lambda *_: None,
}
