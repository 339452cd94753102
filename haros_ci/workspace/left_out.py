# SPDX-License-Identifier: Apache-2.0
"""The files that linters say nothing of by default: those that nothing uses, and copies of other projects' single files."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from haros_ci.model.workspace import Workspace
from haros_ci.workspace.products import Products
from haros_ci.workspace.single_copies import SingleCopies
from haros_ci.workspace.unused import Unused


class LeftOut:
    """Both kinds of *workspace*, as ``Judged`` tells of each; *base* is what it was before a change, and *renames* what has moved since."""

    def __init__(
        self,
        workspace: Workspace,
        base: Workspace | None = None,
        renames: Mapping[str, str] | None = None,
        *,
        is_known: bool = True,
    ) -> None:
        used = None if base is None else Unused(base)
        copied = None if base is None else SingleCopies(base)
        self.unused = Unused(workspace, used, renames, is_known=is_known)
        self.copies = SingleCopies(workspace, copied, renames, is_known=is_known)
        self.products = Products(workspace)

    @property
    def found(self) -> tuple[str, ...]:
        """All that were asked about and are of either kind."""
        return tuple(sorted({*self.unused.found, *self.copies.found}))

    def among(self, paths: Collection[str]) -> frozenset[str]:
        """Those of *paths* that are of either kind."""
        copies = self.copies.among(paths)
        return copies | self.unused.among([path for path in paths if path not in copies])
