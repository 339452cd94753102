# SPDX-License-Identifier: Apache-2.0
"""What one shard has found, before any of it is selected, suppressed or compared."""

from __future__ import annotations

from collections.abc import Mapping

from haros_ci.records import dataclass
from haros_ci.results.result import Run

#: The revision under analysis and the one that it is compared with.
HEAD, BASE = "head", "base"
SIDES = (HEAD, BASE)


class ShardError(Exception):
    """Shards that cannot be joined: *message* says which and why, *help* what to do."""

    def __init__(self, message: str, *, help: str = "") -> None:
        super().__init__(message)
        self.message, self.help = message, help


@dataclass(frozen=True, slots=True)
class Had:
    """A tool as the shard had it for one *side*; *version* is None if it was missing, *fingerprint* that of linters/linter.py.

    *error* is why a plug-in's adapter could not be used.
    """

    tool: str
    side: str
    version: str | None
    fingerprint: str
    error: str = ""


@dataclass(frozen=True, slots=True)
class RecordedAnswer:
    """A tool's answer for one unit, as JSON text (linters/rows.py); *cost* in CPU microseconds, None if it is not known."""

    tool: str
    path: str
    key: str
    cost: int | None
    value: str


@dataclass(frozen=True, slots=True)
class Failed:
    """What failed: a sentence, the paths that it leaves without an answer, and the keys of those units."""

    tool: str
    message: str
    paths: tuple[str, ...]
    keys: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class WorkspaceRun:
    """Work that is done once for the whole workspace: the run that came of it, on one *side*."""

    name: str
    side: str
    cost: int | None
    run: Run


@dataclass(frozen=True, slots=True)
class Header:
    """Who says it of what. All but *number* and *confined* is equal in shards that belong together.

    *workspace* is a digest of the analysed content, *base* the commit that it is compared with, *settings* a digest of each
    setting that analysis depends on, *plan* a digest of who does what. *confined* is how linters were confined on that
    machine (results/confined.py).
    """

    version: str
    number: int
    of: int
    workspace: str
    base: str | None
    settings: Mapping[str, str]
    tools: tuple[Had, ...]
    plan: str
    confined: str


@dataclass(frozen=True, slots=True)
class Shard:
    """One shard file; *name* is how the user calls it."""

    header: Header
    answers: tuple[RecordedAnswer, ...] = ()
    failures: tuple[Failed, ...] = ()
    wholes: tuple[WorkspaceRun, ...] = ()
    name: str = ""
