# SPDX-License-Identifier: Apache-2.0
"""What a misspelt word was meant to be, and how a foreign word is quoted in a message."""

from __future__ import annotations

from collections.abc import Iterable

LONGEST = 60


def nearest(word: str, known: Iterable[str]) -> str | None:
    """The known word most like *word*, or None if none is near."""
    import difflib

    words = {name.lower(): name for name in sorted(known)}
    found = difflib.get_close_matches(word[:LONGEST].lower(), words, n=1, cutoff=0.6)
    return words[found[0]] if found else None


def did_you_mean(word: str, known: Iterable[str]) -> str | None:
    """The near miss as a question."""
    near = nearest(word, known)
    return None if near is None else f"did you mean {near!r}?"


def suggestion(word: str, known: Iterable[str]) -> str:
    """A ``help`` sentence: the near miss, or else all the known words."""
    words = tuple(known)
    return did_you_mean(word, words) or f"one of: {', '.join(words)}"


def quoted(value: object) -> str:
    """*value* as one short printable line."""
    text = repr(value) if isinstance(value, str) else str(value).lower() if isinstance(value, bool) else str(value)
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 1]}…"
