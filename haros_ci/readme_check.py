# SPDX-License-Identifier: Apache-2.0
"""``haros-ci model --check-readme``: where the interface tables of packages' READMEs and the code disagree."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.model.architecture import Architecture
from haros_ci.model.package import Package
from haros_ci.model.workspace import Workspace
from haros_ci.report.node_interface import interfaces
from haros_ci.report.readme_compare import Difference, Known, compare, known
from haros_ci.report.readme_tables import rows

NAMES = ("README.md", "Readme.md", "readme.md", "README.MD")


def differences(workspace: Workspace, architecture: Architecture) -> tuple[Difference, ...]:
    """What the README of each package in *workspace* says otherwise than *architecture*, by file and line.

    A package of which no node is in the model and that has no endpoint in its files is passed over: nothing is known
    of it.
    """
    facts = known(interfaces(architecture), architecture)
    found = [
        difference
        for package in architecture.packages
        if package.name in facts
        for difference in _of(package, facts[package.name], workspace)
    ]
    return tuple(sorted(found, key=lambda item: (item.path, item.line, item.rule, item.message)))


def _of(package: Package, facts: Known, workspace: Workspace) -> Iterator[Difference]:
    for name in NAMES:
        path = name if package.path == "." else f"{package.path}/{name}"
        if workspace.reports_on(path):
            yield from compare(path, rows(workspace.text(path)), facts)
