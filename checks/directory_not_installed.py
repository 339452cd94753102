# SPDX-License-Identifier: Apache-2.0
"""Launch files, configuration, models and headers that something needs and that are not installed, or not to there."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from haros_ci.api import Check, Finding, Level, Location, Project, ProjectPackage, dataclass, field, listed, regex
from haros_ci.api.launch import share_uses
from haros_ci.api.packages import (
    CMakeCommand,
    DevelSpaces,
    Leftovers,
    Programs,
    describes_installed,
    install_commands,
    install_directory,
    install_line,
    install_place,
    installs_nothing,
    lacks_interface,
    landings,
    left_out_on_purpose,
    lost_plugins,
    uninstalled,
)

_LAUNCH = regex(r"\.launch(?:\.(?:py|xml|ya?ml))?$|[_-]launch\.(?:py|xml|ya?ml)$|^launch/.*\.xml$")
_ASIDE = regex(r"(?:^|[/_-])(?:tests?|testing|examples?|demos?|samples?|benchmarks?|mock|old|deprecated)(?:$|[/_.-])")
_OF_ROS1 = regex(r"<node\b[^<>]*\stype\s*=|\$\(arg\s")
#: So many places that need something are shown.
_SHOWN = 5
_HEADERS = (".h", ".hpp", ".hh", ".hxx", ".ipp", ".tpp")


@dataclass(slots=True)
class _Need:
    """A directory of a package, or a file beside its manifest, that something needs."""

    places: list[tuple[Location, str]] = field(default_factory=list)
    wrong: str = ""
    #: The paths that are needed of it, from the package on.
    paths: dict[str, None] = field(default_factory=dict)


def check(project: Project) -> Iterator[Finding]:
    needs = _used(project)
    leftovers, devel = Leftovers(project), DevelSpaces(project)
    for package in project.packages:
        if _is_readable(package):
            for folder in _launch_folders(package, leftovers):
                needs.setdefault((package.name, folder), _Need())
            yield from _headers(package, devel)
    needed, programs = _needed(project, needs), Programs(project)
    wanting: dict[str, dict[str, _Need]] = {}
    for (name, thing), need in needs.items():
        wanting.setdefault(name, {})[thing] = need
    for name, asked in wanting.items():
        owner = project.package(name)
        if owner is None or not (things := _lacking(owner, asked)):
            continue
        is_alone = len(things) == 1 and owner.ros == 2
        if not installs_nothing(owner):
            for thing, need in things.items():
                is_idle = ((name, thing) not in needed or devel.has(owner)) and not describes_installed(owner, thing)
                yield _finding(owner, thing, need, is_idle)
        elif all(other_uninstalled.level is Level.NOTE for other_uninstalled in uninstalled(owner, programs)):
            # else target-not-installed tells that the package has no install() at all
            yield (
                _finding(owner, *next(iter(things.items())), devel.has(owner)) if is_alone else _nothing(owner, things)
            )


def _used(project: Project) -> dict[tuple[str, str], _Need]:
    """What something uses of a package, by package and directory or file, and is not installed to there."""
    needs: dict[tuple[str, str], _Need] = {}
    for place, name, inner in share_uses(project):
        package = project.package(name)
        if package is None or not _is_readable(package):
            continue
        path = package.inside(inner)
        if not project.exists(path) or _is_made(package, inner) or _ASIDE.search(place.path.lower()):
            continue
        found = landings(package, path)
        if f"share/{name}/{inner}" in found or any("$" in item for item in found) or _is_filled(package, path, inner):
            continue
        need = needs.setdefault((name, inner.partition("/")[0]), _Need())
        need.places.append((place, f"needs {inner}"))
        need.paths[inner] = None
        need.wrong = need.wrong or next(iter(found), "")
    return needs


def _lacking(package: ProjectPackage, things: Mapping[str, _Need]) -> dict[str, _Need]:
    """Those of *things* that are not left out on purpose, and of which no other check speaks."""
    meant = left_out_on_purpose(package)
    lacking = {thing: need for thing, need in things.items() if need.wrong or thing not in meant}
    if package.ros != 1 or installs_nothing(package):
        return lacking
    # target-not-installed tells of plug-ins' descriptions with the library
    reported = {plugin.location.path for plugins in lost_plugins(package).values() for plugin in plugins}
    return {thing: need for thing, need in lacking.items() if not _is_reported(package, thing, need, reported)}


def _is_filled(package: ProjectPackage, path: str, inner: str) -> bool:
    """Whether files of the directory at *path* are installed one by one to where it is looked for: by ``glob()`` in data_files."""
    place = f"share/{package.name}/{inner}".rstrip("/")
    return any(
        row.path.startswith(f"{path.rstrip('/')}/") and row.destination in (place, f"{place}/")
        for row in package.build.installed
    )


def _needed(project: Project, needs: Mapping[tuple[str, str], _Need]) -> set[tuple[str, str]]:
    """Those of *needs* that something needs which is installed, or ought to be: a launch directory, or what is needed in turn."""
    owners = {file.path: file.package for file in project.workspace.files}
    needed = {key for key, need in needs.items() if not need.places}
    keys: dict[str, tuple[str, str] | None] = {}
    for need in needs.values():
        for place, _ in need.places:
            package = project.package(owners.get(place.path) or "")
            if package is None or not _is_readable(package) or place.path == package.manifest_path:
                keys[place.path] = None
            elif place.path not in keys:
                inner = place.path if package.path == "." else place.path.removeprefix(f"{package.path}/")
                is_kept = bool(landings(package, place.path)) or _is_made(package, inner)
                keys[place.path] = None if is_kept else (package.name, inner.partition("/")[0])
    before = -1
    while len(needed) != before:
        before = len(needed)
        for key, need in needs.items():
            if any(keys[place.path] is None or keys[place.path] in needed for place, _ in need.places):
                needed.add(key)
    return needed


def _is_reported(package: ProjectPackage, thing: str, need: _Need, reported: set[str]) -> bool:
    """Whether *thing* describes plug-ins whose library is not installed, either, and the manifest alone needs it."""
    return package.inside(thing) in reported and all(place.path == package.manifest_path for place, _ in need.places)


def _is_readable(package: ProjectPackage) -> bool:
    """Whether all that the package installs is known."""
    if package.ros is None or package.raw.is_metapackage or re.search(r"(?:^|_)tests?(?:$|_)", package.name):
        return False
    if "data_files" in package.project.text(package.inside("setup.cfg")):
        return False
    if any("computed when setup.py runs" in problem.message for problem in package.build.problems):
        return False
    if package.build.commands:
        things = (thing for install in package.cmake.installs if install.kind != "TARGETS" for thing in install.things)
        return package.cmake.is_whole and not any("${" in thing.replace("${ROOT}", "") for thing in things)
    return package.ros == 2 and package.inside("setup.py") in package.project.workspace.names


def _is_made(package: ProjectPackage, inner: str) -> bool:
    """Whether a command that is not known here may install the file: it names it, or its directory."""
    folder = inner.partition("/")[0]
    return any(
        word == folder or word.endswith(f"/{folder}") or word.startswith(f"{folder}/") or f"/{folder}/" in word
        for word in package.cmake.mentioned
    )


def _launch_folders(package: ProjectPackage, leftovers: Leftovers) -> Iterator[str]:
    """Directories with launch files of which none is installed (ROS 2: ros2 launch finds none of them)."""
    if package.ros != 2:
        return
    files: dict[str, list[str]] = {}
    for file in package.files:
        inner = file.path.removeprefix(f"{package.path}/")
        if file.language in ("launch", "python", "xml") and _LAUNCH.search(inner) and "/" in inner:
            if _OF_ROS1.search(package.project.text(file.path)):
                continue  # left from before the package came to ROS 2
            if "launch" in inner.partition("/")[0] and not _ASIDE.search(inner.lower()):
                files.setdefault(inner.partition("/")[0], []).append(file.path)
    for folder, paths in files.items():
        is_left = _is_made(package, f"{folder}/") or all(leftovers.starts_only_gone(path, package) for path in paths)
        if not is_left and not any(landings(package, path) for path in paths):
            yield folder


def _headers(package: ProjectPackage, devel: DevelSpaces) -> Iterator[Finding]:
    """An exported include directory that is not installed."""
    root = package.inside("include")
    headers = [file.path for file in package.files if file.path.startswith(f"{root}/") and file.path.endswith(_HEADERS)]
    headers = [path for path in headers if not lacks_interface(path, package)]
    if not headers or _is_made(package, "include/") or (package.ros == 1 and installs_nothing(package)):
        return  # of ROS 1 what installs nothing at all is built for its devel space
    exports = [
        command
        for command in package.commands(
            "ament_export_include_directories", "ament_export_targets", "ament_export_libraries"
        )
        if command.name != "ament_export_include_directories" or any(w.startswith("include") for w in command.arguments)
    ]
    exports.sort(key=lambda export: export.name != "ament_export_include_directories")
    keywords = ("LIBRARIES", "CATKIN_DEPENDS", "DEPENDS", "CFG_EXTRAS", "EXPORTED_TARGETS")
    catkin = (c for c in package.commands("catkin_package") if "include" in c.after("INCLUDE_DIRS", *keywords))
    command = next((export for export in (*exports, *catkin) if not export.is_conditional), None)
    if command is None or any(landings(package, path) for path in headers):
        return
    name = f"include/{package.name}"
    users = [
        other.name
        for other in package.project.packages
        if other.name != package.name and package.name in other.declared
        if any(include.startswith(f"{package.name}/") for include in _includes(other))
    ]
    is_old = package.ros == 1
    line = (
        f"install(DIRECTORY {name}/ DESTINATION ${{CATKIN_PACKAGE_INCLUDE_DESTINATION}})"
        if is_old
        else "install(DIRECTORY include/ DESTINATION include/${PROJECT_NAME})"
    )
    fix = install_line(package, line, "install the headers")
    is_usual = (
        is_old
        and package.project.exists(package.inside(name))
        or "include/${PROJECT_NAME}" in package.project.text(package.cmake_path)
    )
    if command.name in ("ament_export_targets", "ament_export_libraries") and not users:
        return  # libraries that are only loaded: plug-ins
    kinds = {target.kind for target in package.build.targets if not target.is_test}
    libraries = package.commands("ament_export_targets", "ament_export_libraries")
    is_private = not users and (kinds == {"executable"} or bool(kinds) and not is_old and not libraries)  # for nobody
    is_private = is_private or (is_old and not users and _is_own(package, command)) or devel.has(package)
    who = f"{users[0]} includes them" if users else "packages that use it cannot find them"
    yield Finding(
        at=command.location,
        message=f"the headers in include are exported but not installed: {who}; install the directory",
        about=(package.name, "include"),
        level=Level.NOTE if is_private else Level.ERROR if users and not is_old else Level.WARNING,
        related=((Location(headers[0]), "such a header"),),
        fixes=(fix,) if fix is not None and is_usual else (),
    )


def _is_own(package: ProjectPackage, command: CMakeCommand) -> bool:
    """Whether a package of ROS 1 is for its workspace alone, where no package includes its headers: it was never released and exports no library."""
    knowledge = package.project.knowledge
    if not knowledge.is_there or knowledge.is_package(package.name):
        return False
    exported = command.after("LIBRARIES", "INCLUDE_DIRS", "CATKIN_DEPENDS", "DEPENDS", "CFG_EXTRAS", "EXPORTED_TARGETS")
    return not any("$" in name or name in package.cmake.targets for name in exported)


def _includes(package: ProjectPackage) -> Iterator[str]:
    for file in package.files:
        program = package.project.programs.get(file.path) if file.language == "cpp" else None
        yield from (name.strip('<>"') for name in program.includes) if program is not None else ()


def _nothing(package: ProjectPackage, things: Mapping[str, _Need]) -> Finding:
    """One finding for a package without any install rule; a note in ROS 1, where such a package is used from its devel space."""
    names = ", ".join(things)
    places = list(dict.fromkeys(place for need in things.values() for place in need.places))
    fix = install_line(package, install_commands(package, things), f"install {names}")
    is_needed = bool(places) and package.ros == 2
    finder = "ros2 launch and nodes" if package.ros == 2 else "in an install space roslaunch and nodes"
    return Finding(
        at=install_place(package),
        message=f"{package.name} has no install() at all: {finder} do not find {names}",
        about=(package.name, *things),
        apart=tuple(things),
        related=tuple(places[:_SHOWN]),
        level=Level.ERROR if is_needed else Level.WARNING if package.ros == 2 else Level.NOTE,
        fixes=(fix,) if fix is not None else (),
    )


def _finding(package: ProjectPackage, thing: str, need: _Need, is_idle: bool) -> Finding:
    is_folder = package.inside(thing) in package.project.directories
    is_old = package.ros == 1
    lone = tuple(need.paths) if is_folder and not need.wrong and _is_in_part(package, thing) else ()
    what = f"the directory {thing}" if is_folder and not lone else f"the file {lone[0] if lone else thing}"
    if len(lone) > 1:
        what = f"the files {listed(lone)}"
    fix, verb = None, "are" if len(lone) > 1 else "is"
    if need.wrong:
        message = (
            f"{what} of {package.name} {verb} installed to {need.wrong}, but used from share/{package.name}/{thing}; "
        )
        message += _right_place(package, thing, need)
    elif need.places:
        place, more = need.places[0][0], len(need.places) - 1
        also = f" and {more} more place{'s' if more > 1 else ''} need" if more else " needs"
        them = "them" if len(lone) > 1 else "it"
        rest = f" with the other files of {thing}" if lone and not package.build.commands else ""
        how = f"{_how(package, is_folder and not lone, them)}{rest}"
        message = f"{what} of {package.name} {verb} not installed, but {place.path}:{place.line}{also} {them}; {how}"
    else:
        message = f"{what} of {package.name} is not installed: ros2 launch finds none of its launch files; "
        message += _how(package, is_folder)
    if not need.wrong and is_folder and not lone and package.build.commands:
        fix = install_directory(package, thing)
    return Finding(
        at=install_place(package),
        message=message,
        about=(package.name, thing),
        apart=(thing,),
        related=tuple(need.places[:_SHOWN]),
        level=Level.NOTE
        if is_idle and not need.wrong and (need.places or is_old)
        else Level.ERROR
        if need.places and not is_old
        else Level.WARNING,
        fixes=(fix,) if fix is not None else (),
    )


def _right_place(package: ProjectPackage, thing: str, need: _Need) -> str:
    """What to write where *thing* is installed elsewhere: install() puts a directory itself into the destination, and with a slash behind it what is inside."""
    share, folder = f"share/{package.name}", package.inside(thing)
    if f"{need.wrong}/".startswith(f"{share}/{thing}/{thing}/"):
        return f"write DIRECTORY {thing}/ with a slash, or leave {thing} out of the destination"
    rows = (row for row in package.build.installed if row.kind == "directory" and row.path == folder)
    if any(row.destination.rstrip("/") == share for row in rows):
        return f"write DIRECTORY {thing} without a slash, which installs the directory itself"
    return "correct the destination"


def _is_in_part(package: ProjectPackage, folder: str) -> bool:
    """Whether some files of the directory are installed."""
    return any(landings(package, path) for path in package.project.below(package.inside(folder)))


def _how(package: ProjectPackage, is_folder: bool, them: str = "it") -> str:
    """What to write so that it is installed."""
    if not package.build.commands:
        return f"install {them}"
    return f"add {them} to install({'DIRECTORY' if is_folder else 'FILES'} ...)"


CHECK = Check(
    id="directory-not-installed",
    summary="Launch files, configuration, models or headers that are used but not installed.",
    level=Level.ERROR,
    catalogue="B06",
    tags=("build",),
    project=check,
)
