# SPDX-License-Identifier: Apache-2.0
"""Where a thing stands in the workspace."""

from __future__ import annotations

from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True)
class Location:
    """A place in a file, as SARIF §3.29–3.30 counts.

    *path* is POSIX-style and relative to the workspace root. Lines and columns are 1-based; columns count
    Unicode code points, a tab is one, a byte-order mark none. ``line`` is None when the whole file is meant,
    ``column`` when the whole line is. ``end_column`` is exclusive (SARIF §3.30.8).
    """

    path: str
    line: int | None = None
    column: int | None = None
    end_line: int | None = None
    end_column: int | None = None

    @property
    def sort_key(self) -> tuple[str, int, int, int, int]:
        return (self.path, self.line or 0, self.column or 0, self.end_line or 0, self.end_column or 0)

    def __str__(self) -> str:
        """``path``, ``path:line`` or ``path:line:column``, as terminals and editors link it."""
        parts = [self.path]
        if self.line is not None:
            parts.append(str(self.line))
            if self.column is not None:
                parts.append(str(self.column))
        return ":".join(parts)
