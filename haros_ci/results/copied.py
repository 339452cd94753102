# SPDX-License-Identifier: Apache-2.0
"""The same finding in copies of one text: one finding at the first place, which names the others.

Robots that are sold in ten variants have ten packages with the same scripts, and one mistake is found ten times. Such findings are
joined last of all, when each has its identity and its state: what is known and what is new are never joined, so a copy that a change
adds is reported although the others are known. Only reports that a person reads join them (``haros_ci.commands.output``); what a
program matches place by place keeps every place.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from posixpath import splitext

from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.results import alike as beside
from haros_ci.results.across import across, standing_for
from haros_ci.results.comments import bare, lines_of, syntax
from haros_ci.results.result import Report, Result, Run
from haros_ci.results.scope import LineScopes, scopes
from haros_ci.results.twins import twins

#: Texts of more characters are compared with no other.
LARGEST = 400_000
#: Different texts that the findings of one rule and shape are compared with.
MOST_HEADS = 30
#: Lines that a function has at least; of a shorter one the whole file is compared.
LEAST_LINES = 5
#: Names, beside those of the package and the path, in which copies may differ: one written in two ways.
OTHER_NAMES = 2

_TOKEN = regex(r"\w+|[^\w\s]")
_WORD = regex(r"\w+")
_LEAST_NAME = 3
#: Numbers of functions are of each of them.
_COUNTED = "metrics"


def together(report: Report, text: Callable[[str], str], package: Callable[[str], str]) -> Report:
    """*report* with the findings in copies joined, and then those of one file that are alike; *text* and *package* tell those of a path."""
    languages = {artifact.path: artifact.language for artifact in report.artifacts}
    texts = _Texts(text, lambda path: languages.get(path, ""), package)
    return replace(report, runs=tuple(_joined_run(run, texts) for run in report.runs))


def copy_of(joined: Report) -> Mapping[int, Location]:
    """Of the results that others of *joined* stand for, by identity, the place of the one that does."""
    return {id(copy): one.location for run in joined.runs for one in run.results for copy in one.copies}


def standing_for_others(joined: Report) -> Mapping[tuple[str, Location], Result]:
    """The results of *joined* that others are left to, by rule and place, with what people read of all of them."""
    every = (result for run in joined.runs for result in run.results)
    return {(result.full_id, result.location): result for result in every if result.copies}


def _joined_run(run: Run, texts: _Texts) -> Run:
    if run.imported or run.tool.name == _COUNTED:
        return run
    alike: dict[tuple[object, ...], list[int]] = defaultdict(list)
    for i, result in enumerate(run.results):
        if result.state in beside.UNITED and not result.suppressions and result.value is None:
            shape = _WORD.sub("_", result.message)
            ending = splitext(result.location.path)[1]
            alike[result.rule, result.level, result.state, shape, ending, result.location.line is None].append(i)
    copies: dict[int, list[Result]] = {}
    dropped: set[int] = set()
    for indexes in alike.values():
        if len({run.results[i].location.path for i in indexes}) > 1:
            for first, *others in _groups([(i, run.results[i]) for i in indexes], texts):
                copies[first] = [run.results[i] for i in others]
                dropped.update(others)
    results = [_joined(one, copies[i]) if i in copies else one for i, one in enumerate(run.results) if i not in dropped]
    joined = twins(across(beside.joined(results)), texts.text, LARGEST)
    return replace(run, results=_with_originals(joined, run.results))


def _with_originals(joined: Sequence[Result], results: Sequence[Result]) -> tuple[Result, ...]:
    """*joined*, each with those of *results* that it stands for: what stood for others on the way has other words since."""
    own = {id(result) for result in results}
    at: dict[tuple[str, Location], list[Result]] = defaultdict(list)
    for result in results:
        at[result.full_id, result.location].append(result)

    def original(copy: Result) -> Result:
        same = at[copy.full_id, copy.location] if id(copy) not in own else ()
        return next((one for one in same if copy.message.startswith(one.message.rstrip("."))), copy)

    return tuple(
        replace(result, copies=tuple(map(original, result.copies))) if result.copies else result for result in joined
    )


def _groups(results: Sequence[tuple[int, Result]], texts: _Texts) -> Iterable[list[int]]:
    """The positions of findings in copies of one text, where they are several: each path once."""
    heads: list[tuple[Result, list[int], set[str]]] = []
    for i, result in results:
        for head, found, paths in heads:
            if result.location.path not in paths and _is_copy(head, result, texts):
                found.append(i)
                paths.add(result.location.path)
                break
        else:
            if len(heads) < MOST_HEADS:
                heads.append((result, [i], {result.location.path}))
    return [found for _, found, _ in heads if len(found) > 1]


def _joined(first: Result, others: Sequence[Result]) -> Result:
    return standing_for(first, others, "1 copy" if len(others) == 1 else f"{len(others)} copies")


@dataclass(frozen=True, slots=True)
class _Unit:
    """The text that is compared: its tokens, and which of its lines that have code the finding is on."""

    tokens: tuple[str, ...]
    line: int


class _Texts:
    """Files by path, read once each."""

    def __init__(
        self, text: Callable[[str], str], language: Callable[[str], str], package: Callable[[str], str]
    ) -> None:
        self.text, self._language, self._package = text, language, package
        self._lines: dict[str, list[str]] = {}
        self._units: dict[tuple[str, int, int], tuple[str, ...]] = {}
        self._names: dict[str, frozenset[str]] = {}
        self._functions: dict[tuple[str, int], tuple[tuple[int, int], ...]] = {}
        self._scopes: dict[str, LineScopes] = {}

    def names(self, path: str) -> frozenset[str]:
        """What a file is called by: its package, its directories, and itself without its ending."""
        if path not in self._names:
            words = {*splitext(path)[0].split("/"), self._package(path)}
            self._names[path] = frozenset(word.lower() for word in words if len(word) >= _LEAST_NAME)
        return self._names[path]

    def units(self, result: Result) -> Iterable[_Unit]:
        """The function around a finding, and then its file; none where the file is too large or gone."""
        path, line = result.location.path, result.location.line or 1
        lines = self._of(path)
        if not 0 < line <= len(lines):
            return
        if (path, line) not in self._functions:
            self._functions[path, line] = tuple(self._function(path, line))
        for start, end in (*self._functions[path, line], (0, len(lines))):
            yield _Unit(self._tokens(path, start, end), sum(map(bool, lines[start : line - 1])))

    def _of(self, path: str) -> list[str]:
        if path not in self._lines:
            text = self.text(path)
            kind = syntax(self._language(path), path)
            lines = lines_of(text) if len(text) <= LARGEST else []
            self._lines[path] = [bare(line, kind).strip() for line in lines]
        return self._lines[path]

    def _tokens(self, path: str, start: int, end: int) -> tuple[str, ...]:
        key = (path, start, end)
        if key not in self._units:
            self._units[key] = tuple(_TOKEN.findall("\n".join(self._of(path)[start:end])))
        return self._units[key]

    def _function(self, path: str, line: int) -> Iterable[tuple[int, int]]:
        if path not in self._scopes:
            self._scopes[path] = scopes(self.text(path), self._language(path))
        known = self._scopes[path]
        name = known.at(line)
        if not name:
            return
        inside = [own == name or own.startswith((f"{name}.", f"{name}::")) for own in known.names]
        at = max(i for i, start in enumerate(known.starts) if start <= line)
        first = last = at
        while first > 0 and inside[first - 1]:
            first -= 1
        while last + 1 < len(inside) and inside[last + 1]:
            last += 1
        lines = self._of(path)
        end = known.starts[last + 1] - 1 if last + 1 < len(inside) else len(lines)
        if sum(map(bool, lines[known.starts[first] - 1 : end])) >= LEAST_LINES:
            yield known.starts[first] - 1, end


def _is_copy(one: Result, other: Result, texts: _Texts) -> bool:
    """Whether two findings have the same message at the same line of equal texts, except for names."""
    names = (texts.names(one.location.path), texts.names(other.location.path))
    for here, there in zip(texts.units(one), texts.units(other)):
        if here.line == there.line and _is_renamed(here.tokens, there.tokens, names, (one.message, other.message)):
            return True
    return False


def _is_renamed(
    here: tuple[str, ...], there: tuple[str, ...], names: tuple[frozenset[str], frozenset[str]], texts: tuple[str, str]
) -> bool:
    if len(here) != len(there):
        return False
    messages = (_TOKEN.findall(texts[0]), _TOKEN.findall(texts[1]))
    if len(messages[0]) != len(messages[1]):
        return False
    renamed = {pair for pair in zip(here, there) if pair[0] != pair[1]} if here != there else set()
    renamed = {pair for pair in renamed if not _is_own(pair, names)}
    if len(renamed) > OTHER_NAMES or not all(_is_name(word) for pair in renamed for word in pair):
        return False
    if len({a for a, _ in renamed}) < len(renamed) or len({b for _, b in renamed}) < len(renamed):
        return False
    if renamed and any((a, a) in zip(here, there) for a, _ in renamed):  # renamed here, and not there
        return False
    return all(pair[0] == pair[1] or pair in renamed or _is_own(pair, names) for pair in zip(*messages))


def _is_name(word: str) -> bool:
    return word[0].isalpha() or word[0] == "_"


def _is_own(pair: tuple[str, str], names: tuple[frozenset[str], frozenset[str]]) -> bool:
    """Whether two words are the same but for what only the one and only the other file is called by."""
    one, other = (_without(word.lower(), own - foreign) for word, own, foreign in zip(pair, names, names[::-1]))
    return one == other


def _without(word: str, names: frozenset[str]) -> str:
    for name in sorted(names, key=len, reverse=True):
        word = word.replace(name, "\0")
        if "_" in name:
            word = word.replace(name.replace("_", ""), "\0")
    return word
