# SPDX-License-Identifier: Apache-2.0
"""What checks have said."""

from __future__ import annotations

from typing import NamedTuple

from haros_ci.records import dataclass
from haros_ci.results.result import Graph, Notification, Result


class Unseen(NamedTuple):
    """The ids of checks that saw nothing of C++, and of those that saw programs, but of texts the words and includes alone, or what is noted.

    *words* are what these looked up in texts, *read* are the paths of the files that they read.
    """

    programs: frozenset[str] = frozenset()
    texts: frozenset[str] = frozenset()
    words: frozenset[str] = frozenset()
    read: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class Checked:
    """All that the checks say: sorted results, the graphs that they traverse, checks that failed, and what they did not see (``checking.unseen``)."""

    results: tuple[Result, ...]
    graphs: tuple[Graph, ...] = ()
    notifications: tuple[Notification, ...] = ()
    unseen: Unseen = Unseen()
