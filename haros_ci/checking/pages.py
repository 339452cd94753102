# SPDX-License-Identifier: Apache-2.0
"""Files that tell people and machines how a workspace is built and used, and the distribution of ROS 1 that they name."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.checking.project import Project
from haros_ci.regex import regex

_TELLING = regex(
    r"(?:^|/)(?:readme[^/]*|install[^/]*\.(?:md|rst|txt)|[^/]*dockerfile[^/]*|containerfile|\.travis\.yml|\.gitlab-ci\.yml|makefile"
    r"|\.?[\w-]*(?:bashrc|zshrc|profile|bash_aliases))$"
    r"|\.(?:md|rst|sh|bash|zsh|service)$|docker[^/]*\.ya?ml$|/Jenkinsfile$",
    re.IGNORECASE,
)
_CHANGES = regex(r"(?:^|/)changelog[^/]*$", re.IGNORECASE)
#: Of one page so much is read.
_MAX = 200_000
_NOETIC = regex(
    r"\bros-noetic-|\bros:noetic|/opt/ros/noetic\b|\brosdistro[= ]noetic\b|\bROS_DISTRO[=:]\s*[\"']?noetic\b|\bROS[ \t]+(?:1[ \t]+)?Noetic\b|:noetic-|\bnoetic-devel\b",
    re.IGNORECASE,
)
#: A branch that is called after an older one is often that of Noetic, too, and an address tells of another project.
_NO_NAME = regex(r"https?://\S{0,300}|[\w/]{0,40}-devel\b|\borigin/[\w-]{1,40}")
_OLDER = regex(r"\b(?:groovy|hydro|indigo|jade|kinetic|lunar|melodic)\b", re.IGNORECASE)


def pages(project: Project) -> Iterator[str]:
    """The texts of README files and other pages, Dockerfiles, scripts, services and settings of CI; no changelogs."""
    for path in sorted(project.workspace.names):
        if is_page(path):
            yield project.text(path)[:_MAX]


def is_page(path: str) -> bool:
    """Whether the file at *path* is one of :func:`pages`."""
    return _TELLING.search(path) is not None and not _CHANGES.search(path)


def is_for_noetic(project: Project) -> bool:
    """Whether pages and scripts are for Noetic and none names an older distribution of ROS 1; at the base revision, too, if there is one."""
    return _names_noetic(project) and (project.base is None or _names_noetic(project.base))


def _names_noetic(project: Project) -> bool:
    is_named = False
    for text in pages(project):
        if _OLDER.search(_NO_NAME.sub(" ", text)):
            return False
        is_named = is_named or _NOETIC.search(text) is not None
    return is_named
