# SPDX-License-Identifier: Apache-2.0
"""Programs of the workspace that write a file of some name: it is not missing, it is made at run time."""

from __future__ import annotations

import posixpath
import re

from haros_ci.model.workspace import Workspace

#: So much of a file is read.
_MOST = 400_000
#: What opens a file for writing in Python and C++, or hands data over to be written.
_WRITES = re.compile(
    r"ofstream|\bfstream\b|\bfopen\s*\([^;\n]{0,200}[\"'][wa]|\bopen\s*\([^\n]{0,200}[\"'][wax]b?\+?[\"']|\bdump\s*\(|\.write\w*\s*\(|write_text|write_bytes"
    r"|to_csv|savetxt|imwrite|\bsave\w*\s*\("
)
#: Python files that only start others.
_LAUNCH = re.compile(r"launch\.py$|(?:^|/)launch/")
#: A line that reads, whatever else the file does.
_READS = re.compile(
    r"ifstream|LoadFile|load\w*\s*\(|\bread\w*\s*\(|[\"']rb?[\"']|\bexists\s*\(|is_?file\s*\(|include", re.IGNORECASE
)


def writer_of(workspace: Workspace, path: str) -> str:
    """The first program, or script of a shell, that has the base name of *path* in a string and writes files; "" if there is none."""
    base = posixpath.basename(path)
    if len(base) < 3 or "$" in base or "?" in base:
        return ""
    literal = re.compile(rf"[\"'/]{re.escape(base)}[\"']")
    shell = re.compile(rf">\s{{0,9}}[\"']?[^\s;&|<>\"']{{0,200}}(?<![\w.-]){re.escape(base)}(?![\w.-])")
    for file in workspace.files:
        if file.language not in ("cpp", "python") and not file.path.endswith((".sh", ".bash")):
            continue
        if _LAUNCH.search(file.path):
            continue
        text = workspace.text(file.path)[:_MOST]
        if base not in text:
            continue
        lines = [line for line in text.splitlines() if base in line and not line.lstrip().startswith(("#", "//", "*"))]
        if file.path.endswith((".sh", ".bash")):
            if any(shell.search(line[:2_000]) for line in lines):
                return file.path
        elif _WRITES.search(text) and any(literal.search(line) and not _READS.search(line[:2_000]) for line in lines):
            return file.path
    return ""
