# SPDX-License-Identifier: Apache-2.0
"""XML files and directories of the workspace, as programs name them."""

from __future__ import annotations

import posixpath
from collections.abc import Callable

from haros_ci.model.launch import LaunchElement, LaunchFile
from haros_ci.records import dataclass
from haros_ci.substitutions.files import Files
from haros_ci.substitutions.names import literal


@dataclass(frozen=True, slots=True)
class XmlFileReader:
    """XML files and directories by paths as values have them.

    *load* gives the tags of a file by its root-relative path, or of the text after a line feed.
    """

    load: Callable[[str], LaunchFile | None]
    files: Files

    def place(self, path: str) -> str | None:
        """The root-relative path of a file or directory that a program names; None if it is not of the workspace."""
        return self.files.place(literal(path.replace("$(find-pkg-share ", "$(find "))).path

    def root(self, path: str) -> LaunchElement | None:
        """The root of an XML file."""
        place = self.place(path)
        found = self.load(place) if place is not None and place in self.files.listed else None
        return found.root if found is not None else None

    def directory(self, path: str) -> tuple[str, ...]:
        """The paths of the files that are in a directory, sorted; none if it is not of the workspace."""
        place = self.place(path)
        if place is None:
            return ()
        inside = (file for file in self.files.listed if posixpath.dirname(file) == place)
        return tuple(f"{path.rstrip('/')}/{posixpath.basename(file)}" for file in sorted(inside))
