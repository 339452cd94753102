# SPDX-License-Identifier: Apache-2.0
"""What stands at namespace and class scope, and what may stand in functions, too: aliases, macros, classes."""

from __future__ import annotations

from collections.abc import Callable

from tree_sitter import Node

from haros_ci import syntax
from haros_ci.extract.cpp import declarations, expansion, flags, functions, preprocessor, types
from haros_ci.extract.cpp.grammar import ERROR, field, kinds, table
from haros_ci.extract.cpp.unit import DEEPEST, TOO_DEEP, CppScope, Unit
from haros_ci.regex import regex
from haros_ci.syntax import Alias, Field

_NAME = field("name")
_BODY = field("body")
_TYPE = field("type")
_PATH = field("path")
_FUNCTION = field("function")
_ARGUMENTS = field("arguments")
_VALUE = field("value")
_PARAMETERS = field("parameters")
_SEMICOLON = kinds(";")
_INLINE = kinds("inline")
_NAMESPACE = kinds("namespace")
_TEMPLATE_PARAMETERS = kinds("template_parameter_list")
_NAMED = kinds("identifier type_identifier namespace_identifier qualified_identifier nested_namespace_specifier")
_CALL = kinds("call_expression")
_IDENTIFIER = kinds("identifier")
_LOST = kinds(
    "{ function_declarator expression_statement compound_statement if_statement for_statement for_range_loop"
    " while_statement do_statement switch_statement return_statement try_statement"
)
_WORD = regex(r"\w+")
_CONTINUATION = regex(r"\\\r?\n")

Handler = Callable[[Unit, Node, CppScope, int], None]


def declare(unit: Unit, nodes: list[Node], scope: CppScope, depth: int) -> None:
    """Add what *nodes* declare in *scope* to the unit."""
    if depth > DEEPEST:
        if nodes:
            unit.problem(nodes[0], TOO_DEEP)
        return
    for node in nodes:
        handler = _HANDLERS.get(node.kind_id)
        if handler is not None:
            handler(unit, node, scope, depth + 1)


