# SPDX-License-Identifier: Apache-2.0
"""Launch files in directories of what is no longer used: what is wrong in them waits for somebody to start them again."""

from __future__ import annotations

import re
from dataclasses import replace
from posixpath import basename

from haros_ci.checking.check import Finding
from haros_ci.model.former_names import is_archived
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.rule import Level

#: Directories of what was there for a while.
_PASSING = frozenset(("temp", "tmp"))
#: What file managers call a copy: ``Copy of drive.launch``, ``drive (copy).launch``, ``drive (2).launch``.
_COPY = regex(r"(?:copy of .+|[^.]+ ?\((?:copy|\d{1,3})\).*|[^.]+[ _-]+copy(?:[ _-]?\d{1,3})?\..+)", re.IGNORECASE)
#: A version that somebody has kept beside ``drive.launch.py``: ``drive_old.launch.py``, ``drive.launch.backup2.py``, ``old_drive.launch.py``.
_WORDS = "backup|bak|deprecated|obsolete|old|orig|original|unused"
_KEPT = regex(
    rf"(?P<stem>[^.]+(?:\.launch)?)[._ -](?:{_WORDS})\d{{0,8}}(?:[_-]\w{{1,60}})?(?:\.launch)?\.(?:launch|py|xml|ya?ml)"
    rf"|(?:{_WORDS})[_-](?P<whole>.+)",
    re.IGNORECASE,
)
#: Files whose text may start or include a launch file.
_ENDINGS = (".launch", ".launch.py", ".launch.xml", ".launch.yaml", ".py", ".xml", ".yaml")
_NAMING = (".launch", ".py", ".xml", ".yaml", ".yml", ".md", ".rst", ".txt", ".sh", ".bash", ".service")


def lowered(finding: Finding, workspace: Workspace | None) -> Finding:
    """*finding* as a note where it is in a launch file that lies in a directory such as ``deprecated``, or is a copy or a former version by its name, and that no file names.

    Files in such a directory do not count.
    """
    path = finding.at.path
    if workspace is None or finding.level is Level.NOTE or "launch" not in path:
        return finding
    if not _is_archived(path) and not _is_former(path, workspace):
        return finding
    if _is_named(path, workspace):
        return finding
    folder = next((f" outside of {part}" for part in path.split("/")[:-1] if _is_archive(part)), "")
    message = f"{finding.message.rstrip('. ')} (nothing{folder} names {basename(path)})"
    return replace(finding, level=Level.NOTE, message=message)


def is_copy_by_name(path: str) -> bool:
    """Whether a file manager has named the file at *path* as a copy: ``drive (copy).py``."""
    return _COPY.fullmatch(basename(path)) is not None


def _is_archived(path: str) -> bool:
    *folders, name = path.split("/")
    return any(map(_is_archive, folders)) or is_copy_by_name(name)


def _is_archive(folder: str) -> bool:
    return folder.lower() in _PASSING or is_archived(f"{folder}/")


def _is_former(path: str, workspace: Workspace) -> bool:
    """Whether the file is a former version, by its name, of one beside it."""
    folder, _, name = path.rpartition("/")
    found = _KEPT.fullmatch(name)
    if found is None:
        return False
    start = f"{folder}/" if folder else ""
    if found["whole"]:
        return f"{start}{found['whole']}" in workspace.names
    return any(f"{start}{found['stem']}{end}" in workspace.names for end in _ENDINGS)


def _is_named(path: str, workspace: Workspace) -> bool:
    name = basename(path)
    beside = (other for other in workspace.names if other.endswith(_NAMING) and not _is_archived(other))
    return any(name in workspace.text(other) for other in beside)
