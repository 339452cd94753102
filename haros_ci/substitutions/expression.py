# SPDX-License-Identifier: Apache-2.0
"""``$(eval ...)``: a bounded subset of Python expressions, interpreted over ``ast`` and never executed."""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Mapping
from typing import Any, ClassVar

from haros_ci.bounded_python.evaluation import Evaluation
from haros_ci.bounded_python.functions import FUNCTIONS, Function
from haros_ci.bounded_python.language import ARITHMETIC, COMPARISONS, POWER, SYNTAX, Language
from haros_ci.bounded_python.limits import Limits, NotFollowed, TooMuch, check_text_method, parsed
from haros_ci.model.environment import lost_of
from haros_ci.records import dataclass, field
from haros_ci.substitutions.names import Text, literal, quoted
from haros_ci.substitutions.presence import OTHER
from haros_ci.substitutions.types import convert

MAX_SIZE = 10_000
LIMITS = Limits(characters=2_000, depth=40, size=MAX_SIZE, bits=4_000)

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
    name: FUNCTIONS[name]
    for name in (
        *("str", "int", "float", "bool", "list", "dict", "tuple", "len", "abs", "min", "max", "round", "sum"),
        *("sorted", "any", "all"),
    )
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


class Undecided(Exception):
    """The value depends on what is not known, or on what is not interpreted; the text is the reason."""


class Wrong(Exception):
    """roslaunch refuses this; *missing* is the name that it does not find."""

    def __init__(self, message: str, missing: str | None = None) -> None:
        super().__init__(message)
        self.missing = missing


@dataclass(frozen=True, slots=True)
class ExpressionScopes:
    """The args, environment look-up and directory that an expression sees."""

    args: Mapping[str, Text]
    env: Callable[[str], Text]
    environment: Mapping[str, str]
    directory: str
    #: What ``OTHER`` is compared with.
    compared: set[str] = field(default_factory=set)


def evaluate(source: str, scopes: ExpressionScopes) -> str:
    """The text of the value of *source*, as roslaunch makes it; Undecided or Wrong if there is none.

    Args are converted as ``auto`` parameters are. Paths (``find``, ``dirname``) can be passed on and appended to, but
    not looked into, for they are not known here.
    """
    value = compute(source, scopes)
    text = str(value)
    if len(text) > MAX_SIZE:
        raise Undecided("$(eval ...) makes a text too long to follow")
    return text


def compute(source: str, scopes: ExpressionScopes) -> object:
    """The value of the expression *source*; errors as evaluate has them."""
    if "__" in source:
        raise Wrong("double underscores are not allowed")
    try:
        tree = parsed(source.strip(" \t"), LIMITS) if len(source) <= LIMITS.characters else None
    except SyntaxError as err:
        raise Wrong("not a Python expression; mind quotes and parentheses") from err
    except (ValueError, RecursionError, MemoryError) as err:
        raise Wrong("not a Python expression that can be read") from err
    if tree is None:
        raise Undecided(f"$(eval ...) is longer than {LIMITS.characters} characters")
    try:
        return Evaluation(_Roslaunch(scopes)).value(tree)
    except NotFollowed as err:
        reason = err.description or f"uses {type(err.node).__name__}, which is not interpreted"
        raise Undecided(f"$(eval ...) {reason}") from err
    except TooMuch as err:
        is_deep = err.what == "depth"
        reason = "is nested too deeply to follow" if is_deep else "makes a value too large to follow"
        raise Undecided(f"$(eval ...) {reason}") from err
    except (ArithmeticError, TypeError, ValueError, LookupError, AttributeError) as err:
        raise Wrong(f"Python stops with {type(err).__name__}; check the types, args are converted as 'auto'") from err


class _Roslaunch(Language):
    """Python as roslaunch evaluates it: names are args, nothing unknown is computed with, and paths are not looked into."""

    limits = LIMITS
    syntax = SYNTAX | {ast.Dict, ast.FormattedValue, ast.JoinedStr}
    operators: ClassVar = {**ARITHMETIC, **POWER}
    has_formats = True

    def __init__(self, scopes: ExpressionScopes) -> None:
        self.scopes = scopes

    def name(self, name: str) -> object:
        return _name(name, self.scopes)

    def function(self, name: str) -> Function:
        return Function(name, lambda *arguments: _call(name, [*arguments], self.scopes))

    def attribute(self, owner: Any, name: str) -> Function:
        return Function(f".{name}", lambda *arguments: _method(owner, name, [*arguments]))

    def looked_into(self, value: Any) -> Any:
        return _plain(value)

    def compare(self, op: ast.cmpop, left: Any, right: Any) -> bool:
        return _compare(op, left, right, self.scopes.compared)


def _name(name: str, scopes: ExpressionScopes) -> object:
    if name in _CONSTANTS:
        return _CONSTANTS[name]
    if name in _MATH or name in _OTHER_MATH:
        raise Undecided(f"$(eval ...) uses the function {name} of Python's math as a value")
    if name in scopes.args:
        return _argument(name, scopes)
    if name in _BUILTINS:
        raise Undecided(f"$(eval ...) uses the function {name} as a value")
    raise Wrong(f"{quoted(name)} is not an argument declared above", missing=name)


def _argument(name: str, scopes: ExpressionScopes) -> object:
    text = scopes.args[name]
    if not text.known:
        raise Undecided(f"argument {quoted(name)}: {text.reasons[0]}")
    return convert(text.raw, "auto")


def _call(name: str, operands: list[Any], scopes: ExpressionScopes) -> object:
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
    return function(*operands)


def _substitution(name: str, operands: list[Any], scopes: ExpressionScopes) -> object:
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
        lost = lost_of(scopes.environment).get(key)
        if lost is not None:
            raise Undecided(lost)
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
    check_text_method(method, subject, operands, LIMITS)
    result = getattr(subject, method)(*operands)
    return list(result) if method in ("keys", "values") else result


def _compare(op: ast.cmpop, left: Any, right: Any, compared: set[str]) -> bool:
    if OTHER in (left, right):
        other = right if left == OTHER else left
        items = other if isinstance(other, (list, tuple)) else (other,)
        compared.update(str(item) for item in items if isinstance(item, (str, int, float)))
    if isinstance(op, (ast.Eq, ast.NotEq)) and "" in (left, right) and str in map(type, (left, right)):
        return (left == right) is isinstance(op, ast.Eq)  # a path is never empty
    return bool(COMPARISONS[type(op)](_plain(left), _plain(right)))


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
