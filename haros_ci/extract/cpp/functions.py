# SPDX-License-Identifier: Apache-2.0
"""Function definitions and declarations, constructors' initialisers and lambdas."""

from __future__ import annotations

from tree_sitter import Node

from haros_ci import syntax
from haros_ci.extract.cpp import expressions, statements, types
from haros_ci.extract.cpp.grammar import ERROR, errors, field, kinds
from haros_ci.extract.cpp.unit import CppScope, Unit
from haros_ci.regex import regex
from haros_ci.syntax import Function

_ERRORS = 20
_BODY = kinds("compound_statement")
_TRY = kinds("try_statement constructor_try_statement")
_INITS = kinds("field_initializer_list")
_INIT = kinds("field_initializer")
_VIRTUAL = kinds("virtual_specifier")
_LISTS = kinds("argument_list initializer_list")
_CAPTURES = kinds("lambda_capture_specifier")
_CAPTURE_VALUE = kinds("lambda_capture_initializer")
_ABSTRACT_FUNCTION = kinds("abstract_function_declarator lambda_declarator")
_TEMPLATE_PARAMETERS = kinds("template_parameter_list")
_TYPE_PARAMETERS = kinds(
    "type_parameter_declaration optional_type_parameter_declaration variadic_type_parameter_declaration"
)
_DEFAULTED = kinds("optional_type_parameter_declaration")
_NAME, _DEFAULT = field("name"), field("default_type")
_TEMPLATE_TEMPLATE = kinds("template_template_parameter_declaration")
_VALUE_PARAMETERS = kinds("parameter_declaration optional_parameter_declaration variadic_parameter_declaration")
_TRAILING = kinds("trailing_return_type")
_NAMES = kinds("type_identifier identifier")


#: ``operator <<`` is ``operator<<``; ``operator bool`` stays.
_OPERATOR = regex(r"\boperator\s+(?=\W)")


def template_names(unit: Unit, node: Node) -> tuple[str, ...]:
    """The names in a ``template_parameter_list``, in order; unnamed ones are left out."""
    found: list[str] = []
    for child in node.children:
        if child.kind_id in _TEMPLATE_TEMPLATE:
            child = child.children[-1]
        if child.kind_id in _TYPE_PARAMETERS:
            named = next((other_node for other_node in child.children if other_node.kind_id in _NAMES), None)
            found.append(unit.cut(named) if named is not None else "")
        elif child.kind_id in _VALUE_PARAMETERS:
            found.append(types.parameter(unit, child, 0).name.lstrip("*"))
    return tuple(name for name in found if name)


def template_defaults(unit: Unit, node: Node) -> tuple[tuple[str, syntax.Type], ...]:
    """The names in a ``template_parameter_list`` that have a default type, with that."""
    found: list[tuple[str, syntax.Type]] = []
    for child in node.children:
        if child.kind_id in _DEFAULTED:
            named, default = child.child_by_field_id(_NAME), child.child_by_field_id(_DEFAULT)
            if named is not None and default is not None:
                found.append((unit.cut(named), types.plain_type(unit, default, 0)))
    return tuple(found)


def declare(unit: Unit, declared: types.Declared, before: types.Specifiers, scope: CppScope, node: Node | None) -> None:
    """Add the function that *declared* names; *node* is its ``function_definition``, None for a declaration."""
    head = declared.function
    assert head is not None
    name = _OPERATOR.sub("operator", scope.qualified(declared.name))
    owner, _, last = name.rpartition("::")
    kind = "function"
    if last.startswith("~"):
        kind = "destructor"
    elif owner.rpartition("::")[2] == last and (before.node is None or before.type.name.isupper()):
        kind = "constructor"
    slot = len(unit.found.functions)
    unit.found.functions.append(None)
    around = unit.function, unit.owner
    unit.function, unit.owner = name, owner
    parameters: tuple[syntax.Parameter, ...] = ()
    is_virtual = before.is_virtual
    for child in head.children:
        if child.kind_id in types.PARAMETER_LIST:
            parameters = types.parameters(unit, child, 0)
        elif child.kind_id in _VIRTUAL:
            is_virtual = True
    line, column = unit.position(declared.node)
    body, brace, inits = (None, (0, 0), ()) if node is None else _definition(unit, node)
    unit.function, unit.owner = around
    unit.found.functions[slot] = Function(
        name=name,
        owner=owner,
        kind=kind,
        parameters=parameters,
        returns=declared.type,
        line=line,
        column=column,
        body=body,
        body_line=brace[0],
        body_column=brace[1],
        templates=scope.templates,
        template_defaults=scope.defaults,
        inits=inits,
        guards=scope.guards,
        is_static=before.is_static,
        is_virtual=is_virtual,
        specialises=_specialised(unit, declared, scope),
    )


def _specialised(unit: Unit, declared: types.Declared, scope: CppScope) -> tuple[syntax.Argument, ...]:
    """The template arguments behind the name of a function that is no template itself."""
    node = declared.node
    if scope.templates or "<" not in unit.text[node.start_byte : node.end_byte] or "operator" in declared.name:
        return ()
    return types.path(unit, node, 0)[1]


