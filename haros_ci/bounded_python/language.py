# SPDX-License-Identifier: Apache-2.0
"""What differs between the places where an expression of Python may stand."""

from __future__ import annotations

import ast
import operator
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from typing import Any, ClassVar

from haros_ci.bounded_python.limits import Limits, NotFollowed

COLLECTIONS = (list, tuple, dict, set, frozenset)

ARITHMETIC: Mapping[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
}
POWER: Mapping[type[ast.operator], Callable[[Any, Any], Any]] = {ast.Pow: operator.pow}
BITS: Mapping[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.BitAnd: operator.and_,
    ast.BitOr: operator.or_,
    ast.BitXor: operator.xor,
}
SIGNS: Mapping[type[ast.unaryop], Callable[[Any], Any]] = {
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
    ast.Not: operator.not_,
}
COMPARISONS: Mapping[type[ast.cmpop], Callable[[Any, Any], Any]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Is: operator.is_,
    ast.IsNot: operator.is_not,
    ast.In: lambda item, among: item in among,
    ast.NotIn: lambda item, among: item not in among,
}
#: The syntax that every language has.
SYNTAX: frozenset[type[ast.expr]] = frozenset(
    (ast.Constant, ast.Name, ast.List, ast.Tuple, ast.UnaryOp, ast.BoolOp, ast.BinOp, ast.Compare, ast.IfExp)
) | {ast.Subscript, ast.Call}


class Language(ABC):
    """What expressions of one kind may say, and what is made of what is not known."""

    limits: ClassVar[Limits]
    syntax: ClassVar[frozenset[type[ast.expr]]] = SYNTAX
    #: The types of constants, beside None.
    constants: ClassVar[tuple[type, ...]] = (str, int, float)
    operators: ClassVar[Mapping[type[ast.operator], Callable[[Any, Any], Any]]] = ARITHMETIC
    signs: ClassVar[Mapping[type[ast.unaryop], Callable[[Any], Any]]] = SIGNS
    #: Whether operators but ``+`` and ``not`` are followed for numbers alone.
    is_arithmetic: ClassVar[bool] = False
    #: Whether ``%`` on a text is followed.
    has_formats: ClassVar[bool] = False
    #: Whether a slice may have a step.
    has_steps: ClassVar[bool] = True
    #: Whether calls may name their arguments.
    has_keywords: ClassVar[bool] = False
    #: Whether functions are values that names and attributes give, and may be called wherever they stand.
    has_functions: ClassVar[bool] = False
    #: The methods there are, whatever their owner is; None if that depends on it.
    methods: ClassVar[frozenset[str] | None] = None
    #: Whether what stands after an unknown operand is looked at, for it may decide alone.
    looks_past_unknown: ClassVar[bool] = False
    #: Called for each step.
    spend: Callable[[int], None] = staticmethod(lambda steps: None)
    #: What a set is made of.
    set_of: ClassVar[type[set[Any] | frozenset[Any]]] = set

    @abstractmethod
    def name(self, name: str) -> Any:
        """The value that *name* has."""

    def function(self, name: str) -> Any:
        """The function *name*, where functions are no values."""
        raise NotFollowed

    @abstractmethod
    def attribute(self, owner: Any, name: str) -> Any:
        """``owner.name``; where functions are no values, the method of that name."""

    def is_unknown(self, value: Any) -> bool:
        """Whether *value*, or something in it, is not known."""
        return False

    def is_unknown_operand(self, value: Any) -> bool:
        """Whether nothing can be computed with *value*."""
        return self.is_unknown(value)

    def is_truth(self, value: Any) -> bool:
        """Whether an unknown *value* is True or False."""
        return False

    def unknown(self, is_truth: bool = False) -> Any:
        """What stands for a value that is not known; *is_truth* if it is True or False."""
        raise NotFollowed

    def unfollowed(self, node: ast.AST) -> Any:
        """What stands for the value of *node*, whose operands are evaluated, and which itself is not followed."""
        raise NotFollowed(node)

    def looked_into(self, value: Any) -> Any:
        """*value*, where its inside matters."""
        return value

    def compare(self, op: ast.cmpop, left: Any, right: Any) -> bool:
        """``left op right`` of two values that are known."""
        return bool(COMPARISONS[type(op)](left, right))

    def item(self, owner: Any, index: Any) -> Any:
        """``owner[index]``, where *index* may be a slice."""
        return owner[index]
