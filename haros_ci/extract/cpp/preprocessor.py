# SPDX-License-Identifier: Apache-2.0
"""Preprocessor conditionals in the tree: their branches and conditions."""

from __future__ import annotations

from tree_sitter import Node

from haros_ci.extract.cpp.blanks import compared
from haros_ci.extract.cpp.grammar import field, kinds
from haros_ci.extract.cpp.unit import Unit
from haros_ci.regex import regex

CONDITIONAL = kinds("preproc_if preproc_ifdef")
_ALTERNATIVES = kinds("preproc_else preproc_elif preproc_elifdef")
_DEFINITION = kinds("preproc_def")
_NAME = field("name")
_CONDITION = field("condition")
_NEVER = regex(r"#\s*(?:if|elif)\s+(?:0|false)")
#: A condition that compares two numbers or macros.
_COMPARED = regex(r"#\s*(?:el)?if\s+(\w+)\s*(==|!=)\s*(\w+)")
#: Macros in place of macros that are followed.
_DEEPEST = 8
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


def holds(unit: Unit, text: str) -> bool | None:
    """Whether the condition of a branch holds: ``#if A == B`` of macros that this file defines once, under no condition, as numbers."""
    found = _COMPARED.fullmatch(text)
    if found is None:
        return None
    left, right = _number(unit, found[1], _DEEPEST), _number(unit, found[3], _DEEPEST)
    return None if left is None or right is None else (left == right) is (found[2] == "==")


def _number(unit: Unit, word: str, depth: int) -> int | None:
    if word.isdecimal():
        return int(word) if len(word) < 20 else None
    bodies = {body for name, parameters, body in unit.found.macros if name == word and parameters is None}
    if len(bodies) != 1 or word in unit.found.guarded or not depth:
        return None
    body = bodies.pop()
    return _number(unit, body, depth - 1) if body.isidentifier() or body.isdecimal() else None
