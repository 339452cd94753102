# SPDX-License-Identifier: Apache-2.0
"""Files that are called as tests are (``motor_spec.cpp``), and of which a build makes a program or library all the same: what decides is what the build does with them."""

from __future__ import annotations

import re
from functools import cached_property

from haros_ci.model.package import Package
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex

#: Names of targets and programs that are for tests, whatever a build says of them.
_OF_TESTS = regex(r"test|mock|spec(?![a-z])", re.IGNORECASE)


class Products:
    """What the builds of *workspace* make of its files; a package's build is read when it is first asked about."""

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self._made: dict[str, frozenset[str]] = {}

    def has(self, path: str) -> bool:
        """Whether a target that is not for tests, by its name or by where it stands in CMake, compiles the file at *path*, or an entry point of such a name calls it."""
        name = self._package_of.get(path)
        package = self._packages.get(name or "")
        if package is None:
            return False
        if package.name not in self._made:
            self._made[package.name] = frozenset(_made(self._workspace, package))
        return path in self._made[package.name]

    @cached_property
    def _package_of(self) -> dict[str, str | None]:
        return {file.path: file.package for file in self._workspace.files}

    @cached_property
    def _packages(self) -> dict[str, Package]:
        return {package.name: package for package in reversed(self._workspace.packages)}


def _made(workspace: Workspace, package: Package) -> set[str]:
    from haros_ci.workspace.build import build_of  # most runs have no finding to ask for

    build = build_of(workspace, package)
    targets = [
        target
        for target in build.targets
        if not target.is_test and not _OF_TESTS.search(f"{target.name} {target.output}")
    ]
    found = {path for target in targets for path in (*target.sources, *target.conditional_sources)}
    return found | {entry.path for entry in build.entry_points if entry.path and not _OF_TESTS.search(entry.name)}
