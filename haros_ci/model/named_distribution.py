# SPDX-License-Identifier: Apache-2.0
"""Which distribution of ROS 1 pages and scripts of a workspace name."""

from __future__ import annotations

import re
from collections.abc import Iterable

from haros_ci.regex import regex

_TELLING = regex(
    r"(?:^|/)(?:readme[^/]*|install[^/]*\.(?:md|rst|txt)|[^/]*dockerfile[^/]*|containerfile|\.travis\.yml|\.gitlab-ci\.yml|makefile"
    r"|\.?[\w-]*(?:bashrc|zshrc|profile|bash_aliases))$"
    r"|\.(?:md|rst|sh|bash|zsh|service)$|docker[^/]*\.ya?ml$|/Jenkinsfile$",
    re.IGNORECASE,
)
_CHANGES = regex(r"(?:^|/)changelog[^/]*$", re.IGNORECASE)
#: Of one page so much is read.
MAX_PAGE = 200_000
_NOETIC = regex(
    r"\bros-noetic-|\bros:noetic|/opt/ros/noetic\b|\brosdistro[= ]noetic\b|\bROS_DISTRO[=:]\s*[\"']?noetic\b|\bROS[ \t]+(?:1[ \t]+)?Noetic\b|:noetic-|\bnoetic-devel\b",
    re.IGNORECASE,
)
#: A branch that is called after an older one is often that of Noetic, too, and an address tells of another project.
_NO_NAME = regex(r"https?://\S{0,300}|[\w/]{0,40}-devel\b|\borigin/[\w-]{1,40}")
_SAID = regex("noetic", re.IGNORECASE)
_OLDER = regex(r"\b(?:groovy|hydro|indigo|jade|kinetic|lunar|melodic)\b", re.IGNORECASE)


def is_page(path: str) -> bool:
    """Whether the file at *path* tells people or machines how a workspace is built and used; no changelog does."""
    return _TELLING.search(path) is not None and not _CHANGES.search(path)


def names_noetic(texts: Iterable[str]) -> bool:
    """Whether the *texts* of pages and scripts are for Noetic and none names an older distribution of ROS 1."""
    is_named = False
    for text in texts:
        if _OLDER.search(_NO_NAME.sub(" ", text)):
            return False
        is_named = is_named or _NOETIC.search(text) is not None
    return is_named


def names_older(texts: Iterable[str]) -> bool:
    """Whether the *texts* of pages and scripts are for distributions of ROS 1 before Noetic, whose Python is Python 2, and none has the name of Noetic."""
    is_named = False
    for text in texts:
        if _SAID.search(text):
            return False
        is_named = is_named or _OLDER.search(_NO_NAME.sub(" ", text)) is not None
    return is_named
