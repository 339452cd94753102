# SPDX-License-Identifier: Apache-2.0
"""How many findings of one rule in a file are held against its text: to look through a large file for each of thousands takes hours."""

from __future__ import annotations

#: Characters that are looked through for the findings of one rule in a file: one of 50 kB may have 400 of them.
MOST = 20_000_000


class Doubting:
    """Counts what is looked through, by file and rule; what is beyond the limit is not doubted, and so it is reported."""

    def __init__(self) -> None:
        self._read: dict[tuple[str, str], int] = {}

    def may(self, path: str, rule: str, text: str) -> bool:
        """Whether one more finding of *rule* in the file at *path* may be held against its *text*."""
        read = self._read.get((path, rule), 0)
        self._read[path, rule] = read + len(text)
        return read < MOST
