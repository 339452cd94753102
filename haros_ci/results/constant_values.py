# SPDX-License-Identifier: Apache-2.0
"""What an expression of Python comes to that is made of constants alone: ``1 - 1``, ``len("")``, ``"a" in ()``. Nothing is run; sizes are bounded."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import Any, ClassVar

from haros_ci.bounded_python.evaluation import Evaluation
from haros_ci.bounded_python.functions import FUNCTIONS, Function
from haros_ci.bounded_python.language import ARITHMETIC, BITS, SYNTAX, Language
from haros_ci.bounded_python.limits import Limits, NotFollowed, TooMuch


class Unknown:
    """What an expression comes to that is not known."""


UNKNOWN = Unknown()
_FAULTS = (NotFollowed, TooMuch, TypeError, ValueError, ArithmeticError, LookupError, AttributeError)
_NAMES = ("abs", "all", "any", "bool", "dict", "float", "int", "len", "list", "max", "min", "set", "str", "tuple")
_FUNCTIONS = {name: Function(name, FUNCTIONS[name]) for name in _NAMES}
_TYPES: dict[str, type] = {one.__name__: one for one in (bool, bytes, dict, float, int, list, set, str, tuple)}
_PLAIN = (bool, bytes, float, int, str)
#: The methods of a type; each makes a number, a truth, or a text that is about as long as its own.
_METHODS: dict[type, frozenset[str]] = {
    str: frozenset("strip lower upper startswith endswith isdigit isalpha count find title".split()),
    dict: frozenset(("get",)),
}


def value_of(node: ast.expr, given: Mapping[str, object]) -> object:
    """What *node* always comes to, with the constants *given*; UNKNOWN where that is not known, or is a failure."""
    if isinstance(node, ast.NamedExpr):
        return value_of(node.value, given)  # `if (found := 0):`; inside of other expressions it is not known
    evaluation = Evaluation(_Constants(given))
    try:
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "isinstance":
            value, kinds = node.args
            return _is_instance(evaluation.value(value), kinds)
        return evaluation.value(node)
    except _FAULTS:
        return UNKNOWN


def _is_instance(value: object, kinds: ast.expr) -> object:
    """Whether a constant is of one of the built-in types that are named there."""
    names = kinds.elts if isinstance(kinds, ast.Tuple) else [kinds]
    types = [_TYPES.get(one.id) if isinstance(one, ast.Name) else None for one in names]
    is_known = None not in types and (value is None or isinstance(value, _PLAIN))
    return isinstance(value, tuple(one for one in types if one is not None)) if is_known else UNKNOWN


class _Constants(Language):
    """Expressions of a file that is looked at, and not run: what is made of anything but constants raises NotFollowed."""

    limits = Limits(characters=0, depth=20, size=1_000, bits=30, weight=400)
    syntax = SYNTAX | {ast.Set, ast.Dict}
    constants = (str, bytes, int, float)
    operators: ClassVar = {**ARITHMETIC, **BITS}

    def __init__(self, given: Mapping[str, object]) -> None:
        self.given = given

    def name(self, name: str) -> Any:
        found = self.given.get(name, UNKNOWN)
        if found is UNKNOWN:
            raise NotFollowed
        return found

    def function(self, name: str) -> Any:
        if name in self.given or name not in _FUNCTIONS:
            raise NotFollowed
        return _FUNCTIONS[name]

    def attribute(self, owner: Any, name: str) -> Any:
        if name not in _METHODS.get(type(owner), ()):
            raise NotFollowed
        return Function(name, getattr(owner, name))

    def compare(self, op: ast.cmpop, left: Any, right: Any) -> bool:
        """Python may make two objects of one constant, or one of two, but of None, True and False."""
        if isinstance(op, ast.Is | ast.IsNot) and not any(
            one is None or isinstance(one, bool) for one in (left, right)
        ):
            raise NotFollowed
        return super().compare(op, left, right)
