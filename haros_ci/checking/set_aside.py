# SPDX-License-Identifier: Apache-2.0
"""Launch files in directories of what is no longer used: what is wrong in them waits for somebody to start them again."""

from __future__ import annotations

from dataclasses import replace
from posixpath import basename

from haros_ci.checking.check import Finding
from haros_ci.model.workspace import Workspace
from haros_ci.results.rule import Level

_ARCHIVES = frozenset(
    "archive archived archives attic backup backups deprecated graveyard legacy obsolete old trash unused".split()
)
#: Files whose text may start or include a launch file.
_NAMING = (".launch", ".py", ".xml", ".yaml", ".yml", ".md", ".rst", ".txt", ".sh", ".bash", ".service")


def lowered(finding: Finding, workspace: Workspace | None) -> Finding:
    """*finding* as a note where it is in a launch file that lies in a directory such as ``deprecated``, and that no file outside of such a directory names."""
    path = finding.at.path
    if workspace is None or finding.level is Level.NOTE or not _is_archived(path) or "launch" not in path:
        return finding
    if _is_named(path, workspace):
        return finding
    folder = next(part for part in path.split("/") if part.lower() in _ARCHIVES)
    message = f"{finding.message.rstrip('. ')} (nothing outside of {folder} names {basename(path)})"
    return replace(finding, level=Level.NOTE, message=message)


def _is_archived(path: str) -> bool:
    return any(part.lower() in _ARCHIVES for part in path.split("/")[:-1])


def _is_named(path: str, workspace: Workspace) -> bool:
    name = basename(path)
    beside = (other for other in workspace.names if other.endswith(_NAMING) and not _is_archived(other))
    return any(name in workspace.text(other) for other in beside)
