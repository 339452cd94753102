# SPDX-License-Identifier: Apache-2.0
"""How messages name places and lists."""

from __future__ import annotations

from collections.abc import Sequence

from haros_ci.model.location import Location

#: So many names of one finding are named.
NAMED = 5
#: So many that may be meant by a wrong one are named; of more of them none says more than another.
MEANT = 3
#: So many where a user has to write them.
WRITTEN = 100


def line_of(location: Location) -> str:
    """``path:line`` of *location*, for messages that name a place in another file (a column would be noise there)."""
    return location.path if location.line is None else f"{location.path}:{location.line}"


def listed(names: Sequence[str]) -> str:
    """*names* in words (``a, b and c``), of many the first ones and how many more there are."""
    return _in_words(names, NAMED)


def alternatives(names: Sequence[str]) -> str:
    """*names* of which one is meant, in words (``a, b or c``); "" where there are none, or too many."""
    return " or ".join(part for part in (", ".join(names[:-1]), *names[-1:]) if part) if len(names) <= MEANT else ""


def spelled_out(names: Sequence[str]) -> str:
    """All *names* in words, as a user has to write them: none may hide behind a number. Of more than WRITTEN names only these are named."""
    return _in_words(names, WRITTEN)


def _in_words(names: Sequence[str], most: int) -> str:
    if len(names) > most:
        return f"{', '.join(names[:most])} and {len(names) - most} more"
    return " and ".join(part for part in (", ".join(names[:-1]), *names[-1:]) if part)
