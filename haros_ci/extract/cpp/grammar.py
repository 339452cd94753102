# SPDX-License-Identifier: Apache-2.0
"""The C++ grammar: node kinds by number, so that dispatch is one look-up of a small integer."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from typing import TypeVar

import tree_sitter_cpp
from tree_sitter import Language, Node, Parser, TreeCursor

LANGUAGE = Language(tree_sitter_cpp.language())
ERROR = 65535

_CHUNK = 1 << 16
_STEPS = 10_000
_BYTES_PER_STEP = 4

_Handler = TypeVar("_Handler")


def kinds(names: str) -> frozenset[int]:
    """The numbers of the node kinds called one of *names*: a kind may have several, for aliases and bare tokens."""
    numbers = _numbers()
    return frozenset(number for name in names.split() for number in numbers.get(name, ()))


@cache
def _numbers() -> Mapping[str, Sequence[int]]:
    """The numbers of all node kinds by name; the grammar is asked for them once, as 170 sets and tables are made of them."""
    found: dict[str, list[int]] = {"ERROR": [ERROR]}
    for number in range(LANGUAGE.node_kind_count):
        found.setdefault(LANGUAGE.node_kind_for_id(number) or "", []).append(number)
    return found


def table(handlers: Mapping[str, _Handler]) -> dict[int, _Handler]:
    """*handlers*, whose keys are space-separated kind names, by kind number."""
    return {number: handler for names, handler in handlers.items() for number in kinds(names)}


def field(name: str) -> int:
    """The number of a field of the grammar."""
    number = LANGUAGE.field_id_for_name(name)
    assert number is not None, name
    return number


def parse(data: bytes) -> Node | None:
    """The root of the tree of *data*, UTF-8; None where the parser needs many times more steps than for any code."""
    steps = 0
    limit = _STEPS + len(data) // _BYTES_PER_STEP

    def read(offset: int, _point: object) -> bytes:
        return data[offset : offset + _CHUNK]

    def is_enough(_offset: int, _has_error: bool) -> bool:
        nonlocal steps
        steps += 1
        return steps > limit

    try:
        return Parser(LANGUAGE).parse(read, progress_callback=is_enough).root_node
    except ValueError:
        return None


def onwards(cursor: TreeCursor, is_inside: bool) -> bool:
    """Move *cursor* on in the order of the text, past what is in its node unless *is_inside*; False at the end.

    What a cursor has passed is not kept: walking so is several times faster than by the children of nodes.
    """
    if is_inside and cursor.goto_first_child():
        return True
    while not cursor.goto_next_sibling():
        if not cursor.goto_parent():
            return False
    return True


def errors(root: Node, limit: int) -> list[Node]:
    """The first *limit* ERROR nodes under *root*, outermost ones, in the order of the text."""
    found: list[Node] = []
    if not root.has_error:
        return found
    waiting = [root]
    while waiting and len(found) < limit:
        node = waiting.pop()
        if node.kind_id == ERROR:
            found.append(node)
        else:
            waiting.extend(child for child in reversed(node.children) if child.has_error)
    return found


def missing(root: Node, limit: int) -> list[Node]:
    """The first *limit* tokens under *root* that the parser made up to go on."""
    found: list[Node] = []
    waiting = [root] if root.has_error else []
    while waiting and len(found) < limit:
        node = waiting.pop()
        if node.is_missing:
            found.append(node)
        else:
            waiting.extend(child for child in node.children if child.has_error)
    return found
