# SPDX-License-Identifier: Apache-2.0
"""Whether a known finding has moved to another file with the code around it, or was mended in the one and made in the other."""

from __future__ import annotations

from collections.abc import Callable

from haros_ci.results.comments import lines_of
from haros_ci.results.known import ComparedFiles
from haros_ci.results.line_map import line_mapper
from haros_ci.results.scope import scopes

#: Lines around that are compared, on each side, and how many of them have to be the same; lines without a letter say nothing.
_AROUND = 12
_LEAST = 2

Mapper = Callable[[int], int | None]


class MovedCode:
    """The texts of *sides* as far as moves ask for them; each file is compared with its past once."""

    def __init__(self, sides: ComparedFiles) -> None:
        self._sides = sides
        self._before = {now: then for then, now in sides.renames.items()}
        self._maps: dict[tuple[str, bool], Mapper] = {}
        self._scopes: dict[tuple[str, bool], frozenset[str]] = {}

    def is_move(self, old: tuple[str, int | None], new: tuple[str, int | None], scope: str, *, with_code: bool) -> bool:
        """Whether what stood at *old* (path in the base, line) can stand at *new* now because it was moved there; True where the past has no texts.

        It has not, if its line gave way to another one where it stood, or took the place of one where it stands now: so one was mended, and one made.
        *with_code* asks that the function around, of which *scope* is the name, is gone from the old file, and that lines around have come along.
        """
        base = self._sides.base
        if base is None or old[1] is None or new[1] is None:
            return True
        if self._is_edited(self._now(old[0]), old[0], old[1], is_old=True):
            return False
        if self._is_edited(new[0], self._before.get(new[0], new[0]), new[1], is_old=False):
            return False
        if not with_code:
            return True
        if (
            scope
            and scope in self._names(self._now(old[0]), is_old=False)
            and scope in self._names(old[0], is_old=True)
        ):
            return False
        return _alike(lines_of(base(old[0])), old[1], lines_of(self._sides.head(new[0])), new[1])

    def _now(self, path: str) -> str:
        return self._sides.renames.get(path, path)

    def _names(self, path: str, *, is_old: bool) -> frozenset[str]:
        key = (path, is_old)
        if key not in self._scopes:
            text = self._text(path, is_old=is_old)
            self._scopes[key] = frozenset(scopes(text, self._sides.language(path)).names)
        return self._scopes[key]

    def _text(self, path: str, *, is_old: bool) -> str:
        if not is_old:
            return self._sides.head(path) if self._sides.exists(path) else ""
        return self._sides.base(path) if self._sides.base else ""

    def _is_edited(self, head: str, base: str, line: int, *, is_old: bool) -> bool:
        """Whether another line stands on the other side where *line* stands on this one, between the lines that are next to it on both."""
        texts = self._text(head, is_old=False), self._text(base, is_old=True)
        here, there = texts[::-1] if is_old else texts
        if not here or not there:
            return False
        key = (head, is_old)
        if key not in self._maps:
            self._maps[key] = line_mapper(here, there)
        ours, theirs = lines_of(here), lines_of(there)
        above, below = _next(ours, line, -1), _next(ours, line, 1)
        first = self._maps[key](above) if above else 0
        last = self._maps[key](below) if below else len(theirs) + 1
        if first is None or last is None:
            return False
        return any(text.strip() for text in theirs[first : last - 1])


def _next(lines: list[str], line: int, step: int) -> int:
    """The number of the nearest line before or behind *line* that is not blank; 0 without one."""
    line += step
    while 0 < line <= len(lines) and not lines[line - 1].strip():
        line += step
    return line if 0 < line <= len(lines) else 0


def _alike(old: list[str], before: int, new: list[str], now: int) -> bool:
    """Whether the two lines have enough lines around them that are the same, in one piece with them; or all there are."""
    found = whole = 0
    for step in (-1, 1):
        there, here = before, now
        for _ in range(_AROUND):
            there, here = _next(old, there, step), _next(new, here, step)
            if not there or not here:
                whole += not there
                break
            if "".join(old[there - 1].split()) != "".join(new[here - 1].split()):
                break
            found += any(map(str.isalnum, old[there - 1]))
    return found >= _LEAST or whole == 2
