# SPDX-License-Identifier: Apache-2.0
"""One C++ file: its functions measured, and its classes with their methods and what they mention."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

from tree_sitter import Node

from haros_ci.extract.cpp import blanks, branches, types
from haros_ci.extract.cpp.grammar import errors, kinds, table
from haros_ci.extract.cpp.grammar import field as field_of
from haros_ci.extract.cpp.read import LARGEST, tree_of
from haros_ci.extract.cpp.unit import DEEPEST, Unit, unit_of
from haros_ci.measuring.cpp_body import CppBody
from haros_ci.measuring.cpp_mentions import mentions
from haros_ci.measuring.facts import MOST_PROBLEMS, TOO_DEEP, ClassFacts, FileFacts, FunctionFacts
from haros_ci.records import dataclass, field
from haros_ci.regex import regex

_BODY, _NAME = field_of("body"), field_of("name")
_CLASS = types.CLASS_KINDS
_INLINE = kinds("inline")
_PUBLIC = kinds("public")
_STRUCT = kinds("struct union")
_TYPEDEF_NAME = kinds("type_identifier")
_DELETED = kinds("delete_method_clause")
_BODIES = kinds("compound_statement try_statement constructor_try_statement")
_INITS = kinds("field_initializer_list")
_TRAILING = kinds("trailing_return_type")
#: Tokens in a syntax error that mean that a branch or a function may be missing.
_LOST = kinds("{ } if for while switch case else try catch compound_statement if_statement for_statement")
#: Macros that the grammar does not know where they stand: behind the parameters of a function, and for inlining. The first begins with a bracket, which is
#: found much faster than what would look back for one.
_BEHIND = regex(
    r"\)(\s{0,40}(?:const\b\s{0,40})?\b[A-Z][A-Z0-9_]{3,80})(?=\s{0,40}(?:\{|=\s{0,9}(?:default|delete|0)\b))"
)
_INLINING = regex(r"\b[A-Z][A-Z0-9_]{0,80}INLINE\b(?=\s{1,40}[A-Za-z_~:])")
_VISIBLE = regex(r"\S")
_OPERATOR = regex(r"\boperator\s+(?=\W)")
_ERRORS = 20
_COMPOUND, _DECLARATION = kinds("compound_statement"), kinds("declaration")
_MADE, _ARGUMENTS = kinds("init_declarator"), kinds("argument_list")
_OUTSIDE = "a statement outside of functions: braces that do not match hide part of the file"
_UNREAD = "syntax that is not understood: part of the function is not measured"


@dataclass(slots=True)
class _Class:
    """A class being read."""

    name: str
    is_public: bool
    methods: int = 0
    available: int = 0


@dataclass(frozen=True, slots=True)
class _Scope:
    """Where declarations stand: *name* is qualified, *space* the namespace around it, for friends."""

    name: str = ""
    space: str = ""
    inside: _Class | None = None

    def qualified(self, name: str) -> str:
        if name.startswith("::"):
            return name[2:]
        return f"{self.name}::{name}" if self.name else name


@dataclass(slots=True)
class _CppFile:
    unit: Unit
    functions: list[FunctionFacts] = field(default_factory=list)
    classes: list[ClassFacts] = field(default_factory=list)
    problems: list[tuple[int, str]] = field(default_factory=list)

    def problem(self, node: Node, message: str) -> None:
        entry = (self.unit.position(node)[0], message)
        if len(self.problems) < MOST_PROBLEMS and entry not in self.problems:
            self.problems.append(entry)


def read_cpp(text: str) -> FileFacts:
    """Measure a C++ source or header. Of the branches of ``#if`` the first is read (of ``#if 0`` the next).

    What cannot be read is left out, with a problem; nothing is raised.
    """
    if len(text) > LARGEST:
        return FileFacts(problems=((1, f"larger than {LARGEST} characters: the file is not measured"),))
    text = branches.first(text.removeprefix("\ufeff"))
    data, root = tree_of(_without_macros(blanks.readable(text)))
    if root is None:
        return FileFacts(problems=((1, "too unlike C++ to parse in reasonable time: the file is not measured"),))
    file = _CppFile(unit_of(data))
    _visit(file, root.children, _Scope(), 0)
    functions = sorted(file.functions, key=lambda f: (f.line, f.column))
    classes = sorted(file.classes, key=lambda c: (c.line, c.column))
    return FileFacts(tuple(functions), tuple(classes), tuple(file.problems))


def _without_macros(text: str) -> str:
    """*text* with blanks where macros stand that the grammar does not know."""
    text = _BEHIND.sub(lambda match: ")" + _VISIBLE.sub(" ", match[1]), text)
    return _INLINING.sub(lambda match: _VISIBLE.sub(" ", match.group()), text) if "INLINE" in text else text


def _visit(file: _CppFile, nodes: Iterable[Node], scope: _Scope, depth: int) -> None:
    for node in nodes:
        handler = _HANDLERS.get(node.kind_id)
        if handler is not None:
            if depth > DEEPEST:
                file.problem(node, TOO_DEEP)
                return
            handler(file, node, scope, depth + 1)


def _inside(file: _CppFile, node: Node, scope: _Scope, depth: int) -> None:
    _visit(file, node.children, scope, depth)


def _namespace(file: _CppFile, node: Node, scope: _Scope, depth: int) -> None:
    """Unnamed and inline namespaces are as good as not there."""
    named, body = node.child_by_field_id(_NAME), node.child_by_field_id(_BODY)
    name = scope.name
    if named is not None and node.children[0].kind_id not in _INLINE:
        name = scope.qualified("".join(file.unit.cut(named).split()))
    if body is not None:
        _visit(file, body.children, _Scope(name, name), depth)


def _friend(file: _CppFile, node: Node, scope: _Scope, depth: int) -> None:
    """A friend is no method; one that is defined here belongs to the namespace."""
    _visit(file, node.children, _Scope(scope.space, scope.space), depth)


def _access(file: _CppFile, node: Node, scope: _Scope, depth: int) -> None:
    if scope.inside is not None:
        scope.inside.is_public = any(child.kind_id in _PUBLIC for child in node.children)


def _class(file: _CppFile, node: Node, scope: _Scope, depth: int, alias: str = "") -> None:
    body = node.child_by_field_id(_BODY)
    if body is None:
        return
    named = types.specified_name(node)
    name = types.path(file.unit, named, depth)[0] if named is not None else alias
    if not name:  # its members are those of the class around it
        _visit(file, body.children, scope, depth)
        return
    line, column = file.unit.position(node if named is None else named)
    found = _Class(scope.qualified(name), any(child.kind_id in _STRUCT for child in node.children[:1]))
    _visit(file, body.children, _Scope(found.name, scope.space, found), depth)
    file.classes.append(
        ClassFacts(found.name, line, column, found.methods, found.available, mentions(file.unit, [node], is_class=True))
    )


def _typedef(file: _CppFile, node: Node, scope: _Scope, depth: int) -> None:
    alias = next((file.unit.cut(child) for child in reversed(node.children) if child.kind_id in _TYPEDEF_NAME), "")
    for child in node.children:
        if child.kind_id in _CLASS:
            _class(file, child, scope, depth, alias)


def _declaration(file: _CppFile, node: Node, scope: _Scope, depth: int) -> None:
    """Methods that are declared, and classes with the variables that are declared of them."""
    before = types.specifiers(file.unit, node.children, depth)
    if before.node is not None and before.node.kind_id in _CLASS:
        _class(file, before.node, scope, depth)
    if scope.inside is None:
        return
    for child in before.rest:
        if child.kind_id in types.DECLARATORS:
            declared = types.declarator(file.unit, child, before.type, depth)
            if declared.function is not None and not declared.is_parenthesized:
                _method(scope.inside, declared.name, node, before.node is not None)


def _method(owner: _Class, name: str, node: Node, has_type: bool) -> bool:
    """Count a method; False for a macro's use, which looks like a constructor of another name."""
    name = name.strip()
    is_made = name.startswith("~") or (name == owner.name.rpartition("::")[2] and not has_type)
    if not (has_type or is_made or name.startswith("operator")):
        return False
    owner.methods += 1
    is_deleted = any(child.kind_id in _DELETED for child in node.children)
    owner.available += owner.is_public and not is_made and not is_deleted
    return True


