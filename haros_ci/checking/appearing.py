# SPDX-License-Identifier: Apache-2.0
"""Whether a file that is not among those of the workspace may be there when a package is built."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Collection, Iterator

from haros_ci.checking.project import Project, ProjectPackage


def may_appear(package: ProjectPackage, path: str, quiet: Collection[str]) -> bool:
    """Whether something may make the root-relative *path*: a submodule, a command that names it, or what git is told to ignore.

    *quiet* are the commands that make nothing.
    """
    project, base = package.project, posixpath.basename(path)
    if any(path == module or path.startswith(f"{module}/") for module in submodules(project)):
        return True
    if any(path == link or path.startswith(f"{link}/") for link, _ in project.workspace.links):
        return True
    stem = base.partition(".")[0]
    for command in package.build.commands:
        if command.name not in quiet and any(base in word or (stem and stem == word) for word in command.arguments):
            return True
    return _is_ignored(project, path)


def submodules(project: Project) -> Iterator[str]:
    """The directories that git fills from other repositories (gitmodules(5))."""
    for name in project.workspace.names:
        if posixpath.basename(name) == ".gitmodules":
            for found in re.finditer(r"(?m)^\s*path\s*=\s*(\S+)\s*$", project.text(name)):
                yield posixpath.normpath(posixpath.join(posixpath.dirname(name), found[1]))


def _is_ignored(project: Project, path: str) -> bool:
    """Whether a .gitignore at or above *path* names it or its kind (gitignore(5), as far as it names one thing)."""
    base, suffix = posixpath.basename(path), posixpath.splitext(path)[1]
    folder = path
    while folder:
        folder = posixpath.dirname(folder)
        ignored = project.text(posixpath.join(folder, ".gitignore"))
        if re.search(rf"(?m)^/?(?:[^#\n]*/)?{re.escape(base)}/?\s*$", ignored):
            return True
        if suffix and re.search(rf"(?m)^\*\*?/?\*?{re.escape(suffix)}\s*$", ignored):
            return True
    return False
