# SPDX-License-Identifier: Apache-2.0
"""The same finding in files that are mostly one text: one finding at the first place, which names the others.

A launch file that was copied for another robot and changed in a few lines has the mistakes of the first one. Unlike copies
(``haros_ci.results.copied``) such files differ in more than names. As with copies only reports that a person reads join findings,
and what is new and what is known are never joined.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from posixpath import dirname, splitext

from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.results.across import cause, places_named
from haros_ci.results.alike import UNITED
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

#: Lines with words that the shorter of two files has at least.
LEAST = 8
#: The share of their lines that two files have in common.
ALIKE = 0.75
#: The lines of the shorter file, LONG at least, that the longer one has: the shorter one is an extract.
INSIDE, LONG = 0.9, 20
#: So many further files of a directory have a line, and its warning, where it was pasted into them.
PASTED = 2
#: Findings of one rule that are compared with each other; the others stay as they are.
MOST = 60

_BLANKS = regex(r"\s+")
_COMMENT = regex(r"<!--|-->")
_WORD = regex(r"\w")
#: What follows what a finding says of itself: the others that it stands for.
_OTHERS = regex(r"; and (?:the same (?:in|of) |\d+ more like it)")


@dataclass(frozen=True, slots=True)
class _Group:
    """A result with those of its file that it stands for, as what each says and the line that it says it of."""

    at: int
    result: Result
    statements: frozenset[tuple[tuple[str, ...], str]]

    def is_twin(self, other: _Group, files: _Files) -> bool:
        """Whether *other* stands for the same mistake, in a file that is mostly the same text; one of the two may stand for more.

        In one directory the files may differ in all else, where two or more warnings of each are the same: these lines were pasted.
        """
        here, there = self.result, other.result
        if here.location.path == there.location.path:
            return False
        is_part = self.statements <= other.statements or other.statements <= self.statements
        if is_part and files.are_alike(here.location.path, there.location.path):
            return True
        is_pasted = here.level is not Level.ERROR and len(self.statements) > 1 and self.causes() == other.causes()
        return is_pasted and dirname(here.location.path) == dirname(there.location.path)

    def is_same_line(self, other: _Group) -> bool:
        """Whether *other* is the one same warning of the one same line, in another file of the directory."""
        here, there = self.result, other.result
        if here.level is Level.ERROR or len(self.statements) != 1 or self.statements != other.statements:
            return False
        paths = here.location.path, there.location.path
        return paths[0] != paths[1] and dirname(paths[0]) == dirname(paths[1])

    def causes(self) -> frozenset[tuple[str, ...]]:
        """What the findings say, whatever their lines are."""
        return frozenset(cause for cause, _ in self.statements)


class _Files:
    """The lines of files, read once each, without what does not tell two texts apart."""

    def __init__(self, text: Callable[[str], str], largest: int) -> None:
        self._text, self._largest = text, largest
        self._lines: dict[str, list[str]] = {}
        self._counted: dict[str, Counter[str]] = {}
        self._alike: dict[tuple[str, str], bool] = {}

    def line(self, path: str, number: int) -> str:
        """One line, by its number from 1; "" where there is none."""
        lines = self._of(path)
        return lines[number - 1] if 0 < number <= len(lines) else ""

    def are_alike(self, one: str, other: str) -> bool:
        """Whether two files are mostly one text, or one is an extract of the other."""
        key = (one, other)
        if key not in self._alike:
            here, there = self._count(one), self._count(other)
            sizes = sorted((here.total(), there.total()))
            common = (here & there).total() if sizes[0] >= LEAST else 0
            is_extract = sizes[0] >= LONG and common >= INSIDE * sizes[0]
            self._alike[key] = sizes[0] >= LEAST and (2 * common >= ALIKE * sum(sizes) or is_extract)
        return self._alike[key]

    def _of(self, path: str) -> list[str]:
        if path not in self._lines:
            text = self._text(path)
            self._lines[path] = [_plain(line) for line in text.split("\n")] if len(text) <= self._largest else []
        return self._lines[path]

    def _count(self, path: str) -> Counter[str]:
        if path not in self._counted:
            self._counted[path] = Counter(line for line in self._of(path) if _WORD.search(line))
        return self._counted[path]


def _plain(line: str) -> str:
    return _BLANKS.sub(" ", _COMMENT.sub("", line).replace("'", '"')).strip(" ,;")


def twins(results: Sequence[Result], text: Callable[[str], str], largest: int) -> tuple[Result, ...]:
    """*results* with those as one that say the same of the same lines of files which are mostly one text."""
    files = _Files(text, largest)
    alike: dict[tuple[object, ...], list[int]] = defaultdict(list)
    for i, one in enumerate(results):
        if _is_joined(one):
            alike[one.full_id, one.level, one.state, splitext(one.location.path)[1]].append(i)
    heads: dict[int, list[_Group]] = {}
    for indexes in alike.values():
        if len({results[i].location.path for i in indexes}) > 1:
            heads.update(_by_head([_Group(i, results[i], _statements(results[i], files)) for i in indexes], files))
    dropped = {group.at for same in heads.values() for group in same}
    joined = {at: _joined(results[at], [group.result for group in same]) for at, same in heads.items()}
    return tuple(joined.get(i, one) for i, one in enumerate(results) if i not in dropped)


def _is_joined(one: Result) -> bool:
    return one.state in UNITED and not one.suppressions and one.value is None and bool(one.location.line)


def _by_head(groups: Sequence[_Group], files: _Files) -> Iterator[tuple[int, list[_Group]]]:
    """The twins among *groups*: the place of the one that says most, or else comes first, with the others."""
    waiting = sorted(groups, key=lambda group: -len(group.statements))[:MOST]
    while waiting:
        head, *waiting = waiting
        pasted = [group for group in waiting if head.is_same_line(group)]
        same = [
            group
            for group in waiting
            if head.is_twin(group, files) or (len(pasted) >= PASTED and head.is_same_line(group))
        ]
        if same:
            yield head.at, same
            waiting = [group for group in waiting if group not in same]


def _statements(one: Result, files: _Files) -> frozenset[tuple[tuple[str, ...], str]]:
    path = one.location.path
    inside = (one, *(copy for copy in one.copies if copy.location.path == path))
    return frozenset(
        (cause(_OTHERS.split(result.message)[0]), files.line(path, result.location.line or 0)) for result in inside
    )


def _joined(first: Result, others: Sequence[Result]) -> Result:
    where = "1 similar file" if len(others) == 1 else f"{len(others)} similar files"
    words, related = places_named(others, where)
    return replace(
        first,
        message=f"{first.message.rstrip('.')}; {words}",
        related=(*first.related, *related),
        copies=(*first.copies, *(copy for other in others for copy in (other, *other.copies))),
    )
