# SPDX-License-Identifier: Apache-2.0
"""Files and directories of install() commands that do not exist."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator, Mapping
from difflib import get_close_matches

from haros_ci.api import Check, Finding, Level, Project, ProjectPackage, alternatives, regex
from haros_ci.api.launch import similar_files
from haros_ci.api.packages import (
    NO_ENTRIES,
    CMakeCommand,
    brings_files,
    entries_of,
    exports,
    is_ignored,
    is_told_of,
    may_appear,
)

_KINDS = ("FILES", "PROGRAMS", "DIRECTORY")
#: Keywords that end the list of files in install() and similar commands.
_ENDS = regex(
    r"DESTINATION|TYPE|PATTERN|REGEX|RENAME|COMPONENT|PERMISSIONS|\w+_PERMISSIONS|CONFIGURATIONS|FILES_MATCHING|OPTIONAL"
    r"|MESSAGE_NEVER|EXCLUDE|EXCLUDE_FROM_ALL|INSTALL_TO_SHARE|INSTALL_TO_PATH|USE_SOURCE_PERMISSIONS|CONFIG_EXTRAS\w*"
)
#: What a setup.py has that does more than to call setup(), or does it under conditions: it may make the files that it installs.
_DOES_MORE = regex(
    r"(?m)^[ \t]*(?:(?:el)?if(?![ \t(]+__name__)|else|try|while|with)\b|\bif\b[^\n]*\belse\b|\bcmdclass\b|\b(?:exists|isfile|isdir|is_file)\("
    r"|\b(?:open|system|popen|Popen|check_\w+|run|make\w*|mkdir|copy\w*|move|rename|symlink|write\w*|dump|touch|exec|eval|generate\w*|url\w*)\("
)
_REMARKS = regex(r"(?m)#[^\n]*$")
#: Directories that are called in several ways.
_SAME = tuple(
    frozenset(words.split())
    for words in (
        "config configs cfg cfgs conf configuration configurations param params parameter parameters",
        "launch launches launchs launchfiles launch_files",
        "mesh meshes",
        "model models",
        "script scripts",
        "urdf urdfs xacro description robot_description robots",
        "world worlds",
        "map maps",
        "rviz rviz_config rviz_cfg rviz2",
    )
)
#: Directories that are compared with one name.
_MOST = 300
_QUIET = frozenset(("install", "catkin_install_python", "ament_auto_package", "autoware_ament_auto_package"))
_QUIET |= {"cs_install_scripts", "target_include_directories", "include_directories", "find_package", "project"}
#: Endings of what Python and editors write beside a file.
_LEFT = (".pyc", ".pyo", ".bak", ".orig", ".swp", ".save")


def check(project: Project) -> Iterator[Finding]:
    if not project.workspace.names:
        return
    for package in project.packages:
        commands = package.build.commands
        named = frozenset(place for command in commands for word in command.arguments if (place := command.place(word)))
        exported = _exported(package, named)
        if brings_files(package):
            continue
        reported: set[str] = set()
        for command in commands:
            for word in _things(command):
                path = command.place(word)
                if path is None or path in reported or project.exists(path) or may_appear(package, path, _QUIET):
                    continue
                reported.add(path)
                if is_told_of(package, path):
                    continue
                yield _finding(package, command, word, path, exported, named)
    for package in project.packages:
        if package.raw.build_type == "ament_python":
            yield from _of_setup(package)


def _of_setup(package: ProjectPackage) -> Iterator[Finding]:
    """Names in ``data_files`` and ``scripts`` of a setup.py that does nothing but call setup(): distutils takes regular files alone."""
    project, setup = package.project, package.inside("setup.py")
    if _DOES_MORE.search(_REMARKS.sub("", project.text(setup))):
        return
    reported: set[str] = set()
    for item in package.build.installed:
        path = item.path
        if item.location.path != setup or path in reported or path in project.workspace.names:
            continue
        reported.add(path)
        shown = path.removeprefix(f"{package.path}/")
        is_left_out = shown == f"resource/{package.name}" and is_ignored(project.workspace, path)  # no build makes it
        if not is_left_out and (may_appear(package, path, _QUIET) or is_told_of(package, path)):
            continue
        is_directory = project.exists(path)
        why = "a directory, of which setup.py installs files alone" if is_directory else "which is not there"
        instead = _instead(package, path, is_directory)
        if is_left_out:
            why, instead = (
                "which a .gitignore keeps out of the repository",
                f"{instead}, and !{shown} to that .gitignore",
            )
        yield Finding(
            at=item.location,
            message=f"{package.name} installs {shown}, {why}: colcon build stops with an error; {instead}",
            about=(package.name, shown),
            apart=(shown,),
        )


def _instead(package: ProjectPackage, path: str, is_directory: bool) -> str:
    """What to write in setup.py for *path*."""
    shown = path.removeprefix(f"{package.path}/")
    if is_directory:
        return f"write glob('{shown}/*')"
    if "*" in path or "?" in path:
        return f"write glob('{shown}')"
    folder, _, base = path.rpartition("/")
    prefix = f"{folder}/" if folder else ""
    beside = sorted(
        f"{prefix}{name}" for name in entries_of(package.project.workspace.names).get(folder, NO_ENTRIES).names
    )
    near = alternatives([name.removeprefix(prefix) for name in similar_files(path, beside, package.name)])
    if near:
        return f"did you mean {near}?"
    return (
        f"add an empty file {shown}"
        if folder.endswith("resource") and base == package.name
        else "remove the name, or add the file"
    )


def _things(command: CMakeCommand) -> tuple[str, ...]:
    """What a command surely installs from the sources."""
    if command.is_conditional or "OPTIONAL" in command.arguments or "FILES_MATCHING" in command.arguments:
        return ()  # CMake takes a directory that is not there for one without files that match
    words = command.arguments
    if command.name == "install" and words[:1] and words[0] in _KINDS:
        rest = words[1:]
    elif command.name == "catkin_install_python":
        rest = words[1:] if words[:1] in (("PROGRAMS",), ("FILES",)) else words
    elif command.name in ("ament_auto_package", "autoware_ament_auto_package"):
        rest = command.after("INSTALL_TO_SHARE")
    elif command.name == "cs_install_scripts":
        rest = words
    else:
        return ()
    end = next((at for at, word in enumerate(rest) if _ENDS.fullmatch(word)), len(rest))
    return tuple(word for word in rest[:end] if "$" not in word.replace("${ROOT}", "") and word)


def _finding(
    package: ProjectPackage,
    command: CMakeCommand,
    word: str,
    path: str,
    exported: Mapping[str, str],
    named: frozenset[str],
) -> Finding:
    shown = path.removeprefix(f"{package.path}/")
    folder = posixpath.dirname(path)
    prefix = f"{folder}/" if folder else ""
    beside = entries_of(package.project.workspace.names).get(folder, NO_ENTRIES).names
    only = exported.get(posixpath.splitext(path)[1])
    ended = [
        f"{prefix}{name}"
        for name in sorted(beside)
        if posixpath.splitext(name)[0] == posixpath.basename(path) and not name.endswith(_LEFT)
    ]
    near = [only] if only else ended or similar_files(path, sorted(f"{prefix}{name}" for name in beside), package.name)
    meant = alternatives([name.removeprefix(prefix) for name in near])
    alike = _directory_like(path, package, named) if not near and not posixpath.splitext(path)[1] else ""
    if "*" in word or "?" in word:
        hint = "install() does not expand patterns; list the files with file(GLOB), or install the directory"
    elif meant:
        hint = f"did you mean {meant}?"
    elif alike:
        hint = f"did you mean {alike}?"
    elif posixpath.splitext(path)[1]:
        hint = "remove the name, or add the file"
    else:
        hint = f"remove it from the line, or add a file to {shown}: git stores no directory that is empty"
    return Finding(
        at=command.location,
        message=f"{package.name} installs {shown}, which is not there: {_builder(package)} stops with an error; {hint}",
        about=(package.name, shown),
        apart=(shown,),
    )


def _directory_like(path: str, package: ProjectPackage, named: frozenset[str]) -> str:
    """The directory beside *path* that has another name for the same, or nearly its name, and is none of *named*; "" if none or several."""
    folder, _, base = path.rpartition("/")
    prefix = f"{folder}/" if folder else ""
    there = entries_of(package.project.workspace.names).get(folder, NO_ENTRIES).directories
    free = sorted(name for name in there if f"{prefix}{name}" not in named and not name.startswith("."))
    same = next((words for words in _SAME if base.lower() in words), frozenset[str]())
    found = [name for name in free if name.lower() in same] or get_close_matches(base[:100], free[:_MOST], 2, 0.8)
    return found[0] if len(found) == 1 else ""


def _builder(package: ProjectPackage) -> str:
    """The command that installs the package and fails (catkin_make and catkin build install nothing unless they are asked to)."""
    return "catkin_make install" if package.ros == 1 else "colcon build"


def _exported(package: ProjectPackage, installed: frozenset[str]) -> Mapping[str, str]:
    """By suffix, the one file that the manifest exports, that is there and none of *installed*: what is installed has to have it."""
    named = {
        value for export in exports(package) for value in export.attributes.values() if value.startswith("${prefix}/")
    }
    by_suffix: dict[str, list[str]] = {}
    for value in sorted(named):
        if suffix := posixpath.splitext(value)[1]:
            by_suffix.setdefault(suffix, []).append(package.inside(value.removeprefix("${prefix}/")))
    only = {suffix: paths[0] for suffix, paths in by_suffix.items() if len(paths) == 1}
    return {suffix: path for suffix, path in only.items() if package.project.exists(path) and path not in installed}


CHECK = Check(
    id="missing-install-source",
    summary="Installation of a file or directory that does not exist.",
    level=Level.ERROR,
    catalogue="B07",
    tags=("build",),
    project=check,
)
