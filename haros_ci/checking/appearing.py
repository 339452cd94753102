# SPDX-License-Identifier: Apache-2.0
"""Whether a file that is not among those of the workspace may be there when a package is built."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Collection

from haros_ci.checking.project import Project, ProjectPackage


def may_appear(package: ProjectPackage, path: str, quiet: Collection[str]) -> bool:
    """Whether something may make the root-relative *path*: a submodule, a command that names it, or what git is told to ignore.

    *quiet* are the commands that make nothing.
    """
    project, base = package.project, posixpath.basename(path)
    if any(path == module or path.startswith(f"{module}/") for module in project.submodules):
        return True
    if any(path == link or path.startswith(f"{link}/") for link, _ in project.workspace.links):
        return True
    stem = base.partition(".")[0]
    words, text = package.cmake.words(frozenset(quiet))
    return bool(stem and stem in words) or base in text or _is_ignored(project, path)


def _is_ignored(project: Project, path: str) -> bool:
    """Whether a .gitignore at or above *path* names it or its kind (gitignore(5), as far as it names one thing)."""
    base, suffix = posixpath.basename(path), posixpath.splitext(path)[1]
    folder = path
    while folder:
        folder = posixpath.dirname(folder)
        ignored = project.text(posixpath.join(folder, ".gitignore"))
        if base in ignored and re.search(rf"(?m)^/?(?:[^#\n]*/)?{re.escape(base)}/?[ \t\r]*$", ignored):
            return True
        if suffix and suffix in ignored and re.search(rf"(?m)^\*\*?/?\*?{re.escape(suffix)}[ \t\r]*$", ignored):
            return True
    return False
