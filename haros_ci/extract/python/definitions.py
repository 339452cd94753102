# SPDX-License-Identifier: Apache-2.0
"""Functions and classes of a Python file."""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import Any

from haros_ci import syntax
from haros_ci.extract.python import generators
from haros_ci.extract.python.annotations import NO_TYPE, dotted, type_of
from haros_ci.extract.python.expressions import expression, parameters, this_within
from haros_ci.extract.python.scope import Bindings, PythonScope, bound, qualified
from haros_ci.extract.python.source import place
from haros_ci.syntax import Block, Class, Expression, Function, Type

#: Lowers statements in a scope; ``statements.block``.
LowerBlock = Callable[[list[ast.stmt], PythonScope, int], Block]

_KINDS = {"__init__": "constructor", "__del__": "destructor"}
#: Class and static methods without a decorator (docs.python.org/3/reference/datamodel.html).
_IMPLICIT = frozenset(("__new__", "__init_subclass__", "__class_getitem__"))
_STATIC = frozenset(("staticmethod", "abstractstaticmethod"))
_OF_CLASS = frozenset(("classmethod", "abstractclassmethod"))


def define_function(
    node: ast.FunctionDef | ast.AsyncFunctionDef, scope: PythonScope, depth: int, lower: LowerBlock
) -> int:
    """Lower a function into ``scope.file.functions`` and give its index there."""
    file = scope.file
    index = len(file.functions)
    file.functions.append(None)
    is_method = scope.kind == "class"
    marks = {dotted(item).rpartition(".")[2] for item in node.decorator_list}
    is_static = is_method and (bool(marks & (_STATIC | _OF_CLASS)) or node.name in _IMPLICIT)
    found = parameters(node.args, scope, depth)
    positional = [*node.args.posonlyargs, *node.args.args]
    if is_method and positional and not marks & _STATIC:
        this: str | None = positional[0].arg
        found = found[1:]
    else:
        this = this_within(scope, {parameter.name.lstrip("*") for parameter in found})
    name = qualified(scope, node.name)
    line, column = place(file.source, node)
    file.functions[index] = Function(
        name=name,
        owner=scope.name if is_method else "",
        kind=_KINDS.get(node.name, "function") if is_method else "function",
        parameters=found,
        returns=annotation(node.returns, scope, depth),
        line=line,
        column=column,
        body=lower(generators.body_of(node), PythonScope(file, "function", name, this), depth),
        body_line=line,
        body_column=column,
        templates=_templates(node),
        is_static=is_static,
        decorators=tuple([expression(item, scope, depth) for item in node.decorator_list]),
    )
    return index


def define_class(node: ast.ClassDef, scope: PythonScope, depth: int, lower: LowerBlock) -> tuple[str, Block]:
    """Lower a class into ``scope.file.classes``; its qualified name, and the calls that are statements of its body: they run where it is defined."""
    file = scope.file
    name = qualified(scope, node.name)
    bindings = Bindings()
    index = len(file.classes)
    bases = tuple([annotation(base, scope, depth) for base in node.bases])
    line, column = place(file.source, node)
    file.classes.append(Class(name, bases, (), line, column, _templates(node)))
    body = lower(node.body, PythonScope(file, "class", name, None, bindings), depth)
    fields = bound(bindings, file.source, set())
    marks = tuple([expression(item, scope, depth) for item in node.decorator_list])
    file.classes[index] = Class(name, bases, fields, line, column, _templates(node), decorators=marks)
    return name, tuple(one for one in body if type(one) is syntax.Do and type(one.value) is syntax.Call)


def annotation(node: ast.expr | None, scope: PythonScope, depth: int) -> Type:
    """The type that an annotation or a base class says."""
    return NO_TYPE if node is None else type_of(node, lambda item: _value(item, scope, depth))


def _value(node: ast.expr, scope: PythonScope, depth: int) -> Expression:
    return expression(node, scope, depth)


def _templates(node: Any) -> tuple[str, ...]:
    """Type parameters in brackets (PEP 695), which ast has from Python 3.12."""
    return tuple(parameter.name for parameter in getattr(node, "type_params", ()))
