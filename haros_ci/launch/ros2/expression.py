# SPDX-License-Identifier: Apache-2.0
"""``$(eval ...)`` and PythonExpression: a small part of Python computed over its syntax tree, never run."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Mapping
from typing import Any

from haros_ci.substitutions.names import MARK, Text, literal, quoted, unknown

MAX_CHARACTERS = 4_000
MAX_PARENTHESES = 40
MAX_DEPTH = 60
MAX_RESULT = 10_000

#: Stands for an unknown part while the text is parsed: a letter of an old script, so that it may be a name.
_LETTER = "\ua66e"
_METHODS = frozenset(
    ("lower", "upper", "strip", "lstrip", "rstrip", "startswith", "endswith", "replace", "split", "title", "capitalize")
)
_COMPARISONS: Mapping[type, Callable[[Any, Any], Any]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.In: lambda one, other: one in other,
    ast.NotIn: lambda one, other: one not in other,
    ast.Is: lambda one, other: one is other,
    ast.IsNot: lambda one, other: one is not other,
}
_ARITHMETIC: Mapping[type, Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
}


class _Undecided(Exception):
    """The value is not known, or outside of what is computed here."""


_SET_METHODS = frozenset(("intersection", "union", "difference"))


def _listed(values: Any = ()) -> list[Any]:
    """``list(x)``; in which order it takes what is in a set is not known."""
    if isinstance(values, frozenset) and len(values) > 1:
        raise _Undecided("the order of what is in a set is not known")
    return list(values)


_FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    "str": lambda value="": _text(value),
    "bool": bool,
    "int": int,
    "float": float,
    "len": len,
    "min": min,
    "max": max,
    "abs": abs,
    "any": any,
    "all": all,
    "list": _listed,
    "tuple": lambda values=(): tuple(_listed(values)),
    "set": frozenset,
    "sorted": sorted,
}


class _Opaque:
    """A value that is not known; *is_truth* if it is True or False."""

    def __init__(self, is_truth: bool = False) -> None:
        self.is_truth = is_truth


def expression_value(text: Text) -> Text:
    """What the Python expression *text* gives, as text (``str`` of it); unknown where it cannot be told.

    Constants, comparisons, and/or/not, in, + - * / // %, the conditional expression, str, bool, int, float, len,
    methods of texts, lists, sets and indices are computed; anything else is unknown. An unknown part of a text counts
    only where the value depends on it.
    """
    shown = quoted(text.raw)
    reasons = "; ".join(dict.fromkeys(text.reasons))
    source = text.raw.replace(_LETTER, "?").replace(MARK, _LETTER).strip()
    try:
        if len(source) > MAX_CHARACTERS or sum(map(source.count, "([{-~+")) > MAX_PARENTHESES * 10:
            raise _Undecided("it is too long")
        if sum(map(source.count, "([{")) > MAX_PARENTHESES:
            raise _Undecided("it is nested too deeply")
        value = _value(ast.parse(source, mode="eval").body, 0)
        if isinstance(value, _Opaque) or (isinstance(value, (list, tuple)) and _has_unknown(value)):
            return unknown(reasons or f"the expression {shown} is not computed")
        made = _text(value)
        if len(made) > MAX_RESULT:
            raise _Undecided("its value is too long")
    except _Undecided as err:
        return unknown(reasons or f"the expression {shown} is not computed: {err}")
    except SyntaxError:
        return unknown(reasons or f"{shown} is no Python expression")
    except (TypeError, ValueError, ArithmeticError, LookupError, AttributeError) as err:
        return unknown(reasons or f"the expression {shown} fails: {err}")
    except (RecursionError, MemoryError):
        return unknown(f"the expression {shown} is nested too deeply")
    if _LETTER in made:
        return Text(made.replace(_LETTER, MARK), (reasons,) * made.count(_LETTER))
    return literal(made)


def _text(value: Any) -> str:
    """``str(value)``."""
    todo = [value]
    while todo:
        part = todo.pop()
        if isinstance(part, frozenset):
            raise _Undecided("the order of what is in a set is not known")
        todo.extend(part if isinstance(part, (list, tuple)) else ())
    return str(value)


def _has_unknown(value: Any) -> bool:
    if isinstance(value, (list, tuple, frozenset)):
        return any(_has_unknown(item) for item in value)
    return isinstance(value, _Opaque) or (isinstance(value, str) and _LETTER in value)


def _value(node: ast.expr, depth: int) -> Any:
    if depth > MAX_DEPTH:
        raise _Undecided("it is nested too deeply")
    depth += 1
    if isinstance(node, ast.Constant):
        if node.value is None or isinstance(node.value, (bool, int, float, str)):
            return node.value
    elif isinstance(node, ast.Name):
        if _LETTER in node.id:
            return _Opaque()
        raise _Undecided(f"the name '{node.id}' is not defined; quote it if it is text")
    elif isinstance(node, ast.BoolOp):
        return _bool_operation(node, depth)
    elif isinstance(node, ast.UnaryOp):
        return _unary(node, depth)
    elif isinstance(node, ast.Compare):
        return _comparison(node, depth)
    elif isinstance(node, ast.IfExp):
        return _conditional(node, depth)
    elif isinstance(node, (ast.List, ast.Tuple, ast.Set)):
        items = [_value(item, depth) for item in node.elts]
        if isinstance(node, ast.Set):
            return frozenset(items)
        return items if isinstance(node, ast.List) else tuple(items)
    elif isinstance(node, ast.BinOp):
        return _arithmetic(node, depth)
    elif isinstance(node, ast.Subscript):
        return _subscript(node, depth)
    elif isinstance(node, ast.Call):
        return _call(node, depth)
    raise _Undecided("it uses more of Python than is followed")


def _bool_operation(node: ast.BoolOp, depth: int) -> Any:
    """``and``, ``or``: the first value that decides; an unknown truth does not matter before one that decides."""
    stops = isinstance(node.op, ast.Or)
    doubt = False
    value: Any = None
    for item in node.values:
        value = _value(item, depth)
        if _has_unknown(value):
            if not (isinstance(value, _Opaque) and value.is_truth):
                return _Opaque()
            doubt = True
        elif bool(value) == stops:
            if not doubt or isinstance(value, bool):
                return value
            return _Opaque()
    return _Opaque(isinstance(value, (bool, _Opaque))) if doubt else value


def _unary(node: ast.UnaryOp, depth: int) -> Any:
    value = _value(node.operand, depth)
    if _has_unknown(value):
        return _Opaque(isinstance(node.op, ast.Not))
    if isinstance(node.op, ast.Not):
        return not value
    if isinstance(node.op, (ast.USub, ast.UAdd)) and isinstance(value, (int, float)):
        return -value if isinstance(node.op, ast.USub) else +value
    raise _Undecided("it uses more of Python than is followed")


def _comparison(node: ast.Compare, depth: int) -> Any:
    left = _value(node.left, depth)
    doubt = False
    for kind, item in zip(node.ops, node.comparators, strict=True):
        right = _value(item, depth)
        if _has_unknown(left) or _has_unknown(right):
            doubt = True
        elif not _COMPARISONS[type(kind)](left, right):
            return False
        left = right
    return _Opaque(True) if doubt else True


def _conditional(node: ast.IfExp, depth: int) -> Any:
    test = _value(node.test, depth)
    if not _has_unknown(test):
        return _value(node.body if test else node.orelse, depth)
    one, other = _value(node.body, depth), _value(node.orelse, depth)
    if not _has_unknown(one) and type(one) is type(other) and one == other:
        return one
    return _Opaque(isinstance(one, bool) and isinstance(other, bool))


def _arithmetic(node: ast.BinOp, depth: int) -> Any:
    compute = _ARITHMETIC.get(type(node.op))
    if compute is None:
        raise _Undecided("it uses more of Python than is followed")
    left, right = _value(node.left, depth), _value(node.right, depth)
    if isinstance(left, _Opaque) or isinstance(right, _Opaque):
        return _Opaque()
    if not isinstance(node.op, ast.Add):
        if not all(isinstance(side, (int, float)) for side in (left, right)):
            raise _Undecided("it uses more of Python than is followed")
        if isinstance(node.op, ast.Mult) and max(abs(left), abs(right)) > 10**100:
            raise _Undecided("a number is too large")
    made = compute(left, right)
    if isinstance(made, (str, list, tuple)) and len(made) > MAX_RESULT:
        raise _Undecided("its value is too long")
    return made


def _subscript(node: ast.Subscript, depth: int) -> Any:
    value = _value(node.value, depth)
    if isinstance(node.slice, ast.Slice):
        ends = [None if part is None else _value(part, depth) for part in (node.slice.lower, node.slice.upper)]
        if node.slice.step is not None:
            raise _Undecided("it uses more of Python than is followed")
        index: Any = slice(*ends)
        doubt = any(_has_unknown(end) for end in ends)
    else:
        index = _value(node.slice, depth)
        doubt = _has_unknown(index)
    if doubt or isinstance(value, _Opaque) or (isinstance(value, str) and _LETTER in value):
        return _Opaque()
    return value[index]


def _call(node: ast.Call, depth: int) -> Any:
    if node.keywords or any(isinstance(item, ast.Starred) for item in node.args):
        raise _Undecided("it uses more of Python than is followed")
    arguments = [_value(item, depth) for item in node.args]
    if isinstance(node.func, ast.Name):
        function = _FUNCTIONS.get(node.func.id)
        if function is None:
            raise _Undecided(f"the function '{node.func.id}' is not followed")
        if node.func.id == "str" and len(arguments) == 1 and isinstance(arguments[0], str):
            return arguments[0]
        if any(_has_unknown(item) for item in arguments):
            return _Opaque(node.func.id in ("bool", "any", "all"))
        return function(*arguments)
    if isinstance(node.func, ast.Attribute) and node.func.attr in _METHODS | _SET_METHODS:
        owner = _value(node.func.value, depth)
        if _has_unknown(owner) or any(_has_unknown(item) for item in arguments):
            return _Opaque(node.func.attr in ("startswith", "endswith"))
        if isinstance(owner, frozenset) and node.func.attr in _SET_METHODS:
            return getattr(owner, node.func.attr)(*arguments)
        if isinstance(owner, str) and node.func.attr in _METHODS:
            if node.func.attr == "replace" and len(owner) * len(str(arguments[1:2])) > MAX_RESULT * 10:
                raise _Undecided("its value is too long")
            return getattr(owner, node.func.attr)(*arguments)
    raise _Undecided("it uses more of Python than is followed")
