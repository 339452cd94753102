# SPDX-License-Identifier: Apache-2.0
"""What an opening brace after the tokens of a C++ declaration begins: a container, a body, or a part of it."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum

from haros_ci.regex import regex

_CLASS_KEYS = frozenset({"class", "struct", "union", "enum"})
KEYS = _CLASS_KEYS | {"namespace"}
#: A parenthesis after one of these holds no parameters.
_NOT_NAMES = frozenset(
    (
        *("decltype", "alignas", "noexcept", "__attribute__", "__declspec", "explicit", "requires", "throw", "typeof"),
        *("__typeof__", "sizeof", "asm", "void", "bool", "char", "int", "short", "long", "float", "double"),
        *("signed", "unsigned", "auto", "const", "volatile", "return"),
    )
)
_CONTROL = frozenset({"if", "for", "while", "switch", "catch", "do", "else", "try"})
_QUALIFIERS = frozenset({"const", "volatile", "noexcept", "override", "final", "mutable", "&", "&&"})
_WORD = regex(r"[A-Za-z_]")
_MACRO = regex(r"[A-Z][A-Z0-9_]+\Z")
_LONGEST_ARGUMENTS = 120

Item = str | list[str]  # a token, or the tokens of one parenthesis


class DeclarationKind(Enum):
    """CONTAINER holds declarations; BODY is skipped and ends the declaration; PART is skipped within it."""

    CONTAINER = 1
    BODY = 2
    PART = 3


def classify(head: Sequence[str], last: str, inside: str) -> tuple[DeclarationKind, str]:
    """Kind and name of what ``{`` begins after the tokens *head*, the last of them *last*, in the class *inside*."""
    items = _items(head)
    if not items:
        return DeclarationKind.BODY, ""
    if "namespace" in items:
        return DeclarationKind.CONTAINER, _qualified_from(items, items.index("namespace") + 1)
    if items[0] == "extern" and len(items) == 2 and isinstance(items[1], str) and items[1].startswith('"'):
        return DeclarationKind.CONTAINER, ""
    if "=" in items:
        return DeclarationKind.PART, ""
    key = next((i for i, item in enumerate(items) if isinstance(item, str) and item in _CLASS_KEYS), None)
    if key is not None:
        name = _class_name(items[key + 1 :])
        if name is not None:
            return (DeclarationKind.BODY if items[key] == "enum" else DeclarationKind.CONTAINER), name
    return _function(items, last, inside)


def _items(head: Sequence[str]) -> list[Item]:
    """Tokens with parentheses folded, template arguments and ``[[attributes]]`` dropped, operator names joined."""
    return _fold(head, angles=True) or _fold(head, angles=False) or []


def _fold(head: Sequence[str], *, angles: bool) -> list[Item] | None:
    """None where a ``<`` stays open, so that it was no bracket."""
    items: list[Item] = []
    group: list[str] = []
    opened: list[str] = []
    index = 0
    while index < len(head):
        token = head[index]
        index += 1
        if token == "operator" and not opened:
            name, index = _operator(head, index)
            items.append(name)
            continue
        outermost = not opened
        if token in "([" or (token == "<" and angles and index > 1 and _WORD.match(head[index - 2])):
            opened.append(token)
        elif token == ">" and opened and opened[-1] == "<":
            opened.pop()
        elif token in ")]":
            while opened and opened.pop() == "<":
                pass
        if not outermost:
            if opened:
                group.append(token)
            elif token == ")":
                items.append(group)
                group = []
            else:
                group = []
        elif not opened and token not in ")]":
            items.append(token)
    if "<" in opened:
        return None
    return [item for item in items if item != "template"]


def _operator(head: Sequence[str], index: int) -> tuple[str, int]:
    """The name of an operator whose symbol starts at *index*, and where its parameters begin."""
    if head[index : index + 2] == ["(", ")"]:
        return "operator()", index + 2
    symbol: list[str] = []
    while index < len(head) and head[index] != "(":
        symbol.append(head[index])
        index += 1
    space = " " if symbol and _WORD.match(symbol[0]) else ""
    return f"operator{space}{''.join(symbol)}", index


def _qualified_from(items: Sequence[Item], index: int) -> str:
    """``a::b`` from the items at *index* on."""
    name = ""
    for item in items[index:]:
        if not isinstance(item, str) or not (item == "::" or _WORD.match(item)):
            break
        if item == "inline":
            continue
        if name and item != "::" and not name.endswith("::"):
            break
        name += item
    return name


def _class_name(after: Sequence[Item]) -> str | None:
    """The name in a class head that follows its keyword, "" if it has none; None if a function returns the class."""
    head = list(after[: after.index(":")]) if ":" in after else list(after)
    while head and head[-1] in ("final", "class", "struct"):
        head.pop()
    groups = [i for i, item in enumerate(head) if isinstance(item, list)]
    if groups and not any(isinstance(item, str) and item not in _QUALIFIERS for item in head[groups[-1] + 1 :]):
        return None
    start = len(head)
    while start > 0 and isinstance(word := head[start - 1], str) and _WORD.match(word):
        start -= 1
        if start == 0 or head[start - 1] != "::":
            break
        start -= 1
    return _qualified_from(head, start)


def _function(items: Sequence[Item], last: str, inside: str) -> tuple[DeclarationKind, str]:
    groups = [i for i, item in enumerate(items) if isinstance(item, list)]
    if not groups:
        control = any(item in _CONTROL for item in items if isinstance(item, str))
        return (DeclarationKind.BODY if control else DeclarationKind.PART), ""
    colon = next((i for i in range(groups[0], len(items)) if items[i] == ":"), len(items))
    if colon < len(items) and (_WORD.match(last) or last == ">") and last != "try":
        return DeclarationKind.PART, ""  # a member's initializer in braces
    found = [(start, name, i) for i in groups if i < colon for start, name in _named(items, i)]
    if not found:
        return DeclarationKind.BODY, ""
    start, name, group = found[0]
    if start == 0 and "::" not in name and name != inside:
        for later_start, later_name, _later_group in found[1:]:
            if _is_type(items[later_start - 1]) or "::" in later_name or later_name == inside:
                return DeclarationKind.BODY, later_name
        if _MACRO.match(name):
            return DeclarationKind.BODY, f"{name}({_arguments(items[group])})"
    return DeclarationKind.BODY, name


def _is_type(item: Item) -> bool:
    """Whether the last word of a type may be *item*."""
    return (
        isinstance(item, str)
        and item not in _QUALIFIERS
        and (item in ("*", "&", "*&") or _WORD.match(item) is not None)
    )


def _named(items: Sequence[Item], group: int) -> list[tuple[int, str]]:
    """Where the name before the parenthesis at *group* starts, and the name; nothing if none stands there."""
    index = group - 1
    name = items[index] if index >= 0 else ""
    if not isinstance(name, str) or not _WORD.match(name) or name in _NOT_NAMES or name in _CONTROL:
        return []
    if index and items[index - 1] == "~":
        index -= 1
        name = f"~{name}"
    while index > 1 and items[index - 1] == "::":
        outer = items[index - 2]
        if not isinstance(outer, str) or not _WORD.match(outer) or outer in _NOT_NAMES:
            break
        index -= 2
        name = f"{outer}::{name}"
    return [(index, name)]


def _arguments(group: Item) -> str:
    return "".join(f"{token} " if token == "," else token for token in group)[:_LONGEST_ARGUMENTS].rstrip()
