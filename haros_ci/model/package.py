# SPDX-License-Identifier: Apache-2.0
"""Packages and files of a workspace, as values."""

from __future__ import annotations

from haros_ci.records import dataclass

#: The kinds of file that anything here reads. ``cpp`` is C and C++, headers included, ``world`` what Gazebo reads besides SDF, ``hpl`` properties.
LANGUAGES = (
    "cpp",
    "python",
    "launch",
    "package",
    "cmake",
    "yaml",
    "interface",
    "xml",
    "setup",
    "shell",
    "dockerfile",
    "markdown",
    "world",
    "hpl",
)

#: The kind of any other file: one that a tool of the project file reads, and one that sets environment variables.
OTHER = "other"


@dataclass(frozen=True, slots=True)
class Dependency:
    """One dependency tag of a manifest (REP 127, 140, 149); *kind* is the tag's name, for example ``exec_depend``."""

    name: str
    kind: str
    condition: str | None = None
    line: int | None = None


@dataclass(frozen=True, slots=True)
class Package:
    """A ROS package: the directory that holds a package.xml, and lies in no other package.

    *path* is the directory, POSIX-style, relative to the workspace root (``.`` for the root itself). *ros* is 1 or 2
    by build type and dependencies, None where the manifest does not tell.
    """

    name: str
    path: str
    format: int = 1
    version: str = ""
    build_type: str = ""
    ros: int | None = None
    dependencies: tuple[Dependency, ...] = ()
    is_metapackage: bool = False


#: Lines of a long file.
LONG = 2_000


@dataclass(frozen=True, slots=True)
class SourceFile:
    """One file that can be analysed.

    *path* is POSIX-style and relative to the workspace root; *digest* is the SHA-256 of its bytes in hex; *size* is
    in bytes; *package* is the name of the package that contains it, or None; *lines* counts line feeds;
    *has_directive* is False where no suppression comment of ours can be in it; *is_generated* is True for a file whose first
    comment says that a program has written it: linters leave it alone; *third_party* is the directory around the file that holds a
    copy of another project, or its own path if the file itself is one, "" if neither: nothing is reported there.
    """

    path: str
    language: str
    size: int
    digest: str
    package: str | None = None
    lines: int = 0
    has_directive: bool = True
    is_generated: bool = False
    third_party: str = ""

    @property
    def is_bulk(self) -> bool:
        """Whether it is a long C++ source that a program has written: a solver, for which a linter takes minutes.

        Files that include it (a plug-in its solver) are read without it.
        """
        is_source = self.path.endswith((".c", ".cc", ".cpp", ".cxx", ".c++"))
        return self.is_generated and is_source and self.lines > LONG

    @property
    def is_linted(self) -> bool:
        """Whether somebody would mend what a linter finds in it."""
        return not self.is_generated and not self.third_party
