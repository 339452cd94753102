# SPDX-License-Identifier: Apache-2.0
"""Python source read as data: literals, names bound to them, simple arithmetic; nothing is run."""

from __future__ import annotations

import ast
import math
import re
import warnings
from collections.abc import Callable, Mapping
from typing import Any

from haros_ci.regex import regex

MAX_TEXT = 10_000
MAX_SOURCE = 500_000
MAX_DEPTH = 50

#: What is not a value that the text tells.
MISSING = object()

_NAMES: Mapping[str, Any] = {"True": True, "False": False, "None": None, "pi": math.pi}
_PRINT = regex(r"^([ \t]*)print[ \t]+(?!\()(.*)$", re.MULTILINE)
_EXEC = regex(r"^([ \t]*)exec[ \t]+(?!\()(.*)$", re.MULTILINE)
_EXCEPT = regex(r"^([ \t]*except[ \t]+[\w.]+),[ \t]*(\w+)[ \t]*:", re.MULTILINE)
#: Where ``%`` and ``format()`` put a text, and what else of the kind there may be: that is not computed.
_PERCENT = regex(r"%s")
_BRACES = regex(r"\{\}")
_OTHER_PLACES = {_PERCENT: regex("%"), _BRACES: regex("[{}]")}
_MAX_LOOP = 100
_OCTAL = regex(r"(?<![\w.])0([0-7]+)[lL]?(?![\w.])")


def parse_python(text: str) -> ast.Module | str:
    """The module, Python 2's print, exec, except and octal numbers tolerated; else what is wrong, with its line."""
    if len(text) > MAX_SOURCE:
        return "too long to be read"
    problem = ""
    for source in (text, _modern(text)):
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                return ast.parse(source.replace("\r\n", "\n"))
        except SyntaxError as err:
            problem = problem or f"line {err.lineno}: {err.msg}"
        except (ValueError, RecursionError, MemoryError):
            problem = problem or "nested too deeply, or with a null byte"
    return problem


def _modern(text: str) -> str:
    """*text* without those lines of Python 2 that Python 3 does not parse; lines keep their numbers."""
    text = _PRINT.sub(r"\1pass", text)
    text = _EXEC.sub(r"\1pass", text)
    text = _EXCEPT.sub(r"\1 as \2:", text)
    return _OCTAL.sub(r"0o\1", text).replace("\t", "        ")


def dotted(node: ast.expr) -> str:
    """``a.b.c`` of names and attributes, "" of anything else."""
    parts: list[str] = []
    while isinstance(node, ast.Attribute):
        parts.append(node.attr)
        node = node.value
    return ".".join([node.id, *reversed(parts)]) if isinstance(node, ast.Name) else ""


def value_of(node: ast.expr, names: Mapping[str, Any], depth: int = 0) -> Any:
    """The value of an expression: literals, *names*, containers, arithmetic; MISSING if that does not tell."""
    if depth > MAX_DEPTH:
        return MISSING
    if isinstance(node, ast.Constant):
        return node.value if isinstance(node.value, (str, int, float, bool, type(None))) else MISSING
    if isinstance(node, (ast.Name, ast.Attribute)):
        name = dotted(node)
        if name in names:
            return names[name]
        return math.pi if name in ("math.pi", "numpy.pi", "np.pi") else _NAMES.get(name, MISSING)
    if isinstance(node, (ast.List, ast.Tuple)):
        items = [value_of(item, names, depth + 1) for item in node.elts]
        return MISSING if any(item is MISSING for item in items) else items
    if isinstance(node, ast.Dict):
        return _dict(node, names, depth)
    if isinstance(node, ast.UnaryOp):
        return _unary(node.op, value_of(node.operand, names, depth + 1))
    if isinstance(node, ast.ListComp):
        return _list(node, names, depth)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mod) and isinstance(node.left, (ast.Constant, ast.Name)):
        filled = _filled(value_of(node.left, names, depth + 1), _PERCENT, value_of(node.right, names, depth + 1))
        if filled is not MISSING:
            return filled
    if isinstance(node, ast.BinOp):
        return _binary(node.op, value_of(node.left, names, depth + 1), value_of(node.right, names, depth + 1))
    if isinstance(node, ast.JoinedStr):
        parts = [value_of(p.value if isinstance(p, ast.FormattedValue) else p, names, depth + 1) for p in node.values]
        return text_of(parts) if parts else ""
    if isinstance(node, ast.Call) and len(node.args) == 1 and not node.keywords and dotted(node.func) in _CASTS:
        return _cast(dotted(node.func), value_of(node.args[0], names, depth + 1))
    if (
        isinstance(node, ast.Call)
        and isinstance(node.func, ast.Attribute)
        and node.func.attr == "format"
        and not node.keywords
    ):
        items = [value_of(argument, names, depth + 1) for argument in node.args]
        return _filled(value_of(node.func.value, names, depth + 1), _BRACES, items)
    return MISSING


