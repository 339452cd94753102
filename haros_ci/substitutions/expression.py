# SPDX-License-Identifier: Apache-2.0
"""``$(eval ...)``: a bounded subset of Python expressions, interpreted over ``ast`` and never executed."""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from haros_ci.substitutions.names import Text, literal, quoted
from haros_ci.substitutions.presence import OTHER
from haros_ci.substitutions.types import convert

MAX_SOURCE = 2_000
MAX_DEPTH = 40
MAX_SIZE = 10_000
_MAX_BITS = 4_000

_CONSTANTS: dict[str, object] = {
    "true": True,
    "false": False,
    "pi": math.pi,
    "e": math.e,
    "tau": math.tau,
    "inf": math.inf,
    "nan": math.nan,
}
_MATH: dict[str, Callable[..., Any]] = {
    function.__name__: function
    for function in (
        *(math.sin, math.cos, math.tan, math.asin, math.acos, math.atan, math.atan2, math.hypot),
        *(math.sinh, math.cosh, math.tanh, math.asinh, math.acosh, math.atanh, math.degrees, math.radians),
        *(math.sqrt, math.pow, math.exp, math.expm1, math.log, math.log10, math.log1p, math.log2),
        *(math.ceil, math.floor, math.trunc, math.fabs, math.fmod, math.copysign, math.isinf, math.isnan),
    )
}
#: Other names of Python's math module: they hide args of the same name, and are not computed here.
_OTHER_MATH = frozenset(
    ("comb", "dist", "erf", "erfc", "factorial", "frexp", "fsum", "gamma", "gcd", "isclose", "isfinite", "isqrt")
) | {"ldexp", "lgamma", "modf", "perm", "prod", "remainder"}
_BUILTINS: dict[str, Callable[..., Any]] = {
    "str": str,
    "int": int,
    "float": float,
    "bool": bool,
    "list": list,
    "dict": dict,
    "tuple": tuple,
    "len": len,
    "abs": abs,
    "min": min,
    "max": max,
    "round": round,
    "sum": sum,
    "sorted": sorted,
    "any": any,
    "all": all,
}
_TEXT_METHODS = frozenset(
    ("lower", "upper", "strip", "lstrip", "rstrip", "startswith", "endswith", "split", "rsplit", "replace", "title")
) | {"capitalize", "swapcase", "find", "rfind", "index", "count", "join", "isdigit", "isalpha", "isalnum", "isnumeric"}
_METHODS: dict[type, frozenset[str]] = {
    str: _TEXT_METHODS | {"islower", "isupper", "isspace"},
    list: frozenset(("index", "count")),
    tuple: frozenset(("index", "count")),
    dict: frozenset(("get", "keys", "values")),
}
_BINARY: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.Pow: operator.pow,
}
_COMPARE: dict[type[ast.cmpop], Callable[[Any, Any], bool]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Is: operator.is_,
    ast.IsNot: operator.is_not,
    ast.In: lambda item, items: item in items,
    ast.NotIn: lambda item, items: item not in items,
}


class Undecided(Exception):
    """The value depends on what is not known, or on what is not interpreted; the text is the reason."""


class Wrong(Exception):
    """roslaunch refuses this; *missing* is the name that it does not find."""

    def __init__(self, message: str, missing: str | None = None) -> None:
        super().__init__(message)
        self.missing = missing


@dataclass(frozen=True, slots=True)
class Scopes:
    """The args, environment look-up and directory that an expression sees."""

    args: Mapping[str, Text]
    env: Callable[[str], Text]
    environment: Mapping[str, str]
    directory: str
    #: What ``OTHER`` is compared with.
    compared: set[str] = field(default_factory=set)


def evaluate(source: str, scopes: Scopes) -> str:
    """The text of the value of *source*, as roslaunch makes it; Undecided or Wrong if there is none.

    Args are converted as ``auto`` parameters are. Paths (``find``, ``dirname``) can be passed on and appended to, but
    not looked into, for they are not known here.
    """
    value = compute(source, scopes)
    text = str(value)
    if len(text) > MAX_SIZE:
        raise Undecided("$(eval ...) makes a text too long to follow")
    return text


