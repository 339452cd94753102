# SPDX-License-Identifier: Apache-2.0
"""From two revisions of a workspace to what the change between them does."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import PurePosixPath

from haros_ci.changes.change import shown
from haros_ci.changes.compare import Side, compare
from haros_ci.changes.definitions import told
from haros_ci.changes.interfaces import Defined, containing, interface_changes
from haros_ci.changes.settings import Value
from haros_ci.link.launching.parameter_files import SECTION, values_in
from haros_ci.link.link import Linked
from haros_ci.model.changes import Changes
from haros_ci.model.workspace import Workspace


def changes_of(
    base: Workspace, base_made: Linked, head: Workspace, head_made: Linked, renames: Mapping[str, str]
) -> Changes:
    """What is otherwise in *head* than in *base*, of architecture, parameter files and interfaces."""
    new = {file.path: file.digest for file in head.files}
    old = {renames.get(file.path, file.path): file.digest for file in base.files}
    same = {path for path, digest in new.items() if old.get(path) == digest}
    defined = _defined(head, head_made)
    return compare(
        Side(
            architecture=base_made.architecture,
            files=base.names,
            values={path: values for path, values in _values(base) if renames.get(path, path) not in same},
        ),
        Side(
            architecture=head_made.architecture,
            files=head.names,
            values={path: values for path, values in _values(head) if path not in same},
        ),
        renames,
        told(interface_changes(_defined(base, base_made), defined), lambda name: containing(defined, name)),
    )


def _defined(workspace: Workspace, made: Linked) -> tuple[Defined, ...]:
    """Every interface with the ROS version of its package."""
    versions = {package.name: package.ros for package in workspace.packages}
    return tuple((each, versions.get(name)) for name, build in made.builds.items() for each in build.interfaces)


def _values(workspace: Workspace) -> Iterator[tuple[str, tuple[Value, ...]]]:
    """What each parameter file of ROS 2 gives."""
    for file in workspace.files:
        if PurePosixPath(file.path).suffix in (".yaml", ".yml"):
            text = workspace.text(file.path)
            if SECTION in text:
                rules = values_in(text, file.path)
                yield (
                    file.path,
                    tuple(
                        Value(
                            rule.node,
                            rule.name,
                            None if rule.unknowns else shown(rule.value),
                            rule.origin or rule.location,
                        )
                        for rule in rules
                    ),
                )
