# SPDX-License-Identifier: Apache-2.0
"""What a change silences by comments: those of tools that it adds, and findings that its ``haros:`` comments suppress."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Iterable, Iterator

from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.results.comments import bare, comments, lines_of, syntax
from haros_ci.results.directives import code_lines, directives
from haros_ci.results.line_map import line_mapper, words
from haros_ci.results.result import Run, Silenced
from haros_ci.results.silencers import is_generated, silencers

#: Texts with more characters than this are compared by what their comments say and stand beside alone.
_LARGEST_MAPPED = 1_000_000


#: The comments of C++ that hold for more than a line, and what ends them.
_BLOCK = regex(r"/[/*]\s*(?:cppcheck-suppress-(?:begin|(?P<macro>macro))\b|NOLINTBEGIN(?!\w))[^\n]*")
_END = regex(r"/[/*]\s*(?:cppcheck-suppress-end\b|NOLINTEND(?!\w))")
_WORD = regex(r"\w")
#: Comments of one line, and of a whole file, of tools that do not tell what they silence, as pylint does.
_OF_LINES = frozenset(("NOLINT", "NOLINTNEXTLINE", "cppcheck-suppress", "noqa"))
_OF_BLOCKS = ("cppcheck-suppress-begin", "cppcheck-suppress-end", "cppcheck-suppress-macro", "cppcheck-suppress-file")
_OF_FILES = frozenset(("flake8: noqa", "ruff: noqa", "LINT_C_FILE"))
#: Comments that name rules of style alone: cpplint's categories, codes of pycodestyle, pydocstyle, isort and naming.
_OF_STYLE = regex(r"\ANOLINT\w*\((?:\w+/\w+[,)])+|noqa:(?:[EWIDQNC]\d+,?)+\Z", re.IGNORECASE)

#: What a comment says, and a line.
_Key = tuple[str, int | None]


@dataclass(frozen=True, slots=True)
class SilencedPair:
    """A changed file: its path and text now and, if it was there before, its text then (None: it is new)."""

    path: str
    language: str
    head: str
    base: str | None


@dataclass(frozen=True, slots=True)
class _Mark:
    """A comment that silences: where it stands, what it says, and the code that it is about, with its line."""

    place: Location
    words: str
    code: str
    code_line: int
    name: str
    is_own: bool


@dataclass(frozen=True, slots=True)
class AddedComments:
    """The comments that a change adds: the places of *own* ones, those of *others* with their names; and those that have *grown*."""

    own: frozenset[Location]
    others: tuple[tuple[Location, str], ...]
    grown: tuple[tuple[Location, str], ...]

    @property
    def places(self) -> frozenset[Location]:
        """Where all of them stand that are added."""
        return self.own | {place for place, _ in self.others}

    def silenced(self, runs: Iterable[Run]) -> Silenced:
        """These, and how many results of *runs* are suppressed by new ones alone."""
        results = (result for run in runs for result in run.results if result.suppressions)
        count = sum(all(s.kind == "inSource" and s.location in self.own for s in r.suppressions) for r in results)
        return Silenced(count, self.others, self.grown)


def added_comments(pairs: Iterable[SilencedPair], removed: Iterable[tuple[str, str, str]]) -> AddedComments:
    """The comments that are new in *pairs*, and those that were there and hold for more.

    A comment is old if one with the same words stands in the base on the line that maps to its own, or beside the line that maps to its code, or
    beside the same code that has moved: from another place of the file, from another changed file, or from one that is *removed* (path, language
    and text). If that code is still in its place, it has lost the comment, and the comment is new. Of a file that was generated before
    and still is nothing is said.
    """
    new: list[_Mark] = []
    grown: list[tuple[Location, str]] = []
    pool: Counter[tuple[str, str]] = Counter()
    for pair in pairs:
        marks = list(_marks(pair.path, pair.language, pair.head))
        before = [] if pair.base is None else list(_marks(pair.path, pair.language, pair.base))
        if pair.base is not None and marks and is_generated(pair.base) and is_generated(pair.head):
            continue
        grown += _grown(pair)
        left, unmatched = _unmapped(pair, marks, before)
        grown += _edited(pair, [mark for mark in marks if mark not in left], before)
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
    others = [(mark.place, mark.name) for mark in added if not mark.is_own]
    return AddedComments(
        frozenset(mark.place for mark in added if mark.is_own),
        tuple(sorted(others, key=by_place)),
        tuple(sorted({*grown} - {*others}, key=by_place)),
    )


def by_place(pair: tuple[Location, str]) -> tuple[object, ...]:
    """What to sort pairs of a place and a text by."""
    return pair[0].sort_key, pair[1]


def _grown(pair: SilencedPair) -> Iterator[tuple[Location, str]]:
    """The comments of *pair* that hold for a block, and were there before, under which lines stand that none of the same words stood above."""
    if pair.base is None or syntax(pair.language, pair.path) != "c" or not _BLOCK.search(pair.base):
        return
    old: dict[str, Counter[str]] = {}
    for key, _, lines in _blocks(pair.base):
        old.setdefault(key, Counter()).update(lines)
    for key, line, lines in _blocks(pair.head):
        if key in old and lines - old[key]:
            yield Location(pair.path, line), "NOLINTBEGIN" if key.startswith("NOLINT") else "cppcheck-suppress"
        elif key in old:
            old[key] -= lines


def _edited(pair: SilencedPair, old: Iterable[_Mark], before: Iterable[_Mark]) -> Iterator[tuple[Location, str]]:
    """The comments of *pair* that were there *before*, and hold for code now that they did not hold for: beside them, or somewhere in the file."""
    known = Counter((mark.words, mark.code) for mark in before)
    for mark in old:
        if mark.is_own or _OF_STYLE.search(mark.words):
            continue
        if mark.name in _OF_LINES and not mark.words.lstrip("/*").startswith(_OF_BLOCKS):
            known[mark.words, mark.code] -= 1
            if mark.code and known[mark.words, mark.code] < 0:
                yield mark.place, mark.name
        elif mark.name in _OF_FILES or "cppcheck-suppress-file" in mark.words:
            if pair.base is not None and _code(pair, pair.head) - _code(pair, pair.base):
                yield mark.place, mark.name


def _code(pair: SilencedPair, text: str) -> Counter[str]:
    """The lines of code of a text, without blanks and comments."""
    kind = syntax(pair.language, pair.path)
    lines = lines_of(text)
    return Counter(bare(lines[number - 1], kind) for number in code_lines(text, kind))


def _blocks(text: str) -> Iterator[tuple[str, int, Counter[str]]]:
    """What each comment for a block says, its line, and the lines of code below it: to its end, or of a macro."""
    lines, found = lines_of(text), list(comments(text, "c"))
    for i, comment in enumerate(found):
        match = _BLOCK.match(comment.text)
        if match is None:
            continue
        if match["macro"]:
            end = comment.end_line + 1
            while end < len(lines) and lines[end - 1].endswith("\\"):
                end += 1
        else:
            ends = (one.line for one in found[i + 1 :] if _END.match(one.text))
            end = next(ends, len(lines) + 1) - 1
        code = Counter(bare(line, "c") for line in lines[comment.end_line : end])
        yield "".join(match[0].split()), comment.line, +Counter({k: n for k, n in code.items() if _WORD.search(k)})


def _marks(path: str, language: str, text: str) -> Iterator[_Mark]:
    kind = syntax(language, path)
    if language == "markdown" or not kind:
        return
    lines: list[str] | None = None
    for directive in directives(text, path, kind):
        lines = lines_of(text) if lines is None else lines
        code = bare(lines[directive.line - 1], kind) if directive.line <= len(lines) else ""
        yield _Mark(directive.place, directive.words, code, directive.line, "haros", is_own=True)
    for found in silencers(text, kind):
        place = Location(path, found.line)
        yield _Mark(place, found.words, found.code, found.code_line, found.form.name, is_own=False)


def _unmapped(pair: SilencedPair, marks: list[_Mark], before: list[_Mark]) -> tuple[list[_Mark], list[_Mark]]:
    """The *marks* that do not stand where an equal one of *before* stood, and those of *before* whose code is gone from its place."""
    if pair.base is None or not before or max(len(pair.base), len(pair.head)) > _LARGEST_MAPPED:
        return marks, before
    kind = syntax(pair.language, pair.path)
    mapped = _code_mapper(pair.base, pair.head, kind)
    code = [mapped(mark.code_line) for mark in before]
    by_code: Counter[_Key] = Counter(
        (mark.words, line) for mark, line in zip(before, code, strict=True) if line is not None
    )
    left = [mark for mark in marks if not _taken(by_code, (mark.words, mark.code_line))]
    lines = lines_of(pair.head)
    rest = []
    for mark, line in zip(before, code, strict=True):
        is_left = line is None or _taken(by_code, (mark.words, line))
        if is_left and (line is None or words(mark.code) - words(bare(lines[line - 1], kind))):
            rest.append(mark)
    if not left or not rest:
        return left, rest
    place = line_mapper(pair.base, pair.head)
    places = [place(mark.place.line or 1) for mark in rest]
    by_place: Counter[_Key] = Counter((mark.words, line) for mark, line in zip(rest, places, strict=True))
    left = [mark for mark in left if not _taken(by_place, (mark.words, mark.place.line))]
    return left, [m for m, line in zip(rest, places, strict=True) if _taken(by_place, (m.words, line))]


def _code_mapper(old: str, new: str, kind: str) -> Callable[[int], int | None]:
    """As ``line_mapper``, by the code alone: comments and the lines of comments do not count, so that one that moves leaves its code in place."""
    numbers = [code_lines(text, kind) for text in (old, new)]
    texts = []
    for text, found in zip((old, new), numbers, strict=True):
        lines = lines_of(text)
        texts.append("\n".join(bare(lines[number - 1], kind) for number in found))
    inner = line_mapper(texts[0], texts[1])
    before, after = numbers

    def mapped(line: int) -> int | None:
        at = bisect_left(before, line)
        place = inner(at + 1) if at < len(before) and before[at] == line else None
        return None if place is None or place > len(after) else after[place - 1]

    return mapped


def _taken(counts: Counter[_Key], key: _Key) -> bool:
    """Whether one of *key* is left, which is taken."""
    if counts[key] > 0:
        counts[key] -= 1
        return True
    return False