def compute(source: str, scopes: Scopes) -> object:
    """The value of the expression *source*; errors as evaluate has them."""
    if "__" in source:
        raise Wrong("double underscores are not allowed")
    if len(source) > MAX_SOURCE:
        raise Undecided(f"$(eval ...) is longer than {MAX_SOURCE} characters")
    try:
        tree = ast.parse(source.strip(" \t"), mode="eval")
    except SyntaxError as err:
        raise Wrong("not a Python expression; mind quotes and parentheses") from err
    except (ValueError, RecursionError, MemoryError) as err:
        raise Wrong("not a Python expression that can be read") from err
    try:
        return _value(tree.body, scopes, 0)
    except (ArithmeticError, TypeError, ValueError, LookupError, AttributeError) as err:
        raise Wrong(f"Python stops with {type(err).__name__}; check the types, args are converted as 'auto'") from err


def _value(node: ast.expr, scopes: Scopes, depth: int) -> Any:
    if depth > MAX_DEPTH:
        raise Undecided("$(eval ...) is nested too deeply to follow")

    def of(inner: ast.expr) -> Any:
        return _value(inner, scopes, depth + 1)

    match node:
        case ast.Constant(value=str() | int() | float() | bool() | None as constant):
            return constant
        case ast.Name(id=name):
            return _name(name, scopes)
        case ast.List(elts=items):
            return [of(item) for item in items]
        case ast.Tuple(elts=items):
            return tuple(of(item) for item in items)
        case ast.Dict(keys=keys, values=values) if None not in keys:
            return {_plain(of(key)): of(value) for key, value in zip(keys, values, strict=True) if key is not None}
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return not of(operand)
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -of(operand)
        case ast.UnaryOp(op=ast.UAdd(), operand=operand):
            return +of(operand)
        case ast.BoolOp(op=op, values=values):
            for operand in values:
                value = of(operand)
                if bool(value) == isinstance(op, ast.Or):
                    break
            return value
        case ast.IfExp(test=test, body=body, orelse=orelse):
            return of(body) if of(test) else of(orelse)
        case ast.BinOp(left=left, op=op, right=right):
            return _binary(op, of(left), of(right))
        case ast.Compare(left=left, ops=ops, comparators=comparators):
            return _compare(of(left), ops, comparators, of, scopes.compared)
        case ast.Subscript(value=container, slice=ast.Slice(lower=lower, upper=upper, step=step)):
            bounds = [None if bound is None else of(bound) for bound in (lower, upper, step)]
            return _plain(of(container))[slice(*bounds)]
        case ast.Subscript(value=container, slice=index):
            return _plain(of(container))[_plain(of(index))]
        case ast.Call(func=ast.Name(id=name), args=operands, keywords=[]):
            return _call(name, [of(operand) for operand in operands], scopes)
        case ast.Call(func=ast.Attribute(value=subject, attr=method), args=operands, keywords=[]):
            return _method(of(subject), method, [of(operand) for operand in operands])
        case ast.JoinedStr(values=pieces):
            return _sized("".join(str(of(piece)) for piece in pieces))
        case ast.FormattedValue(value=inner, conversion=-1, format_spec=None):
            return str(of(inner))
    raise Undecided(f"$(eval ...) uses {type(node).__name__}, which is not interpreted")


def _name(name: str, scopes: Scopes) -> object:
    if name in _CONSTANTS:
        return _CONSTANTS[name]
    if name in _MATH or name in _OTHER_MATH:
        raise Undecided(f"$(eval ...) uses the function {name} of Python's math as a value")
    if name in scopes.args:
        return _argument(name, scopes)
    if name in _BUILTINS:
        raise Undecided(f"$(eval ...) uses the function {name} as a value")
    raise Wrong(f"{quoted(name)} is not an argument declared above", missing=name)


def _argument(name: str, scopes: Scopes) -> object:
    text = scopes.args[name]
    if not text.known:
        raise Undecided(f"argument {quoted(name)}: {text.reasons[0]}")
    return convert(text.raw, "auto")


def _call(name: str, operands: list[Any], scopes: Scopes) -> object:
    if name in ("arg", "env", "optenv", "find", "anon", "dirname"):
        return _substitution(name, operands, scopes)
    function = _MATH.get(name)
    if function is None:
        function = _BUILTINS.get(name)
        if function is None or name in scopes.args:
            raise Undecided(f"$(eval ...) calls {name}(), which is not interpreted")
    if function is not str:
        operands = [_plain(operand) for operand in operands]
    if function is int and operands and isinstance(operands[0], str) and len(operands[0]) > 100:
        raise Undecided("$(eval ...) reads a number too long to follow")
    return _sized(function(*operands))


