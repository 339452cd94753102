# SPDX-License-Identifier: Apache-2.0
"""Modules that an installed Python script of ROS 1 imports from its own directory, and that nothing installs."""

from __future__ import annotations

import sys
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, ProjectPackage
from haros_ci.api.packages import Sources, imported

#: What lets a script find modules elsewhere, or makes files that are imported.
_SEARCHING = ("sys.path", "load_manifest", "importlib", "__path__", "addsitedir")
_OTHER = ("execute_process", "externalproject_add", "pybind11_add_module", "add_custom_command")


def check(project: Project) -> Iterator[Finding]:
    sources = project.sources
    for package in project.packages:
        if package.ros == 1 and package.build.commands and not package.commands(*_OTHER):
            yield from _of(package, sources)


def _of(package: ProjectPackage, sources: Sources) -> Iterator[Finding]:
    project = package.project
    installs = package.build.installed
    if not any(install.kind == "program" for install in installs):
        return
    folders = {directory for _, directory in package.build.python_roots}
    written = "\n".join(project.text(path) for path in sorted(_build_files(package)))
    if "*" in written and "GLOB" in written:
        return
    missing: dict[str, list[tuple[str, Location]]] = {}
    for script in sorted({install.path for install in installs if install.kind == "program"}):
        folder, _, base = script.rpartition("/")
        text = project.text(script)
        is_python = base.endswith(".py") or ("." not in base and "python" in text.partition("\n")[0])
        if not is_python or folder in folders or any(word in text for word in _SEARCHING):
            continue
        for module, location in imported(script, text, project.programs.get(script)):
            path = _sibling(module, folder, project)
            if path and not _is_elsewhere(module, package, sources) and not _is_installed(path, package, written):
                missing.setdefault(path, []).append((script, location))
    for path, uses in missing.items():
        script, location = uses[0]
        module = path.rpartition("/")[2].removesuffix(".py")
        where = next(install.destination for install in installs if install.path == script)
        dotted = _dotted(path, package)
        place = f"install {path} to {where or 'the same directory'}, too"
        is_shadowed = dotted.partition(".")[0] == script.rpartition("/")[2].removesuffix(".py")  # it finds itself first
        remedy = (
            (place if is_shadowed else f"import it as {dotted}, which setup.py installs")
            if dotted
            else f"{place}, or make it a module of a Python package (catkin_python_setup)"
        )
        yield Finding(
            at=location,
            message=f"{script} imports {module} from its own directory, but CMake installs the script alone: it fails with "
            f"ImportError when started from an install space; {remedy}",
            about=(package.name, path),
            related=tuple((place, "imports it, too") for _, place in uses[1:5]),
            apart=(module,),
        )


def _dotted(path: str, package: ProjectPackage) -> str:
    """The name by which the file at *path* can be imported, as a module of a package that setup.py names; "" where there is none."""
    named = {name for name, _ in package.build.python_packages}
    for name, directory in package.build.python_roots:
        below = f"{directory}/" if directory != "." else ""
        inside = path.removeprefix(below).removesuffix(".py").split("/")
        whole = inside if not name else [*name.split("."), *inside]
        if path.startswith(below) and ".".join(whole[:-1]) in named:
            if f"{path.rpartition('/')[0]}/__init__.py" in package.project.workspace.names:
                return ".".join(whole)
    return ""


def _build_files(package: ProjectPackage) -> set[str]:
    return {command.location.path for command in package.build.commands} | {package.inside("setup.py")}


def _sibling(module: str, folder: str, project: Project) -> str:
    """The file of *module* in *folder*; "" if there is none, or Python has one of that name."""
    base = f"{folder}/" if folder else ""
    names = project.workspace.names
    if module in sys.stdlib_module_names or f"{base}{module}/__init__.py" in names:
        return ""
    path = f"{base}{module}.py"
    return path if path in names else ""


def _is_elsewhere(module: str, package: ProjectPackage, sources: Sources) -> bool:
    """Whether a package of that name, or one that brings a module of that name, may be meant."""
    project = package.project
    known = project.package(module) is not None or bool(project.knowledge.provider_of_module(module))
    return known or module in sources.modules or module in sources.built_modules


def _is_installed(path: str, package: ProjectPackage, written: str) -> bool:
    """Whether anything installs the file, or its name is in a file of the build."""
    if path.rpartition("/")[2] in written:
        return True
    return any(
        installed.path == path
        or (installed.kind == "directory" and (installed.path == "." or path.startswith(f"{installed.path}/")))
        for installed in package.build.installed
    )


CHECK = Check(
    id="module-not-installed",
    summary="Python module that an installed script imports and nothing installs.",
    level=Level.WARNING,
    tags=("packages", "build"),
    project=check,
)
