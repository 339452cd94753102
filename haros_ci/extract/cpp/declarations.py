# SPDX-License-Identifier: Apache-2.0
"""Declarators with their initialisers, and the classes and enumerations that declarations define."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from haros_ci import syntax
from haros_ci.extract.cpp import expansion, expressions, scopes, types
from haros_ci.extract.cpp.grammar import ERROR, field, kinds
from haros_ci.extract.cpp.unit import DEEPEST, TOO_DEEP, CppScope, Unit
from haros_ci.syntax import Class, Field

_NAME = field("name")
_BODY = field("body")
_VALUE = field("value")
_SEMICOLON = kinds(";")
_COMMA = kinds(",")
_EQUALS = kinds("=")
_SCOPED_ENUM = kinds("class struct")
_ENUMERATOR = kinds("enumerator")
_BASES = kinds("base_class_clause")
_INITIALIZER = kinds("init_declarator")
_BRACES = kinds("initializer_list")
_PARENTHESES = kinds("argument_list")
IGNORED = kinds("bitfield_clause attribute_specifier attribute_declaration gnu_asm_expression ERROR")

#: A declarator with its initialiser; "function" where it declares one.
Variable = tuple["types.Declared", syntax.Init | None | str]


def variables(unit: Unit, node: Node, scope: CppScope, depth: int) -> Iterator[Variable]:
    """The declarators of a declaration in a function: a function there is a variable unless it cannot be one."""
    before = before_declarators(unit, node, scope, depth)
    for declared, init in declarators(unit, before, depth):
        if init is None and declared.function is not None:
            provided = expansion.constructed(unit, declared.function, depth)
            yield declared, "function" if provided is None else syntax.Parentheses(provided)
        else:
            yield declared, init


def before_declarators(unit: Unit, node: Node, scope: CppScope, depth: int) -> types.Specifiers:
    """The specifiers of a declaration; a class or an enumeration among them is added to the unit."""
    before = types.specifiers(unit, node.children, depth)
    if before.node is None:
        return before
    kind = before.node.kind_id
    if kind in types.ENUM:
        enumeration(unit, before.node, scope, depth)
        if before.type.name == "":
            return before._replace(type=syntax.Type("int", (), before.type.marks))
    elif kind in types.CLASS_KINDS and before.node.child_by_field_id(_BODY) is not None:
        is_used = any(child.is_named for child in before.rest)
        name = class_of(unit, before.node, scope, depth, is_used)
        if name and before.type.name == "":
            return before._replace(type=syntax.Type(name, (), before.type.marks))
    return before


def declarators(
    unit: Unit, before: types.Specifiers, depth: int
) -> Iterator[tuple[types.Declared, syntax.Init | None]]:
    """The declarators after *before*, each with its initialiser or None; unknown ones where there is an error."""
    rest = before.rest
    if any(child.kind_id == ERROR for child in rest):
        yield from _damaged(unit, before, depth)
        return
    index = 0
    while index < len(rest):
        other_node = node = rest[index]
        index += 1
        kind = node.kind_id
        if kind in _COMMA or kind in IGNORED or kind in _EQUALS:
            continue
        if kind in _SEMICOLON or not node.is_named:
            return
        init: syntax.Init | None = None
        if kind in _INITIALIZER:
            children = node.children
            node, value = children[0], children[-1]
            if expressions.is_damaged(other_node):
                init = syntax.Equals(expressions.damaged(unit, other_node, children[1:], depth))
            else:
                init = _initialiser(unit, value, any(child.kind_id in _EQUALS for child in children), depth)
        else:
            while index < len(rest) and rest[index].kind_id in IGNORED:
                index += 1
            following = rest[index] if index < len(rest) else None
            if following is not None and following.kind_id in _EQUALS and index + 1 < len(rest):
                init = _initialiser(unit, rest[index + 1], True, depth)
                index += 2
            elif following is not None and following.kind_id in _BRACES:
                init = _initialiser(unit, following, False, depth)
                index += 1
        yield types.declarator(unit, node, before.type, depth), init


def _damaged(unit: Unit, before: types.Specifiers, depth: int) -> Iterator[tuple[types.Declared, syntax.Init]]:
    for child in before.rest:
        node = child.children[0] if child.kind_id in _INITIALIZER else child
        if node.kind_id in types.DECLARATORS:
            declared = types.declarator(unit, node, before.type, depth)
            yield declared, syntax.Equals(expressions.damaged(unit, child, before.rest, depth))


def _initialiser(unit: Unit, value: Node, equals: bool, depth: int) -> syntax.Init | None:
    if equals:
        return syntax.Equals(expressions.expression(unit, value, depth))
    if value.kind_id in _PARENTHESES:
        return syntax.Parentheses(expressions.arguments(unit, value, depth))
    if value.kind_id in _BRACES:
        return syntax.Braces(expressions.arguments(unit, value, depth))
    return None


def class_of(unit: Unit, node: Node, scope: CppScope, depth: int, is_used: bool = False, alias: str = "") -> str:
    """Add the class that *node* defines; its qualified name, "" where it only names one or is an anonymous part.

    An unnamed class takes the name of its typedef, *alias*, or where variables have it (*is_used*) one of its own.
    """
    body = node.child_by_field_id(_BODY)
    if body is None:
        return ""
    if depth > DEEPEST:
        unit.problem(node, TOO_DEEP)
        return ""
    named = types.specified_name(node)
    line, column = unit.position(node if named is None else named)
    specialises: tuple[syntax.Argument, ...] = ()
    if named is not None:
        written, specialises = types.path(unit, named, depth)
        name = scope.qualified(written)
    elif alias or is_used:
        name = scope.qualified(alias or f"(anonymous {line}:{column})")
    else:
        scopes.declare(unit, body.children, scope, depth)
        return ""
    bases = tuple(
        types.plain_type(unit, other_node, depth)
        for child in node.children
        if child.kind_id in _BASES
        for other_node in child.children
        if other_node.kind_id in types.TYPE_KINDS
    )
    slot = len(unit.found.classes)
    unit.found.classes.append(None)
    members: list[Field] = []
    around = unit.function, unit.owner
    unit.function = unit.owner = name
    inside = CppScope(name, scope.space, members, scope.guards)
    scopes.declare(unit, body.children, inside, depth)
    unit.function, unit.owner = around
    unit.found.classes[slot] = Class(name, bases, tuple(members), line, column, scope.templates, specialises)
    return name


def enumeration(unit: Unit, node: Node, scope: CppScope, depth: int, alias: str = "") -> None:
    """Add the constants of an enumeration, with their values where these are literal or counted."""
    body = node.child_by_field_id(_BODY)
    if body is None:
        return
    named = types.specified_name(node)
    name = alias if named is None else types.path(unit, named, depth)[0]
    is_scoped = any(child.kind_id in _SCOPED_ENUM for child in node.children)
    prefixes = [f"{name}::"] if name else []
    if not is_scoped:
        prefixes.append("")
    type_ = syntax.Type(scope.qualified(name) if name else "int", (), "c")
    start: syntax.Expression = syntax.Number(0)
    count = 0
    for child in _enumerators(body):
        child_name = child.child_by_field_id(_NAME)
        if child_name is None:
            continue
        argument = child.child_by_field_id(_VALUE)
        if argument is not None:
            start, count = expressions.expression(unit, argument, depth), 0
        if isinstance(start, syntax.Number):
            value: syntax.Expression = syntax.Number(start.value + count)
        else:
            value = syntax.Operation("+", (start, syntax.Number(count))) if count else start
        count += 1
        line, column = unit.position(child_name)
        text = unit.cut(child_name)
        for prefix in prefixes:
            qualified = scope.qualified(prefix + text)
            unit.found.variables.append(Field(qualified, type_, syntax.Equals(value), line, column, True))


def _enumerators(body: Node) -> Iterator[Node]:
    """The enumerators, those within conditionals included."""
    waiting = [body]
    while waiting:
        node = waiting.pop()
        if node.kind_id in _ENUMERATOR:
            yield node
        else:
            waiting.extend(child for child in reversed(node.children) if child.is_named)
