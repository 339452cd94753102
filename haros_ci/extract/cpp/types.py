# SPDX-License-Identifier: Apache-2.0
"""Types, declarators and parameters."""

from __future__ import annotations

from typing import NamedTuple

from tree_sitter import Node

from haros_ci import syntax
from haros_ci.extract.cpp import expressions
from haros_ci.extract.cpp.grammar import ERROR, kinds, table
from haros_ci.extract.cpp.unit import DEEPEST, Unit
from haros_ci.syntax import Parameter

CLASS_KINDS = kinds("class_specifier struct_specifier union_specifier")
ENUM = kinds("enum_specifier")
TYPE_KINDS = (
    CLASS_KINDS
    | ENUM
    | kinds(
        "primitive_type type_identifier qualified_identifier template_type placeholder_type_specifier auto"
        " sized_type_specifier dependent_type decltype"
    )
)
_QUALIFIED = kinds("qualified_identifier nested_namespace_specifier")
_TEMPLATE = kinds("template_type template_function template_method")
_DEPENDENT = kinds("dependent_type dependent_name")
_PLAIN = kinds("primitive_type type_identifier namespace_identifier identifier field_identifier")
_AUTO = kinds("placeholder_type_specifier auto")
_QUALIFIER = kinds("type_qualifier")
_STORAGE = kinds("storage_class_specifier")
_VIRTUAL = kinds("virtual virtual_function_specifier")
_SKIPPED = kinds(
    "explicit_function_specifier attribute_specifier attribute_declaration alignas_qualifier alignas_specifier"
    " ms_declspec_modifier ms_call_modifier typedef inline constexpr ERROR comment friend"
)
PARAMETER_LIST = kinds("parameter_list")
_OPERATOR_CAST = kinds("operator_cast")

_NAME, _POINTER, _REFERENCE, _ARRAY, _PARENTHESES, _FUNCTION, _UNNAMED_FUNCTION, _VARIADIC, _WRAPPED, _CAST = range(10)
DECLARATORS = table(
    {
        "identifier field_identifier type_identifier operator_name destructor_name qualified_identifier"
        " template_function structured_binding_declarator namespace_identifier template_type": _NAME,
        "pointer_declarator abstract_pointer_declarator pointer_type_declarator": _POINTER,
        "reference_declarator abstract_reference_declarator": _REFERENCE,
        "array_declarator abstract_array_declarator": _ARRAY,
        "parenthesized_declarator abstract_parenthesized_declarator": _PARENTHESES,
        "function_declarator": _FUNCTION,
        "abstract_function_declarator": _UNNAMED_FUNCTION,
        "variadic_declarator": _VARIADIC,
        "attributed_declarator init_declarator": _WRAPPED,
        "operator_cast": _CAST,
    }
)
_PATTERN = kinds("structured_binding_declarator")
_PARAMETER = kinds(
    "parameter_declaration optional_parameter_declaration variadic_parameter_declaration"
    " explicit_object_parameter_declaration"
)
#: What RCLCPP_SMART_PTR_DEFINITIONS gives a class (rclcpp/macros.hpp), and a question about types its answer.
_MAKERS = ("make_shared", "make_unique", "value")
_PACK = kinds("variadic_parameter_declaration")
_EQUALS = kinds("=")
_TRAILING = kinds("trailing_return_type")
_DESCRIPTOR = kinds("type_descriptor")
_IDENTIFIER = kinds("identifier")
#: Templates of the standard library that take types alone.
_OF_TYPES = frozenset(
    "shared_ptr unique_ptr weak_ptr vector list deque set multiset unordered_set map multimap unordered_map optional pair "
    "tuple variant function queue stack atomic future promise reference_wrapper initializer_list".split()
)


class Declared(NamedTuple):
    """One declarator: its name as written ("" where unnamed), type, name node, and the function's declarator.

    ``T (x)`` *is_parenthesized*: a macro's use, rather.
    """

    name: str
    type: syntax.Type
    node: Node
    function: Node | None
    is_parenthesized: bool = False


class Specifiers(NamedTuple):
    """What stands before declarators: *rest* are the children after it."""

    type: syntax.Type
    node: Node | None
    is_static: bool
    is_virtual: bool
    rest: list[Node]


