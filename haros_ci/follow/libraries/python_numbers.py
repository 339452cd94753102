# SPDX-License-Identifier: Apache-2.0
"""Numbers of Python: the constants and functions of ``math`` and their like, and the types that operators give.

docs.python.org/3/library/math.html, docs.python.org/3/reference/expressions.html#binary-arithmetic-operations.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.syntax import Type
from haros_ci.values.abstract import Known, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

_NAMED = {"pi": math.pi, "e": math.e, "inf": math.inf}
CONSTANTS: Mapping[str, float] = {
    **{f"{module}.{name}": value for module in ("math", "numpy") for name, value in _NAMED.items()},
    "math.tau": math.tau,
}
#: Functions of one or two numbers that give a float whatever they get, and are computed here.
_COMPUTED: Mapping[str, Callable[..., float]] = {
    **{
        f"math.{function.__name__}": function
        for function in (
            *(math.acos, math.asin, math.atan, math.atan2, math.copysign, math.cos, math.degrees, math.exp, math.fabs),
            *(math.fmod, math.hypot, math.log10, math.log2, math.radians, math.sin, math.sqrt, math.tan),
        )
    },
    "numpy.deg2rad": math.radians,
    "numpy.radians": math.radians,
    "numpy.rad2deg": math.degrees,
    "numpy.degrees": math.degrees,
    "numpy.sqrt": math.sqrt,
}
#: What gives a float that is another one each time.
_FLOATS = frozenset(
    [
        "time.time",
        "time.monotonic",
        "time.perf_counter",
        "random.random",
        "random.uniform",
        "random.gauss",
        "math.log",
        "math.pow",
        "math.dist",
    ]
)
DOUBLE, INT, TEXT = Type("double"), Type("int"), Type("std::string")
TEXTS = frozenset(("std::string", "str"))
_NUMBERS = frozenset(("bool", "int", "double"))
_LARGEST = 1e300


def called(walk: Walk, frame: Frame, name: str, args: Sequence[PassedArgument]) -> Value | None:
    """What a function of numbers gives; None for other functions. Of numpy's only those of one number, as arrays give arrays."""
    compute = _COMPUTED.get(name)
    if compute is not None:
        numbers = [argument.value.value for argument in args if isinstance(argument.value, Known)]
        if len(numbers) == len(args) <= 2 and all(
            isinstance(number, (int, float)) and abs(number) < _LARGEST for number in numbers
        ):
            try:
                return Known(compute(*numbers))
            except (ValueError, OverflowError, TypeError):
                return None
    if name in _FLOATS or (compute is not None and name.startswith("math.")):
        return walk.opaque(f"what {name} gives", frame, None, DOUBLE)
    return None


def operation(operator: str, kinds: Sequence[Type | None], exponent: object = None) -> Type | None:
    """The type that an operator of Python gives for operands of *kinds*; None where what is not known decides.

    An integer to the power of a negative *exponent* is a float.
    """
    names = [kind.name if kind is not None else "" for kind in kinds]
    if operator in ("&&", "||"):
        return kinds[0] if len(set(names)) == 1 else None
    if operator == "/":
        return DOUBLE if any(name in _NUMBERS for name in names) else None
    if (names[0] in TEXTS and operator in ("%", "+")) or (operator == "+" and names[-1] in TEXTS):
        return TEXT  # which takes nothing else
    if "double" in names and all(name in _NUMBERS or not name for name in names):
        return DOUBLE
    if not all(name in _NUMBERS for name in names) or (operator == "**" and not _is_positive(exponent)):
        return None
    return INT


def _is_positive(exponent: object) -> bool:
    return isinstance(exponent, (int, float)) and exponent >= 0
