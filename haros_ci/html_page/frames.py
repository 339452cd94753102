# SPDX-License-Identifier: Apache-2.0
"""The lines of source around places, each file's once, as far as there is room."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from haros_ci.html_page.pool import Pool
from haros_ci.model.location import Location
from haros_ci.report.source_lines import quoted, split

#: Lines before and after the first and the last of a place, and of a place the most that are shown.
AROUND, MOST_LINES = 3, 12
#: Characters of source on the page.
MOST_CHARACTERS = 3_000_000


class Frames:
    """Lines by file; ``is_full`` says that some were left out."""

    def __init__(self, source: Callable[[str], str], most: int = MOST_CHARACTERS) -> None:
        self._source = source
        self._lines: dict[str, list[str]] = {}
        self._kept: dict[str, set[int]] = {}
        self._left = most
        self.is_full = False

    def keep(self, places: Iterable[Location], around: int = AROUND) -> None:
        """Keep the lines around *places*; nothing where the file is not there."""
        for place in places:
            if place.line is None:
                continue
            lines = self._of(place.path)
            if place.line > len(lines):
                continue
            last = min(place.end_line or place.line, place.line + MOST_LINES)
            kept = self._kept.setdefault(place.path, set())
            for number in range(max(1, place.line - around), min(len(lines), last + around) + 1):
                if number in kept:
                    continue
                self._left -= len(lines[number - 1][:400]) + 1
                if self._left < 0:
                    self.is_full = True
                    return
                kept.add(number)

    def _of(self, path: str) -> list[str]:
        if path not in self._lines:
            text = self._source(path)
            self._lines[path] = split(text) if text else []
        return self._lines[path]

    def document(self, pool: Pool) -> list[tuple[int, list[tuple[int, list[str]]]]]:
        """For each file, by path, runs of lines: the number of the first, and the lines."""
        found = []
        for path, kept in sorted(self._kept.items()):
            runs: list[tuple[int, list[str]]] = []
            for number in sorted(kept):
                line = quoted(self._lines[path][number - 1])
                if runs and runs[-1][0] + len(runs[-1][1]) == number:
                    runs[-1][1].append(line)
                else:
                    runs.append((number, [line]))
            if runs:
                found.append((pool.text(path), runs))
        return found
