# SPDX-License-Identifier: Apache-2.0
"""``${…}`` of xacro evaluated over Python's syntax tree: a safe subset with bounds; what is outside it is unknown."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable
from typing import Any, ClassVar, Protocol

from haros_ci.bounded_python import language, limits
from haros_ci.bounded_python.evaluation import Evaluation
from haros_ci.bounded_python.limits import weight
from haros_ci.robot.functions import CHANGING, LIMITS, Function, Module, NotFollowed, TooMuch, change, method
from haros_ci.robot.unknown import UNKNOWN, UnknownValue
from haros_ci.robot.yaml_values import YamlDict


class Undefined(Exception):
    """A name that is not defined: *kind* property, argument or block; *places* are where it is asked for, innermost first."""

    def __init__(self, kind: str, name: str) -> None:
        super().__init__(kind, name)
        self.kind = kind
        self.name = name
        self.places: list[Any] = []


class Invalid(Exception):
    """An expression or a text that xacro refuses, or that is not followed here: its value is not known."""


class Lists:
    """The lists of one expansion that expressions may change, by their identity: where each was first held, and those that are not known any more."""

    def __init__(self) -> None:
        self._held: dict[int, tuple[list[Any], int]] = {}
        self._lost: dict[int, list[Any]] = {}

    def hold(self, value: object, depth: int) -> None:
        """*value* is that of a property, *depth* unknown conditions deep."""
        if isinstance(value, list):
            known = self._held.get(id(value), (value, depth))[1]
            self._held[id(value)] = value, min(known, depth)

    def may_change(self, value: list[Any], depth: int) -> bool:
        """Whether a change that is *depth* unknown conditions deep is made for certain wherever the list is seen."""
        return depth == 0 or self._held.get(id(value), (value, 0))[1] >= depth

    def lose(self, value: list[Any]) -> None:
        """Nobody knows what is in the list from now on."""
        self._lost[id(value)] = value

    def keep(self, value: list[Any]) -> None:
        self._lost.pop(id(value), None)

    def known(self, value: Any) -> Any:
        """*value*, UNKNOWN if it is a list that is lost."""
        return UNKNOWN if id(value) in self._lost else value


class ExpressionNames(Protocol):
    """What an expression asks for names."""

    def look_up(self, name: str) -> Any:
        """The value of a property or of what xacro offers. Undefined if there is none."""
        ...

    def member(self, name: str) -> Any: ...

    @property
    def lists(self) -> Lists: ...

    def may_change(self, value: list[Any]) -> bool:
        """Whether an expression may change the list here."""
        ...


def parsed(text: str) -> ast.expr | None:
    """The syntax tree of *text*; None if it is not Python."""
    try:
        return limits.parsed(text.strip(), LIMITS)
    except (SyntaxError, ValueError, RecursionError, MemoryError, TooMuch):
        return None


def evaluate(text: str, names: ExpressionNames, spend: Callable[[int], None]) -> Any:
    """The value of the expression *text*, UNKNOWN if it is not known. *spend* is called for each step. Raises Undefined or Invalid."""
    tree = parsed(text)
    if tree is None:
        raise Invalid(f"not an expression: {text[:80]}")
    try:
        return Evaluation(_Xacro(names, spend)).value(tree)
    except (NotFollowed, TooMuch):
        return UNKNOWN
    except (ArithmeticError, LookupError, TypeError, ValueError, AttributeError, RecursionError) as err:
        raise Invalid(f"{type(err).__name__}: {err}"[:200]) from err


def is_open(value: object, depth: int = 0) -> bool:
    """Whether something unknown is in *value*."""
    if isinstance(value, UnknownValue):
        return True
    if depth > 6:
        return True
    if isinstance(value, dict):
        return not isinstance(value, Module) and any(is_open(item, depth + 1) for item in value.values())
    return isinstance(value, (list, tuple)) and any(is_open(item, depth + 1) for item in value)


def _power(base: Any, exponent: Any) -> Any:
    result = base**exponent
    return result if isinstance(result, (int, float)) else UNKNOWN


class _Xacro(language.Language):
    """Python as xacro evaluates it: with its names, functions as values and comprehensions; formats are not followed."""

    limits = LIMITS
    syntax = language.SYNTAX | {
        *(ast.Attribute, ast.Dict, ast.Set, ast.Starred),
        *(ast.DictComp, ast.GeneratorExp, ast.ListComp),
    }
    operators: ClassVar = {**language.ARITHMETIC, **language.BITS, ast.Pow: _power}
    signs: ClassVar = {**language.SIGNS, ast.Invert: operator.invert}
    has_keywords = True
    has_functions = True

    def __init__(self, names: ExpressionNames, spend: Callable[[int], None]) -> None:
        self.names = names
        self.spend = spend

    def name(self, name: str) -> Any:
        return self.names.look_up(name)

    def attribute(self, owner: Any, name: str) -> Any:
        if isinstance(owner, UnknownValue):
            return UNKNOWN
        if isinstance(owner, Module):
            return owner.get(name, UNKNOWN)
        if hasattr(owner, "member"):
            return owner.member(name)
        if isinstance(owner, list) and name in CHANGING:
            return self._changing(owner, name)
        found = method(owner, name)
        if found is not None:
            return found
        if isinstance(owner, YamlDict) and not hasattr(dict, name):
            return self.names.lists.known(owner[name])
        raise NotFollowed

    def _changing(self, owner: list[Any], name: str) -> Function:
        """A method that changes the list *owner*, which is not known until that is done."""
        lists = self.names.lists
        lists.lose(owner)
        if not self.names.may_change(owner):
            raise NotFollowed

        def changed(*received: Any) -> Any:
            result = change(owner, name, received)
            lists.keep(owner)
            return result

        return Function(name, changed)

    def is_unknown(self, value: Any) -> bool:
        """As ``is_open``, for the steps that it takes."""
        if isinstance(value, (list, tuple, dict)):
            self.spend(weight(value, LIMITS) // 8)
        return is_open(value)

    def unknown(self, is_truth: bool = False) -> Any:
        return UNKNOWN

    def unfollowed(self, node: ast.AST) -> Any:
        return UNKNOWN

    def item(self, owner: Any, index: Any) -> Any:
        if not isinstance(index, slice) and not isinstance(owner, (str, list, tuple, dict, range)):
            raise NotFollowed
        return self.names.lists.known(owner[index])
