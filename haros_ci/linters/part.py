# SPDX-License-Identifier: Apache-2.0
"""Some of the units of a run, answered for here: what another machine needs to know of them."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from haros_ci.linters.linter import Linter, LintOptions, Program
from haros_ci.linters.run import Progress, complete
from haros_ci.linters.work import Digests, InstalledTools, Work
from haros_ci.model.workspace import Store, Workspace
from haros_ci.records import dataclass
from haros_ci.results.result import Run


@dataclass(frozen=True, slots=True)
class Answered:
    """A tool's answer for one unit, as the cache has it; *seconds* of CPU time, None if it was known already."""

    tool: str
    path: str
    key: str
    seconds: float | None
    value: object


class Noted(InstalledTools):
    """The tools of this machine, and which of them were asked for."""

    def __init__(self) -> None:
        self.versions: dict[str, str | None] = {}
        self.fingerprints: dict[str, str] = {}
        self.errors: dict[str, str] = {}

    def program(self, linter: Linter, options: LintOptions) -> Program | None:
        try:
            found = super().program(linter, options)
        except ValueError as err:  # of a plug-in's adapter
            self.versions[linter.NAME], self.errors[linter.NAME] = None, str(err)
            raise
        self.versions[linter.NAME] = None if found is None else found.version
        return found

    def fingerprint(self, linter: Linter, workspace: Workspace, options: LintOptions) -> str:
        try:
            found = self.fingerprints[linter.NAME] = super().fingerprint(linter, workspace, options)
        except ValueError as err:
            self.errors[linter.NAME] = str(err)
            raise
        return found


class _Noting:
    """A store that keeps what passes through it."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self.values: dict[tuple[str, str], object] = {}

    def get(self, group: str, path: str, key: str) -> object | None:
        value = self._store.get(group, path, key)
        if value is not None:
            self.values[group, key] = value
        return value

    def put(self, group: str, path: str, key: str, value: object) -> None:
        self.values[group, key] = value
        self._store.put(group, path, key, value)

    def get_text(self, group: str, path: str, key: str) -> str | None:
        return self._store.get_text(group, path, key)

    def put_text(self, group: str, path: str, key: str, text: str) -> None:
        self._store.put_text(group, path, key, text)


def answers(
    works: list[Work | Run],
    keys: Collection[tuple[str, str]],
    workspace: Workspace,
    options: LintOptions,
    store: Store,
    digests: Digests,
    progress: Progress | None = None,
) -> Iterator[Answered]:
    """The answers for those units of *works* whose tool and key are among *keys*, all rules; failures are left in the works."""
    noting = _Noting(store)
    mine = [work for work in works if isinstance(work, Work)]
    for work in mine:
        name = work.linter.NAME
        work.units = tuple(unit for unit in work.units if (name, work.keys[unit.file.path]) in keys)
    complete(mine, workspace, options, noting, lambda tool, rule, path: True, digests, progress)
    for work in mine:
        name = work.linter.NAME
        for unit in work.units:
            path, key = unit.file.path, work.keys[unit.file.path]
            if path in work.answered and path.isprintable():
                yield Answered(name, path, key, work.seconds.get(path), noting.values[name, key])
