# SPDX-License-Identifier: Apache-2.0
"""Directories that git fills from other repositories (gitmodules(5)), and those of them that this checkout lacks."""

from __future__ import annotations

import posixpath
from collections.abc import Collection

from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex

_PATH = regex(r"(?m)^[ \t]*path[ \t]*=[ \t]*(\S+)[ \t\r]*$")


def submodules(workspace: Workspace) -> tuple[str, ...]:
    """The directories of all submodules, relative to the root, checked out or not."""
    return tuple(
        posixpath.normpath(posixpath.join(posixpath.dirname(name), found[1]))
        for name in sorted(workspace.names)
        if name.rpartition("/")[2] == ".gitmodules"
        for found in _PATH.finditer(workspace.text(name))
    )


def absent(workspace: Workspace) -> frozenset[str]:
    """The directories of submodules without a file in them: what they hold is there wherever they are checked out.

    Those are among them that git has as commits of other repositories, and that no ``.gitmodules`` names.
    """
    every = frozenset(submodules(workspace)) | workspace.unfetched
    if not every:
        return every
    there: set[str] = set()
    for path in workspace.names:
        while (path := path.rpartition("/")[0]) and path not in there:
            there.add(path)
    return every - there


def is_below(path: str, folders: Collection[str]) -> bool:
    """Whether *path* is one of *folders*, or in one of them."""
    parts = path.split("/")
    return any("/".join(parts[:end]) in folders for end in range(1, len(parts) + 1)) if folders else False
