# SPDX-License-Identifier: Apache-2.0
"""Statements and local declarations."""

from __future__ import annotations

from collections.abc import Callable

from tree_sitter import Node

from haros_ci import syntax
from haros_ci.extract.cpp import (
    declarations,
    expansion,
    expressions,
    labels,
    method_pointers,
    preprocessor,
    scopes,
    splits,
    switches,
    types,
)
from haros_ci.extract.cpp.grammar import ERROR, field, kinds, table
from haros_ci.extract.cpp.unit import DEEPEST, TOO_DEEP, CppScope, Unit

_BLOCK = kinds("compound_statement")
_ELSE = kinds("else_clause")
_INIT = kinds("init_statement")
_DECLARATION = kinds("declaration")
_CONDITIONS = kinds("condition_clause parenthesized_expression")
_PATTERN = kinds("structured_binding_declarator")
_CATCH = kinds("catch_clause")
_COLON = kinds(":")
_CALL = kinds("call_expression")
_BODY = field("body")
_CONDITION = field("condition")
_CONSEQUENCE = field("consequence")
_ALTERNATIVE = field("alternative")
_INITIALIZER = field("initializer")
_UPDATE = field("update")
_RIGHT = field("right")
_PARAMETERS = field("parameters")

Statements = list[syntax.Statement]
Handler = Callable[[Unit, Node, int, Statements], None]


def block(unit: Unit, nodes: list[Node], depth: int) -> syntax.Block:
    """The statements among *nodes*, the children of a block."""
    out: Statements = []
    if depth > DEEPEST:
        if nodes:
            unit.problem(nodes[0], TOO_DEEP)
        return ()
    for node in nodes:
        handler = _HANDLERS.get(node.kind_id)
        if handler is not None and unit.found.splits:
            splits.statement(unit, node, depth + 1, out, handler)
        elif handler is not None:
            handler(unit, node, depth + 1, out)
    return tuple(out)


def _body(unit: Unit, node: Node | None, depth: int) -> syntax.Block:
    """The block of a controlled statement, with or without braces."""
    if node is None:
        return ()
    return block(unit, node.children if node.kind_id in _BLOCK else [node], depth)


