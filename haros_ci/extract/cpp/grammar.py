# SPDX-License-Identifier: Apache-2.0
"""The C++ grammar: node kinds by number, so that dispatch is one look-up of a small integer."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

import tree_sitter_cpp
from tree_sitter import Language, Node, Parser

LANGUAGE = Language(tree_sitter_cpp.language())
ERROR = 65535

_Handler = TypeVar("_Handler")


def kinds(names: str) -> frozenset[int]:
    """The numbers of the node kinds called one of *names*: a kind may have several, for aliases and bare tokens."""
    wanted = frozenset(names.split())
    found = {i for i in range(LANGUAGE.node_kind_count) if LANGUAGE.node_kind_for_id(i) in wanted}
    if "ERROR" in wanted:
        found.add(ERROR)
    return frozenset(found)


def table(handlers: Mapping[str, _Handler]) -> dict[int, _Handler]:
    """*handlers*, whose keys are space-separated kind names, by kind number."""
    return {number: handler for names, handler in handlers.items() for number in kinds(names)}


def field(name: str) -> int:
    """The number of a field of the grammar."""
    number = LANGUAGE.field_id_for_name(name)
    assert number is not None, name
    return number


def parse(data: bytes) -> Node:
    """The root of the tree of *data*, UTF-8."""
    return Parser(LANGUAGE).parse(data).root_node


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
