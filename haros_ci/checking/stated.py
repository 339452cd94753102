# SPDX-License-Identifier: Apache-2.0
"""Checks of properties: they are not asked, and HPL is not loaded, where a project file states none."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from haros_ci.checking.check import Finding
from haros_ci.checking.project import Project

if TYPE_CHECKING:
    from haros_ci.checking.properties import Properties


def of_properties(check: Callable[[Properties], Iterable[Finding]]) -> Callable[[Project], Iterable[Finding]]:
    """*check* as one of the whole project."""

    def run(project: Project) -> Iterable[Finding]:
        stated = project.properties
        return () if stated is None else check(stated)

    return run