def _function(file: _CppFile, node: Node, scope: _Scope, depth: int) -> None:
    unit = file.unit
    before = types.specifiers(unit, node.children, depth)
    declarator = next((child for child in before.rest if child.kind_id in types.DECLARATORS), None)
    if declarator is None:
        return
    declared = types.declarator(unit, declarator, before.type, depth)
    if declared.function is None or not declared.name:
        return
    has_type = before.node is not None or any(child.kind_id in _TRAILING for child in declared.function.children)
    last = declared.name
    is_macro = not has_type and last.isupper() and "::" not in last and last != scope.name.rpartition("::")[2]
    if scope.inside is not None and not is_macro:
        _method(scope.inside, declared.name, node, has_type)
    parts = [child for child in node.children if child.kind_id in _BODIES or child.kind_id in _INITS]
    if not any(child.kind_id in _BODIES for child in parts):
        return  # defaulted or deleted
    if is_macro:  # TEST_F(Fixture, name): the name alone says nothing
        last = unit.collapsed(declared.function.start_byte, declared.function.end_byte)
        last = re.sub(r"\s*\(\s*", "(", re.sub(r"\s*,\s*", ", ", last))
    name = _OPERATOR.sub("operator", last if is_macro else scope.qualified(last))
    line, column = unit.position(declared.node)
    body = CppBody(unit)
    body.take(parts)
    counts = body.counts
    owner = (
        scope.name if scope.inside is not None and not is_macro else "" if is_macro else _prefix(name, declared.name)
    )
    file.functions.append(
        FunctionFacts(
            name=name,
            class_name=owner,
            line=line,
            column=column,
            complexity=counts.complexity,
            nesting=counts.nesting,
            calls=counts.calls,
            distinct=len(counts.names),
            paths=body.paths,
            mentions=mentions(unit, [node]) if owner else (),
        )
    )
    if counts.is_too_deep:
        file.problem(node, TOO_DEEP)
    if node.has_error and any(_is_lost(error) for error in errors(node, _ERRORS)):
        file.problem(node, _UNREAD)
    _visit(file, body.local, _Scope(name, name), depth)


