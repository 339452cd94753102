# SPDX-License-Identifier: Apache-2.0
"""Types and defaults as documents write them, compared with those of the code; None where that is not known."""

from __future__ import annotations

import json
import re
from math import isclose
from typing import Any

from haros_ci.regex import regex

_SCALARS = {
    "bool": ("bool", "boolean"),
    "int": ("int", "integer", "unsigned integer", "unsigned int", "uint", "long", "size_t"),
    "double": ("double", "float", "real"),
    "str": ("string", "str", "std::string"),
}
_KINDS = {word: kind for kind, words in _SCALARS.items() for word in words}
_LIST = regex(r"\b(?:list|vector|array|sequence)\b|\[")
_NUMBER = regex(r"[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?")
_NOTHING = frozenset(
    ("", "-", "--", "—", "n/a", "na", "none", "null", "nil", "?", "...", "undefined", "not set", "required", "tbd")
)
_TOKEN = regex(r"[\w./~-]+")


def type_differs(documented: str, kind: str, found: str | None) -> bool | None:
    """Whether a documented type is another than *found*, of an end of *kind*."""
    if found is None or "?" in found:
        return None
    return _parameter_type_differs(documented, found) if kind == "parameters" else _ros_type_differs(documented, found)


def _ros_type_differs(documented: str, found: str) -> bool | None:
    parts = [part.strip(" ;\"'") for part in re.split(r"\s+or\s+|,\s*|\s+\|\s+", documented)]
    if any(part in ("any", "TBD", "TODO") or not re.fullmatch(r"[A-Za-z][\w/:]*", part) for part in parts):
        return None
    package, name = _ends(found)
    for part in parts:
        there, called = _ends(part)
        if called.removesuffix(".msg") == name and there in ("", package):
            return False
    return True


def _ends(type: str) -> tuple[str, str]:
    """The package, "" for none, and the name of a type."""
    parts = [part for part in re.split(r"::|/", type) if part]
    return (parts[0] if len(parts) > 1 else "", parts[-1] if parts else "")


def _parameter_type_differs(documented: str, found: str) -> bool | None:
    words = documented.strip().lower()
    if re.fullmatch(r"[<\[]\w+[>\]]", words):  # [double] may mean a list, or one
        return None
    if found == "yaml":
        return None
    if _LIST.search(words):
        return not found.endswith("[]") and found != "bytes"
    if re.fullmatch(r"u?int\d+(?:_t)?", words):
        words = "int"
    elif re.fullmatch(r"float\d+(?:_t)?", words):
        words = "double"
    if words == "number":
        return found not in ("int", "double")
    kind = _KINDS.get(words)
    return None if kind is None else kind != found


def is_value(text: str) -> bool:
    """Whether a cell says a default at all."""
    return text.strip(" `").lower() not in _NOTHING


def default_differs(documented: str, value: Any) -> bool | None:
    """Whether the documented default is another than *value*; a number counts as written, to its last digit."""
    text = re.sub(r"\s+\[[^\[\]]*\]$", "", documented.strip())  # a unit
    if isinstance(value, bool):
        word = text.strip("\"'").lower()
        return (word == "true") != value if word in ("true", "false") else None
    if isinstance(value, (int, float)):
        number = text.strip("\"'").removesuffix("f")
        return not _near(number, value) if len(text) < 40 and _NUMBER.fullmatch(number) else None
    if isinstance(value, str):
        return _text_differs(text, value)
    if isinstance(value, (list, tuple)):
        return _list_differs(text, value)
    return None


def _near(text: str, value: float) -> bool:
    """Whether *value*, rounded to as many digits as *text* has, is *text*."""
    message = float(text)
    mantissa, _, power = text.lower().partition("e")
    decimals = len(mantissa.partition(".")[2]) - int((power or "0")[:4])
    if abs(value) > 1e300 or abs(decimals) > 300:
        return message == value
    return isclose(message, value, rel_tol=1e-9, abs_tol=0.5000001 * 10.0**-decimals if decimals > 1 else 1e-12)


def _text_differs(text: str, value: str) -> bool | None:
    for quote in "\"'":
        if len(text) > 1 and text[0] == text[-1] == quote:
            return text[1:-1].strip() != value.strip() if quote not in text[1:-1] else None
    if text == value:
        return False
    return True if _TOKEN.fullmatch(text) and not text.endswith("...") else None


def _list_differs(text: str, value: list[Any] | tuple[Any, ...]) -> bool | None:
    if len(text) > 2_000 or not text.startswith("["):
        return None
    try:
        report = json.loads(re.sub(r"\b(True|False)\b", lambda match: match[0].lower(), text.replace("'", '"')))
    except (ValueError, RecursionError):
        return None
    if not isinstance(report, list) or any(isinstance(item, (list, dict)) for item in report):
        return None
    if len(report) != len(value):
        return True
    entry = [default_differs(json.dumps(a), b) for a, b in zip(report, value, strict=True)]
    return True if True in entry else None if None in entry else False
