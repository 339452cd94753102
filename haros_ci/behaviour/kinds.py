# SPDX-License-Identifier: Apache-2.0
"""The kinds of values in predicates, and which of them functions and operators take (hpl-specs 1.4, ``types.py`` and ``ast/expressions.py``).

A set of kinds is a number with a bit for each: what may be a number or a text is ``NUMBER | TEXT``.
"""

from __future__ import annotations

from collections.abc import Sequence

BOOL, NUMBER, TEXT, ARRAY, RANGE, SET, MESSAGE = (1 << bit for bit in range(7))
PRIMITIVE = BOOL | NUMBER | TEXT
ITEM = PRIMITIVE | MESSAGE
COMPOUND = ARRAY | RANGE | SET
FIELD = ITEM | ARRAY
ANY = ITEM | COMPOUND

_WORDS = {
    BOOL: "true or false", NUMBER: "a number", TEXT: "a text", ARRAY: "an array", RANGE: "a range", SET: "a set", MESSAGE: "a message",
}  # fmt: skip

_ONE = ((NUMBER,),)
_TWO = ((NUMBER, NUMBER),)
_MEMBERS = ((COMPOUND,),)
_ANGLE = ((MESSAGE,), (NUMBER, NUMBER, NUMBER, NUMBER))
#: Functions that take the members of one value, or two or more numbers.
VARIADIC = frozenset(("max", "min", "gcd"))
#: What each function takes, one row for each way to call it.
PARAMETERS: dict[str, tuple[tuple[int, ...], ...]] = {
    **dict.fromkeys(
        ("abs", "sqrt", "ceil", "floor", "sin", "cos", "tan", "asin", "acos", "atan", "deg", "rad"),
        _ONE,
    ),
    **dict.fromkeys(("log", "atan2"), _TWO),
    **dict.fromkeys(("bool", "int", "float", "str"), ((PRIMITIVE,),)),
    **dict.fromkeys(("len", "sum", "prod"), _MEMBERS),
    **dict.fromkeys(("max", "min", "gcd"), (*_MEMBERS, *_TWO)),
    **dict.fromkeys(("roll", "pitch", "yaw"), _ANGLE),
}
RESULTS = {"bool": BOOL, "str": TEXT}

#: What the operators take and give: left, right, result.
OPERATORS: dict[str, tuple[int, int, int]] = {
    **dict.fromkeys(("+", "-", "*", "/", "**"), (NUMBER, NUMBER, NUMBER)),
    **dict.fromkeys(("implies", "iff", "or", "and"), (BOOL, BOOL, BOOL)),
    **dict.fromkeys(("=", "!="), (PRIMITIVE, PRIMITIVE, BOOL)),
    **dict.fromkeys(("<", "<=", ">", ">="), (NUMBER, NUMBER, BOOL)),
    "in": (PRIMITIVE, COMPOUND, BOOL),
}
UNARY = {"-": NUMBER, "not": BOOL}


def in_words(kinds: int) -> str:
    """``a number or a text``."""
    words = [word for bit, word in _WORDS.items() if kinds & bit]
    return " or ".join(words)


def takes(function: str, arguments: Sequence[int]) -> bool:
    """Whether *function* can be called with arguments of these kinds."""
    for row in PARAMETERS[function]:
        more = arguments[len(row) :]
        fits = len(arguments) >= len(row) and all(argument & parameter for argument, parameter in zip(arguments, row))
        if fits and (not more or (function in VARIADIC and len(row) > 1 and all(number & NUMBER for number in more))):
            return True
    return False


def signature(function: str) -> str:
    """What *function* takes, in words."""
    rows = [", ".join(in_words(number) for number in row) for row in PARAMETERS[function]]
    more = ", …" if function in VARIADIC else ""
    return " or ".join(f"({row}{more if ',' in row else ''})" for row in rows)