def _declaration(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    before = declarations.before_declarators(unit, node, scope, depth)
    is_extern = any(unit.cut(child) == "extern" for child in node.children[:2])
    for declared, init in declarations.declarators(unit, before, depth):
        if declared.function is not None:
            functions.declare(unit, declared, before, scope, None)
            continue
        is_macro = declared.is_parenthesized and init is None
        if not declared.name or is_macro or (is_extern and init is None):
            continue
        line, column = unit.position(declared.node)
        if scope.members is None:
            name = scope.qualified(declared.name)
            unit.found.variables.append(Field(name, declared.type, init, line, column, before.is_static, scope.guards))
        else:
            scope.members.append(
                Field(declared.name, declared.type, init, line, column, before.is_static, scope.guards)
            )


def _function(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    before = declarations.before_declarators(unit, node, scope, depth)
    for child in before.rest:
        if child.is_named and child.kind_id not in declarations.IGNORED:
            declared = types.declarator(unit, child, before.type, depth)
            if declared.function is not None:
                functions.declare(unit, declared, before, scope, node)
            return


def _template(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    names, defaults = scope.templates, scope.defaults
    for child in node.children:
        if child.kind_id in _TEMPLATE_PARAMETERS:
            names = (*names, *functions.template_names(unit, child))
            defaults = (*defaults, *functions.template_defaults(unit, child))
    declare(unit, node.children, CppScope(scope.name, scope.space, scope.members, scope.guards, names, defaults), depth)


def _namespace(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    """Unnamed and inline namespaces are as good as not there."""
    named = node.child_by_field_id(_NAME)
    body = node.child_by_field_id(_BODY)
    name = scope.name
    if named is not None and node.children[0].kind_id not in _INLINE:
        name = scope.qualified("".join(unit.cut(named).split()))
    if body is not None:
        declare(unit, body.children, CppScope(name, name, None, scope.guards), depth)


def _linkage(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    body = node.child_by_field_id(_BODY)
    if body is not None:
        declare(unit, [body], scope, depth)


def _inside(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    declare(unit, node.children, scope, depth)


def _friend(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    declare(unit, node.children, CppScope(scope.space, scope.space, None, scope.guards, scope.templates), depth)


def _error(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    children = node.children
    if any(child.kind_id in _LOST for child in children):
        unit.problem(node, "syntax that is not understood: part of the file is not read")
    declare(unit, children, scope, depth)


def _stray(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    unit.problem(node, "a statement outside of functions: braces that do not match hide part of the file")


def _class(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    declarations.class_of(unit, node, scope, depth)


def _enum(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    declarations.enumeration(unit, node, scope, depth)


def _typedef(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    before = types.specifiers(unit, node.children, depth)
    base = before.type
    is_first = True
    for child in before.rest:
        if child.kind_id in _SEMICOLON:
            break
        if not child.is_named or child.kind_id in declarations.IGNORED:
            continue
        declared = types.declarator(unit, child, base, depth)
        type_ = declared.type
        if declared.function is not None:
            type_ = types.function_type(unit, declared.function.children, type_, depth)
        if is_first and before.node is not None:
            is_unnamed = base.name == ""
            if before.node.kind_id in types.ENUM:
                declarations.enumeration(unit, before.node, scope, depth, declared.name)
            elif before.node.kind_id in types.CLASS_KINDS:
                declarations.class_of(unit, before.node, scope, depth, True, declared.name)
            is_first = False
            if is_unnamed:
                base = syntax.Type(declared.name, (), base.marks)
                continue
        if declared.name:
            unit.found.aliases.append(Alias(scope.qualified(declared.name), type_, scope.templates))


def _alias(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    named, target = node.child_by_field_id(_NAME), node.child_by_field_id(_TYPE)
    if named is not None and target is not None:
        type_ = types.descriptor(unit, target, depth)
        unit.found.aliases.append(Alias(scope.qualified(unit.cut(named)), type_, scope.templates))


def _using(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    children = node.children
    is_directive = any(child.kind_id in _NAMESPACE for child in children)
    for child in children:
        if child.kind_id not in _NAMED:
            continue
        name = types.path(unit, child, depth)[0]
        if is_directive:
            unit.found.scopes.append((scope.name, name))
            continue
        head, _, last = name.rpartition("::")
        if head.rpartition("::")[2] != last:
            unit.found.aliases.append(Alias(scope.qualified(last), syntax.Type(name)))


def _namespace_alias(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    names = ["".join(unit.cut(child).split()) for child in node.children if child.kind_id in _NAMED]
    if len(names) == 2:
        unit.found.aliases.append(Alias(scope.qualified(names[0]), syntax.Type(names[1], (), "namespace")))


def _include(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    path = node.child_by_field_id(_PATH)
    if path is not None:
        unit.found.includes.append(unit.cut(path))


def _macro(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    named, value, listed = (node.child_by_field_id(number) for number in (_NAME, _VALUE, _PARAMETERS))
    if named is None:
        return
    body = "" if value is None else _CONTINUATION.sub(" ", unit.cut(value)).strip()
    parameters = None
    if listed is not None:
        inside = _CONTINUATION.sub(" ", unit.cut(listed))[1:-1].strip()
        parameters = tuple(part.strip() for part in inside.split(",")) if inside else ()
        if "(" in body or "#" in body:
            unit.found.callable_macros[unit.cut(named)] = (parameters, body)
    if scope.guards:
        unit.found.guarded.add(unit.cut(named))
    unit.found.macros.append((unit.cut(named), parameters, body))


def _conditional(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    found = preprocessor.branches(unit, node)
    is_guard = preprocessor.is_include_guard(unit, found)
    if is_guard:  # or a default, which the build may replace
        unit.found.guarded.update(_WORD.findall(found[0][2]))
    is_taken = False
    for index, (line, column, text, nodes) in enumerate(found):
        known, holds = len(unit.found.macros), preprocessor.holds(unit, text)
        guards = scope.guards if is_guard and index == 0 else (*scope.guards, (line, column, text))
        declare(unit, nodes, CppScope(scope.name, scope.space, scope.members, guards, scope.templates), depth)
        if is_taken or holds is False:
            del unit.found.macros[known:]  # what they would be defined as is never meant
        is_taken = is_taken or bool(holds)


def _registration(unit: Unit, node: Node, scope: CppScope, depth: int) -> None:
    call = node.children[0] if node.child_count else node
    if call.kind_id not in _CALL:
        return
    function, argument = call.child_by_field_id(_FUNCTION), call.child_by_field_id(_ARGUMENTS)
    if function is None or argument is None or function.kind_id not in _IDENTIFIER:
        return
    written = [child for child in argument.children if child.is_named and child.kind_id != ERROR]
    texts = tuple(unit.collapsed(child.start_byte, child.end_byte) for child in written)
    flags.define(unit, unit.cut(function), written, scope, depth)
    unit.found.registered.append((unit.cut(function), texts, *unit.position(call)))
    if (found := expansion.declared(unit, call)) is not None:
        declare(*found, scope, depth)


_HANDLERS: dict[int, Handler] = table(
    {
        "declaration field_declaration": _declaration,
        "function_definition inline_method_definition": _function,
        "template_declaration": _template,
        "namespace_definition": _namespace,
        "linkage_specification": _linkage,
        "declaration_list translation_unit": _inside,
        "friend_declaration": _friend,
        "ERROR": _error,
        "class_specifier struct_specifier union_specifier": _class,
        "enum_specifier": _enum,
        "type_definition": _typedef,
        "alias_declaration": _alias,
        "using_declaration": _using,
        "namespace_alias_definition": _namespace_alias,
        "preproc_include": _include,
        "preproc_def preproc_function_def": _macro,
        "preproc_if preproc_ifdef": _conditional,
        "expression_statement": _registration,
        "if_statement for_statement for_range_loop while_statement do_statement switch_statement return_statement"
        " compound_statement try_statement": _stray,
    }
)
