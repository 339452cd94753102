# SPDX-License-Identifier: Apache-2.0
"""Workspaces of ROS 1 that are used from their devel space alone, as their pages and scripts show: nobody misses what is not installed."""

from __future__ import annotations

import re
from functools import cached_property

from haros_ci.checking.pages import pages
from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.regex import regex

#: What builds and sources a devel space.
_DEVEL = regex(r"\bdevel(?:_isolated)?/(?:local_)?setup\.|\bcatkin_make(?:_isolated)?\b|\bcatkin[ \t]+(?:build|b)\b")
#: What builds or uses an install space or a Debian package, or leaves that to a build farm's tool. ``\`` at an end continues a line.
_INSTALL = regex(
    r"\binstall(?:_isolated)?/(?:local_)?setup\.|\bcatkin\w*\b(?:[^\n]|\\\n){0,300}\binstall\b|\bbloom-(?:release|generate)\b"
    r"|\bdpkg-(?:buildpackage|deb)\b|\bdebuild\b|\bdebhelper\b|\bindustrial_ci\b|\baction-ros-ci\b|\bros_buildfarm\b|\bcpack\b|\bcolcon\b",
    re.IGNORECASE,
)
_DEBIAN = regex(r"(?:^|/)debian/(?:rules|control)(?:\.em)?$|(?:^|/)tracks\.yaml$")


class DevelSpaces:
    """Which packages of *project* are evidently used from a devel space alone."""

    def __init__(self, project: Project) -> None:
        self._project = project

    def has(self, package: ProjectPackage) -> bool:
        """Whether *package* is one of ROS 1 that no distribution has, in a workspace that nobody installs."""
        knowledge = self._project.knowledge
        if package.ros != 1 or not knowledge.is_there or knowledge.is_package(package.name):
            return False
        return self._is_evident

    @cached_property
    def _is_evident(self) -> bool:
        """Whether pages and scripts build a devel space and none an install space, at the base revision, too, if there is one."""
        if not _is_documented(self._project):
            return False
        base = self._project.base
        return base is None or _is_documented(base)


def _is_documented(project: Project) -> bool:
    if any(_DEBIAN.search(path) for path in project.workspace.names):
        return False
    is_devel = False
    for text in pages(project):
        if _INSTALL.search(text):
            return False
        is_devel = is_devel or _DEVEL.search(text) is not None
    return is_devel
