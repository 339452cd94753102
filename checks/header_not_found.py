# SPDX-License-Identifier: Apache-2.0
"""Headers of packages of the workspace that code includes, and that no file of the workspace is."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator, Mapping

from haros_ci.api import Check, Finding, Level, Location, Project, ProjectPackage, alternatives, equally_near
from haros_ci.api.interfaces import of_include
from haros_ci.api.packages import is_ignored, is_told_of, may_appear, may_have_more

_HEADERS = (".h", ".hpp", ".hh", ".hxx")
_INTERFACES = (".msg", ".srv", ".action", ".idl")
#: Commands that make no headers, though they may name something alike.
_QUIET = frozenset(
    (
        *(
            "add_executable",
            "add_library",
            "target_link_libraries",
            "install",
            "ament_target_dependencies",
            "include_directories",
        ),
        *(
            "target_include_directories",
            "find_package",
            "catkin_package",
            "ament_export_dependencies",
            "add_dependencies",
        ),
        *("set_target_properties", "ament_export_targets", "ament_export_libraries", "target_sources", "project"),
        *(
            "rclcpp_components_register_node",
            "rclcpp_components_register_nodes",
            "pluginlib_export_plugin_description_file",
        ),
    )
)
#: Files that templates make: ``version.h`` of ``version.h.in``.
_TEMPLATES = (".in", ".em", ".j2", ".template", ".tmpl", ".cmake")


class Headers:
    """The headers of the workspace."""

    def __init__(self, project: Project) -> None:
        self.project = project
        self.by_name: dict[str, list[str]] = {}
        self.templates: set[str] = set()
        for path in project.workspace.names:
            name = posixpath.basename(path)
            if name.endswith(_HEADERS):
                self.by_name.setdefault(name, []).append(path)
            elif name.endswith(_TEMPLATES):
                self.templates.add(name.partition(".")[0])

    def are_there(self, header: str) -> bool:
        """Whether some file may be what ``#include`` of *header* means, wherever the compiler looks."""
        ending = f"/{posixpath.normpath(header)}"
        return any(f"/{path}".endswith(ending) for path in self.by_name.get(posixpath.basename(header), ()))

    def below(self, package: ProjectPackage) -> list[str]:
        """The headers of *package* as code includes them: what follows ``include/``, below its own name."""
        begin = f"{package.inside('include')}/"
        found = (
            path.removeprefix(begin) for paths in self.by_name.values() for path in paths if path.startswith(begin)
        )
        return sorted(item for item in found if item.startswith(f"{package.name}/"))


def check(project: Project) -> Iterator[Finding]:
    if project.absent or not project.workspace.names:
        return
    headers = Headers(project)
    owners: dict[str, list[str] | None] = {}
    for package in project.packages:
        reported: set[str] = set()
        for name, place in _included(package):
            owner = project.package(name.partition("/")[0])
            if name in reported or owner is None or headers.are_there(name):
                continue
            if _is_of_an_interface(owner, name):
                continue  # undefined-interface
            if owner.name not in owners:
                owners[owner.name] = headers.below(owner) if _is_known(owner) else None
            known = owners[owner.name]
            if known and not _may_be_made(headers, owner, package, name):
                reported.add(name)
                yield _finding(package, owner, name, place, known)


def _included(package: ProjectPackage) -> Iterator[tuple[str, Location]]:
    """Headers that files which every build compiles include in every build, and that are none of the package's own files."""
    for target in package.build.targets:
        if target.kind in ("executable", "library", "object") and not target.is_conditional:
            found: Mapping[str, Location] = package.included.of(target)
            yield from ((name, place) for name, place in found.items() if "/" in name and name.endswith(_HEADERS))


def _is_of_an_interface(owner: ProjectPackage, name: str) -> bool:
    """Whether the header is, or may be, one that is made of a message, service or action of *owner*, however that is spelt."""
    stem = posixpath.basename(name).partition(".")[0].replace("_", "").lower()
    files = (item for item in owner.project.below(owner.path) if item.endswith(_INTERFACES))
    stems = {posixpath.basename(file).partition(".")[0].replace("_", "").lower() for file in files}
    return any(stem.startswith(item) for item in stems) or (bool(stems) and of_include(name) is not None)


def _is_known(owner: ProjectPackage) -> bool:
    """Whether all that makes headers of *owner* is known."""
    return owner.ros is not None and owner.cmake.is_whole and not may_have_more(owner)


def _may_be_made(headers: Headers, owner: ProjectPackage, package: ProjectPackage, name: str) -> bool:
    stem = posixpath.basename(name).partition(".")[0]
    if stem in headers.templates or stem.endswith("Config"):
        return True
    if any(parameter_library.name == stem for parameter_library in owner.build.parameter_libraries):
        return True
    paths = (f"include/{name}", name, f"src/{name}")
    return any(
        may_appear(other_package, other_package.inside(path), _QUIET)
        or is_ignored(other_package.project.workspace, other_package.inside(path))
        for other_package in {owner.name: owner, package.name: package}.values()
        for path in paths
    ) or is_told_of(owner, owner.inside(f"include/{name}"))


def _finding(package: ProjectPackage, owner: ProjectPackage, name: str, place: Location, known: list[str]) -> Finding:
    base = posixpath.basename(name)
    same = [path for path in known if posixpath.basename(path).lower() == base.lower()]
    found = alternatives(same if len(same) == 1 else equally_near(name, known, 0.8))
    hint = f"; did you mean {found}?" if found else ""
    whose = "the package itself has" if owner is package else f"{owner.name} has"
    return Finding(
        at=place,
        message=f"{name} is included, but {whose} no such header, nor has any other package of the workspace: this file does not build{hint}",
        about=(package.name, name),
        apart=(name,),
    )


CHECK = Check(
    id="header-not-found",
    summary="Header of a package of the workspace that does not exist.",
    level=Level.WARNING,
    tags=("build",),
    profiles=("strict",),
    project=check,
)
