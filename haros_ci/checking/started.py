# SPDX-License-Identifier: Apache-2.0
"""The programs that launch files start."""

from __future__ import annotations

from haros_ci.checking.project import ProjectPackage
from haros_ci.model.launch_facts import ProgramUse


def started_programs(package: ProjectPackage) -> frozenset[str]:
    """The names of the programs of *package* that launch files of the workspace start; those of all packages are gathered once."""
    project = package.project

    def gather() -> dict[str, set[str]]:
        found: dict[str, set[str]] = {}
        for system in project.systems:
            for use in system.facts(ProgramUse):
                if use.kind == "executable":
                    found.setdefault(use.package, set()).add(use.program)
        return found

    return frozenset(project.sources.once("started programs", gather).get(package.name, ()))
