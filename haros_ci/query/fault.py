# SPDX-License-Identifier: Apache-2.0
"""What is wrong with a query, and where in it."""

from __future__ import annotations

from collections.abc import Iterable

#: Texts of a query that messages repeat are cut here.
LONGEST = 60


class QueryError(Exception):
    """A query that cannot be read or evaluated: *message* says why, *at* where (an offset into its text, -1 where it is not known yet), *help* what to do."""

    def __init__(self, message: str, at: int = -1, help: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.at = at
        self.help = help

    def explained(self, text: str) -> str:
        """The whole sentence about a query with this *text*: line, column, what is wrong, what to do."""
        line, column = place(text, self.at)
        return f"line {line}, column {column}: {self.message}{f'; {self.help}' if self.help else ''}"


class QueryBudgetExhausted(QueryError):
    """A query has taken more steps than it may."""


def place(text: str, at: int) -> tuple[int, int]:
    """Line and column of the offset *at*, both from 1."""
    before = text[: max(0, at)]
    return before.count("\n") + 1, len(before) - (before.rfind("\n") + 1) + 1


def suggestion(word: str, known: Iterable[str], main: Iterable[str] | None = None) -> str:
    """What *word* was meant to be, as a question; else what there is, or the *main* part of it."""
    import difflib

    words = sorted(known)
    shown = words if main is None else sorted(main)
    near = difflib.get_close_matches(word[:LONGEST], words, n=1, cutoff=0.6)
    near = near or [name for name in shown if word and name.startswith(word)][:1]
    return f"did you mean {near[0]!r}?" if near else f"there is {', '.join(shown)}" if shown else ""


def short(text: str) -> str:
    """*text* for a message: one line, not too long."""
    line = " ".join(text.split())
    return line if len(line) <= LONGEST else f"{line[: LONGEST - 1]}…"
