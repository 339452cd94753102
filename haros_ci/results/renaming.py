# SPDX-License-Identifier: Apache-2.0
"""Known findings of the architecture whose ROS names changed or are fewer: paired by what the names are, and only with evidence.

Names of the same roles come and go for many reasons, and a new defect must not pass for an old one that was mended in
the same change. So one set of names is taken for another only if as many names differ on both sides, those of the past
are gone from the system, those of today were not in it, and it stands where it stood: docs/decisions/0012.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence

from haros_ci.records import dataclass
from haros_ci.results.candidate import Key, MatchCandidate, MatchedPair, grouped, picker
from haros_ci.results.known import ComparedFiles, KnownFinding, identity_of
from haros_ci.results.result import Result

#: Where a line of an old path stands in a new one; None if it is gone or nothing can be said.
Mapped = Callable[[str, int], tuple[str, int] | None]

_MOST_CHOICES = 40_000  # pairs looked at in one group
_LEAST_NAMES = 2

#: With the past's text at hand the line tells: it stands as it was, or was edited where it stood.
_BY_LINE = (
    ("RKPLT", "same roles and text at its mapped line"),
    ("RKPL", "same roles at its mapped line; the line was edited"),
)
#: Else what the baseline holds of the line and its neighbours has to do.
_BY_TEXT = (
    ("RKPST", "same roles, text and scope"),
    ("RKPB", "same roles after the same lines"),
    ("RKPA", "same roles before the same lines"),
    ("RKPSH", "same roles, scope and shape of the line"),
)


def pair_renamed(
    sides: ComparedFiles, new: Iterable[MatchCandidate], old: Iterable[MatchCandidate], evidence: RenamingEvidence
) -> tuple[MatchedPair, ...]:
    """Pairs of those in *new* and *old*, all of one comparison, that are named otherwise and are the same finding."""
    new, old = [thing for thing in new if thing.names], [thing for thing in old if thing.names]
    pairs: dict[int, MatchedPair] = {}
    for letters, words in _BY_TEXT if sides.base is None else _BY_LINE:
        pick = picker(letters)
        olds = grouped(old, pick, {pick(thing.features) for thing in new})
        news = grouped(new, pick, olds)
        for key, here in news.items():
            pairs.update((a, MatchedPair(a, b, words)) for a, b in _assigned(here, olds[key], evidence))
        removed = {pair.old for pair in pairs.values()}
        new = [thing for thing in new if thing.index not in pairs]
        old = [thing for thing in old if thing.index not in removed]
    return tuple(pairs.values())


def pair_partly_mended(
    new: Iterable[MatchCandidate],
    old: Iterable[MatchCandidate],
    results: Sequence[Result],
    known: Sequence[KnownFinding],
) -> tuple[MatchedPair, ...]:
    """Pairs of findings of one rule and file of which the result is about some of the names, and no other.

    Two names at least: a single one says too little of what was wrong with it.
    """
    pick = picker("RP")
    new = [thing for thing in new if len(set(results[thing.index].subject)) >= _LEAST_NAMES]
    olds = grouped((thing for thing in old if thing.names), pick, {pick(thing.features) for thing in new})
    choices = []
    for key, here in grouped(new, pick, olds).items():
        befores = [(b, set(known[b.index].subject)) for b in olds[key]]
        for a in here if len(here) * len(befores) <= _MOST_CHOICES else ():
            now = set(results[a.index].subject)
            for b, before in befores:
                if now < before:
                    removed = len(before) - len(now)
                    choices.append((removed, abs(a.place[0] - b.place[0]), a.place, b.place, a.index, b.index))
    found = _one_to_one((new, old) for *_, new, old in sorted(choices))
    return tuple(
        MatchedPair(new, old, "some of the same ROS names in the same file; the others were mended")
        for new, old in found
    )


def _assigned(
    here: list[MatchCandidate], there: list[MatchCandidate], evidence: RenamingEvidence
) -> list[tuple[int, int]]:
    """One to one: those that have most names in common first, then the nearest."""
    if len(here) * len(there) > _MOST_CHOICES:
        return []
    choices = []
    for a in here:
        for b in there:
            common = evidence.common(a.index, b.index)
            if common is not None:
                choices.append((-common, abs(a.place[0] - b.place[0]), a.place, b.place, a.index, b.index))
    return _one_to_one((new, old) for *_, new, old in sorted(choices))


def _one_to_one(choices: Iterable[tuple[int, int]]) -> list[tuple[int, int]]:
    """The first choice of each, as far as the other is free."""
    found: list[tuple[int, int]] = []
    news: set[int] = set()
    olds: set[int] = set()
    for new, old in choices:
        if new not in news and old not in olds:
            news.add(new)
            olds.add(old)
            found.append((new, old))
    return found


class RenamingEvidence:
    """What tells a renaming from one defect mended and another made."""

    def __init__(
        self, results: Sequence[Result], known: Sequence[KnownFinding], sides: ComparedFiles, mapped: Mapped
    ) -> None:
        self.results, self.known, self.sides, self.mapped = results, known, sides, mapped
        self.now = _System(sides.head_names, ((result.graph, result.subject) for result in results))
        self.past = _System(sides.base_names or {}, ((entry.graph, entry.subject) for entry in known))
        self.new_names = [frozenset(result.subject) for result in results]
        self.old_names = [frozenset(entry.subject) for entry in known]
        self.news: dict[Key, list[frozenset[str]]] = {}
        self.olds: dict[Key, list[frozenset[str]]] = {}
        for result, names in zip(results, self.new_names, strict=True):
            self.news.setdefault(_kind(result), []).append(names)
        for entry, names in zip(known, self.old_names, strict=True):
            kind = (sides.rule(entry), sides.renames.get(entry.path, entry.path), entry.roles)
            self.olds.setdefault(kind, []).append(names)

    def common(self, new: int, old: int) -> int | None:
        """How many names a result and a known finding share, if they are one finding renamed; else None."""
        before, now = self.old_names[old], self.new_names[new]
        if len(before) != len(now) or before == now:
            return None
        removed, fresh, common = before - now, now - before, len(before & now)
        by_text = self.sides.base is None
        if by_text and (len(removed) != 1 or not common):
            return None
        result, known = self.results[new], self.known[old]
        if self.now.has(removed, known.graph, result.graph) or self.past.has(fresh, result.graph, known.graph):
            return None
        fits = self.all_renamed(_kind(result), *removed, *fresh) if by_text else self.in_place(result, known)
        return common if fits else None

    def all_renamed(self, kind: Key, old: str, new: str) -> bool:
        """Whether all known findings of that kind are about the *old* name, and those of today the same but for it."""
        subjects = self.olds.get(kind, [])
        renamed = Counter(subject - {old} | {new} for subject in subjects if old in subject)
        return renamed.total() == len(subjects) and renamed == Counter(self.news[kind])

    def in_place(self, result: Result, known: KnownFinding) -> bool:
        """Whether the further places of a known finding are further places of the result, moved or edited."""
        places = {(near.location.path, near.location.line) for near in result.related}
        return all(self.mapped(path, line) in places for path, line in known.related)


def _kind(result: Result) -> Key:
    """A group of findings that differ in their names only: same rule, file and roles."""
    return (result.full_id, result.location.path, identity_of(result).roles)


@dataclass(slots=True)
class _System:
    """The names of one side by graph. Findings may be about names that no graph has, as those of parameters."""

    graphs: dict[str, set[str]]
    every: set[str]

    def __init__(self, graphs: Mapping[str, frozenset[str]], subjects: Iterable[tuple[str, tuple[str, ...]]]) -> None:
        self.graphs = {name: set(names) for name, names in graphs.items()}
        for name, subject in subjects:
            self.graphs.setdefault(name, set()).update(subject)
        self.every = set().union(*self.graphs.values())

    def has(self, names: frozenset[str], graph: str, other: str) -> bool:
        """Whether any of the names is in the graph, or in the *other* where there is no such graph, else in any."""
        if not graph:
            return not names.isdisjoint(self.every)
        return not names.isdisjoint(self.graphs.get(graph, self.graphs.get(other, self.every)))
