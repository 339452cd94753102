# SPDX-License-Identifier: Apache-2.0
"""What is wrong with an HPL text, and where in it."""

from __future__ import annotations

from haros_ci.behaviour.tree import Place

#: Texts of a property that messages repeat are cut here.
LONGEST = 60


class HplFault(Exception):
    """A text that is no HPL: *message* says what is wrong at *at* and what was expected, *help* what to write instead."""

    def __init__(self, message: str, at: Place, help: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.at = at
        self.help = help

    @property
    def whole(self) -> str:
        """The message with its help."""
        return f"{self.message}; {self.help}" if self.help else self.message

    def __str__(self) -> str:
        return f"line {self.at.line}, column {self.at.column}: {self.whole}"


def short(text: str) -> str:
    """*text* for a message: one line, not too long."""
    line = " ".join(text.split())
    return line if len(line) <= LONGEST else f"{line[: LONGEST - 1]}…"
