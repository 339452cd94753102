# SPDX-License-Identifier: Apache-2.0
"""Numbers that C and C++ libraries name: ``M_PI``, ``DBL_MAX``, ``std::numeric_limits<T>::max()``, on 64-bit systems."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from haros_ci.follow.conversions import CHARACTERS, WIDTHS
from haros_ci.index.types import INTEGERS
from haros_ci.syntax import Type
from haros_ci.values.abstract import Known, Opaque, Sequence, Value

_DOUBLE = {
    "max": 1.7976931348623157e308,
    "lowest": -1.7976931348623157e308,
    "min": 2.2250738585072014e-308,
    "epsilon": 2.220446049250313e-16,
    "infinity": math.inf,
}
_FLOAT = {
    "max": 3.4028234663852886e38,
    "lowest": -3.4028234663852886e38,
    "min": 1.1754943508222875e-38,
    "epsilon": 1.1920928955078125e-07,
    "infinity": math.inf,
}
_SIZES = {"CHAR": 8, "SHRT": 16, "INT": 32, "LONG": 64, "LLONG": 64, "INT8": 8, "INT16": 16, "INT32": 32, "INT64": 64}
#: Functions of <algorithm>, <cmath> and <cstdlib> that give one of the numbers that they are given, or one without its sign.
CHOOSING = frozenset(("std::max", "std::min", "std::clamp", "std::abs", "std::fabs", "abs", "fabs"))
#: The macros of <cmath>, <cfloat>, <climits> and <cstdint>, which a workspace may define otherwise.
CONSTANTS: Mapping[str, float | int] = {
    "M_E": math.e,
    "M_LOG2E": math.log2(math.e),
    "M_LOG10E": math.log10(math.e),
    "M_LN2": math.log(2),
    "M_LN10": math.log(10),
    "M_PI": math.pi,
    "M_PI_2": math.pi / 2,
    "M_PI_4": math.pi / 4,
    "M_1_PI": 1 / math.pi,
    "M_2_PI": 2 / math.pi,
    "M_2_SQRTPI": 2 / math.sqrt(math.pi),
    "M_SQRT2": math.sqrt(2),
    "M_SQRT1_2": math.sqrt(0.5),
    "INFINITY": math.inf,
    "HUGE_VAL": math.inf,
    **{
        f"{short}_{name.upper()}": table[name]
        for short, table in (("DBL", _DOUBLE), ("FLT", _FLOAT))
        for name in ("max", "min", "epsilon")
    },
    **{f"{name}_MAX": (1 << bits - 1) - 1 for name, bits in _SIZES.items() if name != "CHAR"},
    **{f"{name}_MIN": -(1 << bits - 1) for name, bits in _SIZES.items() if name != "CHAR"},
    **{f"U{name}_MAX": (1 << bits) - 1 for name, bits in _SIZES.items()},
    "SIZE_MAX": (1 << 64) - 1,
}


def limit(name: str, kind: Type) -> Known | None:
    """What ``std::numeric_limits<kind>::name()`` returns (en.cppreference.com/w/cpp/types/numeric_limits)."""
    if kind.marks.replace("c", "") or kind.name in ("double", "float"):
        table = {"double": _DOUBLE, "float": _FLOAT}.get(kind.name, {})
        return Known(table[name]) if name in table and not kind.marks.replace("c", "") else None
    words = kind.name.rpartition("::")[2].split()
    if not words or not (kind.name in INTEGERS or set(words) <= INTEGERS) or name not in ("max", "min", "lowest"):
        return None
    if words == ["char"] or "byte" in words:  # signed or not, as the processor has it
        return None
    is_signed = not any(word.startswith(("u", "size_t")) for word in words)
    is_byte = any(word in CHARACTERS for word in words)
    bits = 8 if is_byte else next((size for end, size in WIDTHS if words[-1].startswith(end) or end in words), 32)
    if name == "max":
        return Known((1 << (bits - 1 if is_signed else bits)) - 1)
    return Known(-(1 << bits - 1) if is_signed else 0)


def chosen(name: str, args: Iterable[Value]) -> Value | None:
    """One of several numbers, or one without its sign, as CHOOSING names it; None where they are not all known, and of one kind."""
    values = list(args)
    if len(values) == 1 and isinstance(values[0], Sequence) and isinstance(values[0].content.value, tuple):
        values = [cell.value for cell in values[0].content.value]
    known = [value for value in values if isinstance(value, Known) and value.kind in (int, float)]
    if not known or len(known) != len(values) or any(value.kind is not known[0].kind for value in known):
        return None
    last = name.rpartition("::")[2]
    numbers = [value.of(int) if value.kind is int else value.of(float) for value in known]
    if any(isinstance(number, float) and math.isnan(number) for number in numbers):
        return None
    if last in ("abs", "fabs"):
        return None if len(known) != 1 else known[0] if numbers[0] >= 0 else Known(-numbers[0])
    if last == "clamp":
        return known[sorted((1, 0, 2), key=numbers.__getitem__)[1]] if _is_range(numbers) else None
    place = max if last == "max" else min
    return known[place(range(len(numbers)), key=numbers.__getitem__)] if len(known) > 1 else None


def _is_range(numbers: list[int] | list[float] | list[int | float]) -> bool:
    return len(numbers) == 3 and numbers[1] <= numbers[2]


def of_text(value: Value) -> Value:
    """The number that a text is, as ``boost::lexical_cast`` reads it."""
    if isinstance(value, Known) and issubclass(value.kind, str):
        try:
            return Known(float(value.of(str)) if "." in value.of(str) else int(value.of(str)))
        except ValueError:
            return Opaque("it is no number")
    return value
