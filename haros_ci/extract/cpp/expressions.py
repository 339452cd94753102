# SPDX-License-Identifier: Apache-2.0
"""Expressions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from tree_sitter import Node

from haros_ci.extract.cpp import functions, literals, types
from haros_ci.extract.cpp.grammar import ERROR, field, kinds, table
from haros_ci.extract.cpp.unit import DEEPEST, Unit

_FUNCTION = field("function")
_ARGUMENTS = field("arguments")
_LEFT = field("left")
_RIGHT = field("right")
_OPERATOR = field("operator")
_ARGUMENT = field("argument")
_FIELD = field("field")
_VALUE = field("value")
_TYPE = field("type")
_DECLARATOR = field("declarator")

_SPELLED = {
    "and": "&&",
    "or": "||",
    "not": "!",
    "bitand": "&",
    "bitor": "|",
    "xor": "^",
    "compl": "~",
    "not_eq": "!=",
    "and_eq": "&=",
    "or_eq": "|=",
    "xor_eq": "^=",
}
_CASTS = frozenset(("static_cast", "dynamic_cast", "const_cast", "reinterpret_cast"))
_IDENTIFIER = kinds("identifier")
_QUALIFIED = kinds("qualified_identifier")
_TEMPLATE_FUNCTION = kinds("template_function template_type")
_TEMPLATE_METHOD = kinds("template_method")
_DEPENDENT = kinds("dependent_name")
_FIELD_EXPRESSION = kinds("field_expression")
_BINARY = kinds("binary_expression")
_BLOCK = kinds("compound_statement")
_DESIGNATOR = kinds("field_designator")
_DESCRIPTOR = kinds("type_descriptor")
_TOO_DEEP = "nested too deeply: what is inside is not read"

Handler = Callable[[Unit, Node, int], Any]


def expression(unit: Unit, node: Node, depth: int) -> Any:
    """The expression that *node* stands for; ("?", text) below DEEPEST or where nothing fits."""
    if depth > DEEPEST:
        unit.problem(node, _TOO_DEEP)
        return unit.opaque(node)
    handler = _HANDLERS.get(node.kind_id)
    return unit.opaque(node) if handler is None else handler(unit, node, depth + 1)


def arguments(unit: Unit, node: Node, depth: int) -> tuple[Any, ...]:
    """The expressions of an argument list or of braces."""
    found = []
    for child in node.children:
        if child.is_named:
            kind = child.kind_id
            if kind in _BLOCK:
                found.append(functions.block_as_lambda(unit, child, depth))
            elif kind != ERROR:
                found.append(expression(unit, child, depth))
    return tuple(found)


def _parts(node: Node, *fields: int) -> list[Node]:
    """The children in *fields*, for a node that an error or an attribute has given more children; [] if any lacks."""
    found = [node.child_by_field_id(each) for each in fields]
    return [] if None in found else [each for each in found if each is not None]


def _operands(node: Node) -> list[Node]:
    return [child for child in node.children if child.is_named and child.kind_id != ERROR]


def _name(unit: Unit, node: Node, depth: int) -> Any:
    text = unit.cut(node)
    return ("name", text) if text else ("?", "")


def _qualified(unit: Unit, node: Node, depth: int) -> Any:
    return ("name", types.path(unit, node, depth)[0])


def _call(unit: Unit, node: Node, depth: int) -> Any:
    children = node.children
    if len(children) != 2:
        children = _parts(node, _FUNCTION, _ARGUMENTS)
        if not children:
            return unit.opaque(node)
    function, given = children
    kind = function.kind_id
    chosen: tuple[Any, ...] = ()
    callee: Any
    if kind in _IDENTIFIER:
        callee = ("name", unit.cut(function))
    elif kind in _FIELD_EXPRESSION:
        callee, chosen = _member(unit, function, depth + 1)
    elif kind in _QUALIFIED or kind in _TEMPLATE_FUNCTION:
        name, chosen = types.path(unit, function, depth)
        callee = ("name", name)
        if name in _CASTS and len(chosen) == 1:
            values = arguments(unit, given, depth)
            return ("cast", chosen[0], values[0] if len(values) == 1 else unit.opaque(given))
    else:
        callee = expression(unit, function, depth)
        if callee[0] == "type":
            callee = ("name", callee[1][0])
    line, column = unit.position(node)
    return ("call", callee, arguments(unit, given, depth), chosen, line, column)


def _member(unit: Unit, node: Node, depth: int) -> tuple[Any, tuple[Any, ...]]:
    """A member access, and the template arguments after it."""
    children = node.children
    if len(children) != 3:
        children = _parts(node, _ARGUMENT, _OPERATOR, _FIELD)
        if not children:
            return unit.opaque(node), ()
    receiver, operator, member = children
    inner = expression(unit, receiver, depth)
    if operator.end_byte - operator.start_byte > 1 and unit.text[operator.end_byte - 1] == "*":
        return ("op", unit.cut(operator), (inner, expression(unit, member, depth))), ()
    kind = member.kind_id
    if kind in _DEPENDENT or kind in _TEMPLATE_METHOD or kind in _QUALIFIED:
        name, chosen = types.path(unit, member, depth)
        return ("field", inner, name), chosen
    return ("field", inner, unit.cut(member)), ()


def _field(unit: Unit, node: Node, depth: int) -> Any:
    return _member(unit, node, depth)[0]


def _binary(unit: Unit, node: Node, depth: int) -> Any:
    """Chains such as ``a << b << c`` lean to the left: they are unrolled, for speed and for the stack."""
    waiting: list[tuple[str, Node]] = []
    left = node
    while left.kind_id in _BINARY and depth + len(waiting) <= DEEPEST:
        children = left.children
        if len(children) != 3:
            children = _parts(left, _LEFT, _OPERATOR, _RIGHT)
            if not children:
                break
        operator = unit.text[children[1].start_byte : children[1].end_byte]
        waiting.append((_SPELLED.get(operator, operator), children[2]))
        left = children[0]
    if left.kind_id in _BINARY:
        result = unit.opaque(left)
        unit.problem(left, _TOO_DEEP)
    else:
        result = expression(unit, left, depth + len(waiting) - 1)
    level = len(waiting)
    for operator, right in reversed(waiting):
        level -= 1
        result = ("op", operator, (result, expression(unit, right, depth + level)))
    return result


def _unary(unit: Unit, node: Node, depth: int) -> Any:
    children = node.children
    operator = unit.cut(children[0])
    value = expression(unit, children[-1], depth)
    operator = _SPELLED.get(operator, operator)
    if value[0] == "num" and operator in ("-", "+"):
        return ("num", -value[1] if operator == "-" else value[1])
    return ("op", operator, (value,))


def _pointer(unit: Unit, node: Node, depth: int) -> Any:
    children = node.children
    operator = "*" if unit.cut(children[0]) == "*" else "&"
    return (operator, expression(unit, children[-1], depth))


def _set(unit: Unit, node: Node, depth: int) -> Any:
    children = node.children
    if len(children) != 3:
        children = _parts(node, _LEFT, _OPERATOR, _RIGHT)
        if not children:
            return unit.opaque(node)
    operator = unit.cut(children[1])
    target = expression(unit, children[0], depth)
    return ("set", _SPELLED.get(operator, operator), target, expression(unit, children[2], depth))


def _update(unit: Unit, node: Node, depth: int) -> Any:
    argument = node.child_by_field_id(_ARGUMENT)
    if argument is None:
        return unit.opaque(node)
    is_prefix = argument.start_byte > node.start_byte
    sign = unit.text[node.start_byte] if is_prefix else unit.text[node.end_byte - 1]
    return ("set", sign + "=", expression(unit, argument, depth), ("num", 1))


def _conditional(unit: Unit, node: Node, depth: int) -> Any:
    parts = [expression(unit, child, depth) for child in _operands(node)]
    if len(parts) == 3:
        return ("if", parts[0], parts[1], parts[2])
    return ("if", parts[0], parts[0], parts[1]) if len(parts) == 2 else unit.opaque(node)


def _parentheses(unit: Unit, node: Node, depth: int) -> Any:
    for child in _operands(node):
        if child.kind_id in _BLOCK:
            line, column = unit.position(child)
            return ("call", functions.block_as_lambda(unit, child, depth), (), (), line, column)
        return expression(unit, child, depth)
    return unit.opaque(node)


def _comma(unit: Unit, node: Node, depth: int) -> Any:
    return ("op", ",", tuple(expression(unit, child, depth) for child in _operands(node)))


def _index(unit: Unit, node: Node, depth: int) -> Any:
    children = _operands(node)
    if len(children) != 2:
        return unit.opaque(node)
    inside = arguments(unit, children[1], depth)
    subscript = inside[0] if len(inside) == 1 else ("list", inside)
    return ("index", expression(unit, children[0], depth), subscript)


def _new(unit: Unit, node: Node, depth: int) -> Any:
    type_node = node.child_by_field_id(_TYPE)
    if type_node is None:
        return unit.opaque(node)
    given = node.child_by_field_id(_ARGUMENTS)
    made = types.plain_type(unit, type_node, depth)
    if node.child_by_field_id(_DECLARATOR) is not None:
        made = (made[0], made[1], made[2] + "*")
    line, column = unit.position(node)
    return ("new", made, () if given is None else arguments(unit, given, depth), line, column)


def _cast(unit: Unit, node: Node, depth: int) -> Any:
    children = _parts(node, _TYPE, _VALUE)
    if not children:
        return unit.opaque(node)
    return ("cast", types.descriptor(unit, children[0], depth), expression(unit, children[1], depth))


def _braced(unit: Unit, node: Node, depth: int) -> Any:
    children = _parts(node, _TYPE, _VALUE)
    if not children:
        return unit.opaque(node)
    name, chosen, _ = _type(unit, children[0], depth)[1]
    line, column = unit.position(node)
    return ("call", ("name", name), arguments(unit, children[1], depth), chosen, line, column)


def _keyword(unit: Unit, node: Node, depth: int) -> Any:
    children = node.children
    operands = _operands(node)
    if not operands:
        return unit.opaque(node)
    return ("op", unit.cut(children[0]), (expression(unit, operands[-1], depth),))


def _type(unit: Unit, node: Node, depth: int) -> Any:
    if node.kind_id in _DESCRIPTOR:
        return ("type", types.descriptor(unit, node, depth))
    return ("type", types.plain_type(unit, node, depth))


def _string(unit: Unit, node: Node, depth: int) -> Any:
    return ("str", literals.string(unit.cut(node)))


def _strings(unit: Unit, node: Node, depth: int) -> Any:
    parts: list[Any] = []
    for child in _operands(node):
        part = expression(unit, child, depth)
        if part[0] == "str" and parts and parts[-1][0] == "str":
            parts[-1] = ("str", parts[-1][1] + part[1])
        else:
            parts.append(part)
    return parts[0] if len(parts) == 1 else ("format", tuple(parts))


def _number(unit: Unit, node: Node, depth: int) -> Any:
    value = literals.number(unit.text[node.start_byte : node.end_byte])
    return unit.opaque(node) if value is None else ("num", value)


def _suffixed(unit: Unit, node: Node, depth: int) -> Any:
    children = node.children
    value, suffix = expression(unit, children[0], depth), unit.cut(children[-1])
    if value[0] == "str" and suffix in ("s", "sv"):
        return value
    line, column = unit.position(node)
    return ("call", ("name", 'operator""' + suffix), (value,), (), line, column)


def _character(unit: Unit, node: Node, depth: int) -> Any:
    value = literals.character(unit.cut(node))
    return unit.opaque(node) if value is None else ("num", value)


def _designated(unit: Unit, node: Node, depth: int) -> Any:
    children = node.children
    value = expression(unit, children[-1], depth)
    first = children[0]
    return ("kw", unit.cut(first)[1:].strip(), value) if first.kind_id in _DESIGNATOR else value


def _pack(unit: Unit, node: Node, depth: int) -> Any:
    return ("star", expression(unit, node.children[0], depth))


def _list(unit: Unit, node: Node, depth: int) -> Any:
    return ("list", arguments(unit, node, depth))


def _lambda(unit: Unit, node: Node, depth: int) -> Any:
    return functions.lambda_expression(unit, node, depth)


def _constant(value: Any) -> Handler:
    return lambda unit, node, depth: value


_HANDLERS: dict[int, Handler] = table(
    {
        "identifier field_identifier namespace_identifier operator_name destructor_name": _name,
        "qualified_identifier template_function template_method dependent_name": _qualified,
        "this": _constant(("this",)),
        "true": _constant(("bool", True)),
        "false": _constant(("bool", False)),
        "null": _constant(("none",)),
        "field_expression": _field,
        "call_expression": _call,
        "binary_expression": _binary,
        "unary_expression co_await_expression": _unary,
        "pointer_expression": _pointer,
        "assignment_expression": _set,
        "update_expression": _update,
        "conditional_expression": _conditional,
        "parenthesized_expression condition_clause": _parentheses,
        "comma_expression": _comma,
        "subscript_expression": _index,
        "new_expression": _new,
        "delete_expression sizeof_expression alignof_expression": _keyword,
        "cast_expression": _cast,
        "compound_literal_expression": _braced,
        "lambda_expression": _lambda,
        "initializer_list": _list,
        "initializer_pair": _designated,
        "parameter_pack_expansion": _pack,
        "string_literal raw_string_literal": _string,
        "concatenated_string": _strings,
        "number_literal": _number,
        "char_literal": _character,
        "user_defined_literal": _suffixed,
        "type_descriptor type_identifier primitive_type template_type sized_type_specifier dependent_type": _type,
    }
)
