# SPDX-License-Identifier: Apache-2.0
"""Variables that point to functions and methods (``void (C::*m)() = &C::go;``), which the parser takes for a call of ``void``."""

from __future__ import annotations

from tree_sitter import Node

from haros_ci import syntax
from haros_ci.extract.cpp import expressions
from haros_ci.extract.cpp.grammar import field, kinds
from haros_ci.extract.cpp.unit import Unit

_CALL = kinds("call_expression")
_ASSIGNMENT = kinds("assignment_expression")
_QUALIFIED = kinds("qualified_identifier")
_POINTED = kinds("pointer_type_declarator")
_DEREFERENCE = kinds("pointer_expression")
_PRIMITIVE = kinds("primitive_type")
_IDENTIFIER = kinds("identifier")
_ARGUMENT = field("argument")
_FUNCTION, _ARGUMENTS, _LEFT, _RIGHT = field("function"), field("arguments"), field("left"), field("right")
_NAME, _DECLARATOR = field("name"), field("declarator")
POSTFIX = kinds("subscript_expression call_expression field_expression")
_MEMBER = kinds("field_expression")
_POINTERS = (".*", "->*")
#: Scopes before ``*`` that are gone through.
DEEPEST = 8
KIND = syntax.Type("()", (syntax.Type("void"),), "*")


def variable(unit: Unit, node: Node, depth: int) -> syntax.Variable | None:
    """The variable that an expression declares as it stands there; None for any other expression."""
    is_set = node.kind_id in _ASSIGNMENT
    call = node.child_by_field_id(_LEFT) if is_set else node
    if call is None or call.kind_id not in _CALL:
        return None
    inner = call.child_by_field_id(_FUNCTION)
    arguments = inner.child_by_field_id(_ARGUMENTS) if inner is not None and inner.kind_id in _CALL else None
    named = arguments.named_children if arguments is not None else ()
    pointed = _pointed(named[0], inner.child_by_field_id(_FUNCTION)) if inner is not None and len(named) == 1 else None
    if pointed is None:
        return None
    value = node.child_by_field_id(_RIGHT) if is_set else None
    init = None if value is None else syntax.Equals(expressions.expression(unit, value, depth))
    return syntax.Variable(unit.cut(pointed), KIND, init, *unit.position(pointed))


def regrouped(unit: Unit, node: Node, found: syntax.Expression) -> syntax.Expression:
    """*found*, what the *node* in parentheses is, with ``a->*m[0]`` as ``a->*(m[0])``: the parser takes it for ``(a->*m)[0]`` ([expr.mptr.oper])."""
    for _ in range(DEEPEST):
        operator = node.children[1] if node.child_count > 1 else None
        if node.kind_id in _MEMBER and operator is not None and unit.cut(operator) in _POINTERS:
            break
        if node.kind_id not in POSTFIX:
            return found
        node = node.children[0]
    left, right = _apart(found)
    return found if left is None else syntax.Operation(".*", (left, right))


def _apart(found: syntax.Expression) -> tuple[syntax.Expression | None, syntax.Expression]:
    """The object of ``.*`` inside of *found*, and what is left of *found* with the pointer in the place of that."""
    if type(found) is syntax.Operation and found.operator in _POINTERS:
        return found.operands[0], found.operands[1]
    if type(found) is syntax.Subscript or type(found) is syntax.Member:
        left, right = _apart(found.object)
        return left, syntax.replace(found, object=right)
    if type(found) is syntax.Call:
        left, right = _apart(found.callee)
        is_grouped = right == syntax.Unknown("") and len(found.arguments) == 1
        return left, found.arguments[0] if is_grouped else syntax.replace(found, callee=right)
    return None, found


def _pointed(node: Node | None, kind: Node | None) -> Node | None:
    """``m`` of ``C::*m``, and of ``*m`` behind a type such as ``void``, which nobody calls."""
    for _ in range(DEEPEST):
        if node is None or node.kind_id not in _QUALIFIED:
            break
        node = node.child_by_field_id(_NAME)
    if node is not None and node.kind_id in _POINTED:
        return node.child_by_field_id(_DECLARATOR)
    if node is not None and node.kind_id in _DEREFERENCE and kind is not None and kind.kind_id in _PRIMITIVE:
        argument = node.child_by_field_id(_ARGUMENT)
        return argument if argument is not None and argument.kind_id in _IDENTIFIER else None
    return None
