# SPDX-License-Identifier: Apache-2.0
"""Which result is which known finding: one-to-one, the strictest evidence first."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

from haros_ci.results.assignment import assign
from haros_ci.results.candidate import Key, MatchCandidate, MatchedPair, features, grouped, picker
from haros_ci.results.comments import lines_of
from haros_ci.results.fingerprint import message_template, quoted_names, text_hashes
from haros_ci.results.known import ComparedFiles, KnownFinding, identity_of
from haros_ci.results.line_map import line_mapper, words
from haros_ci.results.named_defects import OF_MISSING_NAMES, is_other_defect
from haros_ci.results.renaming import RenamingEvidence, pair_partly_mended, pair_renamed
from haros_ci.results.result import Identity, Result

_Seen = TypeVar("_Seen", Identity, KnownFinding)

#: Lines that a mapped line may be off.
NEAR = 3
_KINSHIP = 0.6  # of the shorter line's words
_REWRITTEN = 0.7  # of the longer line's words: with less in common, lines that are about other names are other lines


@dataclass(frozen=True, slots=True)
class _Pass:
    """Pairs what agrees in all *letters*. *near* asks for a mapped line at most NEAR away, *gone* that the old file is,
    *scoped* that the scope is not the whole file. *edited* asks that the old text is gone and the new one was not
    there, and where the old line's place is known, for that place: an edited line has not moved, too. A place alone is no
    evidence: a finding about another name in a line of another shape is another finding."""

    letters: str
    evidence: str
    near: bool = False
    edited: bool = False
    gone: bool = False
    scoped: bool = False

    @property
    def conditional(self) -> bool:
        """Whether more than the key decides which known findings take part."""
        return self.near or self.edited or self.scoped or "P" not in self.letters

    @property
    def anchor(self) -> str:
        """The few letters that tell soonest what cannot be paired."""
        if "W" in self.letters:
            return "RW"
        return "RT" if "T" in self.letters else "RM" if "M" in self.letters else "RPS"


#: For findings that are about ROS names: those say which finding it is, wherever it stands.
_NAMED = (
    _Pass("RWPLST", "same ROS names at its mapped line"),
    _Pass("RWPST", "same ROS names, text and scope"),
    _Pass("RWPT", "same ROS names and text"),
    _Pass("RWPL", "same ROS names at its mapped line; the line was edited"),
    _Pass("RWPS", "same ROS names in the same scope; the line was edited", scoped=True),
    _Pass("RWP", "same ROS names in the same file"),
    _Pass("RWST", "moved: same ROS names, text and scope in another file"),
    _Pass("RWN", "moved: same ROS names in a file of the same name"),
    _Pass("RW", "moved: same ROS names in another file"),
)
_IN_FILE = (
    _Pass("RPLSTX", "same text at its mapped line"),
    _Pass("RPLSTM", "same text at its mapped line"),
    _Pass("RPLST", "same text at its mapped line"),
    _Pass("RPSTXBA", "same text and scope"),
    _Pass("RPSTMBA", "same text and scope"),
    _Pass("RPSTMB", "same text and scope"),
    _Pass("RPSTMA", "same text and scope"),
    _Pass("RPSTX", "same text and scope"),
    _Pass("RPSTM", "same text and scope"),
    _Pass("RPSTB", "same text and scope"),
    _Pass("RPSTA", "same text and scope"),
    _Pass("RPST", "same text and scope", scoped=True),
    _Pass("RPLTM", "same text at its mapped line, in another scope"),
    _Pass("RPLT", "same text at its mapped line, in another scope"),
    _Pass("RPTMBA", "same text between the same lines"),
    _Pass("RPTMB", "same text after the same lines"),
    _Pass("RPTMA", "same text before the same lines"),
    _Pass("RPTB", "same text after the same lines"),
    _Pass("RPTA", "same text before the same lines"),
    _Pass("RPT", "same text near its mapped line", near=True),
    _Pass("RPSME", "same message on the file's first line"),
    _Pass("RPSMBA", "same message between the same lines; the line was edited", edited=True),
    _Pass("RPSML", "same message at its mapped line; the line was edited", edited=True),
    _Pass("RPSMB", "same message after the same lines; the line was edited", edited=True),
    _Pass("RPSMA", "same message before the same lines; the line was edited", edited=True),
    _Pass("RPSM", "same message near its mapped line; the line was edited", near=True, edited=True),
    _Pass("RPSMH", "same message and same shape of the line; names were edited", edited=True, scoped=True),
    _Pass("RPSV", "same metric of the same scope; the line was edited", edited=True),
    _Pass("RPMBA", "same message between the same lines; scope and line were edited", edited=True),
    _Pass("RPML", "same message at its mapped line; scope and line were edited", edited=True),
    _Pass("RPMB", "same message after the same lines; scope and line were edited", edited=True),
    _Pass("RPMA", "same message before the same lines; scope and line were edited", edited=True),
    _Pass("RPM", "same message near its mapped line; scope and line were edited", near=True, edited=True),
    _Pass("RPSH", "same rule and same shape of the line; names were edited", edited=True, scoped=True),
    _Pass("RPSBA", "same rule between the same lines; the line was edited", edited=True),
    _Pass("RPSL", "same rule at its mapped line; the line was edited", edited=True),
    _Pass("RPSMU", "same message in the same scope; the baseline does not tell the text"),
    _Pass("RPMU", "same message in the same file; the baseline does not tell the text"),
)
_MOVED = (
    _Pass("RSTMBA", "moved: same text and scope in another file"),
    _Pass("RSTMN", "moved: same text and scope in another file", gone=True),
    _Pass("RSTM", "moved: same text and scope in another file", scoped=True),
    _Pass("RST", "moved: same text and scope in another file", scoped=True),
    _Pass("RTMBA", "moved: same text between the same lines in another file"),
    _Pass("RTMB", "moved: same text after the same lines in another file", gone=True),
    _Pass("RTMA", "moved: same text before the same lines in another file", gone=True),
)
_RENAMED = (_Pass("RNSM", "same message in a file of the same name; the old file is gone", gone=True),)


def pair(new: Sequence[Result], known: Sequence[KnownFinding], sides: ComparedFiles) -> tuple[MatchedPair, ...]:
    """Pair results with known findings. No two pairs share a side; copies of a known finding stay unpaired."""
    matcher = _Matcher(new, known, sides)
    matcher.run_named()
    matcher.run(_IN_FILE)
    matcher.run(_MOVED)
    if matcher.follow_renames():
        matcher.run(_IN_FILE)
    matcher.run(_RENAMED)
    return tuple(sorted(matcher.pairs, key=lambda found: found.new))


class _Matcher:
    """What is still unpaired on each side, between passes."""

    def __init__(self, new: Sequence[Result], known: Sequence[KnownFinding], sides: ComparedFiles) -> None:
        self.sides = sides
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
        self.run(_NAMED)
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

    def run(self, passes: Iterable[_Pass]) -> None:
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
        self, step: _Pass, olds: Mapping[Key, Sequence[MatchCandidate]], news: Mapping[Key, Sequence[MatchCandidate]]
    ) -> Iterator[MatchedPair]:
        """What one pass pairs, of findings that have the same features."""
        limit = NEAR if step.near else None
        for key, there in olds.items():
            here = news[key]
            if step.edited:
                here, there = list(filter(self.is_fresh, here)), list(filter(self.is_gone, there))
            for a, b in assign([thing.place for thing in here], [thing.place for thing in there], limit):
                if not step.edited or self.is_edited(step, there[b], here[a]):
                    yield MatchedPair(here[a].index, there[b].index, step.evidence)

    def is_edited(self, step: _Pass, old: MatchCandidate, new: MatchCandidate) -> bool:
        """Whether the line of *new* may be that of *old*, edited."""
        return (
            (not step.near or self.akin(old, new)) and not self.is_rewritten(old, new) and not self.is_other(old, new)
        )

    def is_other(self, old: MatchCandidate, new: MatchCandidate) -> bool:
        """Whether the names that the two are about are their defects, and are others."""
        known, result = self.known[old.index], self.results[new.index]
        base = None if self.sides.base is None else self.sides.base(known.path)
        return is_other_defect(result.full_id, known.message, result.message, base, lambda: self.sides.head(new.path))

    def fits(self, thing: MatchCandidate, step: _Pass) -> bool:
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
