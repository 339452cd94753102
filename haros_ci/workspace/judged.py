# SPDX-License-Identifier: Apache-2.0
"""Files of which linters need say nothing, found out for those that are asked about, and held against the revision before a change."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Iterable, Mapping
from functools import cached_property

from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace


class Judged(ABC):
    """Which files of *workspace* are of one kind, as far as its own text tells; found out for those that are asked about.

    Where a change is examined, a file counts only if it was so *before* the change, too: *renames* maps paths of
    then to those of now. None does where nothing *is_known* of the time before.
    """

    def __init__(
        self,
        workspace: Workspace,
        before: Judged | None = None,
        renames: Mapping[str, str] | None = None,
        *,
        is_known: bool = True,
    ) -> None:
        self._workspace = workspace
        self._is_known = is_known
        self._before = before
        self._olds = {new: old for old, new in (renames or {}).items()}
        self._known: dict[str, bool] = {}

    @property
    def found(self) -> tuple[str, ...]:
        """Those of the kind among all that were asked about."""
        return tuple(sorted(path for path, is_one in self._known.items() if is_one))

    def among(self, paths: Collection[str]) -> frozenset[str]:
        """Those of *paths* that are of the kind."""
        undecided = sorted(set(paths) - self._known.keys())
        files = [self._files[path] for path in undecided if path in self._files] if self._is_known else []
        left = set(self._judge(files)) if files else set()
        if left and self._before is not None:
            olds = {path: self._olds.get(path, path) for path in left}
            known = self._before.among(olds.values())
            left = {path for path in left if olds[path] in known}
        self._known.update((path, path in left) for path in undecided)
        return frozenset(path for path in paths if self._known[path])

    @cached_property
    def _files(self) -> dict[str, SourceFile]:
        return {file.path: file for file in self._workspace.files}

    @abstractmethod
    def _judge(self, files: Collection[SourceFile]) -> Iterable[str]:
        """The paths of those of *files* that are of the kind."""
