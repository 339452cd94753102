# SPDX-License-Identifier: Apache-2.0
"""``$(eval ...)`` and PythonExpression: a small part of Python computed over its syntax tree, never run."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from typing import Any

from haros_ci.bounded_python.evaluation import Evaluation
from haros_ci.bounded_python.functions import FUNCTIONS, Function
from haros_ci.bounded_python.language import SYNTAX, Language
from haros_ci.bounded_python.limits import Limits, NotFollowed, TooMuch, check_text_method, parsed
from haros_ci.substitutions.names import MARK, Text, literal, quoted, unknown

MAX_RESULT = 10_000
LIMITS = Limits(characters=4_000, depth=60, size=MAX_RESULT, bits=4_000, brackets=40, signs=400)
_OVER = {
    "characters": "it is too long",
    "depth": "it is nested too deeply",
    "size": "its value is too long",
    "number": "a number is too large",
}

#: Stands for an unknown part while the text is parsed: a letter of an old script, so that it may be a name.
_LETTER = "\ua66e"
_METHODS = frozenset(
    ("lower", "upper", "strip", "lstrip", "rstrip", "startswith", "endswith", "replace", "split", "title", "capitalize")
)
_SET_METHODS = frozenset(("intersection", "union", "difference"))


class _Undecided(Exception):
    """The value is not known, or outside of what is computed here."""


def _listed(values: Any = ()) -> list[Any]:
    """``list(x)``; in which order it takes what is in a set is not known."""
    if isinstance(values, frozenset) and len(values) > 1:
        raise _Undecided("the order of what is in a set is not known")
    return list(values)


_FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    **{name: FUNCTIONS[name] for name in ("bool", "int", "float", "len", "min", "max", "abs", "any", "all", "sorted")},
    "str": lambda value="": _text(value),
    "list": _listed,
    "tuple": lambda values=(): tuple(_listed(values)),
    "set": frozenset,
}
#: Functions and methods that give True or False, whatever they are given.
_TRUTHS = frozenset(("bool", "any", "all", "startswith", "endswith"))


class _Opaque:
    """A value that is not known; *is_truth* if it is True or False."""

    def __init__(self, is_truth: bool = False) -> None:
        self.is_truth = is_truth


def expression_value(text: Text) -> Text:
    """What the Python expression *text* gives, as text (``str`` of it); unknown where it cannot be decided.

    Constants, comparisons, and/or/not, in, + - * / // %, the conditional expression, str, bool, int, float, len,
    methods of texts, lists, sets and indices are computed; anything else is unknown. An unknown part of a text counts
    only where the value depends on it.
    """
    shown = quoted(text.raw)
    reasons = "; ".join(dict.fromkeys(text.reasons))
    source = text.raw.replace(_LETTER, "?").replace(MARK, _LETTER).strip()
    try:
        value = Evaluation(_Launch()).value(parsed(source, LIMITS))
        if isinstance(value, _Opaque) or (isinstance(value, (list, tuple)) and _has_unknown(value)):
            return unknown(reasons or f"the expression {shown} is not computed")
        made = _text(value)
        if len(made) > MAX_RESULT:
            raise _Undecided("its value is too long")
    except (_Undecided, NotFollowed, TooMuch) as err:
        if isinstance(err, NotFollowed):
            err = _Undecided("it uses more of Python than is followed")
        elif isinstance(err, TooMuch):
            err = _Undecided(_OVER[err.what])
        return unknown(reasons or f"the expression {shown} is not computed: {err}")
    except SyntaxError:
        return unknown(reasons or f"{shown} is no Python expression")
    except (TypeError, ValueError, ArithmeticError, LookupError, AttributeError) as err:
        return unknown(reasons or f"the expression {shown} fails: {err}")
    except (RecursionError, MemoryError):
        return unknown(f"the expression {shown} is nested too deeply")
    if _LETTER in made:
        return Text(made.replace(_LETTER, MARK), (reasons,) * made.count(_LETTER))
    return literal(made)


def _text(value: Any) -> str:
    """``str(value)``."""
    todo = [value]
    while todo:
        part = todo.pop()
        if isinstance(part, frozenset):
            raise _Undecided("the order of what is in a set is not known")
        todo.extend(part if isinstance(part, (list, tuple)) else ())
    return str(value)


def _has_unknown(value: Any) -> bool:
    if isinstance(value, (list, tuple, frozenset)):
        return any(_has_unknown(item) for item in value)
    return isinstance(value, _Opaque) or (isinstance(value, str) and _LETTER in value)


class _Launch(Language):
    """Python as launch evaluates it, without names; an unknown part of a text counts only where the value depends on it."""

    limits = LIMITS
    syntax = SYNTAX | {ast.Set}
    is_arithmetic = True
    has_steps = False
    methods = _METHODS | _SET_METHODS
    looks_past_unknown = True
    set_of = frozenset

    def name(self, name: str) -> Any:
        if _LETTER in name:
            return _Opaque()
        raise _Undecided(f"the name '{name}' is not defined; quote it if it is text")

    def function(self, name: str) -> Function:
        return Function(name, _FUNCTIONS.get(name) or _unfollowed(name), name in _TRUTHS)

    def attribute(self, owner: Any, name: str) -> Function:
        return Function(name, lambda *arguments: _method(owner, name, [*arguments]), name in _TRUTHS)

    def is_unknown(self, value: Any) -> bool:
        return _has_unknown(value)

    def is_unknown_operand(self, value: Any) -> bool:
        return isinstance(value, _Opaque)

    def is_truth(self, value: Any) -> bool:
        return isinstance(value, _Opaque) and value.is_truth

    def unknown(self, is_truth: bool = False) -> _Opaque:
        return _Opaque(is_truth)


def _unfollowed(name: str) -> Callable[..., Any]:
    def call(*_: object) -> Any:
        raise _Undecided(f"the function '{name}' is not followed")

    return call


def _method(owner: Any, name: str, arguments: list[Any]) -> Any:
    if _has_unknown(owner):
        return _Opaque(name in _TRUTHS)
    if isinstance(owner, frozenset) and name in _SET_METHODS:
        return getattr(owner, name)(*arguments)
    if isinstance(owner, str) and name in _METHODS:
        check_text_method(name, owner, arguments, LIMITS)
        return getattr(owner, name)(*arguments)
    raise NotFollowed
