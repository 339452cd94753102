# SPDX-License-Identifier: Apache-2.0
"""What an expression of Python comes to that is made of constants alone: ``1 - 1``, ``len("")``, ``"a" in ()``. Nothing is run; sizes are bounded."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from typing import Any

from haros_ci.bounded_python.language import ARITHMETIC, BITS, COMPARISONS, SIGNS

#: How deep an expression is looked into; what is larger is not known: numbers, and texts and groups by their length.
DEEPEST = 20
_LARGEST = 1_000_000_000
_LONGEST = 1_000


class Unknown:
    """What an expression comes to that is not known."""


UNKNOWN = Unknown()
_CALLED: dict[str, Callable[..., Any]] = {
    **{"len": len, "bool": bool, "int": int, "any": any, "all": all, "abs": abs, "float": float},
    **{
        "tuple": tuple,
        "list": tuple,
        "set": frozenset,
        "frozenset": frozenset,
        "dict": dict,
        "str": str,
        "bytes": lambda *given: b"" if not given else UNKNOWN,  # of a number it has that size
    },
}
_TYPES: dict[str, type] = {one.__name__: one for one in (str, bytes, int, float, bool, list, tuple, dict, set)}
_METHODS = frozenset("strip lower upper startswith endswith isdigit isalpha count find title".split())


def value_of(node: ast.expr, given: Mapping[str, object], depth: int = 0) -> object:
    """What *node* always comes to, with the constants *given*; UNKNOWN where that is not known. Groups are tuples, and equal to no list."""
    if depth > DEEPEST:
        return UNKNOWN
    if isinstance(node, ast.Constant):
        return _bounded(node.value)
    if isinstance(node, ast.Name):
        return given.get(node.id, UNKNOWN)
    if isinstance(node, ast.Tuple | ast.List | ast.Set):
        return _group(node.elts, given, depth) if len(node.elts) <= _LONGEST else UNKNOWN
    if isinstance(node, ast.Dict):
        return {} if not node.keys else UNKNOWN
    if isinstance(node, ast.NamedExpr):
        return value_of(node.value, given, depth + 1)
    if isinstance(node, ast.UnaryOp):
        sign = SIGNS.get(type(node.op))
        return UNKNOWN if sign is None else _made(sign, value_of(node.operand, given, depth + 1))
    if isinstance(node, ast.BinOp):
        join = ARITHMETIC.get(type(node.op)) or BITS.get(type(node.op))
        one, other = value_of(node.left, given, depth + 1), value_of(node.right, given, depth + 1)
        return UNKNOWN if join is None or not _may_join(node.op, one, other) else _made(join, one, other)
    if isinstance(node, ast.Compare):
        return _compared(node, given, depth)
    if isinstance(node, ast.Call) and not node.keywords:
        return _called(node, given, depth)
    return UNKNOWN


def _group(parts: list[ast.expr], given: Mapping[str, object], depth: int) -> object:
    values = [value_of(one, given, depth + 1) for one in parts]
    return UNKNOWN if any(one is UNKNOWN for one in values) else tuple(values)


def _compared(node: ast.Compare, given: Mapping[str, object], depth: int) -> object:
    """A chain of comparisons: False if one is; UNKNOWN if one is not known before that."""
    left = value_of(node.left, given, depth + 1)
    for sign, part in zip(node.ops, node.comparators, strict=True):
        right = value_of(part, given, depth + 1)
        if isinstance(sign, ast.Is | ast.IsNot):
            # other objects may be one or two, as Python likes
            if not any(one is None or isinstance(one, bool) for one in (left, right)) or UNKNOWN in (left, right):
                return UNKNOWN
            answer: object = (left is right) is isinstance(sign, ast.Is)
        elif isinstance(left, tuple) and isinstance(right, tuple) and isinstance(sign, ast.Eq | ast.NotEq):
            return UNKNOWN
        else:
            answer = _made(COMPARISONS[type(sign)], left, right)
        if answer is not True:
            return answer
        left = right
    return True


def _called(node: ast.Call, given: Mapping[str, object], depth: int) -> object:
    if isinstance(node.func, ast.Name) and node.func.id == "isinstance" and len(node.args) == 2:
        return _is_instance(node.args[0], node.args[1], given, depth)
    values = [value_of(one, given, depth + 1) for one in node.args]
    if isinstance(node.func, ast.Name) and node.func.id in _CALLED and node.func.id not in given and len(values) < 2:
        return _made(_CALLED[node.func.id], *values)
    if isinstance(node.func, ast.Attribute) and node.func.attr in _METHODS:
        text = value_of(node.func.value, given, depth + 1)
        return _made(getattr(str, node.func.attr), text, *values) if isinstance(text, str) else UNKNOWN
    if isinstance(node.func, ast.Attribute) and isinstance(node.func.value, ast.Dict) and not node.func.value.keys:
        return _made({}.get, *values) if node.func.attr == "get" else UNKNOWN
    return UNKNOWN


def _is_instance(node: ast.expr, kind: ast.expr, given: Mapping[str, object], depth: int) -> object:
    """Whether a constant is of one of the built-in types that are named there."""
    value = value_of(node, given, depth + 1)
    names = kind.elts if isinstance(kind, ast.Tuple) else [kind]
    types = [_TYPES.get(one.id) if isinstance(one, ast.Name) else None for one in names]
    if value is not None and not isinstance(value, bool | int | float | str | bytes):
        return UNKNOWN
    return UNKNOWN if None in types else isinstance(value, tuple(one for one in types if one is not None))


def _may_join(sign: ast.operator, one: object, other: object) -> bool:
    """Whether the result has a bounded size: two numbers, or two texts that are added."""
    if isinstance(one, int | float) and isinstance(other, int | float):
        return True
    return isinstance(sign, ast.Add) and type(one) is type(other) and isinstance(one, str | tuple)


def _made(function: Callable[..., object], *values: object) -> object:
    """The answer of a harmless *function*; UNKNOWN where it has none, or a large one."""
    if any(one is UNKNOWN for one in values):
        return UNKNOWN
    try:
        return _bounded(function(*values))
    except (TypeError, ValueError, ArithmeticError, AttributeError):
        return UNKNOWN


def _bounded(value: object) -> object:
    if isinstance(value, int | float):
        return value if -_LARGEST <= value <= _LARGEST else UNKNOWN
    if isinstance(value, str | bytes | tuple | frozenset):
        return value if len(value) <= _LONGEST else UNKNOWN
    return value if value is None or value is Ellipsis or value == {} else UNKNOWN
