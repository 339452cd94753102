# SPDX-License-Identifier: Apache-2.0
"""The values of expressions that are the same for all messages: literals, constants, and arithmetic with them."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable

from haros_ci.behaviour.messages import Constant, Scene
from haros_ci.behaviour.tree import Binary, Expression, Field, Literal, Unary

Scalar = bool | int | float | str
#: Greater numbers are not calculated with, nor are greater exponents.
GREATEST, GREATEST_EXPONENT, GREATEST_RESULT = 1e18, 64, 1e300

_ARITHMETIC: dict[str, Callable[[float, float], float]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "**": operator.pow,
}


def folded(expression: Expression, scene: Scene | None) -> Scalar | None:
    """The value; None if it depends on a message, or is not known. No value is NaN."""
    match expression:
        case Literal(value=value):
            return None if isinstance(value, float) and math.isnan(value) else value
        case Unary(operator="-", operand=operand):
            number = _number(operand, scene)
            return None if number is None else -number
        case Binary(operator=sign, left=left, right=right) if sign in _ARITHMETIC:
            return _calculated(sign, _number(left, scene), _number(right, scene))
        case Field() if scene is not None:
            typed = scene.typed(expression)
            return typed.value if isinstance(typed, Constant) else None
        case _:
            return None


def _number(expression: Expression, scene: Scene | None) -> int | float | None:
    found = folded(expression, scene)
    return None if isinstance(found, (bool, str)) else found


def _calculated(sign: str, left: float | None, right: float | None) -> float | None:
    if left is None or right is None or max(abs(left), abs(right)) > GREATEST:
        return None
    if sign == "**" and (abs(right) > GREATEST_EXPONENT or left < 0):
        return None
    try:
        found = _ARITHMETIC[sign](left, right)
    except (ArithmeticError, ValueError):
        return None
    return None if isinstance(found, complex) or not abs(found) <= GREATEST_RESULT else found