def path(unit: Unit, node: Node, depth: int, is_type: bool = False) -> tuple[str, tuple[syntax.Argument, ...]]:
    """A possibly qualified name without template arguments, and the template arguments of its last part.

    For ``std::numeric_limits<T>::max``, ``InterProcessPollingSubscriber<T>::create_subscription`` and the functions that
    make an object of a class (``C<T>::make_shared``) they are those of the class: its methods say nothing without them.
    So they are for a type that is a member of a class template.
    """
    text = unit.text[node.start_byte : node.end_byte]
    if "<" not in text:
        name = unit.cut(node)
        if "template" not in name and "typename" not in name:
            return (name if name.isidentifier() else "".join(name.split()) if "operator" not in name else name), ()
    parts: list[str] = []
    around: tuple[syntax.Argument, ...] = ()
    chosen: tuple[syntax.Argument, ...] = ()
    while True:
        kind = node.kind_id
        if kind in _QUALIFIED:
            children = node.children
            for child in children[:-1]:
                if child.kind_id in _PLAIN or child.kind_id in _TEMPLATE or child.kind_id in _DEPENDENT:
                    name, chosen = path(unit, child, depth + 1) if depth < DEEPEST else ("?", ())
                    parts.append(name)
                    if is_type:
                        around = chosen or around
                    else:
                        around = chosen if name.endswith(("numeric_limits", "PollingSubscriber")) else ()
                elif not child.is_named and child.end_byte - child.start_byte == 2 and not parts:
                    parts.append("")
            node = children[-1]
        elif kind in _DEPENDENT:
            node = node.children[-1]
        elif kind in _TEMPLATE:
            children = node.children
            parts.append(path(unit, children[0], depth + 1)[0] if depth < DEEPEST else "?")
            return "::".join(parts), arguments(unit, children[-1], depth + 1)
        else:
            parts.append(" ".join(unit.cut(node).split()))
            return "::".join(parts), chosen if parts[-1] in _MAKERS else around


def arguments(unit: Unit, node: Node, depth: int) -> tuple[syntax.Argument, ...]:
    """The template arguments of a ``template_argument_list``: types, or expressions for value arguments."""
    if depth > DEEPEST:
        return ()
    found: list[syntax.Argument] = []
    for child in node.children:
        if child.kind_id in _DESCRIPTOR:
            found.append(descriptor(unit, child, depth + 1))
        elif child.kind_id in _IDENTIFIER and _takes_types(unit, node):
            found.append(syntax.Type(unit.cut(child)))  # the first parameter of a constructor outside of its class
        elif _is_of_template(child):
            found.append(plain_type(unit, child, depth + 1))  # f(a::g<b::C<D>>()): no variable, which few templates are
        elif child.is_named and child.kind_id != ERROR:
            found.append(expressions.expression(unit, child, depth + 1))
    return tuple(found)


def _is_of_template(node: Node) -> bool:
    """Whether the last part of a qualified name has template arguments."""
    while node.kind_id in _QUALIFIED:
        node = node.children[-1]
    return node.kind_id in _TEMPLATE


def _takes_types(unit: Unit, node: Node) -> bool:
    return node.prev_sibling is not None and unit.cut(node.prev_sibling) in _OF_TYPES


def descriptor(unit: Unit, node: Node, depth: int) -> syntax.Type:
    """The type of a ``type_descriptor``: specifiers and an abstract declarator."""
    if depth > DEEPEST:
        return syntax.Type("?")
    found = specifiers(unit, node.children, depth + 1)
    if found.rest and found.rest[0].kind_id in DECLARATORS:
        return declarator(unit, found.rest[0], found.type, depth + 1).type
    return found.type


def plain_type(unit: Unit, node: Node, depth: int) -> syntax.Type:
    """The type that a specifier names, without marks."""
    kind = node.kind_id
    if kind in _PLAIN:
        return syntax.Type(unit.cut(node))
    if kind in _AUTO:
        return syntax.AUTO
    if kind in CLASS_KINDS or kind in ENUM:
        name = specified_name(node)
        return syntax.Type(*path(unit, name, depth + 1)) if name is not None else syntax.NOTHING
    if kind in _QUALIFIED or kind in _TEMPLATE or kind in _DEPENDENT:
        return syntax.Type(*path(unit, node, depth + 1, True))
    return syntax.Type(" ".join(unit.cut(node).split()))


def specified_name(node: Node) -> Node | None:
    """The name in a class or enum head."""
    for child in node.children:
        kind = child.kind_id
        if kind in _PLAIN or kind in _QUALIFIED or kind in _TEMPLATE:
            return child
        if child.is_named and kind not in _SKIPPED:
            return None
    return None


def specifiers(unit: Unit, children: list[Node], depth: int) -> Specifiers:
    """Read the children of a declaration up to the first declarator."""
    node: Node | None = None
    marks = ""
    is_static = is_virtual = False
    index = 0
    for index, child in enumerate(children):  # noqa: B007 - the last one is used below
        kind = child.kind_id
        if kind in _QUALIFIER:
            if unit.cut(child) in ("const", "constexpr", "constinit"):
                marks = "c"
        elif kind in TYPE_KINDS and node is None:
            if kind in _QUALIFIED and _is_conversion(child):
                break
            node = child
        elif kind in _STORAGE:
            is_static = is_static or unit.cut(child) == "static"
        elif kind in _VIRTUAL:
            is_virtual = True
        elif kind not in _SKIPPED:
            break
    else:
        index = len(children)
    if node is None:
        found = syntax.NOTHING
    else:
        found = plain_type(unit, node, depth)
        if marks:
            found = syntax.Type(found.name, found.arguments, marks + found.marks)
    return Specifiers(found, node, is_static, is_virtual, children[index:])


