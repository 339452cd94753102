# SPDX-License-Identifier: Apache-2.0
"""Results and known findings as the matcher's passes see them: features that a key picks by letter."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable
from operator import itemgetter

from haros_ci.records import dataclass, field
from haros_ci.results.assignment import Place
from haros_ci.results.fingerprint import EDGE
from haros_ci.results.known import KnownFinding
from haros_ci.results.result import Identity

#: Feature letters of a key, in the order of Candidate.features:
#: R rule, P path, N file name, L mapped line, S scope, T text of the line, X whole message, M message template,
#: B lines before, A lines after, H shape of the line, E the file's first line, V a metric, U the text is not known,
#: W the ROS names it is about, K the roles of what they name.
LETTERS = "RPNLSTXMBAHEVUWK"

Key = tuple[object, ...]


@dataclass(frozen=True, slots=True)
class MatchedPair:
    """Result *new* is known finding *old* (positions in the inputs), for the reason *evidence*."""

    new: int
    old: int
    evidence: str


@dataclass(slots=True)
class MatchCandidate:
    """A result or a known finding as the passes see it; *index* is its position in the input."""

    index: int
    path: str
    line: int | None  # where it stands in the new file; of a known finding: by line map
    place: Place  # to find the nearest: (line, or an estimate of it; position)
    scope: str
    text: str
    names: str
    features: Key = field(default=())


def features(
    thing: MatchCandidate,
    rule: str,
    seen: Identity | KnownFinding,
    text: str | None,
    message: str,
    metric: bool,
    blind: bool,
) -> Key:
    """In the order of LETTERS; None where a feature is missing or says too little to be evidence."""
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
        seen.names or None,
        seen.roles or None,
    )


def picker(letters: str) -> Callable[[Key], Key]:
    """What picks the key of those letters from features."""
    return itemgetter(*(LETTERS.index(letter) for letter in letters))


def grouped(
    things: Iterable[MatchCandidate], pick: Callable[[Key], Key], requested: Container[Key]
) -> dict[Key, list[MatchCandidate]]:
    """The candidates by key, for the *requested* keys of which every feature is known."""
    groups: dict[Key, list[MatchCandidate]] = {}
    for thing in things:
        key = pick(thing.features)
        if key in requested and None not in key:
            groups.setdefault(key, []).append(thing)
    return groups
