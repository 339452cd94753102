# SPDX-License-Identifier: Apache-2.0
"""The names in a piece of C++ that may be classes, as they are written; the index decides which of them are."""

from __future__ import annotations

from collections.abc import Iterable

from tree_sitter import Node

from haros_ci.extract.cpp import types
from haros_ci.extract.cpp.grammar import field, kinds, onwards
from haros_ci.extract.cpp.unit import Unit

_FUNCTION, _BODY, _DECLARATOR = field("function"), field("body"), field("declarator")
_TYPE = kinds("type_identifier")
_QUALIFIED = kinds("qualified_identifier dependent_type dependent_name nested_namespace_specifier")
_ARGUMENTS = kinds("template_argument_list")
_CALL = kinds("call_expression")
_NAMED = kinds("identifier template_function")
_DEFINITION = kinds("function_definition inline_method_definition")
_FRIEND = kinds("friend_declaration")


def mentions(unit: Unit, roots: Iterable[Node], *, is_class: bool = False) -> tuple[str, ...]:
    """Types, what names are qualified by, and what is called like a constructor; sorted, each once.

    Classes with a body inside of *roots* speak for themselves; so do, for a class, its methods with a body, and friends
    are not its own.
    """
    found: set[str] = set()
    waiting = list(roots)
    while waiting:
        cursor = waiting.pop().walk()
        is_first, goes_on = True, True
        while goes_on:
            node = cursor.node
            assert node is not None
            is_inside = is_first or (node.is_named and not (_speaks_for_itself(node) or (is_class and _is_apart(node))))
            if is_inside:
                is_inside = _mention(unit, node, found, waiting)
            is_first = False
            goes_on = onwards(cursor, is_inside)
    return tuple(sorted(found))


def _speaks_for_itself(node: Node) -> bool:
    return node.kind_id in types.CLASS_KINDS and node.child_by_field_id(_BODY) is not None


def _is_apart(node: Node) -> bool:
    return node.kind_id in _DEFINITION or node.kind_id in _FRIEND


def _mention(unit: Unit, node: Node, found: set[str], waiting: list[Node]) -> bool:
    """Add what *node* itself mentions; whether what is in it is to be looked at now. Of qualified names the arguments are *waiting*."""
    kind = node.kind_id
    if kind in _TYPE:
        found.add(unit.cut(node))
    elif kind in _QUALIFIED:
        found.add(types.path(unit, node, 0, True)[0])
        waiting.extend(_arguments(node))
        return False
    elif kind in _CALL:
        function = node.child_by_field_id(_FUNCTION)
        if function is not None and function.kind_id in _NAMED:
            found.add(types.path(unit, function, 0)[0])
    return True


def _arguments(node: Node) -> list[Node]:
    """The template arguments in a qualified name."""
    found: list[Node] = []
    waiting = [node]
    while waiting:
        for child in waiting.pop().children:
            if child.kind_id in _ARGUMENTS:
                found.append(child)
            elif child.is_named:
                waiting.append(child)
    return found
