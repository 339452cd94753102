# SPDX-License-Identifier: Apache-2.0
"""Programs of the workspace that write a file of some name: it is not missing, it is made at run time."""

from __future__ import annotations

import posixpath
import re
from weakref import WeakKeyDictionary

from haros_ci.checking.system import System
from haros_ci.checking.whole import Whole
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex

#: So much of a file is read.
_MOST = 400_000
#: What opens a file for writing in Python and C++, or hands data over to be written.
_WRITES = regex(
    r"ofstream|\bfstream\b|\bfopen\s*\([^;\n]{0,200}[\"'][wa]|\bopen\s*\([^\n]{0,200}[\"'][wax]b?\+?[\"']|\bdump\s*\(|\.write\w*\s*\(|write_text|write_bytes"
    r"|to_csv|savetxt|imwrite|\bsave\w*\s*\("
)
#: Python files that only start others.
_LAUNCH = regex(r"launch\.py$|(?:^|/)launch/")
#: A line that reads, whatever else the file does.
_READS = regex(
    r"ifstream|LoadFile|load\w*\s*\(|\bread\w*\s*\(|[\"']rb?[\"']|\bexists\s*\(|is_?file\s*\(|include", re.IGNORECASE
)


#: What stands in a string up to its end, behind its last slash.
_STRING = regex(r"(?<=[\"'/])([^\"'/]{3,200})(?=[\"'])")
#: What a shell writes to, and the names in it.
_TARGET = regex(r">\s{0,9}[\"']?([^\s;&|<>\"']{1,300})")
_NAME = regex(r"[\w.-]{3,}")

_known: WeakKeyDictionary[Whole, dict[str, str]] = WeakKeyDictionary()


def writer_of(system: System, path: str) -> str:
    """The first program, or script of a shell, that has the base name of *path* in a string and writes files; "" if there is none."""
    known, name = _known.setdefault(system.whole, {}), posixpath.basename(path)
    if name not in known:
        known[name] = _writer(system.workspace, name) if system.workspace is not None else ""
    return known[name]


def _writer(workspace: Workspace, name: str) -> str:
    """The first file that may write one called *name*."""
    for file in workspace.files:
        is_shell = file.path.endswith((".sh", ".bash"))
        if (file.language not in ("cpp", "python") and not is_shell) or _LAUNCH.search(file.path):
            continue
        text = workspace.text(file.path)[:_MOST]
        if name in text and (is_shell or _WRITES.search(text)):
            if any(name in line and name in _names(line, is_shell) for line in text.splitlines()):
                return file.path
    return ""


def _names(line: str, is_shell: bool) -> list[str]:
    """What *line* may write."""
    if line.lstrip().startswith(("#", "//", "*")):
        return []
    if is_shell:
        return [name for target in _TARGET.findall(line[:2_000]) for name in _NAME.findall(target)]
    return [] if _READS.search(line[:2_000]) else _STRING.findall(line)
