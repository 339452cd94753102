# SPDX-License-Identifier: Apache-2.0
"""Parts of parsed JSON by their expected shape: what has another shape reads as empty."""

from __future__ import annotations

from math import isfinite

_LARGEST = 2**31 - 1
_LONGEST = 100_000


def mapping(value: object, key: str | None = None) -> dict[str, object]:
    """*value*, or its member *key*, as an object."""
    if key is not None:
        value = value.get(key) if isinstance(value, dict) else None
    return value if isinstance(value, dict) else {}


def items(value: dict[str, object], key: str) -> list[object]:
    """The member *key* as an array."""
    found = value.get(key)
    return found if isinstance(found, list) else []


def string(value: dict[str, object], key: str) -> str:
    """The member *key* as a string, cut at a size that no honest one has."""
    found = value.get(key)
    return found[:_LONGEST] if isinstance(found, str) else ""


def strings(value: dict[str, object], key: str) -> tuple[str, ...]:
    """The non-empty strings of the array *key*."""
    return tuple(found for found in items(value, key) if isinstance(found, str) and found)


def natural(value: dict[str, object], key: str) -> int | None:
    """The member *key* as a number from 0 on; ``1.0`` counts, as JSON has one kind of number."""
    found = value.get(key)
    if isinstance(found, float) and found.is_integer():
        found = int(found)
    return found if isinstance(found, int) and not isinstance(found, bool) and 0 <= found <= _LARGEST else None


def number(value: dict[str, object], key: str) -> float | None:
    """The member *key* as a finite number."""
    found = value.get(key)
    if not isinstance(found, (int, float)) or isinstance(found, bool):
        return None
    try:
        return float(found) if isfinite(found) else None
    except OverflowError:
        return None


def boolean(value: dict[str, object], key: str, default: bool) -> bool:
    """The member *key* as true or false, else *default*."""
    found = value.get(key)
    return found if isinstance(found, bool) else default
