# SPDX-License-Identifier: Apache-2.0
"""Flags of gflags: ``DEFINE_string(name, value, help)`` defines the variable ``FLAGS_name`` (gflags.h)."""

from __future__ import annotations

from tree_sitter import Node

from haros_ci import syntax
from haros_ci.extract.cpp import expressions
from haros_ci.extract.cpp.unit import CppScope, Unit
from haros_ci.syntax import Field, Type

#: The macros, and the types of what they define.
DEFINING = {
    "DEFINE_bool": "bool",
    "DEFINE_int32": "int",
    "DEFINE_uint32": "uint32_t",
    "DEFINE_int64": "int64_t",
    "DEFINE_uint64": "uint64_t",
    "DEFINE_double": "double",
    "DEFINE_string": "std::string",
}


def define(unit: Unit, macro: str, arguments: list[Node], scope: CppScope, depth: int) -> None:
    """Add the variable that a call of *macro* at namespace scope defines, if it is one of these."""
    kind = DEFINING.get(macro)
    if kind is None or len(arguments) != 3 or scope.members is not None:
        return
    name = unit.cut(arguments[0])
    if name.isidentifier():
        value = syntax.Equals(expressions.expression(unit, arguments[1], depth))
        line, column = unit.position(arguments[0])
        unit.found.variables.append(
            Field(scope.qualified(f"FLAGS_{name}"), Type(kind), value, line, column, False, scope.guards)
        )
