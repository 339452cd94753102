# SPDX-License-Identifier: Apache-2.0
"""Names that are nearly the same: a slip of the pen, or another namespace."""

from __future__ import annotations

import re
from collections.abc import Iterable
from difflib import get_close_matches

from haros_ci.model.slips import equally_near

#: Words that distinguish members of a pair: names that differ only in these are meant to differ.
_TWINS = frozenset(
    {
        frozenset(pair)
        for pair in (
            ("left", "right"),
            ("front", "rear"),
            ("front", "back"),
            ("in", "out"),
            ("input", "output"),
            ("low", "high"),
            ("min", "max"),
            ("x", "y"),
            ("x", "z"),
            ("y", "z"),
            ("raw", "rect"),
        )
    }
)

#: Words for the two ends of a connection, which are nearly the same.
_OTHER_ENDS = frozenset(
    {frozenset(("pub", "sub")), frozenset(("publisher", "subscriber")), frozenset(("publisher", "subscription"))}
)
#: So many of the names that are alike are tried.
_TRIED = 3


def is_slip(one: str, other: str) -> bool:
    """Whether two words differ by one slip: a letter too much, too few, wrong, or two swapped; or only in case and ``_``.

    Digits distinguish names, and so do words such as left and right: those are no slips. Words of less than five letters are too short.
    """
    if one == other or min(len(one), len(other)) < 5:
        return False
    if _bare(one) == _bare(other):
        return True
    words, others = one.split("_"), other.split("_")
    if len(words) == len(others):
        differing = [pair for pair in zip(words, others) if pair[0] != pair[1]]
        if any(frozenset(pair) in _TWINS or min(map(len, pair)) < 3 for pair in differing):
            return False
    return is_letter_slip(one.lower(), other.lower())


def is_letter_slip(one: str, other: str) -> bool:
    """Whether two names of any length differ by one letter that is too much, too few or wrong, or by two swapped ones: digits distinguish names."""
    return one != other and _digits(one) == _digits(other) and _one_edit(one, other)


def all_nearest(name: str, names: Iterable[str], cutoff: float = 0.75) -> tuple[str, ...]:
    """Those of *names* that are likely to be meant by *name*, none nearer than another (see ``nearest``); empty if there are none."""
    return equally_near(name, _likely(name, names, cutoff), cutoff)


def nearest(name: str, names: Iterable[str], cutoff: float = 0.75) -> str | None:
    """The one of *names* that is likely to be meant by *name*; None if there is none.

    Names of as many words that differ in a word which is another one (``image_x`` and ``image_id``, ``scan_pub`` and ``scan_sub``), or in a
    digit, are names of other things.
    """
    return next(iter(_likely(name, names, cutoff)), None)


def _likely(name: str, names: Iterable[str], cutoff: float) -> list[str]:
    return [other for other in get_close_matches(name, list(names), _TRIED, cutoff) if not _is_of_another(name, other)]


def _is_of_another(one: str, other: str) -> bool:
    """Whether two names differ in a word that distinguishes them."""
    words, others = ([word for word in name.lower().split("_") if word] for name in (one, other))
    if len(words) != len(others) or len(words) < 2:
        return False
    differing = [pair for pair in zip(words, others) if pair[0] != pair[1]]
    return any(_digits(a) != _digits(b) or _are_two(a, b) for a, b in differing)


def _are_two(one: str, other: str) -> bool:
    """Whether two words are two, and none is a slip or a form of the other."""
    if frozenset((one, other)) in _TWINS | _OTHER_ENDS:
        return True
    if one.startswith(other) or other.startswith(one):
        return False
    if min(len(one), len(other)) < 3:
        return len(one) == len(other) or not _one_edit(one, other)
    return not (_one_edit(one, other) or get_close_matches(one, [other], 1, 0.6))


def is_moved(one: str, other: str) -> bool:
    """Whether two full names are the same but for namespaces that one has and the other lacks: /scan and /robot/scan."""
    short, long = sorted((one.split("/")[1:], other.split("/")[1:]), key=len)
    if len(short) == len(long) or short[-1] != long[-1]:
        return False
    rest = iter(long)
    return all(segment in rest for segment in short)


def may_be(pattern: str, name: str) -> bool:
    """Whether a full name of which parts are not known (``?``) can be *name*; a namespace that is not known can be none."""
    if "?" not in pattern:
        return pattern == name
    parts = re.split(r"(/\?(?=/)|\?)", pattern)
    wild = {"?": ".*", "/?": "(?:/.*)?"}
    return re.fullmatch("".join(wild.get(part) or re.escape(part) for part in parts), name) is not None


def _bare(word: str) -> str:
    return word.replace("_", "").lower()


def _digits(name: str) -> list[str]:
    return [letter for letter in name if letter.isdigit()]


def _one_edit(one: str, other: str) -> bool:
    """Whether Damerau's distance is one, of two that differ."""
    if abs(len(one) - len(other)) > 1:
        return False
    at = next((i for i, (a, b) in enumerate(zip(one, other)) if a != b), min(len(one), len(other)))
    if len(one) == len(other):
        return one[at + 1 :] == other[at + 1 :] or (
            one[at : at + 2] == other[at : at + 2][::-1] and one[at + 2 :] == other[at + 2 :]
        )
    short, long = sorted((one, other), key=len)
    return short[at:] == long[at + 1 :]
