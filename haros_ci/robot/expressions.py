# SPDX-License-Identifier: Apache-2.0
"""``${…}`` of xacro evaluated over Python's syntax tree: a safe subset with bounds; what is outside it is unknown."""

from __future__ import annotations

import ast
import operator
import warnings
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any, Protocol

from haros_ci.robot.functions import MAX_SIZE, Function, Module, NotKnown, TooMuch, bounded, method, weight
from haros_ci.robot.unknown import UNKNOWN, Unknown
from haros_ci.robot.yaml_values import YamlDict

MAX_LENGTH = 4_000
MAX_DEPTH = 40


class Undefined(Exception):
    """A name that is not defined: *kind* property, argument or block; *places* are where it is asked for, innermost first."""

    def __init__(self, kind: str, name: str) -> None:
        super().__init__(kind, name)
        self.kind = kind
        self.name = name
        self.places: list[Any] = []


class Invalid(Exception):
    """An expression or a text that xacro refuses, or that is not followed here: its value is not known."""


class Names(Protocol):
    """What an expression asks for names."""

    def look_up(self, name: str) -> Any:
        """The value of a property or of what xacro offers. Undefined if there is none."""
        ...

    def member(self, name: str) -> Any: ...


@lru_cache(maxsize=4_096)
def parsed(text: str) -> ast.expr | None:
    """The syntax tree of *text*; None if it is none of Python."""
    if len(text) > MAX_LENGTH:
        return None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return ast.parse(text.strip(), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def evaluate(text: str, names: Names, spend: Callable[[int], None]) -> Any:
    """The value of the expression *text*, UNKNOWN if it is not known. *spend* is told each step. Undefined, Invalid."""
    tree = parsed(text)
    if tree is None:
        raise Invalid(f"not an expression: {text[:80]}")
    try:
        return _Evaluation(names, spend).value(tree, 0)
    except (NotKnown, TooMuch):
        return UNKNOWN
    except (ArithmeticError, LookupError, TypeError, ValueError, AttributeError, RecursionError) as err:
        raise Invalid(f"{type(err).__name__}: {err}"[:200]) from err


def _power(base: Any, exponent: Any) -> Any:
    if isinstance(base, int) and isinstance(exponent, int) and (abs(exponent) > 512 or base.bit_length() > 64):
        raise TooMuch
    result = base**exponent
    return result if isinstance(result, (int, float)) else UNKNOWN


def _times(left: Any, right: Any) -> Any:
    for text, count in ((left, right), (right, left)):
        if isinstance(text, (str, list, tuple)) and isinstance(count, int) and len(text) * count > MAX_SIZE:
            raise TooMuch
    return left * right


def _remainder(left: Any, right: Any) -> Any:
    if isinstance(left, str):
        raise NotKnown  # the formatting operator
    return left % right


_BINARY: Mapping[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: _times,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: _remainder,
    ast.Pow: _power,
    ast.BitAnd: operator.and_,
    ast.BitOr: operator.or_,
    ast.BitXor: operator.xor,
}
_UNARY: Mapping[type[ast.unaryop], Callable[[Any], Any]] = {
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
    ast.Not: operator.not_,
    ast.Invert: operator.invert,
}
_COMPARE: Mapping[type[ast.cmpop], Callable[[Any, Any], Any]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Is: operator.is_,
    ast.IsNot: operator.is_not,
    ast.In: lambda left, right: left in right,
    ast.NotIn: lambda left, right: left not in right,
}


#: What makes values that may hold more than what they are made of; what a name or an index gives was weighed before.
_MAKES = (ast.BinOp, ast.Call, ast.Dict, ast.DictComp, ast.GeneratorExp, ast.List, ast.ListComp, ast.Set, ast.Tuple)


def is_open(value: object, depth: int = 0) -> bool:
    """Whether something unknown is in *value*."""
    if isinstance(value, Unknown):
        return True
    if depth > 6:
        return True
    if isinstance(value, dict):
        return not isinstance(value, Module) and any(is_open(each, depth + 1) for each in value.values())
    return isinstance(value, (list, tuple)) and any(is_open(each, depth + 1) for each in value)


class _Evaluation:
    def __init__(self, names: Names, spend: Callable[[int], None]) -> None:
        self.names = names
        self.spend = spend
        self.local: dict[str, Any] = {}

    def value(self, node: ast.expr, depth: int) -> Any:
        if depth > MAX_DEPTH:
            raise TooMuch
        self.spend(1)
        handle = getattr(self, f"_{type(node).__name__.lower()}", None)
        if handle is None:
            raise NotKnown
        found = handle(node, depth + 1)
        if isinstance(node, _MAKES) and isinstance(found, (str, list, tuple, dict, set)):
            self.spend(weight(found) // 8)
        return found

    def is_open(self, value: object) -> bool:
        """As ``is_open``, for the steps that it takes."""
        if isinstance(value, (list, tuple, dict)):
            self.spend(weight(value) // 8)
        return is_open(value)

    def _constant(self, node: ast.Constant, _: int) -> Any:
        if isinstance(node.value, (bytes, complex)) or node.value is Ellipsis:
            raise NotKnown
        return bounded(node.value)

    def _name(self, node: ast.Name, _: int) -> Any:
        return self.local[node.id] if node.id in self.local else self.names.look_up(node.id)

    def _binop(self, node: ast.BinOp, depth: int) -> Any:
        left, right = self.value(node.left, depth), self.value(node.right, depth)
        handle = _BINARY.get(type(node.op))
        if handle is None or self.is_open(left) or self.is_open(right):
            return UNKNOWN
        return bounded(handle(left, right))

    def _unaryop(self, node: ast.UnaryOp, depth: int) -> Any:
        value = self.value(node.operand, depth)
        return UNKNOWN if self.is_open(value) else _UNARY[type(node.op)](value)

    def _boolop(self, node: ast.BoolOp, depth: int) -> Any:
        """The first operand that decides; after an unknown one, the others are not sure to be looked at."""
        stops_at = isinstance(node.op, ast.Or)
        value: Any = None
        for each in node.values:
            value = self.value(each, depth)
            if self.is_open(value):
                return UNKNOWN
            if bool(value) is stops_at:
                return value
        return value

    def _compare(self, node: ast.Compare, depth: int) -> Any:
        left = self.value(node.left, depth)
        for sign, each in zip(node.ops, node.comparators):
            right = self.value(each, depth)
            if self.is_open(left) or self.is_open(right):
                return UNKNOWN
            if not _COMPARE[type(sign)](left, right):
                return False
            left = right
        return True

    def _ifexp(self, node: ast.IfExp, depth: int) -> Any:
        test = self.value(node.test, depth)
        if self.is_open(test):
            return UNKNOWN
        return self.value(node.body if test else node.orelse, depth)

    def _list(self, node: ast.List, depth: int) -> Any:
        return [self.value(each, depth) for each in node.elts]

    def _tuple(self, node: ast.Tuple, depth: int) -> Any:
        return tuple(self.value(each, depth) for each in node.elts)

    def _set(self, node: ast.Set, depth: int) -> Any:
        values = [self.value(each, depth) for each in node.elts]
        return UNKNOWN if self.is_open(values) else set(values)

    def _dict(self, node: ast.Dict, depth: int) -> Any:
        found = {}
        for key, each in zip(node.keys, node.values):
            if key is None:
                raise NotKnown
            name = self.value(key, depth)
            if self.is_open(name):
                return UNKNOWN
            found[name] = self.value(each, depth)
        return found

    def _subscript(self, node: ast.Subscript, depth: int) -> Any:
        value = self.value(node.value, depth)
        if isinstance(node.slice, ast.Slice):
            parts = [
                None if each is None else self.value(each, depth)
                for each in (node.slice.lower, node.slice.upper, node.slice.step)
            ]
            if isinstance(value, Unknown) or self.is_open(parts):
                return UNKNOWN
            return value[slice(*parts)]
        index = self.value(node.slice, depth)
        if isinstance(value, Unknown) or self.is_open(index):
            return UNKNOWN
        if not isinstance(value, (str, list, tuple, dict, range)):
            raise NotKnown
        return value[index]

    def _attribute(self, node: ast.Attribute, depth: int) -> Any:
        value = self.value(node.value, depth)
        if isinstance(value, Unknown):
            return UNKNOWN
        if isinstance(value, Module):
            return value.get(node.attr, UNKNOWN)
        if hasattr(value, "member"):
            return value.member(node.attr)
        self.is_open(value)
        found = method(value, node.attr)
        if found is not None:
            return found
        if isinstance(value, YamlDict) and not hasattr(dict, node.attr):
            return value[node.attr]
        raise NotKnown

    def _call(self, node: ast.Call, depth: int) -> Any:
        function = self.value(node.func, depth)
        arguments = []
        for each in node.args:
            value = self.value(each.value if isinstance(each, ast.Starred) else each, depth)
            arguments += list(bounded(value)) if isinstance(each, ast.Starred) and not self.is_open(value) else [value]
        named = {each.arg: self.value(each.value, depth) for each in node.keywords if each.arg is not None}
        if not isinstance(function, Function) or len(named) != len(node.keywords):
            return UNKNOWN
        if self.is_open(arguments) or self.is_open(named):
            return UNKNOWN
        self.spend(1 + sum(len(each) for each in arguments if hasattr(each, "__len__")) // 16)
        return bounded(function.call(*arguments, **named))

    def _listcomp(self, node: ast.ListComp, depth: int) -> Any:
        return self._collected(node.generators, lambda: self.value(node.elt, depth), depth)

    def _generatorexp(self, node: ast.GeneratorExp, depth: int) -> Any:
        return self._collected(node.generators, lambda: self.value(node.elt, depth), depth)

    def _dictcomp(self, node: ast.DictComp, depth: int) -> Any:
        pairs = self._collected(
            node.generators, lambda: (self.value(node.key, depth), self.value(node.value, depth)), depth
        )
        return UNKNOWN if self.is_open(pairs) else dict(pairs)

    def _collected(self, generators: list[ast.comprehension], item: Callable[[], Any], depth: int) -> Any:
        found: list[Any] = []
        kept = dict(self.local)
        known = self._turn(generators, item, found, depth)
        self.local = kept
        return found if known else UNKNOWN

    def _turn(self, generators: list[ast.comprehension], item: Callable[[], Any], found: list[Any], depth: int) -> bool:
        """All turns of the first of *generators*; False if it is not known what they are."""
        if not generators:
            found.append(item())
            bounded(found)
            return True
        values = self.value(generators[0].iter, depth)
        if isinstance(values, Unknown) or not isinstance(values, (str, list, tuple, dict, range, set)):
            return False
        for each in bounded(values):
            self.spend(1)
            if not self._bind(generators[0].target, each):
                return False
            tests = [self.value(test, depth) for test in generators[0].ifs]
            if self.is_open(tests):
                return False
            if all(tests) and not self._turn(generators[1:], item, found, depth + 1):
                return False
        return True

    def _bind(self, target: ast.expr, value: Any) -> bool:
        if isinstance(target, ast.Name):
            self.local[target.id] = value
            return True
        if not isinstance(target, (ast.Tuple, ast.List)) or not isinstance(value, (list, tuple)):
            return False
        if len(target.elts) != len(value):
            return False
        return all([self._bind(each, part) for each, part in zip(target.elts, value)])
