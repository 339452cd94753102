# SPDX-License-Identifier: Apache-2.0
"""What a run looked at, and what it did not."""

from __future__ import annotations

from collections.abc import Collection

from haros_ci.model.workspace import Workspace
from haros_ci.results.confined import sentence
from haros_ci.results.result import Coverage


def coverage(workspace: Workspace, ways: Collection[str] = ()) -> Coverage:
    """What was looked at, and in whole sentences what was not; *ways* are those in which linters were confined."""
    unseen = []
    if not workspace.packages:
        unseen.append("No package.xml was found: files are analysed one by one, nothing is known of packages.")
    if (count := len(workspace.problems) + len(workspace.hiding.unread)) == 1:
        unseen.append("1 input could not be read as it stands.")
    elif count:
        unseen.append(f"{count} inputs could not be read as they stand.")
    return Coverage(
        packages=len(workspace.packages),
        files=len(workspace.files),
        lines=sum(file.lines for file in workspace.files if file.language in ("cpp", "python")),
        targets=None if workspace.targets is None else len(workspace.targets),
        unseen=tuple(unseen),
        sandbox=sentence(ways),
    )
