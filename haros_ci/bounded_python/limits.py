# SPDX-License-Identifier: Apache-2.0
"""How large the values of expressions may become; all that grows is checked before it is made."""

from __future__ import annotations

import ast
import warnings
from functools import lru_cache
from typing import Any

from haros_ci.records import dataclass
from haros_ci.regex import regex

#: The formats of ``%`` that make nothing longer than what they are given.
_PLAIN_FORMATS = regex(r"(?:[^%]|%[sd%])*\Z")


@dataclass(frozen=True, slots=True)
class Limits:
    """How much an expression may hold and make.

    *characters* of its text, *depth* of its syntax, *size* of a text or collection, *bits* of an integer, *weight* of all that a
    value holds, each time that it holds it; *brackets* and *signs* in its text, where the parser itself is spared deep ones.
    """

    characters: int
    depth: int
    size: int
    bits: int
    weight: int = 60_000
    brackets: int | None = None
    signs: int | None = None


class TooMuch(Exception):
    """A value or a computation over a limit: *what* is ``characters``, ``depth``, ``size`` or ``number``."""

    def __init__(self, what: str = "size") -> None:
        super().__init__(what)
        self.what = what


class NotFollowed(Exception):
    """A computation that is not followed: *node* is the syntax that is not interpreted, *description* says it where the kind of node is not enough."""

    def __init__(self, node: ast.AST | None = None, description: str = "") -> None:
        super().__init__(description)
        self.node = node
        self.description = description


class Module(dict[str, Any]):
    """``math`` and the like: names that are had with a dot; as a value it weighs nothing."""


@lru_cache(maxsize=4_096)
def parsed(text: str, limits: Limits) -> ast.expr:
    """The syntax tree of *text*. TooMuch, or what Python's parser raises."""
    if len(text) > limits.characters or (limits.signs is not None and sum(map(text.count, "([{-~+")) > limits.signs):
        raise TooMuch("characters")
    if limits.brackets is not None and sum(map(text.count, "([{")) > limits.brackets:
        raise TooMuch("depth")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ast.parse(text, mode="eval").body


def bounded(value: Any, limits: Limits) -> Any:
    """*value*, if it is of a size that is allowed."""
    if isinstance(value, (str, bytes, list, tuple, dict, set, frozenset, range)) and len(value) > limits.size:
        raise TooMuch
    if isinstance(value, int) and not isinstance(value, bool) and value.bit_length() > limits.bits:
        raise TooMuch("number")
    return value


def weight(value: Any, limits: Limits) -> int:
    """How much is in *value*, however deep, counting what it holds twice twice; TooMuch over the limit."""
    found = 0
    pending = [value]
    while pending:
        item = pending.pop()
        found += 1
        if isinstance(item, str):
            found += len(item) // 16
        elif isinstance(item, dict) and not isinstance(item, Module):
            pending += item.values()
        elif isinstance(item, (list, tuple, set, frozenset)):
            pending += item
        if found + len(pending) > limits.weight:
            raise TooMuch
    return found


def check_operation(op: ast.operator, left: Any, right: Any, limits: Limits) -> None:
    """TooMuch or NotFollowed if *left* *op* *right* would grow beyond the limits before it could be measured."""
    if isinstance(op, ast.Mult):
        for items, times in ((left, right), (right, left)):
            if (
                isinstance(items, (str, bytes, list, tuple))
                and isinstance(times, int)
                and len(items) * times > limits.size
            ):
                raise TooMuch
    elif isinstance(op, ast.Pow):
        if isinstance(left, int) and isinstance(right, int) and left.bit_length() * abs(right) > limits.bits:
            raise TooMuch("number")
    elif isinstance(op, ast.Mod) and isinstance(left, str) and not _PLAIN_FORMATS.match(left):
        raise NotFollowed(description="formats text in a way that is not interpreted")


def check_text_method(name: str, text: str, arguments: list[Any], limits: Limits) -> None:
    """TooMuch if ``text.name(*arguments)`` would be longer than what is allowed."""
    size = 0
    if name == "replace" and len(arguments) >= 2 and all(isinstance(argument, str) for argument in arguments[:2]):
        size = len(text) + (text.count(arguments[0]) + 1) * len(arguments[1])
    elif name == "join" and arguments and isinstance(arguments[0], (list, tuple, dict, set, frozenset)):
        size = sum(len(argument) + len(text) for argument in arguments[0] if isinstance(argument, str))
    if size > limits.size:
        raise TooMuch