def _expression(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    child = node.children[0] if node.child_count else node
    if child.kind_id in _CALL and unit.found.callable_macros and expansion.expand(unit, child, depth, out):
        return
    pointer = method_pointers.variable(unit, child, depth)
    if pointer is not None:
        out.append(pointer)
    elif child.is_named and child.kind_id != ERROR:
        out.append(syntax.Do(expressions.expression(unit, child, depth)))


def _bare(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    out.append(syntax.Do(expressions.expression(unit, node, depth)))


def _declaration(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    scope = CppScope(unit.function, unit.function)
    is_static = any(unit.cut(child) == "static" for child in node.children if child.end_byte - child.start_byte == 6)
    for variable in declarations.variables(unit, node, scope, depth):
        if variable[0].is_parenthesized and variable[1] is None:
            out.append(syntax.Do(unit.opaque(node)))
            continue
        if (both := _both(unit, variable)) is not None:
            out.append(syntax.Do(both))
            continue
        start = len(out)
        _variable(unit, variable, depth, out)
        if is_static:
            out[start:] = [
                syntax.Static(statement) if isinstance(statement, syntax.Variable) else statement
                for statement in out[start:]
            ]


def _both(unit: Unit, variable: declarations.Variable) -> syntax.Expression | None:
    """``ready && go(x);``, which the parser takes for a reference ``go`` to a ``ready``; None for all else."""
    declared, init = variable
    kind = declared.type
    if kind.marks != "&&" or kind.arguments or not kind.name.isidentifier() or kind.name in ("auto", "bool", "int"):
        return None
    if not isinstance(init, (syntax.Parentheses, str)):
        return None
    line, column = unit.position(declared.node)
    arguments = () if isinstance(init, str) else init.arguments
    call = syntax.Call(syntax.Name(declared.name), arguments, (), line, column)
    return syntax.Operation("&&", (syntax.Name(kind.name), call))


def _variable(unit: Unit, variable: declarations.Variable, depth: int, out: Statements) -> None:
    declared, init = variable
    if isinstance(init, str):
        return
    line, column = unit.position(declared.node)
    out.append(syntax.Variable(declared.name, declared.type, init, line, column))
    if declared.node.kind_id in _PATTERN:
        names = [child for child in declared.node.children if child.is_named]
        is_reference = "&" in declared.type.marks and "c" not in declared.type.marks
        kind = syntax.Type("auto", (), "&") if is_reference else syntax.AUTO
        for number, child in enumerate(names):
            line, column = unit.position(child)
            part = syntax.Subscript(syntax.Name(""), syntax.Number(number))
            out.append(syntax.Variable(unit.cut(child), kind, syntax.Equals(part), line, column))


def _condition(unit: Unit, node: Node | None, depth: int, before: Statements) -> tuple[str, syntax.Expression]:
    """Text and value of a condition; what it declares goes to *before*."""
    if node is None:
        return "", syntax.Unknown("")
    if node.kind_id not in _CONDITIONS:
        return unit.written(node.start_byte, node.end_byte), expressions.expression(unit, node, depth)
    text = unit.written(node.start_byte + 1, node.end_byte - 1)
    value: syntax.Expression = syntax.Unknown(text)
    if expressions.is_damaged(node):
        return text, expressions.damaged(unit, node, node.children, depth)
    for child in node.children:
        kind = child.kind_id
        if kind in _INIT:
            before.extend(block(unit, child.children, depth))
        elif kind in _DECLARATION:
            start = len(before)
            _declaration(unit, child, depth, before)
            if len(before) > start:
                first = before[start]
                first = first.statement if isinstance(first, syntax.Static) else first
                value = syntax.Name(first.name) if isinstance(first, syntax.Variable) else value
        elif child.is_named:
            value = expressions.expression(unit, child, depth)
    return text, value


def _wrapped(before: Statements, statement: syntax.Statement, out: Statements) -> None:
    out.append(syntax.Nested((*before, statement)) if before else statement)


def _if(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    before: Statements = []
    line, column = unit.position(node)
    text, value = _condition(unit, node.child_by_field_id(_CONDITION), depth, before)
    then = _body(unit, node.child_by_field_id(_CONSEQUENCE), depth)
    alternative = node.child_by_field_id(_ALTERNATIVE)
    else_line = else_column = 0
    other: syntax.Block = ()
    if alternative is not None:
        else_line, else_column = unit.position(alternative)
        other = _body(unit, alternative.children[-1], depth)
    _wrapped(before, syntax.If(line, column, text, value, then, else_line, else_column, other), out)


def _while(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    before: Statements = []
    line, column = unit.position(node)
    text, value = _condition(unit, node.child_by_field_id(_CONDITION), depth, before)
    body = _body(unit, node.child_by_field_id(_BODY), depth)
    out.append(syntax.Loop("while", line, column, text, tuple(before), value, body))


def _do(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    line, column = unit.position(node)
    text, value = _condition(unit, node.child_by_field_id(_CONDITION), depth, [])
    body = _body(unit, node.child_by_field_id(_BODY), depth)
    if unit.level and value in (syntax.Number(0), syntax.Boolean(False)):
        out.append(syntax.Nested(body))
    else:
        out.append(syntax.Loop("do", line, column, text, (), value, body))


def _for(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    line, column = unit.position(node)
    first = node.child_by_field_id(_INITIALIZER)
    before: syntax.Block = ()
    if first is not None:
        before = block(unit, [first], depth)
    condition = node.child_by_field_id(_CONDITION)
    text = "" if condition is None else unit.written(condition.start_byte, condition.end_byte)
    value = None if condition is None else expressions.expression(unit, condition, depth)
    body = _body(unit, node.child_by_field_id(_BODY), depth)
    update = node.child_by_field_id(_UPDATE)
    if update is not None:
        body = (*body, syntax.Step(expressions.expression(unit, update, depth)))
    out.append(syntax.Loop("for", line, column, text, before, value, body))


def _each(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    before: Statements = []
    line, column = unit.position(node)
    children = node.children
    if len(children) > 2 and children[2].kind_id in _INIT:
        before.extend(block(unit, children[2].children, depth))
    start = next((index for index, child in enumerate(children) if child.type == "("), 0) + 1
    if before:
        start += 1
    found = types.specifiers(unit, children[start:], depth)
    declared = None
    if found.rest and found.rest[0].kind_id not in _COLON:
        declared = types.declarator(unit, found.rest[0], found.type, depth)
    right = node.child_by_field_id(_RIGHT)
    body_node = node.child_by_field_id(_BODY)
    value: syntax.Expression = syntax.Unknown("") if right is None else expressions.expression(unit, right, depth)
    text = "" if right is None else unit.written(children[start].start_byte, right.end_byte)
    names: Statements = []
    if declared is not None and declared.node.kind_id in _PATTERN:
        _variable(unit, (declared, None), depth, names)
    body = (*names[1:], *_body(unit, body_node, depth))
    name, type_ = ("", syntax.AUTO) if declared is None else (declared.name, declared.type)
    _wrapped(before, syntax.Each(line, column, text, name, type_, value, body), out)


def _switch(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    before: Statements = []
    line, column = unit.position(node)
    text, value = _condition(unit, node.child_by_field_id(_CONDITION), depth, before)
    body = node.child_by_field_id(_BODY)
    cases = switches.cases(unit, body.children if body is not None else [], depth, block)
    _wrapped(before, syntax.Switch(line, column, text, value, cases), out)


def _try(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    handlers = []
    for child in node.children:
        if child.kind_id not in _CATCH:
            continue
        line, column = unit.position(child)
        text, name, type_ = "...", "", syntax.NOTHING
        caught = child.child_by_field_id(_PARAMETERS)
        if caught is not None:
            text = unit.collapsed(caught.start_byte + 1, caught.end_byte - 1)
            for parameter in types.parameters(unit, caught, depth):
                name, type_ = parameter.name, parameter.type
        handlers.append(
            syntax.Handler(line, column, text, name, type_, _body(unit, child.child_by_field_id(_BODY), depth))
        )
    out.append(syntax.Try(_body(unit, node.child_by_field_id(_BODY), depth), tuple(handlers)))


def _operand(unit: Unit, node: Node, depth: int) -> syntax.Expression | None:
    if expressions.is_damaged(node):
        return expressions.damaged(unit, node, node.children, depth)
    for child in node.children[1:]:
        if child.is_named:
            return expressions.expression(unit, child, depth)
    return None


def _return(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    out.append(syntax.Return(_operand(unit, node, depth)))


def _throw(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    out.append(syntax.Throw(_operand(unit, node, depth)))


def _yield(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    out.append(syntax.Do(_operand(unit, node, depth) or unit.opaque(node)))


def _nested(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    out.append(syntax.Nested(block(unit, node.children, depth)))


def _inside(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    """What stands behind labels and attributes, and what can be read within a syntax error."""
    if node.type == "labeled_statement":
        out.extend(labels.unknown(unit, node))
    out.extend(block(unit, node.children, depth))


def _pre(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    found = preprocessor.branches(unit, node)
    branches = (syntax.Branch(line, column, text, block(unit, nodes, depth)) for line, column, text, nodes in found)
    out.append(syntax.Preprocessor(tuple(branches)))


def _class(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    name = declarations.class_of(unit, node, CppScope(unit.function, unit.function), depth)
    if name:
        out.append(syntax.NestedClass(name.rpartition("::")[2]))


def _scoped(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    scopes.declare(unit, [node], CppScope(unit.function, unit.function), depth)


def _function(unit: Unit, node: Node, depth: int, out: Statements) -> None:
    """A function definition within a body is a macro with a block after it: the block is read, the macro is not."""
    body = node.child_by_field_id(_BODY)
    if body is not None:
        out.append(syntax.Nested(block(unit, body.children, depth)))


def _constant(statement: syntax.Statement) -> Handler:
    return lambda unit, node, depth, out: out.append(statement)


_HANDLERS: dict[int, Handler] = table(
    {
        "expression_statement": _expression,
        "declaration": _declaration,
        "if_statement": _if,
        "while_statement": _while,
        "do_statement": _do,
        "for_statement": _for,
        "for_range_loop": _each,
        "switch_statement": _switch,
        "try_statement constructor_try_statement": _try,
        "return_statement co_return_statement": _return,
        "co_yield_statement": _yield,
        "throw_statement": _throw,
        "break_statement": _constant(syntax.Break()),
        "continue_statement": _constant(syntax.Continue()),
        "compound_statement": _nested,
        "labeled_statement attributed_statement ERROR": _inside,
        "preproc_if preproc_ifdef": _pre,
        "class_specifier struct_specifier union_specifier": _class,
        "enum_specifier type_definition alias_declaration using_declaration namespace_alias_definition"
        " preproc_def preproc_function_def preproc_include template_declaration": _scoped,
        "function_definition": _function,
        "assignment_expression update_expression call_expression comma_expression binary_expression new_expression"
        " unary_expression parenthesized_expression conditional_expression lambda_expression": _bare,
    }
)
