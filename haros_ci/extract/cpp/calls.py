# SPDX-License-Identifier: Apache-2.0
"""Calls, member accesses and what else makes objects."""

from __future__ import annotations

from tree_sitter import Node

from haros_ci import syntax
from haros_ci.extract.cpp import expansion, expressions, types
from haros_ci.extract.cpp.grammar import field, kinds
from haros_ci.extract.cpp.unit import Unit

_ARGUMENTS = field("arguments")
_VALUE = field("value")
_TYPE = field("type")
_DECLARATOR = field("declarator")
_CASTS = frozenset(("static_cast", "dynamic_cast", "const_cast", "reinterpret_cast"))
#: Namespaces whose class templates are known by their methods' names.
_SPACES = ("std::", "boost::", "ros::", "rclcpp::")
_IDENTIFIER = kinds("identifier")
_QUALIFIED = kinds("qualified_identifier")
_TEMPLATE_FUNCTION = kinds("template_function template_type")
_TEMPLATE_METHOD = kinds("template_method")
_DEPENDENT = kinds("dependent_name")
_FIELD_EXPRESSION = kinds("field_expression")


def call(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    """A call or a named cast."""
    children = node.children
    if len(children) != 2:
        return unit.opaque(node)
    function, argument = children
    kind = function.kind_id
    chosen: tuple[syntax.Argument, ...] = ()
    callee: syntax.Expression
    if kind in _IDENTIFIER:
        expanded = expansion.expression(unit, node, depth) if unit.found.callable_macros else None
        if expanded is not None:
            return expanded
        callee = syntax.Name(unit.cut(function))
    elif kind in _FIELD_EXPRESSION:
        callee, chosen = _member(unit, function, depth + 1)
    elif kind in _QUALIFIED or kind in _TEMPLATE_FUNCTION:
        name, chosen = types.path(unit, function, depth)
        callee = syntax.Name(name)
        if not chosen and kind in _QUALIFIED and not name.startswith(_SPACES):
            around = types.path(unit, function, depth, True)[1]
            chosen = (syntax.Type(syntax.OF_CLASS, around),) if around else ()
        if name in _CASTS and len(chosen) == 1 and isinstance(chosen[0], syntax.Type):
            values = expressions.arguments(unit, argument, depth)
            return syntax.Cast(chosen[0], values[0] if len(values) == 1 else unit.opaque(argument))
    else:
        callee = expressions.expression(unit, function, depth)
        if isinstance(callee, syntax.TypeName):
            callee = syntax.Name(callee.type.name)
    line, column = unit.position(node)
    return syntax.Call(callee, expressions.arguments(unit, argument, depth), chosen, line, column)


#: Methods of smart pointers, which ``p.reset()`` calls; ``p->reset()`` calls that of the object, as ``(*p).reset()`` does ([expr.ref]).
OF_POINTERS = frozenset(("reset", "get", "release", "use_count", "unique", "swap"))


def _member(unit: Unit, node: Node, depth: int) -> tuple[syntax.Expression, tuple[syntax.Argument, ...]]:
    """A member access, and the template arguments after it."""
    children = node.children
    if len(children) != 3:
        return expressions.damaged(unit, node, children, depth), ()
    receiver, operator, member = children
    inner = expressions.expression(unit, receiver, depth)
    if operator.end_byte - operator.start_byte > 1 and unit.text[operator.end_byte - 1] == "*":
        return syntax.Operation(unit.cut(operator), (inner, expressions.expression(unit, member, depth))), ()
    if unit.cut(member) in OF_POINTERS and unit.cut(operator) == "->" and _is_variable(inner):
        inner = syntax.Dereference(inner)
    kind = member.kind_id
    if kind in _DEPENDENT or kind in _TEMPLATE_METHOD or kind in _QUALIFIED:
        name, chosen = types.path(unit, member, depth)
        return syntax.Member(inner, name), chosen
    return syntax.Member(inner, unit.cut(member)), ()


def _is_variable(expression: syntax.Expression) -> bool:
    """Whether *expression* is a variable, a member or an element of one, without a call: what may hold a smart pointer."""
    while type(expression) is syntax.Member or type(expression) is syntax.Subscript:
        if type(expression) is syntax.Subscript and type(expression.index) not in (syntax.Name, syntax.Number):
            return False
        expression = expression.object
        if type(expression) is syntax.This:
            return True
    return type(expression) is syntax.Name


def field_access(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    """``a.b``, ``a->b``."""
    return _member(unit, node, depth)[0]


def new(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    """``new T(x)``; an array of T is a pointer to it."""
    type_node = node.child_by_field_id(_TYPE)
    if type_node is None:
        return unit.opaque(node)
    argument = node.child_by_field_id(_ARGUMENTS)
    made = types.plain_type(unit, type_node, depth)
    if node.child_by_field_id(_DECLARATOR) is not None:
        made = made.marked("*")
    line, column = unit.position(node)
    arguments = () if argument is None else expressions.arguments(unit, argument, depth)
    there = _placed(unit, node, depth)
    if there is not None:
        return syntax.Assignment(
            "=", there, syntax.Call(syntax.Name(made.name), arguments, made.arguments, line, column)
        )
    return syntax.New(made, arguments, line, column)


def _placed(unit: Unit, node: Node, depth: int) -> syntax.Expression | None:
    """The variable in whose place a statement makes an object anew: ``new (&x) T(y);`` is ``x = T(y);``. None for other forms."""
    placement = node.child_by_field_name("placement")
    parent = node.parent
    if placement is None or parent is None or parent.type != "expression_statement":
        return None
    places = expressions.arguments(unit, placement, depth)
    return places[0].value if len(places) == 1 and isinstance(places[0], syntax.Address) else None


#: Containers with a constructor of a list of elements.
_OF_ELEMENTS = frozenset(("vector", "list", "deque", "set", "unordered_set", "array"))


def braced(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    """``T{x}``: a call; of a container, which takes braces for its elements, a call with the list of these ([dcl.init.list])."""
    type_node, value = node.child_by_field_id(_TYPE), node.child_by_field_id(_VALUE)
    if type_node is None or value is None:
        return unit.opaque(node)
    made = expressions.named_type(unit, type_node, depth).type
    line, column = unit.position(node)
    arguments = expressions.arguments(unit, value, depth)
    if arguments and made.name.rpartition("::")[2] in _OF_ELEMENTS:
        arguments = (syntax.ListLiteral(arguments),)
    return syntax.Call(syntax.Name(made.name), arguments, made.arguments, line, column)
