# SPDX-License-Identifier: Apache-2.0
"""Meshes of robot descriptions that are not there, or that are taken for another format."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator

from haros_ci.api import Check, Finding, Level, Project, listed
from haros_ci.api.launch import meant
from haros_ci.api.robots import Description, Mesh, descriptions, is_left_over, lead, together

#: Places of other meshes in the same directory.
_SHOWN = 40
#: So many meshes of one file that one directory lacks have one cause.
MANY = 4
_SUFFIXES = (".stl", ".dae", ".obj", ".glb", ".gltf", ".ply", ".fbx", ".3ds", ".mesh")

#: Endings of archives that a mesh may be packed into.
_ARCHIVES = (".zip", ".7z", ".rar", ".tar.gz", ".tgz", ".tar.xz", ".gz")


def check(project: Project) -> Iterator[Finding]:
    yield from together(_found(project))


def _found(project: Project) -> Iterator[tuple[str, Finding]]:
    """The findings, each with what makes those at one place one: files that do not exist; each that is there is to be exported anew."""
    meshes = [path for path in project.workspace.names if path.lower().endswith(_SUFFIXES)]
    disguised: set[str] = set()
    for description in descriptions(project):
        again: dict[tuple[str, str | None], list[Mesh]] = {}  # a visual and a collision, by file and mesh
        for mesh in description.robot.meshes:
            again.setdefault((mesh.location.path, mesh.filename), []).append(mesh)
        left_over = not description.command and is_left_over(description.robot.path, project)
        for mesh, *others in _by_directory(again.values(), project, not description.command):
            problem = _problem(mesh, others, description, project, meshes)
            if problem and mesh.path is not None and not mesh.is_missing:
                if mesh.path in disguised:  # several robots may have the one file
                    continue
                disguised.add(mesh.path)
            if problem:
                cause = "" if mesh.is_missing else mesh.filename or ""
                yield cause, _finding(problem, mesh, others, description, project, left_over)


def _problem(mesh: Mesh, others: list[Mesh], description: Description, project: Project, meshes: list[str]) -> str:
    """What is wrong with *mesh* and *others* of its directory, in words; "" if nothing is known to be."""
    problem = fault(mesh, project, meshes) if mesh.filename else ""
    more = len({other.filename for other in others} - {mesh.filename})
    if problem and not description.command and _is_literal(mesh, project):
        return _not_substituted(mesh.filename or "", more)
    if problem and more:
        looked_for = "meshes are" if more > 1 else "mesh is"
        problem += f"; {more} more {looked_for} looked for in the same directory{_lacks(mesh, project, more)}"
    return problem


def _finding(
    problem: str, mesh: Mesh, others: list[Mesh], description: Description, project: Project, left_over: bool
) -> Finding:
    is_literal = not description.command and _is_literal(mesh, project)
    also = ((other.location, _also(other, mesh, is_literal)) for other in others if other.location != mesh.location)
    return Finding(
        at=mesh.location,
        message=problem,
        about=(description.package or description.robot.path, mesh.filename or ""),
        related=tuple(also)[:_SHOWN],
        flow=lead(description, mesh.way),
        apart=(mesh.filename or "",),
        level=Level.NOTE
        if not mesh.is_missing or left_over or _packed(mesh, project)
        else Level.ERROR
        if mesh.certain
        else None,
    )


def _is_literal(mesh: Mesh, project: Project) -> bool:
    """Whether the file name has a ``$(find …)`` in a file that is URDF as it is: who loads it reads the name literally."""
    path = mesh.location.path
    return (
        mesh.is_missing
        and "$(find " in (mesh.filename or "")
        and path.endswith(".urdf")
        and "xmlns:xacro" not in project.text(path)
    )


def _not_substituted(filename: str, more: int) -> str:
    inner = filename.partition("$(find ")[2].replace(")", "", 1)
    others = f" ({more} more {'meshes' if more > 1 else 'mesh'} in this file)" if more else ""
    return (
        f"the mesh {filename} is not found{others}: $(find …) is not substituted in a .urdf, which is loaded as it is; "
        f"write package://{inner}"
    )


def _by_directory(meshes: Iterable[list[Mesh]], project: Project, is_plain: bool) -> list[list[Mesh]]:
    """*meshes* of one description; those of one file in one directory that does not exist at all or has no mesh of their format, which is one slip, together.

    So are those of one file whose names nothing substitutes, where it *is_plain* URDF, and many that one directory lacks: they have other names there.
    """
    found: dict[tuple[str, str], list[Mesh]] = {}
    meshes = list(meshes)
    places = {(_home(mesh[0]), mesh[0].location) for mesh in meshes if mesh[0].is_missing}
    lacking = Counter(home for home, _ in places)
    for number, mesh in enumerate(meshes):
        if is_plain and _is_literal(mesh[0], project):
            found.setdefault((mesh[0].location.path, "$(find "), []).extend(mesh)
            continue
        name = mesh[0].filename or ""
        folder, place = name.rpartition("/")[0], _folder(mesh[0], project)
        wrong = place is not None and mesh[0].is_missing and not _has_kind(project, place, name)
        moved = _moved_to(mesh[0])
        is_one_of_many = mesh[0].is_missing and place is not None and lacking[_home(mesh[0])] >= MANY
        key = folder if wrong else f"{folder}\0{moved}" if moved else f"{folder}\0" if is_one_of_many else f"\0{number}"
        found.setdefault((mesh[0].location.path, key), []).extend(mesh)
    return list(found.values())


def _home(mesh: Mesh) -> tuple[str, str]:
    """The file that names *mesh*, and the directory in which it is looked for."""
    return mesh.location.path, (mesh.filename or "").rpartition("/")[0]


def _moved_to(mesh: Mesh) -> str:
    """The directory of the package that has the file by the same name, where it has been moved; "" if none is known."""
    name = (mesh.filename or "").rpartition("/")[2]
    folder, _, similar = mesh.similar[0].rpartition("/") if mesh.is_missing and len(mesh.similar) == 1 else ("", "", "")
    return folder if similar == name and not folder.startswith("..") else ""


def _folder(mesh: Mesh, project: Project) -> str | None:
    """The root-relative directory in which a package of the workspace is to have the file; None for others."""
    name = mesh.filename or ""
    package = project.package(owner(name))
    inside = name.rpartition("/")[0].partition("://")[2].replace("$(find ", "").replace(")", "")
    return package.inside(inside.partition("/")[2]) if package is not None else None


def _has_kind(project: Project, folder: str, filename: str) -> bool:
    """Whether the root-relative *folder* has a file with the ending of *filename* in it."""
    ending = f".{filename.rpartition('.')[2].lower()}"
    start = f"{folder.rstrip('/')}/"
    names = project.workspace.names
    return project.exists(folder) and any(
        name.startswith(start) and "/" not in name[len(start) :] and name.lower().endswith(ending) for name in names
    )


def _lacks(mesh: Mesh, project: Project, more: int) -> str:
    """What the directory of *mesh* lacks: itself, or any file of the format, or those that lie elsewhere."""
    folder = _folder(mesh, project)
    if (moved := _moved_to(mesh)) and folder is not None and _has_kind(project, folder, mesh.filename or ""):
        return f" and lie{'s' if more == 1 else ''} in {moved}"
    is_there = folder is not None and project.exists(folder)
    if is_there and folder is not None and _has_kind(project, folder, mesh.filename or ""):
        return f", which lacks {'it' if more == 1 else 'them'}, too"
    return f", which has no file *.{(mesh.filename or '').rpartition('.')[2]}" if is_there else ", which does not exist"


def fault(mesh: Mesh, project: Project, meshes: list[str]) -> str:
    """What is wrong with *mesh*; "" if nothing is, or nothing is known."""
    if mesh.is_missing:
        package = project.package(owner(mesh.filename or ""))
        if package is None or not any(package.path == "." or path.startswith(f"{package.path}/") for path in meshes):
            return ""  # a package whose meshes come from elsewhere
        return (
            f"the mesh {mesh.filename} does not exist: the link is not displayed, and collision checks "
            f"fail{_packed(mesh, project) or _of_another_format(mesh, project, meshes) or meant(mesh.similar) or '; add the file, or correct its path'}"
        )
    if mesh.path is not None and mesh.path.lower().endswith(".stl") and is_disguised(project.workspace.head(mesh.path)):
        name = mesh.path.rpartition("/")[2]
        return (
            f"{name} is a binary STL file, but its header begins with 'solid' like a text STL file: a program that does not "
            "compare the size parses it as text and loads no geometry; export it with another header"
        )
    return ""


def _packed(mesh: Mesh, project: Project) -> str:
    """What to do where an archive of the same name lies where the mesh is looked for: whoever has the package is to unpack it."""
    folder, name = _folder(mesh, project), (mesh.filename or "").rpartition("/")[2]
    stem = name.rpartition(".")[0]
    if not folder or not stem:
        return ""
    names = (f"{begin}{ending}" for begin in (stem, name) for ending in _ARCHIVES)
    archive = next((one for one in names if f"{folder.rstrip('/')}/{one}" in project.workspace.names), "")
    return f"; {archive} beside it may hold it: add what is in it, or say that it is to be unpacked" if archive else ""


def _of_another_format(mesh: Mesh, project: Project, meshes: list[str]) -> str:
    """What to do where the directory has a mesh of that name in another format: the ending is wrong, most often that of a macro's argument."""
    folder, name = _folder(mesh, project), (mesh.filename or "").rpartition("/")[2]
    stem = name.rpartition(".")[0]
    start = f"{folder.rstrip('/')}/{stem}." if folder and stem else ""
    there = [
        path.rpartition("/")[2] for path in meshes if start and path.startswith(start) and "." not in path[len(start) :]
    ]
    if not there:
        return ""
    where = "" if name in project.text(mesh.location.path) else " where it is set"
    return f"; the directory has {listed(sorted(there))}: write that ending{where}, or add the file"


def _also(other: Mesh, mesh: Mesh, is_literal: bool) -> str:
    if is_literal and other.filename != mesh.filename:
        return f"{other.filename}, too"
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
