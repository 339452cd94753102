# SPDX-License-Identifier: Apache-2.0
"""What is said in many places of the data, once: texts, and rows of tables, by their index."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

from haros_ci.model.architecture import Condition, Unknown
from haros_ci.model.location import Location
from haros_ci.model.presence import Presence, in_words
from haros_ci.report.escape import terminal

#: Characters of a text that are kept.
LONGEST = 2_000
#: The index of what is not there.
NONE = -1


class Table:
    """Rows in the order in which they are first seen; the same row has the same index."""

    def __init__(self) -> None:
        self.rows: list[Any] = []
        self._known: dict[Hashable, int] = {}

    def index(self, row: Hashable) -> int:
        """The index of *row*, a text or a tuple of what JSON holds. 1, 1.0 and True are the same row: rows hold one kind in a place."""
        found = self._known.get(row)
        if found is None:
            found = self._known[row] = len(self.rows)
            self.rows.append(row)
        return found


class Pool:
    """The tables that the whole page shares. Every text goes through ``text``, which leaves no control character in it."""

    def __init__(self) -> None:
        self.tables: dict[str, Table] = {}

    def row(self, table: str, row: Hashable) -> int:
        """The index of *row* in the table of that name."""
        if table not in self.tables:
            self.tables[table] = Table()
        return self.tables[table].index(row)

    def text(self, text: str | None) -> int:
        """The index of *text*, cut to ``LONGEST`` characters; ``NONE`` for None."""
        return NONE if text is None else self.row("texts", terminal(text[:LONGEST]))

    def texts(self, texts: tuple[str, ...]) -> tuple[int, ...]:
        return tuple(self.text(text) for text in texts)

    def place(self, place: Location | None) -> int:
        """The index of a place: path, line and column, 0 for what is not known of it."""
        if place is None:
            return NONE
        return self.row("places", (self.text(place.path), place.line or 0, place.column or 0))

    def place_of(self, path: str) -> int:
        """The index of a whole file."""
        return self.row("places", (self.text(path), 0, 0))

    def conditions(self, conditions: tuple[Condition, ...]) -> int:
        """The index of a list of conditions, each a statement, its text and its place."""
        if not conditions:
            return NONE
        rows = tuple((self.text(c.statement), self.text(c.condition), self.place(c.location)) for c in conditions)
        return self.row("conditions", rows)

    def unknowns(self, unknowns: tuple[Unknown, ...]) -> int:
        """The index of a list of what is not known: the field, the reason, where."""
        if not unknowns:
            return NONE
        rows = tuple((self.text(u.field), self.text(u.reason), self.place(u.location)) for u in unknowns)
        return self.row("unknowns", rows)

    def document(self) -> dict[str, list[Any]]:
        """The tables by name."""
        return {name: table.rows for name, table in sorted(self.tables.items())}


def presence_text(presence: Presence) -> str:
    """The launch arguments under which something is there: ``slam:=true``, ``≠`` for any other value."""
    same = in_words((item.argument, item.value) for item in presence if item.equal)
    other = " ".join(f"{item.argument}≠{item.value}" for item in presence if not item.equal)
    return f"{same} {other}".strip()
