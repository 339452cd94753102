# SPDX-License-Identifier: Apache-2.0
"""Which file is meant by a path that is not there: one of its name elsewhere first, then by its name, never by its directory alone."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable
from difflib import SequenceMatcher
from functools import lru_cache

from haros_ci.model.slips import NEAR
from haros_ci.regex import regex

#: How alike two names are at least, and how much of the longer one the shorter one is where its words are among the other's.
_ALIKE = 0.8
_PART = 0.5
#: Letters of a word that means something.
_WORD = 3
_LONGEST = 200
#: So many are found: one more than a message names.
MOST = 4
#: So much less alike another path is that leads to a file as near as the nearest one.
_PLACES = 0.05
#: The rank of names whose words are all among the words of the other one, and how much less alike one of them is that is as near.
_OF_PARTS = 4
_WORDS_MORE = 0.15
#: Names whose parts are remembered: many that are not there are each held against the same that are.
_NAMES = 1 << 15
_LAUNCH = regex(r"[._]launch(?:\.\w+)?$")
#: Words of which one is not meant by the other.
_APART = ({"left", "right"}, {"front", "rear"}, {"front", "back"}, {"upper", "lower"}, {"min", "max"})


def similar_files(expected: str, paths: Iterable[str], owner: str = "", count: int = MOST) -> tuple[str, ...]:
    """Up to *count* of *paths* that may be meant by *expected* and of which none is nearer than another, the likeliest first; empty where all seem to be other files.

    *owner* is the package that has them: its name may stand before that of a file.
    """
    base = posixpath.basename(expected)
    stem, kind = _stem(base), _kind(base)
    if not stem or len(base) > _LONGEST:
        return ()
    ranked: list[tuple[int, float, str]] = []
    for path in paths:
        other = posixpath.basename(path)
        if path != expected and len(other) <= _LONGEST and (other == base or _kind(other) == kind):
            rank = _rank(base, stem, other, _stem(other), owner)
            if rank is not None:
                ranked.append((rank[0], -rank[1], path))
    ranked.sort()
    best = [item for item in ranked[: 4 * count + 20] if _is_as_near(item, ranked[0])]
    by_path = sorted((rank, less, -_ratio(expected, path), path) for rank, less, path in best)
    return tuple(path for _, _, less, path in by_path if less < by_path[0][2] + _PLACES)[:count]


def similar_names(expected: str, names: Iterable[str], owner: str = "", count: int = MOST) -> tuple[str, ...]:
    """Up to *count* of *names*, of programs and classes, that may be meant by *expected* and are equally near; the part behind a dot has little weight."""
    stem = _stem(expected)
    if not stem or len(expected) > _LONGEST:
        return ()
    ranked = []
    for name in names:
        rank = _rank(expected, stem, name, _stem(name), owner) if name != expected and len(name) <= _LONGEST else None
        if rank is not None:
            ranked.append((rank[0], -rank[1], name))
    ranked.sort()
    return tuple(item[2] for item in ranked[:count] if _is_as_near(item, ranked[0]))


def _is_as_near(item: tuple[int, float, str], best: tuple[int, float, str]) -> bool:
    """Whether what is ranked is not less like the expected name than the *best* is; of longer names none is nearer for having fewer words more."""
    return item[0] == best[0] and item[1] < best[1] + (_WORDS_MORE if best[0] == _OF_PARTS else NEAR)


def _rank(base: str, stem: str, other: str, name: str, owner: str) -> tuple[int, float] | None:
    """How near a file's name is, 0 for the same one; None for another one."""
    if other == base:
        return 0, 1.0
    plain = _squeezed(name)
    if _squeezed(stem) == plain or _squeezed(base) == _squeezed(other):
        return 1, float(_squeezed(other) == _squeezed(base))
    if owner and plain in (_squeezed(owner + stem), _squeezed(stem + owner)):
        return 2, 1.0
    if owner and plain == _squeezed(owner) and set(_words(stem)) <= set(_words(owner)):
        return 2, 0.5
    if _numbers(stem) != _numbers(name):
        return None
    words, others = _words(stem), _words(name)
    left, right = set(words) - set(others), set(others) - set(words)
    if any(left & pair and right & pair for pair in _APART):
        return None
    if sorted(words) == sorted(others):  # the same words in another order
        return 2, _ratio(stem.lower(), name.lower())
    ratio = _ratio(stem.lower(), name.lower())
    if ratio >= _ALIKE:
        return (3, ratio) if _are_slips(left, right) else None
    is_part = (not left or not right) and min(len(stem), len(name)) >= _PART * max(len(stem), len(name))
    return (_OF_PARTS, ratio) if is_part else None


def _are_slips(left: set[str], right: set[str]) -> bool:
    """Whether every word of one name that the other lacks is like one of the other's: ``vel`` of ``start_vel`` is no slip of ``mode``."""
    if not left or not right:
        return True
    return all(max(_ratio(word, other) for other in right) >= _PART for word in left if len(word) >= _WORD)


def _ratio(one: str, other: str) -> float:
    if 2 * min(len(one), len(other)) < _PART * (len(one) + len(other)):
        return 0.0
    matcher = SequenceMatcher(None, one, other)
    return matcher.ratio() if matcher.quick_ratio() >= _PART else 0.0


@lru_cache(_NAMES)
def _stem(base: str) -> str:
    return re.sub(r"_launch$", "", base.lstrip(".").partition(".")[0])


@lru_cache(_NAMES)
def _kind(base: str) -> str:
    return "launch" if _LAUNCH.search(base) else posixpath.splitext(base)[1].lower()


@lru_cache(_NAMES)
def _words(name: str) -> tuple[str, ...]:
    return tuple(word.lower() for word in re.split(r"[^A-Za-z0-9]+|(?<=[a-z])(?=[A-Z])", name) if word)


@lru_cache(_NAMES)
def _numbers(name: str) -> tuple[str, ...]:
    return tuple(re.findall(r"\d+", name))


@lru_cache(_NAMES)
def _squeezed(name: str) -> str:
    return re.sub(r"[-_ .]", "", name).lower()
