# SPDX-License-Identifier: Apache-2.0
"""Modules that an installed Python script imports from its own directory, and that nothing installs."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from dataclasses import replace

from haros_ci.api import Check, Finding, Level, Location, Project, ProjectPackage
from haros_ci.api.packages import DevelSpaces, Sources, imported, is_built_with_links

#: What lets a script find modules elsewhere, or makes files that are imported.
_SEARCHING = ("sys.path", "load_manifest", "importlib", "__path__", "addsitedir")
_OTHER = (
    "execute_process",
    "externalproject_add",
    "pybind11_add_module",
    "add_custom_command",
    "ament_environment_hooks",
    "ament_python_install_module",
)


def check(project: Project) -> Iterator[Finding]:
    sources, devel = project.sources, DevelSpaces(project)
    for package in project.packages:
        if package.ros is not None and package.build.commands and not package.commands(*_OTHER):
            is_in_place = devel.has(package) if package.ros == 1 else is_built_with_links(project)
            for finding in _of(package, sources):
                yield replace(finding, level=Level.NOTE) if is_in_place else finding


def _of(package: ProjectPackage, sources: Sources) -> Iterator[Finding]:
    project = package.project
    installs = package.build.installed
    if not any(install.kind == "program" for install in installs):
        return
    folders = {directory for _, directory in package.build.python_roots} if package.ros == 1 else set()
    written = "\n".join(project.text(path) for path in sorted(_build_files(package)))
    if ("*" in written and "GLOB" in written) or _is_path_set(package, written):
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
        yield _finding(package, path, uses)


def _finding(package: ProjectPackage, path: str, uses: list[tuple[str, Location]]) -> Finding:
    script, location = uses[0]
    file = path.removesuffix("/__init__.py")
    module = file.rpartition("/")[2].removesuffix(".py")
    fails = (
        "ImportError when started from an install space"
        if package.ros == 1
        else "ModuleNotFoundError, except after colcon build --symlink-install"
    )
    return Finding(
        at=location,
        message=f"{script} imports {module} from its own directory, but CMake installs the script alone: it fails with "
        f"{fails}; {_remedy(package, path, file, script)}",
        about=(package.name, path),
        related=tuple((place, "imports it, too") for _, place in uses[1:5]),
        apart=(module,),
    )


def _remedy(package: ProjectPackage, path: str, file: str, script: str) -> str:
    where = next(install.destination for install in package.build.installed if install.path == script)
    dotted = _dotted(path, package)
    place = f"install {file} to {where or 'the same directory'}, too"
    if dotted and dotted.partition(".")[0] == script.rpartition("/")[2].removesuffix(".py"):  # it finds itself first
        return place
    is_old = package.ros == 1
    if dotted:
        return f"import it as {dotted}, which {'setup.py' if is_old else 'ament_python_install_package()'} installs"
    setup = "catkin_python_setup" if is_old else "ament_python_install_package"
    return f"{place}, or make it a module of a Python package ({setup})"


def _dotted(path: str, package: ProjectPackage) -> str:
    """The name by which the file at *path* can be imported, as a module of a package that is installed; "" where there is none."""
    if package.ros == 2:
        commands = package.commands("ament_python_install_package")
        made = {name for command in commands for name in command.arguments[:1]}
        roots = [(name, at) for name, at in package.build.python_roots if name in made]
        return next((f"{name}.{_below(path, at)}" for name, at in roots if _below(path, at)), "")
    named = {name for name, _ in package.build.python_packages}
    for name, directory in package.build.python_roots:
        below = f"{directory}/" if directory != "." else ""
        inside = path.removeprefix(below).removesuffix(".py").split("/")
        whole = inside if not name else [*name.split("."), *inside]
        if path.startswith(below) and ".".join(whole[:-1]) in named:
            if f"{path.rpartition('/')[0]}/__init__.py" in package.project.workspace.names:
                return ".".join(whole)
    return ""


def _below(path: str, directory: str) -> str:
    """The name in *directory*, of a Python package, of the module at *path*; "" if it is not below it."""
    inner = path.removeprefix(f"{directory}/").removesuffix(".py").removesuffix("/__init__")
    return inner.replace("/", ".") if path.startswith(f"{directory}/") else ""


def _is_path_set(package: ProjectPackage, written: str) -> bool:
    """Whether the build or a launch file may set where Python searches."""
    launch = (
        package.project.text(file.path) for file in package.files if "launch" in (file.language, *file.path.split("."))
    )
    return "PYTHONPATH" in written or any("PYTHONPATH" in text for text in launch)


def _build_files(package: ProjectPackage) -> set[str]:
    return {command.location.path for command in package.build.commands} | {package.inside("setup.py")}


def _sibling(module: str, folder: str, project: Project) -> str:
    """The file of *module* in *folder*, or of a Python package of that name; "" if there is none, or Python has one of that name."""
    base = f"{folder}/" if folder else ""
    names = project.workspace.names
    if module in sys.stdlib_module_names:
        return ""
    # a package has precedence before a module (importlib.machinery.FileFinder)
    paths = (f"{base}{module}/__init__.py", f"{base}{module}.py")
    return next((path for path in paths if path in names), "")


def _is_elsewhere(module: str, package: ProjectPackage, sources: Sources) -> bool:
    """Whether a package of that name, or one that brings a module of that name, may be meant."""
    project = package.project
    known = project.package(module) is not None or bool(project.knowledge.provider_of_module(module))
    return known or module in sources.modules or module in sources.built_modules


def _is_installed(path: str, package: ProjectPackage, written: str) -> bool:
    """Whether anything installs the file, or its name, or that of a Python package's directory, is in a file of the build."""
    name = path.removesuffix("/__init__.py").rpartition("/")[2]
    if re.search(rf"(?<![\w-]){re.escape(name)}(?![\w-])", written):
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
