# SPDX-License-Identifier: Apache-2.0
"""Whether a file that is not among those of the workspace may be there when a package is built."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Collection
from functools import lru_cache

from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.model.globs import fault, matches
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex

#: Commands that bring or make files whose names they do not tell.
_BRINGING = regex(
    r"externalproject_|fetchcontent_|catkin_download|ament_vendor|execute_process|exec_program|git_submodule|vcs|cpm|.*download"
)


def brings_files(package: ProjectPackage) -> bool:
    """Whether CMake downloads files for *package*, or runs programs that may make some, while it configures the package."""
    return any(
        _BRINGING.match(command.name) or (command.name == "file" and "DOWNLOAD" in command.arguments[:1])
        for command in package.build.commands
    )


def may_appear(package: ProjectPackage, path: str, quiet: Collection[str]) -> bool:
    """Whether something may make the root-relative *path*: a submodule, a command that names it, or an entry of ``.gitignore``.

    *quiet* are the commands that make nothing.
    """
    project, base = package.project, posixpath.basename(path)
    if any(path == module or path.startswith(f"{module}/") for module in project.submodules):
        return True
    if any(path == link or path.startswith(f"{link}/") for link, _ in project.workspace.links):
        return True
    if any(path[:at] in project.workspace.names for at, letter in enumerate(path) if letter == "/"):
        return True  # a link that leads to nothing here
    stem = base.partition(".")[0]
    words, text = package.cmake.words(frozenset(quiet))
    return bool(stem and stem in words) or base in text or is_ignored(project.workspace, path)


#: Pages and scripts that tell how to make what is not in the repository, so much of each, and words for making it.
_PAGES = (".md", ".rst", ".txt", ".sh", ".bash", "dockerfile", "makefile", ".yml", ".yaml")
_MAX_PAGE = 200_000
_NO_PAGES = regex(r"(?:^|/)(?:CMakeLists\.txt|changelog[^/]*)$", re.IGNORECASE)
_MAKES = regex(
    r"\b(?:mkdir|wget|curl|git clone|git submodule|unzip|tar|ln|cp|mv|gdown|vcs|create|make|download\w*|extract|place|put|save|copy|generate\w*"
    r"|clone|move|unpack|store)\b",
    re.IGNORECASE,
)


def is_told_of(package: ProjectPackage, path: str) -> bool:
    """Whether a page or script of the workspace tells to make, download or copy the root-relative *path* of *package*.

    It has the path, with the package before it or in the package's own pages, in one line with a word for that or in the line below.
    """
    inner = path if package.path == "." else path.removeprefix(f"{package.path}/")
    named = {f"{package.name}/{inner}", f"{posixpath.basename(package.path)}/{inner}"}
    own = "" if package.path == "." else f"{package.path}/"
    for name in package.project.sources.once("pages that tell", lambda: _pages(package.project)):
        words = {*named, inner} if name.startswith(own) else named
        text = package.project.text(name)[:_MAX_PAGE]
        if not any(word in text for word in words):
            continue
        ends = re.compile(rf"(?<![\w.-])(?:{'|'.join(map(re.escape, sorted(words)))})(?![\w-])")
        before = ""
        for line in text.splitlines():
            if (_MAKES.search(line) or _MAKES.search(before)) and ends.search(line):
                return True
            before = line
    return False


def _pages(project: Project) -> tuple[str, ...]:
    """The pages and scripts of the workspace, without changelogs."""
    names = project.below(".")
    return tuple(name for name in names if name.lower().endswith(_PAGES) and not _NO_PAGES.search(name))


def is_ignored(workspace: Workspace, path: str) -> bool:
    """Whether a .gitignore at or above the root-relative *path* has git ignore it, or a directory above it: then something makes it (gitignore(5)).

    With a base revision the .gitignore of the base counts (``Workspace.setting``): a change cannot lower its own findings.
    """
    parts = path.split("/")
    ignored = False
    for depth in range(len(parts)):
        place = "/".join((*parts[:depth], ".gitignore"))
        if place in workspace.names:
            below = "/".join(parts[depth:])
            for glob in _patterns(workspace.setting(place)):
                if matches(glob.removeprefix("!"), below):
                    ignored = not glob.startswith("!")  # the last one that matches decides
    return ignored


@lru_cache(maxsize=256)
def _patterns(text: str) -> tuple[str, ...]:
    lines = (line.strip() for line in text.splitlines())
    return tuple(line for line in lines if line and not line.startswith("#") and fault(line.removeprefix("!")) is None)
