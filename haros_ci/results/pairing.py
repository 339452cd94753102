# SPDX-License-Identifier: Apache-2.0
"""Which result is which known finding: one-to-one, the strictest evidence first."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Container, Iterable, Sequence
from dataclasses import dataclass, field
from operator import itemgetter

from haros_ci.results.assignment import Place, assign
from haros_ci.results.comments import lines_of
from haros_ci.results.fingerprint import EDGE, text_hashes
from haros_ci.results.known import Known, Sides, identity_of
from haros_ci.results.line_map import line_mapper, words
from haros_ci.results.result import Identity, Result

#: Lines that a mapped line may be off.
NEAR = 3
_KINSHIP = 0.6  # of the shorter line's words

#: Feature letters of a key, in the order of _Thing.features:
#: R rule, P path, N file name, L mapped line, S scope, T text of the line, X whole message, M message template,
#: B lines before, A lines after, H shape of the line, E the file's first line, V a metric, U the text is not known.
_LETTERS = "RPNLSTXMBAHEVU"


_Key = tuple[object, ...]


@dataclass(frozen=True, slots=True)
class _Pass:
    """Pairs what agrees in all *letters*. *near* asks for a mapped line at most NEAR away, *gone* that the old file is,
    *scoped* that the scope is not the whole file. *edited* asks that the old text is gone and the new one was not
    there, and where the old line's place is known, for that place: an edited line has not moved, too."""

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
        return "RT" if "T" in self.letters else "RM" if "M" in self.letters else "RPS"


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


@dataclass(frozen=True, slots=True)
class Pair:
    """Result *new* is known finding *old* (positions in the inputs), for the reason *evidence*."""

    new: int
    old: int
    evidence: str


@dataclass(slots=True)
class _Thing:
    """A result or a known finding as the passes see it."""

    index: int
    path: str
    line: int | None  # where it stands in the new file; of a known finding: by line map
    place: Place  # to find the nearest: (line, or an estimate of it; position)
    scope: str
    text: str
    features: tuple[object, ...] = field(default=())


def pair(new: Sequence[Result], known: Sequence[Known], sides: Sides) -> tuple[Pair, ...]:
    """Pair results with known findings. No two pairs share a side; copies of a known finding stay unpaired."""
    matcher = _Matcher(new, known, sides)
    matcher.run(_IN_FILE)
    matcher.run(_MOVED)
    if matcher.follow_renames():
        matcher.run(_IN_FILE)
    matcher.run(_RENAMED)
    return tuple(sorted(matcher.pairs, key=lambda found: found.new))


