# SPDX-License-Identifier: Apache-2.0
"""``math(EXPR)``: 64-bit integer expressions of C."""

from __future__ import annotations

from haros_ci.regex import regex

MAX_TOKENS = 200
MAX_NESTING = 30
LARGEST = (1 << 63) - 1  # CMake reads numbers with std::stoll, and refuses what is out of its range

_TOKEN = regex(r"\s*(0[xX][0-9a-fA-F]{1,16}|[0-9]{1,19}|<<|>>|[-+*/%|&^~()])")
_LEVELS = (("|",), ("^",), ("&",), ("<<", ">>"), ("+", "-"), ("*", "/", "%"))


def evaluate_math(text: str) -> int | None:
    """The value of an expression; None if it is malformed, too long, divides by zero, or has a number of more than 63 bits."""
    tokens: list[str] = []
    position = 0
    text = text.rstrip()
    while position < len(text):
        match = _TOKEN.match(text, position)
        if match is None or len(tokens) >= MAX_TOKENS:
            return None
        tokens.append(match[1])
        position = match.end()
    tokens.reverse()
    try:
        value = _binary(tokens, 0, 0)
    except (ValueError, ZeroDivisionError, IndexError):
        return None
    return None if tokens else value


def _binary(tokens: list[str], level: int, depth: int) -> int:
    if level == len(_LEVELS):
        return _unary(tokens, depth)
    value = _binary(tokens, level + 1, depth)
    while tokens and tokens[-1] in _LEVELS[level]:
        operator = tokens.pop()
        value = _apply(operator, value, _binary(tokens, level + 1, depth))
    return value


def _unary(tokens: list[str], depth: int) -> int:
    token = tokens.pop()
    if token in "+-~(":
        if depth >= MAX_NESTING:
            raise ValueError
        if token == "(":
            value = _binary(tokens, 0, depth + 1)
            if tokens.pop() != ")":
                raise ValueError
            return value
        value = _unary(tokens, depth + 1)
        return _wrapped({"+": value, "-": -value, "~": ~value}[token])
    number = int(token, 0) if token[:2].lower() == "0x" else int(token)
    if number > LARGEST:
        raise ValueError
    return number


def _apply(operator: str, left: int, right: int) -> int:
    if operator in ("/", "%"):  # towards zero, as C divides
        quotient = abs(left) // abs(right) * (1 if (left < 0) == (right < 0) else -1)
        if quotient > LARGEST:  # the smallest number by -1: no number of C
            raise ValueError
        return quotient if operator == "/" else left - quotient * right
    if operator in ("<<", ">>"):
        if not 0 <= right < 64:
            raise ValueError
        return _wrapped(left << right) if operator == "<<" else left >> right
    values = {"|": left | right, "^": left ^ right, "&": left & right}
    values |= {"+": left + right, "-": left - right, "*": left * right}
    return _wrapped(values[operator])


def _wrapped(value: int) -> int:
    return (value + (1 << 63)) % (1 << 64) - (1 << 63)
