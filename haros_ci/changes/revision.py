# SPDX-License-Identifier: Apache-2.0
"""Two revisions of a workspace compared in all that a change may do to a system."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping
from dataclasses import replace

from haros_ci.changes.calls import Rows, calls_in, is_test
from haros_ci.changes.compare import ComparedRevision, compare
from haros_ci.changes.definitions import interface_changes_shown
from haros_ci.changes.evidence import RevisionCode, functions_of
from haros_ci.changes.interfaces import Defined, containing, interface_changes
from haros_ci.changes.rates import paces_differ
from haros_ci.changes.settings import ParameterValue
from haros_ci.changes.wrappers import Wrappers
from haros_ci.model.architecture import Architecture
from haros_ci.model.changes import Changes
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.syntax import Program


@dataclass(frozen=True, slots=True)
class Revision:
    """A workspace with its architecture and interfaces; *read_values* gives what a parameter file says, by path and text,
    *programs* are its code, *rows* what calls mean, by language and ROS version.
    """

    workspace: Workspace
    architecture: Architecture
    interfaces: tuple[Defined, ...]
    read_values: Callable[[str, str], tuple[ParameterValue, ...]]
    programs: Mapping[str, Program]
    rows: Mapping[tuple[str, int], Rows]
    #: The architecture with the rates of its configurations, made when it is asked for.
    timed: Callable[[], Architecture] | None = None

    def side(self, moved: Callable[[str], str], same: Container[str]) -> ComparedRevision:
        """What is compared of it; parameter files and code that are the *same* on both sides are left out."""
        changed = [f.path for f in self.workspace.files if f.language == "yaml" and moved(f.path) not in same]
        read = {path: self.read_values(path, self.workspace.text(path)) for path in changed}
        values = {path: values for path, values in read.items() if values}
        code = [f for f in self.workspace.files if f.path in self.programs and moved(f.path) not in same]
        versions = {package.name: package.ros for package in self.workspace.packages}
        rows = {
            file.path: self.rows.get((file.language, versions.get(file.package or "") or 2), {})
            for file in self.workspace.files
            if file.path in self.programs
        }
        wrappers = Wrappers((self.programs[path], rows[path]) for path in (rows if code else ()))
        calls = {
            f.path: calls_in(f.path, self.programs[f.path], rows[f.path], wrappers.named)
            for f in code
            if not is_test(f.path)
        }
        return ComparedRevision(
            architecture=self.architecture,
            files=self.workspace.names,
            values=values,
            calls=calls,
            source=self._source(moved, same),
        )

    def _source(self, moved: Callable[[str], str], same: Container[str]) -> RevisionCode:
        """Where functions begin, and the texts that have changed."""
        changed = [file for file in self.workspace.files if moved(file.path) not in same]
        own = [file for file in changed if file.package is not None and not is_test(file.path)]
        return RevisionCode(
            functions={path: functions_of(program) for path, program in self.programs.items()},
            texts={
                file.path: self.workspace.text(file.path)
                for file in changed
                if file.path in self.programs and not is_test(file.path)
            },
            changed=frozenset(file.language for file in own),
        )


def with_rates(revision: Revision) -> Revision:
    """*revision* with the rates of its configurations, if they can be had."""
    return revision if revision.timed is None else replace(revision, architecture=revision.timed())


def changes_of(base: Revision, head: Revision, renames: Mapping[str, str], *, rates: bool = False) -> Changes:
    """What is otherwise in *head* than in *base*; *renames* maps paths of the base to those of files that have moved.

    Rates are compared if that is asked for, or a node has a timer or rate with a period that it did not have.
    """
    if rates or paces_differ(base.architecture, head.architecture):
        base, head = with_rates(base), with_rates(head)

    def moved(path: str) -> str:
        return renames.get(path, path)

    new = {file.path: file.digest for file in head.workspace.files}
    old = {moved(file.path): file.digest for file in base.workspace.files}
    same = {path for path, digest in new.items() if old.get(path) == digest}
    interfaces = interface_changes_shown(
        interface_changes(base.interfaces, head.interfaces), lambda name: containing(head.interfaces, name)
    )
    return compare(base.side(moved, same), head.side(lambda path: path, same), renames, interfaces)
