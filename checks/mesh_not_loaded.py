# SPDX-License-Identifier: Apache-2.0
"""Meshes of robot descriptions that are not there, or that are taken for another format."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from haros_ci.api import Check, Finding, Level, Project
from haros_ci.api.launch import meant
from haros_ci.api.robots import Mesh, descriptions, lead

#: Places of other meshes in the same directory.
_SHOWN = 40
_SUFFIXES = (".stl", ".dae", ".obj", ".glb", ".gltf", ".ply", ".fbx", ".3ds", ".mesh")


def check(project: Project) -> Iterator[Finding]:
    meshes = [path for path in project.workspace.names if path.lower().endswith(_SUFFIXES)]
    disguised: set[str] = set()
    for description in descriptions(project):
        again: dict[tuple[str, str | None], list[Mesh]] = {}  # a visual and a collision, by file and mesh
        for mesh in description.robot.meshes:
            again.setdefault((mesh.location.path, mesh.filename), []).append(mesh)
        for mesh, *others in _by_directory(again.values(), project):
            said = fault(mesh, project, meshes) if mesh.filename else ""
            more = len({each.filename for each in others} - {mesh.filename})
            if said and more:
                said += f"; {more} more {'meshes are' if more > 1 else 'mesh is'} looked for in the same directory, which does not exist"
            if said and mesh.path is not None and not mesh.is_missing:
                if mesh.path in disguised:  # several robots may have the one file
                    continue
                disguised.add(mesh.path)
            if said:
                yield Finding(
                    at=mesh.location,
                    message=said,
                    about=(description.package or description.robot.path, mesh.filename or ""),
                    related=tuple(
                        (each.location, _also(each, mesh)) for each in others if each.location != mesh.location
                    )[:_SHOWN],
                    flow=lead(description, mesh.way),
                    apart=(mesh.filename or "",),
                    level=Level.NOTE if not mesh.is_missing else Level.ERROR if mesh.certain else None,
                )


def _by_directory(meshes: Iterable[list[Mesh]], project: Project) -> list[list[Mesh]]:
    """*meshes* of one description; those of one file in one directory that does not exist at all, which is one slip, together."""
    found: dict[tuple[str, str], list[Mesh]] = {}
    for number, each in enumerate(meshes):
        folder = (each[0].filename or "").rpartition("/")[0]
        inside = folder.partition("://")[2].replace("$(find ", "").replace(")", "")
        package = project.package(owner(each[0].filename or ""))
        wrong = (
            package is not None and each[0].is_missing and not project.exists(package.inside(inside.partition("/")[2]))
        )
        found.setdefault((each[0].location.path, folder if wrong else f"\0{number}"), []).extend(each)
    return list(found.values())


def fault(mesh: Mesh, project: Project, meshes: list[str]) -> str:
    """What is wrong with *mesh*; "" if nothing is, or nothing is known."""
    if mesh.is_missing:
        package = project.package(owner(mesh.filename or ""))
        if package is None or not any(package.path == "." or path.startswith(f"{package.path}/") for path in meshes):
            return ""  # a package whose meshes come from elsewhere
        return (
            f"the mesh {mesh.filename} does not exist: the link is not displayed, and collision checks "
            f"fail{meant(mesh.similar)}"
        )
    if mesh.path is not None and mesh.path.lower().endswith(".stl") and is_disguised(project.workspace.head(mesh.path)):
        name = mesh.path.rpartition("/")[2]
        return (
            f"{name} is a binary STL file, but its header begins with 'solid' like a text STL file: a program that does not "
            "compare the size parses it as text and loads no geometry; export it with another header"
        )
    return ""


def _also(other: Mesh, mesh: Mesh) -> str:
    return "here, too" if other.filename == mesh.filename else f"{other.filename}, in the same directory"


def owner(filename: str) -> str:
    """The package that a mesh's file name is in."""
    for start in ("package://", "file://$(find "):
        if filename.startswith(start):
            return filename[len(start) :].replace(")", "/").partition("/")[0]
    return ""


def is_disguised(head: bytes) -> bool:
    """Whether a file that begins so is a binary STL (80 bytes of header, 4 of a count, of which some are 0) that begins as text."""
    return head[:5].lower() == b"solid" and len(head) >= 84 and b"\0" in head


CHECK = Check(
    id="mesh-not-loaded",
    summary="Mesh of a robot description that does not exist or has the wrong format.",
    level=Level.WARNING,
    catalogue="X04",
    tags=("robot-description",),
    project=check,
)
