# SPDX-License-Identifier: Apache-2.0
"""Expressions."""

from __future__ import annotations

from collections.abc import Callable

from tree_sitter import Node

from haros_ci import syntax
from haros_ci.extract.cpp import calls, functions, literals, method_pointers, splits, types
from haros_ci.extract.cpp.grammar import ERROR, field, kinds, table
from haros_ci.extract.cpp.unit import DEEPEST, TOO_DEEP, Unit

_ARGUMENT = field("argument")
_VALUE = field("value")
_UPDATED = field("update")
_TYPE = field("type")

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
_BINARY = kinds("binary_expression")
_LISTS = kinds("argument_list initializer_list")
_MENDED = kinds("assignment_expression binary_expression initializer_list")
_BLOCK = kinds("compound_statement")
_DESIGNATOR = kinds("field_designator")
_DESCRIPTOR = kinds("type_descriptor")
_UNUSED = kinds("expression_statement comma_expression")

Handler = Callable[[Unit, Node, int], syntax.Expression]


def expression(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    """The expression that *node* stands for; unknown below DEEPEST or where nothing fits."""
    if depth > DEEPEST:
        unit.problem(node, TOO_DEEP)
        return unit.opaque(node)
    kind = node.kind_id
    if node.has_error and kind not in _MENDED and is_damaged(node):
        return damaged(unit, node, node.children, depth + 1)
    handler = _HANDLERS.get(kind)
    if handler is not None and unit.found.splits:
        if (split := unit.split(node)) is not None:
            return splits.expression(unit, node, depth, split, expression)
        if (further := splits.going_on(unit, node)) is not None:
            return splits.longer(unit, node, depth, *further, expression)
    return unit.opaque(node) if handler is None else handler(unit, node, depth + 1)


def is_damaged(node: Node) -> bool:
    """Whether part of *node* itself is a syntax error, so that what is left of it does not mean what it says."""
    return node.has_error and any(child.kind_id == ERROR for child in node.children)


def damaged(unit: Unit, node: Node, nodes: list[Node], depth: int) -> syntax.Expression:
    """What is around a syntax error: of unknown value, but with the calls that can be found."""
    inside = []
    for other_node in nodes:
        if other_node.kind_id in _HANDLERS:
            inside.append(expression(unit, other_node, depth))
        elif (other_node.kind_id in _LISTS or other_node.kind_id == ERROR) and depth < DEEPEST:
            inside.append(damaged(unit, other_node, other_node.children, depth + 1))
    return (
        syntax.Operation("?", (unit.opaque(node), syntax.ListLiteral(tuple(inside)))) if inside else unit.opaque(node)
    )


def arguments(unit: Unit, node: Node, depth: int) -> tuple[syntax.Expression, ...]:
    """The expressions of an argument list or of braces; an unknown number where there is a syntax error."""
    if is_damaged(node):
        return (syntax.Star(damaged(unit, node, node.children, depth)),)
    found: list[syntax.Expression] = []
    for child in node.children:
        if child.is_named:
            kind = child.kind_id
            if kind in _BLOCK:
                found.append(functions.block_as_lambda(unit, child, depth))
            else:
                found.append(expression(unit, child, depth))
    return tuple(found)


def _operands(node: Node) -> list[Node]:
    return [child for child in node.children if child.is_named]


def _name(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    text = unit.cut(node)
    return syntax.Name(text) if text else syntax.Unknown("")


def _qualified(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    name, arguments = types.path(unit, node, depth)
    trait = name.removesuffix("_v").removesuffix("::value")
    if (
        trait != name and arguments and trait.startswith("std::is_")
    ):  # a question about types is one call, in both forms
        return syntax.Call(syntax.Name(trait), (), arguments, *unit.position(node))
    return syntax.Name(name)


def _binary(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    """Chains such as ``a << b << c`` lean to the left: they are unrolled, for speed and for the stack."""
    waiting: list[tuple[str, Node]] = []
    left = node
    while left.kind_id in _BINARY and depth + len(waiting) <= DEEPEST:
        children = left.children
        if len(children) != 3:
            break
        operator = unit.text[children[1].start_byte : children[1].end_byte]
        waiting.append((_SPELLED.get(operator, operator), children[2]))
        left = children[0]
    if depth + len(waiting) > DEEPEST:
        result = unit.opaque(left)
        unit.problem(left, TOO_DEEP)
    elif left.kind_id in _BINARY:
        result = damaged(unit, left, left.children, depth + len(waiting))
    else:
        result = expression(unit, left, depth + len(waiting) - 1)
    level = len(waiting)
    for operator, right in reversed(waiting):
        level -= 1
        result = syntax.Operation(operator, (result, expression(unit, right, depth + level)))
    return result


def _unary(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    children = node.children
    operator = unit.cut(children[0])
    value = expression(unit, children[-1], depth)
    operator = _SPELLED.get(operator, operator)
    if isinstance(value, syntax.Number) and operator in ("-", "+"):
        return syntax.Number(-value.value if operator == "-" else value.value)
    return syntax.Operation(operator, (value,))


def _pointer(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    children = node.children
    kind = syntax.Dereference if unit.cut(children[0]) == "*" else syntax.Address
    return kind(expression(unit, children[-1], depth))


def _set(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    children = node.children
    operator = next((child for child in children if not child.is_named), None)
    if operator is None or len(children) < 2:
        return unit.opaque(node)
    text = unit.cut(operator)
    target = expression(unit, children[0], depth)
    is_whole = len(children) == 3
    value = expression(unit, children[2], depth) if is_whole else damaged(unit, node, children[1:], depth)
    return syntax.Assignment(_SPELLED.get(text, text), target, value)


def _update(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    argument = node.child_by_field_id(_ARGUMENT)
    if argument is None:
        return unit.opaque(node)
    is_prefix = argument.start_byte > node.start_byte
    sign = unit.text[node.start_byte] if is_prefix else unit.text[node.end_byte - 1]
    changed = syntax.Assignment(sign + "=", expression(unit, argument, depth), syntax.Number(1))
    above = node.parent
    if is_prefix or above is None or above.kind_id in _UNUSED or above.child_by_field_id(_UPDATED) == node:
        return changed
    return syntax.Operation("-" if sign == "+" else "+", (changed, syntax.Number(1)))  # x++ is (x += 1) - 1


def _conditional(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    values = [expression(unit, child, depth) for child in _operands(node)]
    if len(values) == 3:
        return syntax.Conditional(values[0], values[1], values[2])
    return syntax.Conditional(values[0], values[0], values[1]) if len(values) == 2 else unit.opaque(node)


def _parentheses(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    for child in _operands(node):
        if child.kind_id in _BLOCK:
            line, column = unit.position(child)
            return syntax.Call(functions.block_as_lambda(unit, child, depth), (), (), line, column)
        found = expression(unit, child, depth)
        return method_pointers.regrouped(unit, child, found) if child.kind_id in method_pointers.POSTFIX else found
    return unit.opaque(node)


def _comma(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    return syntax.Operation(",", tuple(expression(unit, child, depth) for child in _operands(node)))


def _fold(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    """``(f(a), ...)`` as a call of ``[fold]``; other operators are not read."""
    parts = [child for child in node.children if child.is_named]
    if len(parts) != 1 or all(unit.cut(child) != "," for child in node.children if not child.child_count):
        return unit.opaque(node)
    line, column = unit.position(node)
    return syntax.Call(syntax.Name("[fold]"), (expression(unit, parts[0], depth),), (), line, column)


def _index(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    children = _operands(node)
    if len(children) != 2:
        return unit.opaque(node)
    inside = arguments(unit, children[1], depth)
    subscript = inside[0] if len(inside) == 1 else syntax.ListLiteral(inside)
    return syntax.Subscript(expression(unit, children[0], depth), subscript)


def _cast(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    type_node, value = node.child_by_field_id(_TYPE), node.child_by_field_id(_VALUE)
    if type_node is None or value is None:
        return unit.opaque(node)
    return syntax.Cast(types.descriptor(unit, type_node, depth), expression(unit, value, depth))


def _keyword(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    children = node.children
    operands = _operands(node)
    if not operands:
        return unit.opaque(node)
    return syntax.Operation(unit.cut(children[0]), (expression(unit, operands[-1], depth),))


def named_type(unit: Unit, node: Node, depth: int) -> syntax.TypeName:
    """The name of a type where an expression is expected."""
    if node.kind_id in _DESCRIPTOR:
        return syntax.TypeName(types.descriptor(unit, node, depth))
    return syntax.TypeName(types.plain_type(unit, node, depth))


def _string(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    return syntax.String(literals.string(unit.cut(node)))


def _strings(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    pieces: list[syntax.Expression] = []
    for child in _operands(node):
        piece = expression(unit, child, depth)
        last = pieces[-1] if pieces else None
        if isinstance(piece, syntax.String) and isinstance(last, syntax.String):
            pieces[-1] = syntax.String(last.value + piece.value)
        else:
            pieces.append(piece)
    return pieces[0] if len(pieces) == 1 else syntax.Format(tuple(pieces))


def _number(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    value = literals.number(unit.text[node.start_byte : node.end_byte])
    return unit.opaque(node) if value is None else syntax.Number(value)


def _suffixed(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    children = node.children
    value, suffix = expression(unit, children[0], depth), unit.cut(children[-1])
    if isinstance(value, syntax.String) and suffix in ("s", "sv"):
        return value
    line, column = unit.position(node)
    return syntax.Call(syntax.Name('operator""' + suffix), (value,), (), line, column)


def _character(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    text = unit.cut(node)
    value = literals.character(text)
    if value is None:
        return unit.opaque(node)
    is_wide = text.startswith(("L", "u'", "U"))
    return syntax.Number(value) if is_wide else syntax.Cast(syntax.Type("char"), syntax.Number(value))


def _designated(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    children = node.children
    value = expression(unit, children[-1], depth)
    first = children[0]
    return syntax.Keyword(unit.cut(first)[1:].strip(), value) if first.kind_id in _DESIGNATOR else value


def _pack(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    return syntax.Star(expression(unit, node.children[0], depth))


def _list(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    return syntax.ListLiteral(arguments(unit, node, depth))


def _lambda(unit: Unit, node: Node, depth: int) -> syntax.Expression:
    return functions.lambda_expression(unit, node, depth)


def _constant(value: syntax.Expression) -> Handler:
    return lambda unit, node, depth: value


_HANDLERS: dict[int, Handler] = table(
    {
        "identifier field_identifier namespace_identifier operator_name destructor_name": _name,
        "qualified_identifier template_function template_method dependent_name": _qualified,
        "this": _constant(syntax.This()),
        "true": _constant(syntax.Boolean(True)),
        "false": _constant(syntax.Boolean(False)),
        "null": _constant(syntax.Null()),
        "field_expression": calls.field_access,
        "call_expression": calls.call,
        "binary_expression": _binary,
        "unary_expression co_await_expression": _unary,
        "pointer_expression": _pointer,
        "assignment_expression": _set,
        "update_expression": _update,
        "conditional_expression": _conditional,
        "parenthesized_expression condition_clause": _parentheses,
        "comma_expression": _comma,
        "fold_expression": _fold,
        "subscript_expression": _index,
        "new_expression": calls.new,
        "delete_expression sizeof_expression alignof_expression": _keyword,
        "cast_expression": _cast,
        "compound_literal_expression": calls.braced,
        "lambda_expression": _lambda,
        "initializer_list": _list,
        "initializer_pair": _designated,
        "parameter_pack_expansion": _pack,
        "string_literal raw_string_literal": _string,
        "concatenated_string": _strings,
        "number_literal": _number,
        "char_literal": _character,
        "user_defined_literal": _suffixed,
        "type_descriptor type_identifier primitive_type template_type sized_type_specifier dependent_type": named_type,
    }
)
