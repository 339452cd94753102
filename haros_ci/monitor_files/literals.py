# SPDX-License-Identifier: Apache-2.0
"""Values of a workspace as literals of Python: the one way in which its names and texts come into a generated file."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any


def literal(value: Any) -> str:
    """Python text of ASCII, without a line break, that is *value*: a text, number, truth value or None, or lists and maps of them."""
    if isinstance(value, str):
        return ascii(value)
    if value is None or isinstance(value, (bool, int)):
        return repr(value)
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else f"float({str(value)!r})"
    if isinstance(value, (list, tuple)):
        inner = ", ".join(map(literal, value))
        return f"({inner},)" if isinstance(value, tuple) and len(value) == 1 else _bracketed(value, inner)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{literal(str(key))}: {literal(entry)}" for key, entry in value.items()) + "}"
    raise TypeError(f"{type(value).__name__} has no literal")


def _bracketed(value: Any, inner: str) -> str:
    return f"({inner})" if isinstance(value, tuple) else f"[{inner}]"
