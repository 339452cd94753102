# SPDX-License-Identifier: Apache-2.0
"""Regular expressions from settings, matched against text of unknown origin in time that grows with both lengths only: by RE2.

The syntax is RE2's (https://github.com/google/re2/wiki/Syntax): Python's, without back references and look-around.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from haros_ci.records import dataclass

MAX_PATTERN = 500  # characters
MAX_GROUPS = 20


class PatternError(ValueError):
    """The pattern is malformed, too large, or uses what cannot be matched in linear time."""


@dataclass(frozen=True, slots=True)
class LinearPattern:
    """A compiled pattern; *groups* are the named ones."""

    groups: tuple[str, ...]
    _machine: Any

    def search(self, text: str) -> dict[str, str | None] | None:
        """What the named groups hold in the leftmost match, None for a group without a part in it; None without a match."""
        found = self._machine.search(_sound(text))
        return None if found is None else found.groupdict()


@lru_cache(maxsize=500)
def compiled(pattern: str) -> LinearPattern:
    """*pattern* ready to search with. Raises PatternError, which says what is wrong with it."""
    import re2

    if len(pattern) > MAX_PATTERN:
        raise PatternError(f"more than {MAX_PATTERN} characters")
    options = re2.Options()
    options.log_errors = False
    try:
        machine = re2.compile(_sound(pattern), options)
    except re2.error as err:
        message = err.args[0] if err.args else b""
        raise PatternError(message.decode("utf-8", "replace") if isinstance(message, bytes) else str(message)) from err
    if machine.groups > MAX_GROUPS:
        raise PatternError(f"more than {MAX_GROUPS} groups")
    return LinearPattern(tuple(machine.groupindex), machine)


def _sound(text: str) -> str:
    """*text* without halves of characters, which cannot be UTF-8."""
    return text.encode("utf-8", "replace").decode("utf-8")


__all__ = ["MAX_PATTERN", "LinearPattern", "PatternError", "compiled"]
