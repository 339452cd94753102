# SPDX-License-Identifier: Apache-2.0
"""Generator expressions (cmake-generator-expressions(7)) as far as they decide which words there are."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from haros_ci.regex import regex
from haros_ci.workspace.cmake_words import MAYBE, UNKNOWN, split_list, truth

_PIECE = regex(r"\$<|[>:,]|[^$>:,]+|\$")

#: Those that give their content, a condition that holds or not, or nothing.
_CONTENT = frozenset(("BUILD_INTERFACE", "BUILD_LOCAL_INTERFACE", "1", "TARGET_NAME", "TARGET_OBJECTS", "LINK_ONLY"))
_CONTENT |= {"TARGET_NAME_IF_EXISTS", "PATH", "SHELL_PATH"}
_DROPPED = frozenset(("INSTALL_INTERFACE", "0"))
_BITS = frozenset(("0", "1"))
_LOGIC: dict[str, Callable[[Iterable[bool]], bool]] = {"NOT": lambda bits: not all(bits), "AND": all, "OR": any}
_CHARACTERS = {"SEMICOLON": ";", "COMMA": ",", "ANGLE-R": ">"}


def resolved(words: list[str]) -> list[str]:
    """*words* with generator expressions evaluated; what depends on the configuration is marked as doubtful.

    ``$<TARGET_OBJECTS:x>`` becomes ``$<x>``, which callers take for the sources of *x*.
    """
    if not any("$<" in word for word in words):
        return words
    text = ";".join(words)
    stack: list[list[str]] = []
    parts: list[str] = []
    for match in _PIECE.finditer(text):
        piece = match[0]
        if piece == "$<":
            stack.append(parts)
            parts = []
        elif piece == ">" and stack:
            value = _value("".join(parts))
            parts = stack.pop()
            parts.append(value)
        elif piece in ":," and stack:
            parts.append("\ue004" if piece == ":" else "\ue005")
        else:
            parts.append(piece)
    while stack:
        parts = [*stack.pop(), UNKNOWN]
    value = "".join(parts).replace("\ue006", "$<").replace("\ue007", ">").replace("\ue004", ":").replace("\ue005", ",")
    return [element for element in split_list(value) if element and element != MAYBE]


def _value(inner: str) -> str:
    """The value of an expression without its brackets; colons and commas of its own level are private characters."""
    head, colon, content = inner.partition("\ue004")
    content = content.replace("\ue004", ":")
    if head in _DROPPED:
        return ""
    if head in _CONTENT:
        plain = content.replace("\ue005", ",")
        return f"\ue006{plain}\ue007" if head == "TARGET_OBJECTS" else plain
    arguments = content.split("\ue005")
    verdict = _verdict(head, content, arguments)
    if verdict is not None:
        return "1" if verdict else "0"
    if head == "IF" and len(arguments) == 3 and arguments[0] in _BITS:
        return arguments[1] if arguments[0] == "1" else arguments[2]
    if head == "JOIN" and len(arguments) == 2 and UNKNOWN not in content:
        return content.replace("\ue005", ",") if not arguments[1] else arguments[1].join(split_list(arguments[0]))
    if head == UNKNOWN and colon:  # a condition on the configuration, the compiler, or the language
        return ";".join(MAYBE + element.lstrip(MAYBE) for element in split_list(content.replace("\ue005", ",")))
    return _CHARACTERS.get(inner, UNKNOWN)


def _verdict(head: str, content: str, arguments: list[str]) -> bool | None:
    """Whether a logical expression or a comparison holds; None if it is neither, or not known."""
    if head == "PLATFORM_ID":
        return "Linux" in arguments
    if UNKNOWN in content or MAYBE in content:
        return None
    if head == "BOOL":
        return bool(content) and truth(content) is not False
    if head in ("STREQUAL", "EQUAL") and len(arguments) == 2:
        return arguments[0] == arguments[1]
    if head not in _LOGIC or not _BITS.issuperset(arguments):
        return None
    return _LOGIC[head](argument == "1" for argument in arguments)