def _filled(text: Any, places: re.Pattern[str], values: Any) -> Any:
    """*text* with *values* in its *places*, ``%s`` or ``{}``; MISSING where one is no text, or another kind of place is in it."""
    items = values if isinstance(values, list) else [values]
    if not isinstance(text, str) or not all(isinstance(item, str) for item in items):
        return MISSING
    parts = places.split(text)
    if len(parts) != len(items) + 1 or any(_OTHER_PLACES[places].search(part) for part in parts):
        return MISSING
    return text_of([part for pair in zip(parts, [*items, ""], strict=True) for part in pair])


def _list(node: ast.ListComp, names: Mapping[str, Any], depth: int) -> Any:
    """A list of one loop over a list that is known, without a condition and without another comprehension in it."""
    loop = node.generators[0]
    is_simple = len(node.generators) == 1 and not loop.ifs and isinstance(loop.target, ast.Name)
    items = value_of(loop.iter, names, depth + 1) if is_simple else MISSING
    if (
        not isinstance(items, list)
        or len(items) > _MAX_LOOP
        or any(isinstance(n, ast.ListComp) for n in ast.walk(node.elt))
    ):
        return MISSING
    made = [value_of(node.elt, {**names, dotted(loop.target): item}, depth + 1) for item in items]
    return MISSING if any(item is MISSING for item in made) else made


def text_of(parts: list[Any], join: Callable[[list[str]], str] = "".join) -> Any:
    """*parts* put together by *join*; MISSING if one of them is no text, or all are too long: a text that doubles would take all memory."""
    is_text = bool(parts) and all(isinstance(part, str) for part in parts)
    return join(parts) if is_text and sum(map(len, parts)) < MAX_TEXT else MISSING


def _dict(node: ast.Dict, names: Mapping[str, Any], depth: int) -> Any:
    made: dict[Any, Any] = {}
    for key, item in zip(node.keys, node.values, strict=True):
        name = MISSING if key is None else value_of(key, names, depth + 1)
        value = value_of(item, names, depth + 1)
        if not isinstance(name, (str, int, float)) or value is MISSING:
            return MISSING
        made[name] = value
    return made


def _unary(operator: ast.unaryop, value: Any) -> Any:
    if isinstance(operator, ast.Not) and value is not MISSING:
        return not value
    if not isinstance(value, (int, float)):
        return MISSING
    if isinstance(operator, ast.USub):
        return -value
    return value if isinstance(operator, ast.UAdd) else MISSING


def _binary(operator: ast.operator, left: Any, right: Any) -> Any:
    if isinstance(operator, ast.Add):
        if isinstance(left, str) and isinstance(right, str):
            return left + right if len(left) + len(right) < MAX_TEXT else MISSING
        if isinstance(left, list) and isinstance(right, list):
            return left + right if len(left) + len(right) < MAX_TEXT else MISSING
    if not isinstance(left, (int, float)) or not isinstance(right, (int, float)):
        return MISSING
    try:
        return _arithmetic(operator, left, right)
    except (ArithmeticError, ValueError):
        return MISSING


def _arithmetic(operator: ast.operator, left: float, right: float) -> Any:
    if max(abs(left), abs(right)) > 1e18:
        return MISSING
    if isinstance(operator, ast.Add):
        return left + right
    if isinstance(operator, ast.Sub):
        return left - right
    if isinstance(operator, ast.Mult):
        return left * right
    if isinstance(operator, ast.Div):
        return left / right
    if isinstance(operator, ast.FloorDiv):
        return left // right
    if isinstance(operator, ast.Mod):
        return left % right
    if isinstance(operator, ast.Pow) and abs(right) <= 64 and abs(left) <= 1000:
        power = left**right
        return MISSING if isinstance(power, complex) else power
    if isinstance(left, int) and isinstance(right, int):
        if isinstance(operator, ast.LShift) and 0 <= right < 64:
            return left << right
        if isinstance(operator, ast.BitOr):
            return left | right
    return MISSING


_CASTS = ("int", "float", "str", "bool", "math.radians", "radians")


def _cast(name: str, value: Any) -> Any:
    if not isinstance(value, (int, float)) or abs(value) > 1e18:
        return value if name == "str" and isinstance(value, str) else MISSING
    if name.endswith("radians"):
        return math.radians(value)
    try:
        return {"int": int, "float": float, "bool": bool, "str": str}[name](value)
    except (ArithmeticError, ValueError):
        return MISSING


def summands(node: ast.expr) -> list[ast.expr]:
    """``a``, ``b`` and ``c`` of ``a + b + c``."""
    found = []
    while isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        found.append(node.right)
        node = node.left
    return [node, *reversed(found)]


def is_constant(node: ast.expr | None, value: str | bool) -> bool:
    return isinstance(node, ast.Constant) and node.value == value