def _substitution(name: str, operands: list[Any], scopes: Scopes) -> object:
    counts = {"dirname": (0, 0), "optenv": (1, 2)}.get(name, (1, 1))
    if not counts[0] <= len(operands) <= counts[1] or not all(isinstance(operand, str) for operand in operands):
        raise TypeError
    if name == "dirname":
        return scopes.directory
    key = _plain(operands[0])
    if name == "find":
        return f"$(find {key})"
    if name == "anon":
        raise Undecided(f"anon({quoted(key)}) is chosen anew at each launch")
    if name == "optenv":
        default = operands[1] if len(operands) == 2 else ""
        return literal(scopes.environment.get(key, default)).raw
    if name == "env":
        text = scopes.env(key)
        if not text.known:
            raise Undecided(text.reasons[0])
        return text.raw
    if key not in scopes.args:
        raise Wrong(f"{quoted(key)} is not an argument declared above", missing=key)
    return _argument(key, scopes)


def _method(subject: Any, method: str, operands: list[Any]) -> object:
    _plain(subject)
    operands = [_plain(operand) for operand in operands]
    if method not in _METHODS.get(type(subject), ()):
        raise Undecided(f"$(eval ...) calls .{method}(), which is not interpreted")
    if method == "replace" and len(operands) >= 2 and all(isinstance(operand, str) for operand in operands[:2]):
        _fits(len(subject) + (subject.count(operands[0]) + 1) * len(operands[1]))
    if method == "join" and operands and isinstance(operands[0], (list, tuple)):
        _fits(sum(len(item) + len(subject) for item in operands[0] if isinstance(item, str)))
    result = getattr(subject, method)(*operands)
    return list(result) if method in ("keys", "values") else _sized(result)


def _binary(op: ast.operator, left: Any, right: Any) -> object:
    function = _BINARY.get(type(op))
    if function is None:
        raise Undecided(f"$(eval ...) uses {type(op).__name__}, which is not interpreted")
    if not isinstance(op, ast.Add):
        left, right = _plain(left), _plain(right)
    if isinstance(op, ast.Mult):
        for sequence, times in ((left, right), (right, left)):
            if isinstance(sequence, (str, list, tuple)) and isinstance(times, int):
                _fits(len(sequence) * max(times, 0))
    if isinstance(op, ast.Pow) and isinstance(left, int) and isinstance(right, int):
        _fits(left.bit_length() * abs(right), _MAX_BITS)
    if isinstance(op, ast.Mod) and isinstance(left, str) and re.search(r"%(?![sd%])", left):
        raise Undecided("$(eval ...) formats text in a way that is not interpreted")
    return _sized(function(left, right))


def _compare(
    left: Any, ops: list[ast.cmpop], comparators: list[ast.expr], of: Callable[[ast.expr], Any], compared: set[str]
) -> bool:
    for op, comparator in zip(ops, comparators, strict=True):
        right = of(comparator)
        if OTHER in (left, right):
            other = right if left == OTHER else left
            items = other if isinstance(other, (list, tuple)) else (other,)
            compared.update(str(item) for item in items if isinstance(item, (str, int, float)))
        if isinstance(op, (ast.Eq, ast.NotEq)) and "" in (left, right) and str in map(type, (left, right)):
            holds = (left == right) is isinstance(op, ast.Eq)  # a path is never empty
        else:
            holds = _COMPARE[type(op)](_plain(left), _plain(right))
        if not holds:
            return False
        left = right
    return True


def _plain(value: Any) -> Any:
    """*value* if nothing in it is a path, whose text is not known; else Undecided."""
    parts = [value]
    while parts:
        part = parts.pop()
        if isinstance(part, str):
            if "$(" in part:
                raise Undecided("$(eval ...) looks into a path, whose text depends on the machine")
        elif isinstance(part, (list, tuple)):
            parts.extend(part)
        elif isinstance(part, dict):
            parts.extend((*part.keys(), *part.values()))
    return value


def _sized(value: object) -> object:
    if isinstance(value, (str, list, tuple, dict)):
        _fits(len(value))
    elif isinstance(value, int):
        _fits(value.bit_length(), _MAX_BITS)
    return value


def _fits(size: int, limit: int = MAX_SIZE) -> None:
    if size > limit:
        raise Undecided("$(eval ...) makes a value too large to follow")
