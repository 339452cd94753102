# SPDX-License-Identifier: Apache-2.0
"""Terms that the C++ and the Python of a parameter library have in common: values, names, bounds of numbers."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable

from haros_ci import syntax
from haros_ci.extract.parameter_library_tree import MAP, Declared, Element
from haros_ci.syntax import Expression, Statement, Type

NO_TYPE: Type = syntax.Type("")
THIS: Expression = syntax.This()


def name(text: str) -> Expression:
    return syntax.Name(text)


def text(value: str) -> Expression:
    return syntax.String(value)


def field(owner: Expression, *names: str) -> Expression:
    """``owner.a.b``."""
    for item in names:
        owner = syntax.Member(owner, item)
    return owner


def call(callee: Expression, args: Iterable[Expression], place: Declared, types: tuple[Type, ...] = ()) -> Expression:
    return syntax.Call(callee, tuple(args), types, place.line, place.column)


def assign(target: Expression, value: Expression) -> Statement:
    return syntax.Do(syntax.Assignment("=", target, value))


def joined(*parts: Expression) -> Expression:
    """``a + b + c``."""
    first, *rest = parts
    for part in rest:
        first = syntax.Operation("+", (first, part))
    return first


def pascal(key: str) -> str:
    """The struct's name for a key: ``__map_joints`` is MapJoints."""
    return "".join(word.title() for word in key.split("_"))


def map_place(parameter: Declared) -> tuple[tuple[str, ...], tuple[str, ...], tuple[str, ...]]:
    """The path of a mapped parameter before its maps, the keys of its maps, and the path in them."""
    at = [number for number, part in enumerate(parameter.path) if part.startswith(MAP)]
    return parameter.path[: at[0]], parameter.path[at[0] : at[-1] + 1], parameter.path[at[-1] + 1 :]


def element(value: Element, not_finite: dict[str, Expression]) -> Expression:
    """A literal; what is no finite number is one of *not_finite* (``nan``, ``inf``)."""
    if isinstance(value, bool):
        return syntax.Boolean(value)
    if isinstance(value, str):
        return syntax.String(value)
    if isinstance(value, float) and not math.isfinite(value):
        if math.isnan(value):
            return not_finite["nan"]
        return not_finite["inf"] if value > 0 else syntax.Operation("-", (not_finite["inf"],))
    return syntax.Number(value)


def default_of(parameter: Declared, not_finite: dict[str, Expression]) -> Expression | None:
    """The default as an expression, None where there is none."""
    if not parameter.is_sure:
        return syntax.Unknown("a default of another type than the parameter's")
    if parameter.default is None:
        return None
    if isinstance(parameter.default, tuple):
        return syntax.ListLiteral(tuple(element(item, not_finite) for item in parameter.default))
    return element(parameter.default, not_finite)


_LOWER = frozenset(("lower_bounds", "lower_element_bounds", "gt_eq"))
_UPPER = frozenset(("upper_bounds", "upper_element_bounds", "lt_eq"))


def bounds_of(parameter: Declared, *, is_exact: bool) -> tuple[float | None, float | None]:
    """The least and the greatest value that validators allow.

    Beyond a double that is excluded lies the next double, *is_exact*, or one that is an epsilon away.
    """
    lower: float | None = None
    upper: float | None = None
    if parameter.base not in ("int", "double"):
        return None, None
    for check, arguments in parameter.checks:
        numbers = [item for item in arguments if isinstance(item, int | float) and not isinstance(item, bool)]
        if len(numbers) != len(arguments) or not all(abs(n) < 2**1000 for n in numbers):
            continue
        if check in ("bounds", "element_bounds") and len(numbers) == 2:
            lower, upper = numbers
        elif len(numbers) != 1:
            continue
        elif check in _LOWER:
            lower = numbers[0]
        elif check in _UPPER:
            upper = numbers[0]
        elif check in ("gt", "lt"):
            bound = _next(parameter.base, numbers[0], 1 if check == "gt" else -1, is_exact)
            lower, upper = (bound, upper) if check == "gt" else (lower, bound)
    return lower, upper


def _next(base: str, value: float, sign: int, is_exact: bool) -> float:
    if base == "int":
        return value + sign
    return math.nextafter(value, sign * math.inf) if is_exact else value + sign * sys.float_info.epsilon