def _is_conversion(node: Node) -> bool:
    while node.kind_id in _QUALIFIED and node.child_count:
        node = node.children[-1]
    return node.kind_id in _OPERATOR_CAST


def declarator(unit: Unit, node: Node, base: syntax.Type, depth: int) -> Declared:  # noqa: C901 - one branch for each form of a declarator
    """Follow a declarator from the outside in, adding to *base* what it says."""
    function: Node | None = None
    is_parenthesized = DECLARATORS.get(node.kind_id) == _PARENTHESES and not _is_pointer(node)
    made = base
    for _ in range(DEEPEST):
        kind = DECLARATORS.get(node.kind_id)
        if kind == _NAME:
            if node.kind_id in _PATTERN:
                return Declared("", made, node, function)
            if node.kind_id in _QUALIFIED and _is_conversion(node):
                node_, text = node, path(unit, node, depth)[0].partition("(")[0]
                while node.kind_id in _QUALIFIED:
                    node = node.children[-1]
                declared = declarator(unit, node, syntax.NOTHING, depth)
                return Declared(text, declared.type, node_, declared.function)
            text = path(unit, node, depth)[0]
            if "::*" in text:  # a pointer to a member
                kept = made if function is None else syntax.Type("()", (made,))
                return Declared(text.rpartition("*")[2].strip(), kept.marked("*"), node, None)
            return Declared(text, made, node, function, is_parenthesized)
        children = node.children
        inner: Node | None = None
        for child in children:
            if child.kind_id in DECLARATORS:
                inner = child
                break
        if kind == _POINTER:
            constants = sum(child.kind_id in _QUALIFIER and unit.cut(child) == "const" for child in children)
            made = made.marked("*" + "c" * constants)
        elif kind == _REFERENCE:
            made = made.marked(unit.cut(children[0]))
        elif kind == _ARRAY:
            made = made.marked("*")
        elif kind == _FUNCTION:
            if inner is not None and DECLARATORS.get(inner.kind_id) == _PARENTHESES and _is_pointer(inner):
                made = function_type(unit, children, made, depth)
            else:
                function = node
                for child in children:
                    if child.kind_id in _TRAILING:
                        made = descriptor(unit, child.children[-1], depth + 1)
        elif kind == _UNNAMED_FUNCTION:
            made = function_type(unit, children, made, depth)
        elif kind == _VARIADIC:
            text = unit.cut(children[-1]) if len(children) > 1 else ""
            return Declared(text, made, node, function)
        elif kind == _CAST:
            found = specifiers(unit, children[1:], depth + 1)
            text = "operator " + found.type.name
            for child in found.rest:
                if child.kind_id in DECLARATORS:
                    function = child
            return Declared(text, found.type, node, function or node)
        if inner is None:
            return Declared("", made, node, function)
        node = inner
    return Declared("", made, node, function)


def _is_pointer(node: Node) -> bool:
    """Whether a parenthesized declarator declares a pointer, and not just a name in parentheses."""
    return any(DECLARATORS.get(child.kind_id) in (_POINTER, _REFERENCE) for child in node.children)


def function_type(unit: Unit, children: list[Node], returned: syntax.Type, depth: int) -> syntax.Type:
    """The type of a function whose declarator has *children*."""
    found: tuple[syntax.Type, ...] = ()
    for child in children:
        if child.kind_id in PARAMETER_LIST:
            found = tuple(other_parameter.type for other_parameter in parameters(unit, child, depth + 1))
        elif child.kind_id in _TRAILING:
            returned = descriptor(unit, child.children[-1], depth + 1)
    return syntax.Type("()", (returned, *found))


def parameters(unit: Unit, node: Node, depth: int) -> tuple[Parameter, ...]:
    """The parameters of a ``parameter_list``; ``(void)`` has none, an ellipsis is not one."""
    if depth > DEEPEST:
        return ()
    found: list[Parameter] = []
    for child in node.children:
        if child.kind_id in _PARAMETER:
            found.append(parameter(unit, child, depth + 1))
    if len(found) == 1 and found[0].type == syntax.Type("void") and not found[0].name:
        return ()
    return tuple(found)


def parameter(unit: Unit, node: Node, depth: int) -> Parameter:
    """One parameter with its default; the name of a pack starts with ``*``."""
    found = specifiers(unit, node.children, depth)
    name, type_, default = "", found.type, None
    equals = False
    for child in found.rest:
        kind = child.kind_id
        if equals:
            default = expressions.expression(unit, child, depth + 1)
            break
        if kind in _EQUALS:
            equals = True
        elif kind in DECLARATORS:
            declared = declarator(unit, child, type_, depth)
            name, type_ = declared.name, declared.type
            if declared.function is not None:
                type_ = function_type(unit, declared.function.children, type_, depth)
    if node.kind_id in _PACK:
        name = "*" + name
    return Parameter(name, type_, default)
