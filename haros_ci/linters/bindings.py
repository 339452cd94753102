# SPDX-License-Identifier: Apache-2.0
"""What the scopes of a Python file bind, line by line."""

from __future__ import annotations

from haros_ci.records import dataclass, field


@dataclass(eq=False, slots=True)
class Scope:
    """A module, class, function or comprehension; *name* is that of the function, "" for others."""

    kind: str
    parent: Scope | None
    name: str = ""
    line: int = 0
    #: Lines at which a name is bound, with "" or why that does not count.
    bound: dict[str, list[tuple[int, str]]] = field(default_factory=dict)
    deleted: dict[str, int] = field(default_factory=dict)
    outer: dict[str, str] = field(default_factory=dict)
    _summaries: dict[str, tuple[int, int, frozenset[str]]] = field(default_factory=dict)

    def bind(self, name: str, line: int, why: str) -> None:
        self.bound.setdefault(name, []).append((line, why))

    def summary(self, name: str) -> tuple[int, int, frozenset[str]]:
        """The first line that binds *name*, the last one that counts (0: none), and why others do not; asked when all is read."""
        if name not in self._summaries:
            lines = self.bound[name]
            last = max((line for line, why in lines if not why), default=0)
            self._summaries[name] = (min(lines)[0], last, frozenset(why for _, why in lines if why))
        return self._summaries[name]
