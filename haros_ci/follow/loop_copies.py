# SPDX-License-Identifier: Apache-2.0
"""Elements that a loop of C++ copies (``for (auto item : items)``), as far as its body may change them."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.follow import copies
from haros_ci.follow.walk import Walk
from haros_ci.syntax import Expression, Type
from haros_ci.syntax.walk import everything
from haros_ci.values.abstract import Object, Value


def changes(walk: Walk, statement: syntax.Each) -> bool:
    """Whether the body of a loop may change its variable, which is a copy of the element: by a method, or by another name, too."""
    key = ("sets", id(statement))
    if key not in walk.found:
        name = statement.name
        walk.found[key] = (any(_may_change(node, name) for node in everything(statement.body)), statement)
    return bool(walk.found[key][0])


def _may_change(node: object, name: str) -> bool:
    if type(node) is syntax.Assignment:
        return _root(node.target) == name
    if type(node) is syntax.Call:
        return _root(node.callee) == name if type(node.callee) is syntax.Member else syntax.Name(name) in node.arguments
    return type(node) is syntax.Variable and "&" in node.type.marks and name in map(_root, syntax.started(node.init))


def element_type(value: Value, known: Type | None) -> Type | None:
    """The type of an element that a loop over it copies: that of a map is a pair."""
    is_pair = known is None and isinstance(value, Object) and value.name == copies.PAIR
    return syntax.Type(copies.PAIR) if is_pair else known


def _root(target: Expression) -> str:
    """The variable of which a member or an element is assigned to; "" of all else."""
    while isinstance(target, (syntax.Member, syntax.Subscript)):
        target = target.object
    return target.name if type(target) is syntax.Name else ""
