# SPDX-License-Identifier: Apache-2.0
"""Literals: what numbers, characters and strings stand for."""

from __future__ import annotations

import re

from haros_ci.regex import regex

_SIMPLE = {"n": "\n", "t": "\t", "r": "\r", "0": "\0", "a": "\a", "b": "\b", "f": "\f", "v": "\v", "e": "\x1b"}
_ESCAPE = regex(r"\\(?:x([0-9A-Fa-f]{1,8})|u([0-9A-Fa-f]{4})|U([0-9A-Fa-f]{8})|([0-7]{1,3})|(\r?\n)|(.))", re.DOTALL)
_INTEGER = regex(r"([-+]?)(0[xX][0-9a-fA-F]+|0[bB][01]+|[0-9]+)([uUlLzZ]*)")
_FLOAT = regex(r"([-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)[fFlL]?")
_HEX_FLOAT = regex(r"([-+]?0[xX][0-9a-fA-F.]+[pP][-+]?[0-9]+)[fFlL]?")
_LONGEST_NUMBER = 100


def number(text: str) -> int | float | None:
    """The value of a C++ number, signed or not; None if it is not one."""
    if len(text) > _LONGEST_NUMBER:
        return None
    text = text.replace("'", "").replace(" ", "")
    match = _INTEGER.fullmatch(text)
    if match:
        sign, digits, _ = match.groups()
        base = 10
        if digits[:2] in ("0x", "0X"):
            base, digits = 16, digits[2:]
        elif digits[:2] in ("0b", "0B"):
            base, digits = 2, digits[2:]
        elif len(digits) > 1 and digits[0] == "0":
            base = 8
        try:
            value = int(digits, base)
        except ValueError:
            return None
        return -value if sign == "-" else value
    match = _FLOAT.fullmatch(text)
    if match:
        return _finite(float(match.group(1)))
    match = _HEX_FLOAT.fullmatch(text)
    if match:
        try:
            return _finite(float.fromhex(match.group(1)))
        except (ValueError, OverflowError):
            return None
    return None


def _finite(value: float) -> float | None:
    return value if abs(value) <= 1.7976931348623157e308 else None


def string(text: str) -> str:
    """The characters of a string literal as written, prefix and quotes included, raw or not."""
    quote = text.find('"')
    if quote > 0 and text[quote - 1] == "R":
        return text[text.find("(") + 1 : text.rfind(")")]
    inside = text[quote + 1 : -1] if len(text) > quote + 1 and text.endswith('"') else text[quote + 1 :]
    return unescaped(inside)


def unescaped(text: str) -> str:
    """*text* with its escape sequences resolved."""
    return _ESCAPE.sub(_character, text) if "\\" in text else text


def character(text: str) -> int | None:
    """The code of a character literal; that of several characters is up to the compiler."""
    inside = unescaped(text[text.find("'") + 1 : -1])
    return ord(inside) if len(inside) == 1 else None


def _character(match: re.Match[str]) -> str:
    hexadecimal, short, long, octal, newline, other = match.groups()
    if newline is not None:
        return ""
    if other is not None:
        return _SIMPLE.get(other, other)
    code = int(octal, 8) if octal is not None else int(hexadecimal or short or long, 16)
    return chr(code) if code < 0xD800 or 0xDFFF < code < 0x110000 else "\ufffd"