class _Matcher:
    """What is still unpaired on each side, between passes."""

    def __init__(self, new: Sequence[Result], known: Sequence[Known], sides: Sides) -> None:
        self.sides = sides
        self.known = known
        self.results = new
        self.pairs: list[Pair] = []
        self.maps: dict[str, Callable[[int], int | None] | None] = {}
        self.texts: dict[tuple[bool, str], frozenset[str]] = {}
        self.old_paths = {now: before for before, now in sides.renames.items()}
        rules = {result.full_id for result in new}
        self.old = [self.of_known(i, k) for i, k in enumerate(known) if sides.rule(k) in rules]
        rules = {sides.rule(k) for k in known}
        self.new = [self.of_result(i, result) for i, result in enumerate(new) if result.full_id in rules]

    def of_result(self, index: int, result: Result) -> _Thing:
        seen, line = identity_of(result), result.location.line
        thing = _Thing(index, result.location.path, line, (line or 0, index), seen.scope, seen.text)
        text = seen.text if seen.text or line is None else None
        thing.features = _features(thing, result.full_id, seen, text, result.message, result.value is not None, True)
        return thing

    def of_known(self, index: int, known: Known, path: str | None = None) -> _Thing:
        path = path or self.sides.renames.get(known.path, known.path)
        line = self.mapped(known, path)
        place = (line or known.line or 0, known.occurrence)
        thing = _Thing(index, path, line, place, known.scope, known.text)
        blind = not known.text and known.line is not None
        text = None if blind else known.text
        thing.features = _features(thing, self.sides.rule(known), known, text, known.message, True, blind)
        return thing

    def mapped(self, known: Known, path: str) -> int | None:
        if known.line is None or self.sides.base is None:
            return None
        key = f"{known.path}\0{path}"
        if key not in self.maps:
            old, head = self.sides.base(known.path), self.sides.head(path)
            self.maps[key] = line_mapper(old, head) if old and head else None
        mapper = self.maps[key]
        return mapper(known.line) if mapper else None

    def run(self, passes: Iterable[_Pass]) -> None:
        pools: dict[str, tuple[list[_Thing], list[_Thing]]] = {}
        for step in passes:
            if step.anchor not in pools:
                pools[step.anchor] = _common(self.old, self.new, _key_of(step.anchor))
            old, new = pools[step.anchor]
            key_of = _key_of(step.letters)
            olds = _grouped(old, key_of, {key_of(thing.features) for thing in new})
            if step.conditional:
                olds = {key: fit for key, group in olds.items() if (fit := [t for t in group if self.fits(t, step)])}
            if not olds:
                continue
            news = _grouped(new, key_of, olds)
            shared = list(olds)
            if step.edited:
                news = {key: [thing for thing in news[key] if self.is_fresh(thing)] for key in shared}
                olds = {key: [thing for thing in olds[key] if self.is_gone(thing)] for key in shared}
            taken_old: set[int] = set()
            taken_new: set[int] = set()
            for key in shared:
                here, there = news[key], olds[key]
                limit = NEAR if step.near else None
                for a, b in assign([thing.place for thing in here], [thing.place for thing in there], limit):
                    if step.near and step.edited and not self.akin(there[b], here[a]):
                        continue
                    taken_new.add(here[a].index)
                    taken_old.add(there[b].index)
                    self.pairs.append(Pair(here[a].index, there[b].index, step.evidence))
            if not taken_old:
                continue
            self.old, self.new = _without(self.old, taken_old), _without(self.new, taken_new)
            pools = {key: (_without(o, taken_old), _without(n, taken_new)) for key, (o, n) in pools.items()}

    def fits(self, thing: _Thing, step: _Pass) -> bool:
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
        return not step.gone and self.sides.answered(known.tool, known.path)

    def is_gone(self, thing: _Thing) -> bool:
        """Whether the line of a known finding stands in its file no more: else it was mended where it is."""
        return not thing.text or thing.text not in self.lines(self.sides.head, thing.path, is_head=True)

    def is_fresh(self, thing: _Thing) -> bool:
        """Whether the line of a result was not in the old file: else something else made the result."""
        base = self.sides.base
        if base is None or not thing.text:
            return True
        return thing.text not in self.lines(base, self.old_paths.get(thing.path, thing.path), is_head=False)

    def akin(self, old: _Thing, new: _Thing) -> bool:
        """Whether one line is mostly part of the other, as when an expression was spread over several lines."""
        base, line = self.sides.base, self.known[old.index].line
        if base is None or line is None or new.line is None:
            return True
        here = self.words(base, self.known[old.index].path, line)
        there = self.words(self.sides.head, new.path, new.line)
        least = min(here.total(), there.total())
        return least > 0 and (here & there).total() >= _KINSHIP * least

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


def _features(
    thing: _Thing, rule: str, seen: Identity | Known, text: str | None, message: str, metric: bool, blind: bool
) -> tuple[object, ...]:
    """In the order of _LETTERS; None where a feature is missing or says too little to be evidence."""
    return (
        rule,
        thing.path,
        thing.path.rpartition("/")[2],
        thing.line,
        seen.scope,
        text,
        message or None,
        seen.template,
        seen.before if seen.before != EDGE and seen.before else None,
        seen.after if seen.after != EDGE and seen.after else None,
        seen.shape or None,
        True if seen.before == EDGE else None,
        metric or None,
        blind or None,
    )


def _key_of(letters: str) -> Callable[[_Key], _Key]:
    return itemgetter(*(_LETTERS.index(letter) for letter in letters))


def _common(old: list[_Thing], new: list[_Thing], key_of: Callable[[_Key], _Key]) -> tuple[list[_Thing], list[_Thing]]:
    """Those of each side whose key the other side has too."""
    keys = {key_of(thing.features) for thing in old} & {key_of(thing.features) for thing in new}
    return [t for t in old if key_of(t.features) in keys], [t for t in new if key_of(t.features) in keys]


def _without(things: list[_Thing], taken: Container[int]) -> list[_Thing]:
    return [thing for thing in things if thing.index not in taken]


def _grouped(
    things: Iterable[_Thing], key_of: Callable[[_Key], _Key], wanted: Container[_Key]
) -> dict[_Key, list[_Thing]]:
    """The things by key, for keys that are *wanted* and of which no feature is missing."""
    groups: dict[_Key, list[_Thing]] = {}
    for thing in things:
        key = key_of(thing.features)
        if key in wanted and None not in key:
            groups.setdefault(key, []).append(thing)
    return groups