def _definition(unit: Unit, node: Node) -> tuple[syntax.Block | None, tuple[int, int], tuple[syntax.Initializer, ...]]:
    """Body, its brace and the initialisers; defaulted and deleted functions have no body."""
    body: syntax.Block | None = None
    brace = (0, 0)
    inits: tuple[syntax.Initializer, ...] = ()
    for child in node.children:
        kind = child.kind_id
        if kind in _INITS:
            inits = _initialisers(unit, child)
        elif kind in _BODY:
            brace = unit.position(child)
            body = statements.block(unit, child.children, 0)
        elif kind in _TRY:
            for other_node in child.children:
                if other_node.kind_id in _INITS:
                    inits = _initialisers(unit, other_node)
                elif other_node.kind_id in _BODY:
                    brace = unit.position(other_node)
            body = statements.block(unit, [child], 0)
    if node.has_error:
        _note(unit, node)
    return body, brace, inits


def _note(unit: Unit, node: Node) -> None:
    """Record the first error in a function that was not mended by reading it again."""
    for error in errors(node, _ERRORS):
        offset = error.start_byte + unit.shift
        if not any(start <= offset <= end for start, end in unit.found.reread[-_ERRORS:]):
            unit.problem(error, "syntax that is not understood: part of the function is not read")
            return


def _initialisers(unit: Unit, node: Node) -> tuple[syntax.Initializer, ...]:
    found = []
    for child in node.children:
        if child.kind_id not in _INIT:
            continue
        children = child.children
        name, chosen = types.path(unit, children[0], 0)
        values: tuple[syntax.Expression, ...] = ()
        for other_node in children[1:]:
            if other_node.kind_id in _LISTS:
                values = expressions.arguments(unit, other_node, 1)
        line, column = unit.position(child)
        split = unit.split(child)
        guards = ((split.line, 1, split.text),) if split is not None else ()
        found.append(syntax.Initializer(name, syntax.Type(name, chosen), values, line, column, guards))
    return tuple(found)


def lambda_expression(unit: Unit, node: Node, depth: int) -> syntax.Lambda:
    """The lambda; captures with a value become variables at the start of its body."""
    slot = len(unit.found.functions)
    unit.found.functions.append(None)
    parameters: tuple[syntax.Parameter, ...] = ()
    returns: syntax.Type = syntax.AUTO
    captured: list[syntax.Statement] = []
    copied: tuple[str, ...] = ()
    templates: tuple[str, ...] = ()
    body: syntax.Block = ()
    brace = (0, 0)
    for child in node.children:
        kind = child.kind_id
        if kind in _CAPTURES:
            captured, copied = _captures(unit, child, depth), _copied(unit, child)
        elif kind in _ABSTRACT_FUNCTION:
            for other_node in child.children:
                if other_node.kind_id in types.PARAMETER_LIST:
                    parameters = types.parameters(unit, other_node, depth)
                elif other_node.kind_id in _TRAILING:
                    returns = types.descriptor(unit, other_node.children[-1], depth)
        elif kind in _TEMPLATE_PARAMETERS:
            templates = template_names(unit, child)
        elif kind in _BODY:
            brace = unit.position(child)
            body = statements.block(unit, child.children, depth)
    _fill(unit, slot, node, (*captured, *body), brace, parameters, returns, templates, copied)
    return syntax.Lambda(slot)


def block_as_lambda(unit: Unit, node: Node, depth: int) -> syntax.Lambda:
    """A block where an expression is expected (a macro's argument, a statement expression): a lambda of it."""
    slot = len(unit.found.functions)
    unit.found.functions.append(None)
    body = statements.block(unit, node.children, depth)
    _fill(unit, slot, node, body, unit.position(node))
    return syntax.Lambda(slot)


def _fill(
    unit: Unit,
    slot: int,
    node: Node,
    body: syntax.Block,
    brace: tuple[int, int],
    parameters: tuple[syntax.Parameter, ...] = (),
    returns: syntax.Type = syntax.AUTO,
    templates: tuple[str, ...] = (),
    captures: tuple[str, ...] = (),
) -> None:
    line, column = unit.position(node)
    unit.found.functions[slot] = Function(
        name=f"{unit.function}::(lambda)" if unit.function else "(lambda)",
        owner=unit.owner,
        kind="lambda",
        parameters=parameters,
        returns=returns,
        line=line,
        column=column,
        body=body,
        body_line=brace[0],
        body_column=brace[1],
        templates=templates,
        captures=captures,
    )


def _copied(unit: Unit, node: Node) -> tuple[str, ...]:
    """What a lambda captures by value as it stands: names, ``=`` for all but those after ``&``."""
    found, before = [], ""
    for child in node.children:
        text = unit.cut(child) if child.child_count < 2 else ""
        if text == "=":
            found.append(text)
        elif child.kind_id in _NAMES and (before != "&" or "=" in found):
            found.append(f"&{text}" if before == "&" else text)
        before = text
    return tuple(found)


def _captures(unit: Unit, node: Node, depth: int) -> list[syntax.Statement]:
    found: list[syntax.Statement] = []
    for child in node.children:
        if child.kind_id in _CAPTURE_VALUE:
            children = child.children
            named = next((other_node for other_node in children if other_node.kind_id in _NAMES), None)
            if named is not None and children[-1].kind_id != ERROR:
                line, column = unit.position(named)
                value = expressions.expression(unit, children[-1], depth)
                found.append(syntax.Variable(unit.cut(named), syntax.AUTO, syntax.Equals(value), line, column))
    return found
