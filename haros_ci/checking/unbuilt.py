# SPDX-License-Identifier: Apache-2.0
"""C++ sources that no target compiles and no file includes: what they say never runs."""

from __future__ import annotations

import posixpath
from typing import TYPE_CHECKING

from haros_ci.model.unbuilt import SUFFIXES as SUFFIXES
from haros_ci.model.unbuilt import is_cmake, not_included, uncompiled

if TYPE_CHECKING:
    from haros_ci.checking.project import Project, ProjectPackage


def unbuilt(project: Project) -> frozenset[str]:
    """The sources of all packages whose CMake files are known as a whole, and name them nowhere."""
    return frozenset(path for package in project.packages for path in loose(package))


def loose(package: ProjectPackage) -> list[str]:
    """The C++ sources of *package* that no target compiles, the text of no CMake file names and no file includes.

    None where something of its CMake files is unknown, or a command may compile what it does not name. A comment names nothing.
    """
    files = filter(is_cmake, package.project.below(package.path))
    texts = (package.project.text(name) for name in files)
    left = uncompiled(package.build, package.raw, (file.path for file in package.files), texts)
    return not_included(left, _included(package)) if left else []


def _included(package: ProjectPackage) -> set[str]:
    """The last parts of all names that files of the workspace include."""
    programs = package.project.programs.values()
    return {posixpath.basename(name.strip('<>"')) for program in programs for name in program.includes}