def _stray(file: _CppFile, node: Node, scope: _Scope, depth: int) -> None:
    """The body of a function that declares its parameters before it, as C did before ANSI; else something is lost."""
    head = node.prev_sibling if node.kind_id in _COMPOUND and scope.inside is None else None
    while head is not None and head.kind_id in _DECLARATION:
        made = next((child for child in head.children if child.kind_id in _MADE), None)
        if made is not None and made.children[-1].kind_id in _ARGUMENTS:
            name = scope.qualified(file.unit.cut(made.children[0]))
            body = CppBody(file.unit)
            body.take([node])
            counts, (line, column) = body.counts, file.unit.position(made)
            numbers = (counts.complexity, counts.nesting, counts.calls, len(counts.names), body.paths)
            file.functions.append(FunctionFacts(name, "", line, column, *numbers))
            return
        head = head.prev_sibling
    file.problem(node, _OUTSIDE)


def _prefix(name: str, written: str) -> str:
    """What is before the last part of the *name* of a definition outside of its class; "" for a plain function's."""
    return name.rpartition("::")[0] if "::" in written.removeprefix("::").partition("operator")[0] else ""


def _is_lost(error: Node) -> bool:
    return any(child.kind_id in _LOST for child in error.children)


_Handler = Callable[[_CppFile, Node, _Scope, int], None]
_HANDLERS: dict[int, _Handler] = table(
    {
        "declaration field_declaration": _declaration,
        "function_definition inline_method_definition": _function,
        "template_declaration linkage_specification declaration_list translation_unit ERROR preproc_if preproc_ifdef": _inside,
        "compound_statement if_statement for_statement for_range_loop while_statement do_statement switch_statement"
        " return_statement try_statement": _stray,
        "namespace_definition": _namespace,
        "friend_declaration": _friend,
        "access_specifier": _access,
        "class_specifier struct_specifier union_specifier": _class,
        "type_definition": _typedef,
    }
)
