# SPDX-License-Identifier: Apache-2.0
"""Launch files in directories of what is no longer used: what is wrong in them waits for somebody to start them again."""

from __future__ import annotations

import re
from dataclasses import replace
from posixpath import basename

from haros_ci.checking.check import Finding
from haros_ci.model.workspace import Workspace
from haros_ci.results.rule import Level

_ARCHIVES = frozenset(
    "archive archived archives attic backup backups deprecated graveyard legacy obsolete old temp tmp trash unused".split()
)
#: What file managers call a copy: ``Copy of drive.launch``, ``drive (copy).launch``, ``drive (2).launch``.
_COPY = re.compile(r"(?:copy of .+|[^.]+ ?\((?:copy|\d{1,3})\).*|[^.]+[ _-]+copy(?:[ _-]?\d{1,3})?\..+)", re.IGNORECASE)
#: Files whose text may start or include a launch file.
_NAMING = (".launch", ".py", ".xml", ".yaml", ".yml", ".md", ".rst", ".txt", ".sh", ".bash", ".service")


def lowered(finding: Finding, workspace: Workspace | None) -> Finding:
    """*finding* as a note where it is in a launch file that lies in a directory such as ``deprecated``, or is a copy by its name, and that no file names.

    Files in such a directory do not count.
    """
    path = finding.at.path
    if workspace is None or finding.level is Level.NOTE or not _is_archived(path) or "launch" not in path:
        return finding
    if _is_named(path, workspace):
        return finding
    folder = next((f" outside of {part}" for part in path.split("/")[:-1] if part.lower() in _ARCHIVES), "")
    message = f"{finding.message.rstrip('. ')} (nothing{folder} names {basename(path)})"
    return replace(finding, level=Level.NOTE, message=message)


def _is_archived(path: str) -> bool:
    *folders, name = path.split("/")
    return any(part.lower() in _ARCHIVES for part in folders) or _COPY.fullmatch(name) is not None


def _is_named(path: str, workspace: Workspace) -> bool:
    name = basename(path)
    beside = (other for other in workspace.names if other.endswith(_NAMING) and not _is_archived(other))
    return any(name in workspace.text(other) for other in beside)
