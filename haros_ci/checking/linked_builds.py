# SPDX-License-Identifier: Apache-2.0
"""Workspaces of ROS 2 that are evidently built with links to the sources alone: Python finds there what is not installed."""

from __future__ import annotations

from haros_ci.checking.pages import pages
from haros_ci.checking.project import Project
from haros_ci.regex import regex

#: A call of ``colcon build`` with its options; ``\`` at an end continues a line.
_BUILD = regex(r"\bcolcon[ \t]+build\b(?:[^\\\n;&|]|\\[\s\S]){0,400}")
_LINKING = regex(r"symlink[-_]install")
#: What installs by itself: Debian packages and build farms.
_INSTALL = regex(r"\bbloom-(?:release|generate)\b|\bdebuild\b|\bros_buildfarm\b|\bindustrial_ci\b|\baction-ros-ci\b")


def is_built_with_links(project: Project) -> bool:
    """Whether pages and scripts build with ``--symlink-install`` and never without it, at the base revision, too, if there is one."""
    found = project.sources.once("built with links", lambda: _is_documented(project))
    return bool(found) and (project.base is None or _is_documented(project.base))


def _is_documented(project: Project) -> bool:
    is_linked = False
    for text in pages(project):
        calls = [_LINKING.search(call[0]) is not None for call in _BUILD.finditer(text)]
        if not all(calls) or _INSTALL.search(text) is not None:
            return False
        is_linked = is_linked or bool(calls)
    return is_linked
