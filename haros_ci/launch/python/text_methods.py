# SPDX-License-Identifier: Apache-2.0
"""Methods of str."""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import Any

from haros_ci.launch.python.formats import as_text, str_format
from haros_ci.launch.python.heap import LARGEST
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.sequences import items_of
from haros_ci.launch.python.values import (
    LibraryCall,
    Maybe,
    PartialText,
    Rest,
    Unknown,
    Value,
    holes,
    merged,
    mystery,
    phrase,
    text_of,
    uncertain,
    why,
)

#: Methods that make no text longer than theirs, by what they may be given.
PLAIN = frozenset(
    """lower upper strip lstrip rstrip split rsplit splitlines startswith endswith find rfind index rindex count title
    capitalize swapcase isdigit isalpha isalnum isnumeric isdecimal isupper islower isspace isidentifier partition
    rpartition removeprefix removesuffix casefold""".split()
)
PADDED = frozenset(("zfill", "ljust", "rjust", "center"))


def text_method(run: ScriptEvaluation, value: str | PartialText, name: str, call: LibraryCall) -> Value:
    """``value.name(…)``."""
    if name == "join":
        return join(run, value, call)
    if name == "format" and isinstance(value, str):
        return str_format(run, value, list(call.args), call.keywords, call.location)
    doubt = next((item for item in (value, *call.args, *call.keywords.values()) if uncertain(item)), None)
    if doubt is not None:
        return doubtful(value, name, call, doubt)
    if name in PLAIN:
        return run.made(getattr(value, name)(*call.args, **call.keywords), call.location)
    if name == "replace":
        return replace(run, value, call)
    if name in PADDED and call.args and isinstance(call.args[0], int) and call.args[0] <= 1000:
        return getattr(value, name)(*call.args)
    if name in ("encode", "format_map", "translate"):
        return value if name == "encode" else run.unknown(f"str.{name} is not followed", call.location)
    return run.unknown(f"str.{name} is not followed", call.location)


def doubtful(value: str | PartialText, name: str, call: LibraryCall, doubt: Value) -> Value:
    """What a method gives of a text that is not all known: its beginning and its end may be."""
    if isinstance(value, PartialText) and call.args and isinstance(call.args[0], str):
        edge = value.phrase[0] if name == "startswith" else value.phrase[-1] if name == "endswith" else None
        if isinstance(edge, str) and len(edge) >= len(call.args[0]):
            return edge.startswith(call.args[0]) if name == "startswith" else edge.endswith(call.args[0])
    reason = why(doubt)
    if name in (
        "strip",
        "lstrip",
        "rstrip",
        "lower",
        "upper",
        "replace",
        "title",
        "capitalize",
        "removeprefix",
        "removesuffix",
    ):
        return PartialText((mystery(reason, getattr(doubt, "location", None) or call.location),))
    return Unknown(reason, getattr(doubt, "location", None) or call.location)


def replace(run: ScriptEvaluation, value: Any, call: LibraryCall) -> Value:
    if len(call.args) < 2 or not all(isinstance(item, str) for item in call.args[:2]):
        return run.unknown("str.replace is given no texts", call.location)
    old, new = call.args[:2]
    if len(value) + (value.count(old) + 1) * len(new) > LARGEST:
        return run.unknown("it is too large", call.location)
    return run.made(value.replace(*call.args), call.location)


def join(run: ScriptEvaluation, value: str | PartialText, call: LibraryCall) -> Value:
    items = items_of(run, call.args[0] if call.args else None, call.location)
    if isinstance(items, Unknown):
        return PartialText((mystery(items.reason, items.location or call.location),))
    parts: list[Any] = []
    size = 0
    for index, item in enumerate(items):
        run.budget.step()
        if index:
            parts.extend(phrase(value))
        if isinstance(item, (Maybe, Rest)):
            parts.append(mystery(why(item), getattr(item, "location", None) or call.location))
        elif isinstance(item, (str, PartialText)):
            parts.extend(phrase(item))
        else:
            parts.append(mystery(f"{why(item)} in a text", call.location))
        size += sum(len(part) for part in parts[-2:] if isinstance(part, str))
        if size > LARGEST:
            return run.unknown("it is too large", call.location)
    return run.made(text_of(merged(parts)), call.location)


TextWork = Callable[[ScriptEvaluation, Any, LibraryCall], Value]


def number_of(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``int(x)`` and ``float(x)``."""
    value = call.args[0] if call.args else 0
    if uncertain(value):
        return run.unknown(why(value), call.location)
    if isinstance(value, str) and len(value) > 400:
        return run.unknown("the number is too large", call.location)
    if call.name == "builtins.int" and len(call.args) == 2 and isinstance(value, str) and isinstance(call.args[1], int):
        return int(value, call.args[1])
    if isinstance(value, (bool, int, float, str)):
        return run.made(int(value) if call.name == "builtins.int" else float(value), call.location)
    return run.unknown(why(value), call.location)


def literal(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``eval(text)`` and ``ast.literal_eval(text)`` of a literal; nothing else is evaluated."""
    value = call.args[0] if call.args else None
    if not isinstance(value, str) or len(value) > 400:
        return run.unknown(why(value), call.location)
    try:
        made = ast.literal_eval(value)
        if isinstance(made, (str, bool, int, float, list, tuple, dict, type(None))):
            return run.made(made, call.location)
        raise ValueError(value)
    except (ValueError, SyntaxError, TypeError, MemoryError, RecursionError):
        return run.unknown(f"what {call.name.removeprefix('builtins.')} gives is not followed", call.location)


def text(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``str(x)``."""
    return as_text(run, call.args[0], call.location) if call.args else ""


def count(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``len(x)``."""
    value = call.args[0] if call.args else None
    if isinstance(value, (str, bytes, range, list, tuple, dict, set)):
        doubt = holes(value) if isinstance(value, (list, tuple, dict, set)) else None
        return len(value) if doubt is None else run.unknown(doubt.reason, doubt.location)
    return run.unknown(why(value), call.location)
