# SPDX-License-Identifier: Apache-2.0
"""What a change silences by comments: those of tools that it adds, and findings that its ``haros:`` comments suppress."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from haros_ci.model.location import Location
from haros_ci.results.comments import lines_of, syntax
from haros_ci.results.directives import directives
from haros_ci.results.line_map import line_mapper
from haros_ci.results.result import Run, Silenced
from haros_ci.results.silencers import is_generated, silencers

#: Texts with more characters than this are compared by what their comments say and stand beside alone.
_LARGEST_MAPPED = 1_000_000


@dataclass(frozen=True, slots=True)
class SilencedPair:
    """A changed file: its path and text now and, if it was there before, its text then (None: it is new)."""

    path: str
    language: str
    head: str
    base: str | None


@dataclass(frozen=True, slots=True)
class _Mark:
    """A comment that silences: where it stands, what it says, and the code that it is about."""

    place: Location
    words: str
    code: str
    name: str
    is_own: bool


def silenced(pairs: Iterable[SilencedPair], removed: Iterable[tuple[str, str, str]], runs: Iterable[Run]) -> Silenced:
    """The comments that are new in *pairs*, and how many results of *runs* are suppressed by new ones alone.

    A comment is old if one with the same words stands in the base on the line that maps to its own, or beside the same code: in the same
    file, in another changed file, or in one that is *removed* (path, language and text). Of a file that was generated before and
    still is nothing is said.
    """
    new: list[_Mark] = []
    pool: Counter[tuple[str, str]] = Counter()
    for pair in pairs:
        marks = list(_marks(pair.path, pair.language, pair.head))
        before = [] if pair.base is None else list(_marks(pair.path, pair.language, pair.base))
        if pair.base is not None and marks and is_generated(pair.base) and is_generated(pair.head):
            continue
        left, unmatched = _unmapped(pair, marks, before)
        new += left
        pool.update((mark.words, mark.code) for mark in unmatched)
    for path, language, text in removed if new else ():
        pool.update((mark.words, mark.code) for mark in _marks(path, language, text))
    added = []
    for mark in new:
        if pool[mark.words, mark.code] > 0:
            pool[mark.words, mark.code] -= 1
        else:
            added.append(mark)
    own = {mark.place for mark in added if mark.is_own}
    results = (result for run in runs for result in run.results if result.suppressions)
    count = sum(all(s.kind == "inSource" and s.location in own for s in result.suppressions) for result in results)
    others = ((mark.place, mark.name) for mark in added if not mark.is_own)
    return Silenced(count, tuple(sorted(others, key=lambda pair: (pair[0].sort_key, pair[1]))))


def _marks(path: str, language: str, text: str) -> Iterator[_Mark]:
    kind = syntax(language, path)
    if language == "markdown" or not kind:
        return
    lines: list[str] | None = None
    for directive in directives(text, path, kind):
        lines = lines_of(text) if lines is None else lines
        code = lines[directive.line - 1] if directive.line <= len(lines) else ""
        yield _Mark(directive.place, directive.words, "".join(code.split()), "haros", is_own=True)
    for found in silencers(text, kind):
        yield _Mark(Location(path, found.line), found.words, found.code, found.form.name, is_own=False)


def _unmapped(pair: SilencedPair, marks: list[_Mark], before: list[_Mark]) -> tuple[list[_Mark], list[_Mark]]:
    """The *marks* that do not stand where an equal one of *before* stood, and those of *before* that remain."""
    if not marks or not before or pair.base is None:
        return marks, before
    old = Counter((mark.words, mark.code) for mark in before)
    left = []
    for mark in marks:
        if old[mark.words, mark.code] > 0:
            old[mark.words, mark.code] -= 1
        else:
            left.append(mark)
    rest = [mark for mark in before if _taken(old, (mark.words, mark.code))]
    if not left or not rest or max(len(pair.base), len(pair.head)) > _LARGEST_MAPPED:
        return left, rest
    mapped: Callable[[int], int | None] = line_mapper(pair.base, pair.head)
    places = Counter((mark.words, mapped(mark.place.line or 1)) for mark in rest)
    new = []
    for mark in left:  # the code beside it was edited
        key = (mark.words, mark.place.line)
        if places[key] > 0:
            places[key] -= 1
        else:
            new.append(mark)
    return new, [mark for mark in rest if _taken(places, (mark.words, mapped(mark.place.line or 1)))]


def _taken(counts: Counter[tuple[str, str]] | Counter[tuple[str, int | None]], key: tuple[str, object]) -> bool:
    """Whether one of *key* is left, which is taken."""
    if counts[key] > 0:  # type: ignore[index]  # the key is of the kind that the counts have
        counts[key] -= 1  # type: ignore[index]  # the same
        return True
    return False
