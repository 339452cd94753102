# SPDX-License-Identifier: Apache-2.0
"""Preprocessor conditionals in the tree: their branches and conditions."""

from __future__ import annotations

import re

from tree_sitter import Node

from haros_ci.extract.cpp.blanks import compared
from haros_ci.extract.cpp.grammar import field, kinds
from haros_ci.extract.cpp.unit import Unit

CONDITIONAL = kinds("preproc_if preproc_ifdef")
_ALTERNATIVES = kinds("preproc_else preproc_elif preproc_elifdef")
_DEFINITION = kinds("preproc_def")
_NAME = field("name")
_CONDITION = field("condition")
_NEVER = re.compile(r"#\s*(?:if|elif)\s+(?:0|false)")
_MOST_BRANCHES = 1000

Branch = tuple[int, int, str, list[Node]]


def branches(unit: Unit, node: Node) -> list[Branch]:
    """Line, column and text of each branch's directive, with its contents; none in a branch that is ``#if 0``."""
    found: list[Branch] = []
    current: Node | None = node
    while current is not None and len(found) < _MOST_BRANCHES:
        children = current.children
        condition = current.child_by_field_id(_NAME) or current.child_by_field_id(_CONDITION)
        start = 1
        end = children[0].end_byte if children else current.start_byte
        if condition is not None:
            end = condition.end_byte
            start = next((index for index, child in enumerate(children) if child.start_byte >= end), len(children))
        text = compared(unit.collapsed(current.start_byte, end).replace("\\ ", ""))
        following: Node | None = None
        inside: list[Node] = []
        for child in children[start:]:
            if child.kind_id in _ALTERNATIVES:
                following = child
            elif child.is_named:
                inside.append(child)
        line, column = unit.position(current)
        found.append((line, column, text, [] if _NEVER.fullmatch(text) else inside))
        current = following
    return found


def is_include_guard(unit: Unit, found: list[Branch]) -> bool:
    """Whether the branches are a header's include guard, or ``__cplusplus``: always taken."""
    _, _, text, inside = found[0]
    words = text.replace("(", " ").replace(")", " ").replace("!", " ").split()
    if words and words[-1] == "__cplusplus":
        return True
    if not text.replace(" ", "").startswith(("#ifndef", "#if!defined")) or not inside:
        return False
    first = inside[0]
    if first.kind_id not in _DEFINITION:
        return False
    name = first.child_by_field_id(_NAME)
    return name is not None and unit.cut(name) == words[-1]
