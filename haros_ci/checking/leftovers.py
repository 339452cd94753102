# SPDX-License-Identifier: Apache-2.0
"""Launch files that nothing starts any more, and could not start: left over from programs that are gone."""

from __future__ import annotations

from haros_ci.checking.installing import landings
from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.checking.uninstalled import may_be_installed
from haros_ci.model.launch_facts import IncludeUse, ProgramUse


class Leftovers:
    """The launch files of a project that are not installed, that nothing names, and of whose own programs none is there."""

    def __init__(self, project: Project) -> None:
        self.project = project
        self._programs: dict[str, list[ProgramUse]] = {}
        self._included: set[str] = set()
        self._including: set[str] = set()
        for system in project.systems:
            for use in system.facts(ProgramUse):
                self._programs.setdefault(use.location.path, []).append(use)
            includes = system.facts(IncludeUse)
            self._included |= {use.path for use in includes if use.path is not None}
            self._including |= {use.location.path for use in includes}

    def has(self, path: str, name: str) -> bool:
        """Whether the launch file at *path* of the package *name* is one."""
        package = self.project.package(name)
        system = next(iter(self.project.systems), None)
        if package is None or system is None or path in self._included or landings(package, path):
            return False
        if system.whole.is_named(path) or any(file.fullmatch(path) for file, _ in system.whole.chosen_files):
            return False
        return is_readable(package) and self.starts_nothing(path, package)

    def starts_nothing(self, path: str, package: ProjectPackage) -> bool:
        """Whether the launch file starts programs of *package*, none of which is built (ROS 1) or installed (ROS 2)."""
        uses = [use for use in self._programs.get(path, ()) if use.package == package.name]
        return bool(uses) and all(_is_gone(use, package) for use in uses)

    def starts_only_gone(self, path: str, package: ProjectPackage) -> bool:
        """Whether the launch file starts such programs alone of its package, and includes nothing."""
        return path not in self._including and self.starts_nothing(path, package)


def is_readable(package: ProjectPackage) -> bool:
    """Whether all is known that CMake of *package* installs."""
    return bool(package.build.commands) and package.cmake.is_whole and not package.cmake.installs_unknown


def _is_gone(use: ProgramUse, package: ProjectPackage) -> bool:
    if use.is_found is False:
        return True
    targets = [target for target in package.cmake.targets.values() if target.output == use.program]
    return package.ros == 2 and bool(targets) and not any(may_be_installed(package, target) for target in targets)
