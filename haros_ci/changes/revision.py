# SPDX-License-Identifier: Apache-2.0
"""Two revisions of a workspace compared in all that a change may do to a system."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping
from dataclasses import dataclass

from haros_ci.changes.compare import Side, compare
from haros_ci.changes.definitions import told
from haros_ci.changes.interfaces import Defined, containing, interface_changes
from haros_ci.changes.settings import Value
from haros_ci.model.architecture import Architecture
from haros_ci.model.changes import Changes
from haros_ci.model.workspace import Workspace


@dataclass(frozen=True, slots=True)
class Revision:
    """A workspace with its architecture and interfaces; *read_values* gives what a parameter file says, by path and text."""

    workspace: Workspace
    architecture: Architecture
    interfaces: tuple[Defined, ...]
    read_values: Callable[[str, str], tuple[Value, ...]]

    def side(self, moved: Callable[[str], str], same: Container[str]) -> Side:
        """What is compared of it; parameter files that are the *same* on both sides are left out."""
        changed = [f.path for f in self.workspace.files if f.language == "yaml" and moved(f.path) not in same]
        read = {path: self.read_values(path, self.workspace.text(path)) for path in changed}
        values = {path: values for path, values in read.items() if values}
        return Side(architecture=self.architecture, files=self.workspace.names, values=values)


def changes_of(base: Revision, head: Revision, renames: Mapping[str, str]) -> Changes:
    """What is otherwise in *head* than in *base*; *renames* maps paths of the base to those of files that have moved."""

    def moved(path: str) -> str:
        return renames.get(path, path)

    new = {file.path: file.digest for file in head.workspace.files}
    old = {moved(file.path): file.digest for file in base.workspace.files}
    same = {path for path, digest in new.items() if old.get(path) == digest}
    interfaces = told(
        interface_changes(base.interfaces, head.interfaces), lambda name: containing(head.interfaces, name)
    )
    return compare(base.side(moved, same), head.side(lambda path: path, same), renames, interfaces)
