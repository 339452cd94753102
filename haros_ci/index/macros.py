# SPDX-License-Identifier: Apache-2.0
"""Object-like macros as expressions: literals, names, and operators in parentheses; all else is not known. And as names of classes."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.index import compiled
from haros_ci.regex import regex
from haros_ci.syntax import Expression

if TYPE_CHECKING:
    from haros_ci.index.index import Index, Source

_TOKEN = regex(
    r"""\s*(?:
        (?P<str>(?:u8|u|U)?"(?:[^"\\\n]|\\.)*")
      | (?P<chr>'(?:[^'\\\n]|\\.)')
      | (?P<num>\.?[0-9](?:[eEpP][-+]|['\w.])*)
      | (?P<name>(?:::)?[A-Za-z_]\w*(?:::[A-Za-z_]\w*)*)
      | (?P<op>[-+*/%()~])
    )""",
    re.VERBOSE,
)
#: What a macro that names a class stands for.
_QUALIFIED = regex(r"(?:::)?[A-Za-z_]\w*(?:::[A-Za-z_]\w*)+")
#: What a macro that names a namespace stands for.
_SPACE = regex(r"(?:::)?[A-Za-z_]\w*(?:::[A-Za-z_]\w*)*")
_INTEGER = regex(r"(?:0[xX](?P<hex>[0-9a-fA-F]+)|0[bB](?P<bin>[01]+)|(?P<oct>0[0-7]+)|(?P<dec>0|[1-9][0-9]*))[uUlLzZ]*")
_REAL = regex(r"((?:[0-9]+\.[0-9]*|\.[0-9]+|[0-9]+(?=[eE]))(?:[eE][-+]?[0-9]+)?)(?:[fF]|[lL])?")
_ESCAPES = {"n": "\n", "t": "\t", "\\": "\\", '"': '"', "'": "'"}
_LEVELS = {"+": 1, "-": 1, "*": 2, "/": 2, "%": 2}
#: Longer macros are no values; parentheses inside parentheses that are read.
LONGEST, DEEPEST = 400, 20


class _Unreadable(Exception):
    """The text is no expression of the kinds that are read."""


def expression(body: str) -> Expression:
    """The expression that an object-like macro stands for; unknown where that is not known.

    Operators outside of parentheses are put between those around the macro's use ([cpp.replace]: the replacement is
    text), so that their value is known for texts alone.
    """
    text = body.strip()
    try:
        tokens = _tokens(text)
        found, left = _binary(tokens, 0, 0, 0)
        if left != len(tokens) or (_is_open(tokens) and not _is_text(found)):
            raise _Unreadable
    except _Unreadable:
        return syntax.Unknown(f"a macro: {text[:80]}")
    return found


def class_named(index: Index, name: str, source: Source, files: frozenset[str]) -> tuple[Source, str] | None:
    """The qualified name that a macro stands for, and the file that defines it; None otherwise, or one of several."""
    found = index.near(index.macros, name, source, files) if source.separator == "::" else []
    bodies = {body for _, body in found}
    return found[0] if len(bodies) == 1 and _QUALIFIED.fullmatch(found[0][1]) else None


def space_named(index: Index, name: str, source: Source, files: frozenset[str]) -> str | None:
    """The namespace that a macro stands for (``#define nav nav_msgs::msg``); None otherwise, or where it is not known which one."""
    if name not in index.macros or source.separator != "::":
        return None
    bodies = {body for _, body in index.near(index.macros, name, source, files)}
    body = bodies.pop() if len(bodies) == 1 else compiled.value_of(index, name, source.path, files)
    return body if body is not None and body != name and _SPACE.fullmatch(body) else None


def _tokens(text: str) -> list[tuple[str, str]]:
    found: list[tuple[str, str]] = []
    at = 0
    while at < len(text):
        match = _TOKEN.match(text, at) if len(text) <= LONGEST else None
        if match is None or match.lastgroup is None:
            raise _Unreadable
        found.append((match.lastgroup, match[match.lastgroup]))
        at = match.end()
    return found


def _is_open(tokens: list[tuple[str, str]]) -> bool:
    """Whether an operator with two sides stands outside of all parentheses."""
    depth = 0
    for number, (kind, text) in enumerate(tokens):
        if kind != "op":
            continue
        depth += {"(": 1, ")": -1}.get(text, 0)
        if not depth and text in _LEVELS and number and tokens[number - 1][1] not in (*_LEVELS, "("):
            return True
    return False


def _is_text(found: Expression) -> bool:
    """Whether an expression adds to a text, and is the same however it goes on."""
    if type(found) is syntax.Operation and found.operator == "+" and len(found.operands) == 2:
        return _is_text(found.operands[0])
    return bool(type(found) is syntax.Cast and found.type.name == "std::string")


def _binary(tokens: list[tuple[str, str]], at: int, level: int, depth: int) -> tuple[Expression, int]:
    left, at = _unary(tokens, at, depth)
    while at < len(tokens) and tokens[at][0] == "op" and _LEVELS.get(tokens[at][1], 0) > level:
        symbol = tokens[at][1]
        right, at = _binary(tokens, at + 1, _LEVELS[symbol], depth)
        left = syntax.Operation(symbol, (left, right))
    return left, at


def _unary(tokens: list[tuple[str, str]], at: int, depth: int) -> tuple[Expression, int]:
    if depth > DEEPEST or at >= len(tokens):
        raise _Unreadable
    kind, text = tokens[at]
    if kind == "op" and text in "-+~":
        inner, at = _unary(tokens, at + 1, depth + 1)
        if type(inner) is syntax.Number and text != "~":
            return syntax.Number(-inner.value if text == "-" else inner.value), at
        return syntax.Operation(text, (inner,)), at
    if kind == "op" and text == "(":
        inner, at = _binary(tokens, at + 1, 0, depth + 1)
        at = _closed(tokens, at)
    elif kind == "str":
        inner, at = _texts(tokens, at)
    elif kind == "chr":
        inner, at = syntax.Cast(syntax.Type("char"), syntax.Number(ord(_unescaped(text[1:-1])))), at + 1
    elif kind == "num":
        inner, at = syntax.Number(_number(text)), at + 1
    elif kind == "name" and text in ("true", "false"):
        inner, at = syntax.Boolean(text == "true"), at + 1
    elif kind == "name" and text in ("std::string", "string") and tokens[at + 1 : at + 2] == [("op", "(")]:
        whole, at = _texts(tokens, at + 2)
        inner, at = syntax.Cast(syntax.Type("std::string"), whole), _closed(tokens, at)
    elif kind == "name":
        inner, at = syntax.Name(text), at + 1
    else:
        raise _Unreadable
    if at < len(tokens) and (tokens[at][0] != "op" or tokens[at][1] in "(~"):  # a call, a cast, words in a row
        raise _Unreadable
    return inner, at


def _closed(tokens: list[tuple[str, str]], at: int) -> int:
    if tokens[at : at + 1] != [("op", ")")]:
        raise _Unreadable
    return at + 1


def _texts(tokens: list[tuple[str, str]], at: int) -> tuple[Expression, int]:
    """Literals in a row, and the macros between them."""
    parts: list[Expression] = []
    while at < len(tokens) and tokens[at][0] in ("str", "name"):
        kind, text = tokens[at]
        is_text = kind == "str"
        parts.append(syntax.String(_unescaped(text[text.index('"') + 1 : -1])) if is_text else syntax.Name(text))
        at += 1
    texts = [part.value for part in parts if type(part) is syntax.String]
    if not texts:
        raise _Unreadable
    if len(texts) == len(parts):
        return syntax.String("".join(texts)), at
    return syntax.Format(tuple(parts)), at


def _unescaped(text: str) -> str:
    def character(match: re.Match[str]) -> str:
        if match[1] not in _ESCAPES:
            raise _Unreadable
        return _ESCAPES[match[1]]

    return re.sub(r"\\(.)", character, text)


def _number(text: str) -> int | float:
    digits = text.replace("'", "")
    match = _INTEGER.fullmatch(digits)
    if match and len(digits) <= 80:
        for name, base in (("hex", 16), ("bin", 2), ("oct", 8), ("dec", 10)):
            if match[name] is not None:
                return int(match[name], base)
    match = _REAL.fullmatch(digits)
    if match is None:
        raise _Unreadable
    value = float(match[1])
    if abs(value) > 1.7976931348623157e308:
        raise _Unreadable
    return value
