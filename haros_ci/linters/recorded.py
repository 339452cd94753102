# SPDX-License-Identifier: Apache-2.0
"""What tools have said on other machines: it stands in for the tools and for the cache."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from haros_ci.linters.linter import Linter, LintOptions, Program
from haros_ci.linters.work import Work
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.results.result import Run

#: A sentence, and the paths that it leaves without an answer.
Failure = tuple[str, tuple[str, ...]]


class Unanswered(Exception):
    """Nobody has answered for what *tool* was to analyse: the file *path*, or everything."""

    def __init__(self, tool: str, path: str = "") -> None:
        super().__init__(tool, path)
        self.tool, self.path = tool, path


@dataclass(frozen=True, slots=True)
class Recorded:
    """Answers and failures by tool and cache key; ``versions`` and ``fingerprints`` by tool, None for one that was missing.

    *errors* say why a plug-in's adapter could not be used.
    """

    versions: Mapping[str, str | None]
    fingerprints: Mapping[str, str]
    answers: Mapping[tuple[str, str], object]
    failures: Mapping[tuple[str, str], tuple[Failure, ...]]
    errors: Mapping[str, str]

    def program(self, linter: Linter, options: LintOptions) -> Program | None:
        if linter.NAME not in self.versions:
            raise Unanswered(linter.NAME)
        if linter.NAME in self.errors:
            raise ValueError(self.errors[linter.NAME])
        version = self.versions[linter.NAME]
        return None if version is None else Program((), version)

    def fingerprint(self, linter: Linter, workspace: Workspace, options: LintOptions) -> str:
        return self.fingerprints.get(linter.NAME, "")

    def get(self, group: str, path: str, key: str) -> object | None:
        return self.answers.get((group, key))

    def settle(self, works: Iterable[Work]) -> None:
        """Say why units have no answer. Raises Unanswered where that is not known."""
        for work in works:
            failures: dict[Failure, None] = {}
            for unit in work.missing:
                found = self.failures.get((work.linter.NAME, work.keys[unit.file.path]))
                if not found:
                    raise Unanswered(work.linter.NAME, unit.file.path)
                failures.update(dict.fromkeys(found))
            for message, paths in failures:
                work.fail(message, paths)


@dataclass(frozen=True, slots=True)
class Testimony:
    """What other machines have found out of one revision: what the tools say, and runs on the whole of it by name.

    *confined* is how linters were confined there (results/confined.py).
    """

    lint: Recorded
    wholes: Mapping[str, Run]
    confined: frozenset[str]

    def whole(self, name: str) -> Run:
        """Raises Unanswered if nobody has made it."""
        if name not in self.wholes:
            raise Unanswered(name)
        return self.wholes[name]
