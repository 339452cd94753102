# SPDX-License-Identifier: Apache-2.0
"""Which result is which known finding: one-to-one, the strictest evidence first."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TypeVar

from haros_ci.results.assignment import assign
from haros_ci.results.candidate import Key, MatchCandidate, MatchedPair, features, grouped, picker
from haros_ci.results.comments import lines_of
from haros_ci.results.fingerprint import message_template, quoted_names, text_hashes
from haros_ci.results.known import ComparedFiles, KnownFinding, identity_of
from haros_ci.results.line_map import line_mapper, words
from haros_ci.results.moved import MovedCode
from haros_ci.results.named_defects import OF_MISSING_NAMES, is_other_defect
from haros_ci.results.passes import IN_FILE, MOVED, NAMED, NEAR, RENAMED, MatchPass
from haros_ci.results.renaming import RenamingEvidence, pair_partly_mended, pair_renamed
from haros_ci.results.result import Identity, Result

_Seen = TypeVar("_Seen", Identity, KnownFinding)

_KINSHIP = 0.6  # of the shorter line's words
_REWRITTEN = 0.7  # of the longer line's words: with less in common, lines that are about other names are other lines


def pair(new: Sequence[Result], known: Sequence[KnownFinding], sides: ComparedFiles) -> tuple[MatchedPair, ...]:
    """Pair results with known findings. No two pairs share a side; copies of a known finding stay unpaired."""
    matcher = _Matcher(new, known, sides)
    matcher.run_named()
    matcher.run(IN_FILE)
    matcher.run(MOVED)
    if matcher.follow_renames():
        matcher.run(IN_FILE)
    matcher.run(RENAMED)
    return tuple(sorted(matcher.pairs, key=lambda found: found.new))


class _Matcher:
    """What is still unpaired on each side, between passes."""

    def __init__(self, new: Sequence[Result], known: Sequence[KnownFinding], sides: ComparedFiles) -> None:
        self.sides = sides
        self.moves = MovedCode(sides)
        self.known = known
        self.results = new
        self.pairs: list[MatchedPair] = []
        self.maps: dict[str, Callable[[int], int | None] | None] = {}
        self.texts: dict[tuple[bool, str], frozenset[str]] = {}
        self.old_paths = {now: before for before, now in sides.renames.items()}
        rules = {result.full_id for result in new}
        self.old = [self.of_known(i, k) for i, k in enumerate(known) if sides.rule(k) in rules]
        rules = {sides.rule(k) for k in known}
        self.new = [self.of_result(i, result) for i, result in enumerate(new) if result.full_id in rules]

    def of_result(self, index: int, result: Result) -> MatchCandidate:
        seen, line = identity_of(result), result.location.line
        thing = MatchCandidate(index, result.location.path, line, (line or 0, index), seen.scope, seen.text, seen.names)
        text = seen.text if seen.text or line is None else None
        thing.features = features(
            thing,
            result.full_id,
            self.named(seen, result.full_id, result.message),
            text,
            result.message,
            result.value is not None,
            True,
        )
        return thing

    def of_known(self, index: int, known: KnownFinding, path: str | None = None) -> MatchCandidate:
        path = path or self.sides.renames.get(known.path, known.path)
        line = self.mapped(known.line, known.path, path)
        place = (line or known.line or 0, known.occurrence)
        thing = MatchCandidate(index, path, line, place, known.scope, known.text, known.names)
        blind = not known.text and known.line is not None
        text = None if blind else known.text
        rule = self.sides.rule(known)
        seen = self.named(known, rule, known.message)
        thing.features = features(thing, rule, seen, text, known.message, True, blind)
        return thing

    def named(self, seen: _Seen, rule: str, message: str) -> _Seen:
        """*seen* with the names in its template if they are the defect, and known on both sides."""
        if self.sides.base is None or rule not in OF_MISSING_NAMES:
            return seen
        return replace(seen, template=message_template(message.partition("; ")[0], keep_names=True))

    def mapped(self, line: int | None, old_path: str, path: str) -> int | None:
        if line is None or self.sides.base is None:
            return None
        key = f"{old_path}\0{path}"
        if key not in self.maps:
            old, head = self.sides.base(old_path), self.sides.head(path)
            self.maps[key] = line_mapper(old, head) if old and head else None
        mapper = self.maps[key]
        return mapper(line) if mapper else None

    def place_of(self, path: str, line: int) -> tuple[str, int] | None:
        """Where a line of the past stands now."""
        now = self.sides.renames.get(path, path)
        place = self.mapped(line, path, now)
        return None if place is None else (now, place)

    def run_named(self) -> None:
        """Pair the findings about ROS names. A known one that has them is left to no pass that looks at lines: another
        defect in its line is another finding."""
        if not any(thing.names for thing in self.old):
            return
        self.run(NAMED)
        self.take(pair_partly_mended(self.new, self.old, self.results, self.known))
        evidence = RenamingEvidence(self.results, self.known, self.sides, self.place_of)
        self.take(pair_renamed(self.sides, self.new, self.old, evidence))
        self.old = [thing for thing in self.old if not thing.names]

    def take(self, found: Iterable[MatchedPair]) -> None:
        """Pairs that another than the passes found."""
        pairs = tuple(found)
        self.pairs += pairs
        self.new = _without(self.new, {pair.new for pair in pairs})
        self.old = _without(self.old, {pair.old for pair in pairs})

    def run(self, passes: Iterable[MatchPass]) -> None:
        pools: dict[str, tuple[list[MatchCandidate], list[MatchCandidate]]] = {}
        for step in passes:
            if step.anchor not in pools:
                pools[step.anchor] = _common(self.old, self.new, picker(step.anchor))
            old, new = pools[step.anchor]
            pick = picker(step.letters)
            olds = grouped(old, pick, {pick(thing.features) for thing in new})
            if step.conditional:
                olds = {key: fit for key, group in olds.items() if (fit := [t for t in group if self.fits(t, step)])}
            if not olds:
                continue
            pairs = tuple(self.of_pass(step, olds, grouped(new, pick, olds)))
            if not pairs:
                continue
            self.pairs += pairs
            taken_old, taken_new = {pair.old for pair in pairs}, {pair.new for pair in pairs}
            self.old, self.new = _without(self.old, taken_old), _without(self.new, taken_new)
            pools = {key: (_without(o, taken_old), _without(n, taken_new)) for key, (o, n) in pools.items()}

    def of_pass(
        self,
        step: MatchPass,
        olds: Mapping[Key, Sequence[MatchCandidate]],
        news: Mapping[Key, Sequence[MatchCandidate]],
    ) -> Iterator[MatchedPair]:
        """What one pass pairs, of findings that have the same features."""
        limit = NEAR if step.near else None
        for key, there in olds.items():
            here = news[key]
            if step.edited:
                here, there = list(filter(self.is_fresh, here)), list(filter(self.is_gone, there))
            for a, b in assign([thing.place for thing in here], [thing.place for thing in there], limit):
                if self.is_evident(step, there[b], here[a]):
                    yield MatchedPair(here[a].index, there[b].index, step.evidence)

    def is_evident(self, step: MatchPass, old: MatchCandidate, new: MatchCandidate) -> bool:
        """Whether the texts of both sides bear out what *step* takes the two for: an edited line, or moved code."""
        if "P" not in step.letters and old.path != new.path:
            known = self.known[old.index]
            at, place = (known.path, known.line), (new.path, new.line)
            if old.names and known.graph and known.graph == self.results[new.index].graph:
                return True  # the same entities of the same system: wherever it is reported, it is the same
            return self.moves.is_move(at, place, old.scope, with_code="T" in step.letters and not old.names)
        return not step.edited or self.is_edited(step, old, new)

    def is_edited(self, step: MatchPass, old: MatchCandidate, new: MatchCandidate) -> bool:
        """Whether the line of *new* may be that of *old*, edited."""
        return (
            (not step.near or self.akin(old, new)) and not self.is_rewritten(old, new) and not self.is_other(old, new)
        )

    def is_other(self, old: MatchCandidate, new: MatchCandidate) -> bool:
        """Whether the names that the two are about are their defects, and are others."""
        known, result = self.known[old.index], self.results[new.index]
        base = None if self.sides.base is None else self.sides.base(known.path)
        return is_other_defect(result.full_id, known.message, result.message, base, lambda: self.sides.head(new.path))

    def fits(self, thing: MatchCandidate, step: MatchPass) -> bool:
        """Whether a known finding may take part in a pass."""
        if (step.near and thing.line is None) or (step.scoped and not thing.scope):
            return False
        if step.edited and thing.line is not None and not (step.near or "L" in step.letters or "V" in step.letters):
            return False
        if "P" in step.letters:
            return True
        known = self.known[thing.index]
        if not self.sides.exists(thing.path):
            return True
        return not step.gone and self.sides.answered(known)

    def is_gone(self, thing: MatchCandidate) -> bool:
        """Whether the line of a known finding stands in its file no more: else it was mended where it is."""
        return not thing.text or thing.text not in self.lines(self.sides.head, thing.path, is_head=True)

    def is_fresh(self, thing: MatchCandidate) -> bool:
        """Whether the line of a result was not in the old file: else something else made the result."""
        base = self.sides.base
        if base is None or not thing.text:
            return True
        return thing.text not in self.lines(base, self.old_paths.get(thing.path, thing.path), is_head=False)

    def akin(self, old: MatchCandidate, new: MatchCandidate) -> bool:
        """Whether one line is mostly part of the other, as when an expression was spread over several lines."""
        base, line = self.sides.base, self.known[old.index].line
        if base is None or line is None or new.line is None:
            return True
        here = self.words(base, self.known[old.index].path, line)
        there = self.words(self.sides.head, new.path, new.line)
        least = min(here.total(), there.total())
        return least > 0 and (here & there).total() >= _KINSHIP * least

    def is_rewritten(self, old: MatchCandidate, new: MatchCandidate) -> bool:
        """Whether the two are about other names, in lines that have neither their shape nor most of their other words in common."""
        known, result = self.known[old.index], self.results[new.index]
        before, after = quoted_names(known.message), quoted_names(result.message)
        if not before or not after or set(before) & set(after) or result.value is not None:
            return False
        if known.shape and known.shape == identity_of(result).shape:
            return False
        if self.sides.base is None or known.line is None or new.line is None:
            return True
        there = self.words(self.sides.base, known.path, known.line)
        here = self.words(self.sides.head, new.path, new.line)
        for word in words(" ".join((*before, *after))):
            del there[word], here[word]
        return (here & there).total() < _REWRITTEN * max(here.total(), there.total(), 1)

    def words(self, text: Callable[[str], str], path: str, line: int) -> Counter[str]:
        lines = lines_of(text(path))
        return words(lines[line - 1]) if line <= len(lines) else Counter()

    def lines(self, text: Callable[[str], str], path: str, *, is_head: bool) -> frozenset[str]:
        key = (is_head, path)
        if key not in self.texts:
            self.texts[key] = text_hashes(text(path), path, self.sides.language(path))
        return self.texts[key]

    def follow_renames(self) -> bool:
        """Let the pairs found so far tell where files that are gone went; True if that places more findings."""
        votes: dict[str, Counter[str]] = {}
        for found in self.pairs:
            old, new = self.known[found.old].path, self.results[found.new].location.path
            if old != new and not self.sides.exists(old) and old not in self.sides.renames:
                votes.setdefault(old, Counter())[new] += 1
        moved = {old: min(count.items(), key=lambda vote: (-vote[1], vote[0]))[0] for old, count in votes.items()}
        self.old = [
            self.of_known(thing.index, self.known[thing.index], moved.get(self.known[thing.index].path))
            for thing in self.old
        ]
        return bool(moved)


def _common(
    old: list[MatchCandidate], new: list[MatchCandidate], pick: Callable[[Key], Key]
) -> tuple[list[MatchCandidate], list[MatchCandidate]]:
    """Those of each side whose key the other side has too, and that lack no part of it."""
    keys = {pick(thing.features) for thing in old} & {pick(thing.features) for thing in new}
    keys = {key for key in keys if None not in key}
    return [t for t in old if pick(t.features) in keys], [t for t in new if pick(t.features) in keys]


def _without(things: list[MatchCandidate], taken: Container[int]) -> list[MatchCandidate]:
    return [thing for thing in things if thing.index not in taken]
